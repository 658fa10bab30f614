#include "config/reference.hpp"

#include <fmt/format.h>

#include "config/key_table.hpp"

namespace pliant {
namespace {
std::string text_of_default(const Json& value, Presence presence) {
  if (presence == Presence::required) return "required";
  return value.is_null() ? "none" : fmt::format("`{}`", value.dump());
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

template <class Config>
std::string row(const Key<Config>& key, const std::string& path) {
  std::string doc = key.doc;
  if (!key.condition.empty()) doc += fmt::format(". Only when {}", key.condition);
  if (!key.excludes.empty()) {
    std::string others;
    for (const auto& other : key.excludes) others += (others.empty() ? "`" : ", `") + other + "`";
    doc += ". Not together with " + others;
  }
  const auto legal = key.legal.empty() ? (key.type.find("number") != std::string::npos ? "finite" : "any") : key.legal;
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", path, key.type, or_dash(key.unit),
                     text_of_default(key.default_value, key.presence), legal, doc);
}

std::string table_head() { return "| key | type | unit | default | legal | what it is |\n|---|---|---|---|---|---|\n"; }

std::string section_of(const std::string& path) { return path.substr(0, path.find('.')); }
}  // namespace

std::string case_reference() {
  std::string text =
      "# The case file: every key\n\n"
      "Written by `pliant reference` from the table that the reader uses; do not edit by hand.\n\n"
      "A case is a TOML file. Unknown keys are errors. Integers are accepted where numbers are asked. Numbers are in\n"
      "any consistent set of units; with [units] a text such as \"25 mm\" may stand for any number whose unit column "
      "gives "
      "a dimension\n([units.md](units.md)). On the command line `--set key.path=value` overrides a key;\n"
      "bodies go by name: `--set body.drop.potentials.edge.stiffness=300`.\n";
  std::string section;
  for (const auto& key : case_keys()) {
    auto path = key.path;
    if (section_of(path) != section) {
      section = section_of(path);
      text += path == section ? "\n## The case\n\n" : fmt::format("\n## [{}]\n\n", section);
      if (section == "boundary")
        text +=
            "SIDE is one of `x-`, `x+`, `y-`, `y+`, `z-`, `z+` (in quotes: `\"z+\"`), or `x`, `y`, `z` for both "
            "sides\nof a direction. A word alone, `x = \"periodic\"`, is short for `x = { type = \"periodic\" }`. "
            "Both sides of a\ndirection are periodic, or neither.\n\n";
      text += table_head();
    }
    if (section == "boundary" && path.find("x-") == std::string::npos) continue;
    if (section == "boundary") path.replace(path.find("x-"), 2, "SIDE");
    text += row(key, path);
  }
  text +=
      "\n## Patches of a side\n\nParts of the sides z- and z+, of type `wall` or `free-slip`, through which a given "
      "flow passes: a list of tables,\n`\"z+\" = { type = \"wall\", patches = [{ name = \"inlet\", radius = 0.5, "
      "flow_rate = \"1\" }, ...] }`. What comes in goes out through\nthe patch with `balance = true` or through "
      "outflow "
      "sides. On the command line: `--set boundary.z+.patches.inlet.radius=0.4`.\n[patches.md](patches.md) says "
      "more.\n\n" +
      table_head();
  for (const auto& key : patch_keys()) text += row(key, key.path);
  text +=
      "\n## [signals.NAME]\n\nNumbers that vary in time, one of `table`, `csv` and `formula` each. Where a key asks "
      "for a "
      "signal, a formula may stand\nin its place.\n\n" +
      table_head();
  for (const auto& key : signal_keys()) text += row(key, key.path);
  text +=
      "\n## [cavity.NAME]\n\nA body's inside, or what it and flat lids on its borders enclose, followed over time: "
      "`cavities/NAME.csv` and a summary of\neach cycle. [output-files.md](output-files.md) says more.\n\n" +
      table_head();
  for (const auto& key : cavity_keys()) text += row(key, key.path);
  text +=
      "\n## [[body]]\n\nOne for each body; the keys under `potentials` are written under `[body.potentials]`, and a "
      "potential that is not\nwritten is not there.\n\n" +
      table_head();
  for (const auto& key : body_keys()) text += row(key, key.path);
  text +=
      "\n## [body.selection.NAME]\n\nVertices of a deformable body, or of a part of a tight one, by a name: those "
      "for which all that is given holds. Points and directions are in the\ncoordinates of the surface before "
      "`rotation` and `center`, and go "
      "along "
      "with it and its copies. On the command line:\n`--set body.flag.selection.pole.plane.side=beyond`. "
      "[bodies.md](bodies.md) says more.\n\n" +
      table_head();
  for (const auto& key : selection_keys()) text += row(key, key.path);
  text += "\n## [body.tether.NAME]\n\nSprings from vertices to their places at the start.\n\n" + table_head();
  for (const auto& key : tether_keys()) text += row(key, key.path);
  text += "\n## [body.cord.NAME]\n\nCords, which pull and never push.\n\n" + table_head();
  for (const auto& key : cord_keys()) text += row(key, key.path);
  text += "\n## [body.pull.NAME]\n\nConstant forces.\n\n" + table_head();
  for (const auto& key : pull_keys()) text += row(key, key.path);
  return text;
}

}  // namespace pliant
