#include "app/moduli_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/load_case.hpp"
#include "core/error.hpp"
#include "structure/load_surface.hpp"
#include "structure/network_moduli.hpp"

namespace pliant {
namespace {

struct ModuliArguments {
  CaseArguments input;
  std::string body;
  bool as_json = false;
};

struct Row {
  std::string key, text;
  std::optional<double> asked, found;
};

std::vector<Row> rows_of(const MeasuredModuli& m) {
  std::vector<Row> rows;
  if (m.asked.young_across) {
    rows.push_back({"young_along", "Young's modulus along the fibre", m.asked.young, m.plane.young_along()});
    rows.push_back({"young_across", "Young's modulus across it", m.asked.young_across, m.plane.young_across()});
  } else if (m.asked.young) {
    rows.push_back({"area", "area modulus K", m.asked.area, m.plane.area()});
    if (m.inflation) rows.push_back({"area_by_inflation", "K by inflation", m.asked.area, m.inflation});
    rows.push_back({"shear", "shear modulus G", m.asked.shear, m.plane.shear()});
    rows.push_back({"young", "Young's modulus Y", m.asked.young, m.plane.young()});
    rows.push_back({"poisson", "Poisson's ratio", m.asked.poisson, m.plane.poisson()});
  }
  if (m.asked.bending) rows.push_back({"bending", "bending modulus B", m.asked.bending, m.bending.rolling()});
  return rows;
}

std::string deviation(const Row& row) {
  if (!row.asked || !row.found || *row.asked == 0) return "-";
  return fmt::format("{:+.2f} %", 100 * (*row.found / *row.asked - 1));
}

void print_text(const BodyConfig& body, const MeasuredModuli& m) {
  fmt::print("body {}: {} flat patch{} of {} vertices\n", body.name, m.n_patches, m.n_patches == 1 ? "" : "es",
             m.n_vertices);
  fmt::print("{:<34}{:>12}{:>12}{:>12}\n", "modulus, per length", "asked for", "found", "deviation");
  for (const Row& row : rows_of(m))
    fmt::print("{:<34}{:>12.6g}{:>12.6g}{:>12}\n", row.text, row.asked.value_or(0), row.found.value_or(0),
               deviation(row));
}

void print_json(const BodyConfig& body, const MeasuredModuli& m) {
  nlohmann::ordered_json report{{"body", body.name}, {"patches", m.n_patches}, {"vertices", m.n_vertices}};
  for (const Row& row : rows_of(m)) report[row.key] = {{"asked", *row.asked}, {"found", *row.found}};
  const auto along_axes = [](const SheetStiffness& s) -> nlohmann::ordered_json {
    return {{"c11", s.c11}, {"c22", s.c22}, {"c12", s.c12}, {"c66", s.c66}, {"c16", s.c16}, {"c26", s.c26}};
  };
  if (m.asked.young) report["plane_stiffness"] = along_axes(m.plane);
  if (m.asked.bending) report["bending_stiffness"] = along_axes(m.bending);
  fmt::print("{}\n", report.dump(2));
}

int moduli(const ModuliArguments& arguments) {
  const auto config = load_case(arguments.input, 1);
  const auto found = std::find_if(config.bodies.begin(), config.bodies.end(),
                                  [&](const BodyConfig& body) { return body.name == arguments.body; });
  if (found == config.bodies.end()) {
    std::string names;
    for (const auto& body : config.bodies) names += (names.empty() ? "" : ", ") + body.name;
    throw InputError(fmt::format("{}: has no body \"{}\"; it has {}", config.file.string(), arguments.body,
                                 names.empty() ? "none" : names));
  }
  if (found->motion != MotionKind::deformable)
    throw InputError(fmt::format(
        "{}: the vertices of body \"{}\" keep their distances; only bodies with motion = \"deformable\" have "
        "moduli",
        config.file.string(), arguments.body));
  const auto measured = find_moduli(*found, load_shape(*found, config.folder));
  arguments.as_json ? print_json(*found, measured) : print_text(*found, measured);
  return exit_success;
}

}  // namespace

void add_moduli_command(CLI::App& mesh, Action& action) {
  auto arguments = std::make_shared<ModuliArguments>();
  auto* command = mesh.add_subcommand(
      "moduli", "Stretch, inflate and bend a body's network; print the moduli it has against those asked for");
  add_case_arguments(*command, arguments->input);
  command->add_option("BODY", arguments->body, "The name of the body")->required();
  command->add_flag("--json", arguments->as_json, "Print JSON, and nothing else");
  command->callback([arguments, &action] {
    action = [arguments](const Communicator& ranks) -> int {
      return ranks.is_root() ? moduli(*arguments) : static_cast<int>(exit_success);
    };
  });
}

}  // namespace pliant
