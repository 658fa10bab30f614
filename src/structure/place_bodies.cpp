#include "structure/place_bodies.hpp"

#include <fmt/format.h>

#include <map>

#include "config/validate.hpp"
#include "core/error.hpp"
#include "core/random_reals.hpp"
#include "structure/load_surface.hpp"
#include "structure/positions_file.hpp"
#include "structure/sphere_packer.hpp"

namespace pliant {
namespace {

/// A uniformly random rotation: a random point of the unit ball in four dimensions as a quaternion (G. Marsaglia,
/// Ann. Math. Stat. 43, 645, 1972). No trigonometry, so that all platforms agree.
Mat3 random_rotation(RandomReals& random) {
  double w = 0, x = 0, y = 0, z = 0, squared = 0;
  do {
    w = 2 * random.next() - 1;
    x = 2 * random.next() - 1;
    y = 2 * random.next() - 1;
    z = 2 * random.next() - 1;
    squared = w * w + x * x + y * y + z * z;
  } while (squared > 1 || squared < 1e-6);
  const double s = 2 / squared;
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

class Placer {
 public:
  explicit Placer(const CaseConfig& config) : config_(config) {}

  std::vector<PlacedBody> place_all() {
    bodies_.resize(config_.bodies.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) collect([&] { place_given(b); });
    finish();  // without shapes there is nothing to keep off
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (config_.bodies[b].placement.count) place_random(b);
    check_names();
    finish();
    return std::move(bodies_);
  }

 private:
  template <class Work>
  void collect(Work work) {
    try {
      work();
    } catch (const InputError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    }
  }
  void finish() {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }
  std::string name_of(std::size_t b) const { return place_of(config_, "body." + config_.bodies[b].name); }

  void place_given(std::size_t b) {
    const BodyConfig& body = config_.bodies[b];
    bodies_[b].shape = load_shape(body, config_.folder);
    bodies_[b].sphere = bounding_sphere(bodies_[b].shape.positions);
    if (body.placement.count) return;
    if (!body.placement.positions) {
      bodies_[b].placements = {given_placement(body)};
      return;
    }
    bodies_[b].placements = read_positions(config_.folder / *body.placement.positions);
    const Mat3 given = given_placement(body).rotation;
    RandomReals random(seed_for(body.placement.seed, body.name));
    for (Placement& placement : bodies_[b].placements) {
      placement.rotation = product(placement.rotation, given);
      if (body.placement.orientation == OrientationKind::random)
        placement.rotation = product(random_rotation(random), placement.rotation);
    }
  }

  void place_random(std::size_t b) {
    const BodyConfig& body = config_.bodies[b];
    const int count = *body.placement.count;
    PlacedBody& placed = bodies_[b];
    SpherePacker packer(config_, body.placement, {placed.sphere.radius, body.placement.gap, count});
    if (const auto tight = packer.tight_directions(); !tight.empty()) {
      problems_.push_back(fmt::format(
          "{} has copies that no place is wide enough for along {}: a ball of radius {:.4g} around each, and gap = "
          "{:.4g}, have to fit between the sides; make the body smaller, or the region or the box wider",
          name_of(b), "xyz"[tight.front()], placed.sphere.radius, body.placement.gap));
      return;
    }
    const auto surfaces = add_obstacles(packer);
    RandomReals random(seed_for(body.placement.seed, body.name));
    const Mat3 given = given_placement(body).rotation;
    for (int copy = 0; copy < count; ++copy) {
      const auto center = packer.add(random);
      if (!center) {
        problems_.push_back(fmt::format(
            "{}: count = {}, but after {} copies a million random places were all taken; with their gaps the balls "
            "around {} copies would fill {:.2g} of the region's volume, and random places reach 0.3 quickly and 0.38 "
            "at most, other bodies not counted; use fewer copies, a smaller gap, or a larger box or region",
            name_of(b), count, copy, count, packer.volume_fraction(count)));
        return;
      }
      const Mat3 rotation =
          body.placement.orientation == OrientationKind::random ? product(random_rotation(random), given) : given;
      placed.placements.push_back({*center - rotation * placed.sphere.center, rotation});
    }
  }

  /// Returns the surfaces of single bodies, which the packer refers to.
  std::vector<Surface> add_obstacles(SpherePacker& packer) const {
    std::vector<Surface> surfaces;
    surfaces.reserve(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const PlacedBody& other = bodies_[b];
      if (has_copies(config_.bodies[b])) {
        for (const Placement& placement : other.placements) packer.add_obstacle(place(other.sphere, placement));
      } else {
        surfaces.push_back({other.shape.mesh, place(other.shape.positions, other.placements.front())});
        packer.add_obstacle(surfaces.back());
      }
    }
    return surfaces;
  }

  void check_names() {
    std::map<std::string, std::size_t> owner;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t i = 0; i < bodies_[b].placements.size(); ++i) {
        const auto name = copy_name(config_.bodies[b], i, bodies_[b].placements.size());
        const auto [entry, is_new] = owner.emplace(name, b);
        if (is_new) continue;
        problems_.push_back(fmt::format("{} and {} both have a copy or body named {}; rename one of them", name_of(b),
                                        name_of(entry->second), name));
        break;
      }
  }

  const CaseConfig& config_;
  std::vector<PlacedBody> bodies_;
  std::vector<std::string> problems_;
};
}  // namespace

std::vector<PlacedBody> place_bodies(const CaseConfig& config) { return Placer(config).place_all(); }

}  // namespace pliant
