#include "config/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "config/key_table.hpp"
#include "config/validate_bodies.hpp"
#include "config/validate_outputs.hpp"
#include "config/validate_patches.hpp"
#include "config/validate_structure.hpp"

namespace pliant {
namespace {
std::string name_of(int direction) { return std::string(1, "xyz"[direction]); }
constexpr std::size_t longest_name = 100;  // file systems end at 255, with what is added to it
int index_of(Axis axis) { return static_cast<int>(axis); }

class Validator {
 public:
  Validator(const CaseConfig& config, const std::set<std::string>& suspect) : config_(config), suspect_(suspect) {}

  std::vector<std::string> run(int ranks) {
    check_sides();
    check_stretching();
    check_ranks(ranks);
    check_forcing();
    check_initial_flow();
    check_bodies();
    check_motions(config_, suspect_, problems_);
    check_structures(config_, suspect_, problems_);
    check_patches(config_, suspect_, problems_);
    check_outputs(config_, suspect_, problems_);
    return std::move(problems_);
  }

 private:
  bool trusted(std::initializer_list<std::string> keys) const {
    return std::none_of(keys.begin(), keys.end(), [&](const std::string& key) { return suspect_.count(key) > 0; });
  }
  void complain(const std::string& key, const std::string& what) {
    problems_.push_back(place_of(config_, key) + " " + what);
  }

  void check_sides() {
    for (int d = 0; d < 3; ++d) {
      const auto lower = "boundary." + name_of(d) + "-", upper = "boundary." + name_of(d) + "+";
      if (!trusted({lower + ".type", upper + ".type"})) continue;
      const bool first = std::holds_alternative<PeriodicSide>(config_.boundary[2 * d]);
      const bool second = std::holds_alternative<PeriodicSide>(config_.boundary[2 * d + 1]);
      const auto& bounded = first ? upper : lower;
      if (first != second)
        complain(bounded + ".type",
                 fmt::format("is \"{}\" but {} is periodic; make both sides of {} periodic, or give {} a condition",
                             boundary_word(config_.boundary[first ? 2 * d + 1 : 2 * d]), first ? lower : upper,
                             name_of(d), first ? lower : upper));
    }
    check_open_sides();
    for (int side = 0; side < 6; ++side) {
      const auto key = "boundary." + side_names()[side] + ".velocity";
      const auto* wall = std::get_if<WallSide>(&config_.boundary[side]);
      if (!wall || !trusted({key}) || wall->velocity[side / 2] == 0) continue;
      complain(key, fmt::format("has the component {} along {}, normal to the wall; it must be 0",
                                wall->velocity[side / 2], name_of(side / 2)));
    }
  }

  void check_stretching() {
    const auto& box = config_.box;
    if (box.stretching_z.law != StretchingLaw::cluster || !trusted({"box.stretching.z.center"})) return;
    const double lower = box.origin.z, upper = box.origin.z + box.size.z;
    if (box.stretching_z.center < lower || box.stretching_z.center > upper)
      complain("box.stretching.z.center", fmt::format("is {}, outside the box, which reaches from {} to {} along z",
                                                      box.stretching_z.center, lower, upper));
  }

  void check_open_sides() {
    bool has_outflow = false;
    for (const auto& side : config_.boundary) has_outflow |= lets_out(side);
    for (int side = 0; side < 6; ++side) {
      const auto name = "boundary." + side_names()[side];
      const auto* inflow = std::get_if<InflowSide>(&config_.boundary[side]);
      if (!inflow || !trusted({name + ".type", name + ".velocity"})) continue;
      const int d = side / 2;
      const double inwards = (side % 2 == 0 ? 1 : -1) * inflow->velocity[d];
      if (!(inwards > 0))
        complain(name + ".velocity",
                 fmt::format("has the component {} along {}, which does not point into the box; it must be {} than 0",
                             inflow->velocity[d], name_of(d), side % 2 == 0 ? "greater" : "less"));
      if (!has_outflow)
        complain(name + ".type",
                 "is \"inflow\", but nothing lets the fluid out again; give another side type = \"outflow\", or a "
                 "side of z a patch with balance = true");
    }
  }

  void check_ranks(int ranks) {
    const int planes = config_.box.cells[2];
    if (!trusted({"box.cells"}) || ranks <= planes) return;
    complain("box.cells",
             fmt::format("has {} planes in z, too few for {} ranks; use at most {} ranks (mpirun -n {}) or "
                         "more cells in z",
                         planes, ranks, planes, planes));
  }

  void check_forcing() {
    const auto& bulk = config_.forcing.bulk_velocity;
    if (!bulk || !trusted({"forcing.bulk_velocity.axis"})) return;
    if (is_periodic(config_.boundary, index_of(bulk->axis))) return;
    complain("forcing.bulk_velocity.axis",
             fmt::format("is {0}, but {0} is not periodic; a mass flux can be kept along a periodic direction only",
                         word_for(bulk->axis)));
  }

  void check_initial_flow() {
    using enum InitialFlow;
    const auto& initial = config_.initial;
    if (!trusted({"initial.flow", "initial.normal", "initial.direction", "initial.velocity"})) return;
    const int normal = index_of(initial.normal);
    const auto word = word_for(initial.flow);
    if ((initial.flow == couette || initial.flow == poiseuille) && !has_walls(config_.boundary, normal))
      complain("initial.flow", fmt::format("\"{}\" needs walls at both sides of {}; set boundary.{}, or initial.normal "
                                           "to the direction that has walls",
                                           word, name_of(normal), name_of(normal)));
    if (initial.flow == poiseuille && initial.direction == initial.normal)
      complain("initial.direction", fmt::format("is {0}, and so is initial.normal; the flow must run along the walls",
                                                word_for(initial.direction)));
    if (initial.flow == poiseuille && initial.direction != initial.normal &&
        !is_periodic(config_.boundary, index_of(initial.direction)) &&
        !is_open(config_.boundary, index_of(initial.direction)))
      complain("initial.direction", fmt::format("is {0}, but {0} is closed; the flow needs a way through the box",
                                                word_for(initial.direction)));
    for (int d = 0; d < 3; ++d) {
      const bool has_mean = initial.flow == uniform || initial.flow == perturbed;
      if (!has_mean || initial.velocity[d] == 0 || is_periodic(config_.boundary, d)) continue;
      if (is_open(config_.boundary, d)) continue;
      complain("initial.velocity", fmt::format("has the component {} along {}, which is closed; it must be 0",
                                               initial.velocity[d], name_of(d)));
    }
    if (initial.flow != taylor_green) return;
    for (int d = 0; d < 3; ++d) {
      const bool bounded = !is_periodic(config_.boundary, d);
      if (d != normal && bounded)
        complain("initial.flow", fmt::format("\"{}\" with initial.normal = \"{}\" needs a periodic {}; set boundary.{} "
                                             "= \"periodic\"",
                                             word, name_of(normal), name_of(d), name_of(d)));
    }
  }

  void check_bodies() {
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < config_.bodies.size(); ++i) {
      const auto& body = config_.bodies[i];
      const auto prefix = "body." + body.name;
      if (body.name.empty()) continue;
      if (!seen.emplace(body.name, i).second)
        complain(prefix + ".name", fmt::format("is used by more than one body; give each body its own name"));
      const bool plain = std::all_of(body.name.begin(), body.name.end(),
                                     [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
      if (!plain) complain(prefix + ".name", "names files: use only letters, digits, - and _");
      if (body.name == "fields") complain(prefix + ".name", "is the name of the flow's own files; choose another");
      if (body.name.size() > longest_name)
        complain(prefix + ".name",
                 fmt::format("has {} characters; it names files: use at most {}", body.name.size(), longest_name));
      check_placement(body, prefix);
      if (is_open_surface(body.surface) && body.potentials.volume)
        complain(prefix + ".potentials.volume",
                 "holds an enclosed volume, but the surface is open; remove the potential");
      const auto* sphere = std::get_if<SphereSurface>(&body.surface);
      if (body.placement.count || body.placement.positions) continue;  // its copies are checked where they are placed
      const bool known = trusted({prefix + ".surface", prefix + ".surface.shape", prefix + ".surface.radius",
                                  prefix + ".surface.diameter", prefix + ".center", "box.size", "box.origin"});
      if (!sphere || !known) continue;
      const Vec3 reach{sphere->radius, sphere->radius, sphere->radius};
      check_body_extent(config_, i, body.center - reach, body.center + reach, problems_);
    }
  }

  void check_placement(const BodyConfig& body, const std::string& prefix) {
    const auto &lower = body.placement.region_lower, &upper = body.placement.region_upper;
    if (!body.placement.count || (!lower && !upper)) return;
    if (!trusted({"box.size", "box.origin", prefix + ".region", prefix + ".region.lower", prefix + ".region.upper"}))
      return;
    const auto& box = config_.box;
    for (int d = 0; d < 3; ++d) {
      const double from = lower ? (*lower)[d] : box.origin[d];
      const double to = upper ? (*upper)[d] : box.origin[d] + box.size[d];
      if (!(from < to))
        complain(prefix + ".region", fmt::format("reaches from {} to {} along {}; its lower corner must be below its "
                                                 "upper one",
                                                 from, to, name_of(d)));
      else if (to - from > box.size[d] * (1 + 1e-12))
        complain(prefix + ".region", fmt::format("is {} long along {}, longer than the box ({}); shorten it", to - from,
                                                 name_of(d), box.size[d]));
    }
  }

  const CaseConfig& config_;
  const std::set<std::string>& suspect_;
  std::vector<std::string> problems_;
};
}  // namespace

std::string place_of(const CaseConfig& config, const std::string& key) {
  const auto found = config.origins.find(key);
  if (found != config.origins.end()) return found->second + ": " + key;
  return config.file.string() + ": " + key;
}

bool is_periodic(const BoundaryConfig& boundary, int direction) {
  return std::holds_alternative<PeriodicSide>(boundary[2 * direction]) &&
         std::holds_alternative<PeriodicSide>(boundary[2 * direction + 1]);
}

bool is_open(const BoundaryConfig& boundary, int direction) {
  const auto open = [&](int side) {
    return std::holds_alternative<InflowSide>(boundary[side]) || std::holds_alternative<OutflowSide>(boundary[side]);
  };
  return open(2 * direction) && open(2 * direction + 1);
}

bool has_walls(const BoundaryConfig& boundary, int direction) {
  return std::holds_alternative<WallSide>(boundary[2 * direction]) &&
         std::holds_alternative<WallSide>(boundary[2 * direction + 1]);
}

void check_extent(const CaseConfig& config, const std::string& place, Vec3 lower, Vec3 upper,
                  std::vector<std::string>& problems) {
  const auto& box = config.box;
  for (int d = 0; d < 3; ++d) {
    const double begin = box.origin[d], end = begin + box.size[d];
    if (is_periodic(config.boundary, d)) {
      if (upper[d] - lower[d] > box.size[d])
        problems.push_back(
            fmt::format("{} is {} long along {}, more than the periodic box ({}); make the box larger or "
                        "the body smaller",
                        place, upper[d] - lower[d], name_of(d), box.size[d]));
    } else if (lower[d] < begin || upper[d] > end) {
      problems.push_back(
          fmt::format("{} reaches from {} to {} along {}, outside the box ({} to {}); move its center or "
                      "make the box larger",
                      place, lower[d], upper[d], name_of(d), begin, end));
    }
  }
}

void check_body_extent(const CaseConfig& config, std::size_t index, Vec3 lower, Vec3 upper,
                       std::vector<std::string>& problems) {
  check_extent(config, place_of(config, "body." + config.bodies[index].name), lower, upper, problems);
}

std::vector<std::string> validate(const CaseConfig& config, int ranks, const std::set<std::string>& suspect) {
  return Validator(config, suspect).run(ranks);
}

}  // namespace pliant
