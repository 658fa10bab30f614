#include "app/load_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/read_case.hpp"
#include "config/validate.hpp"
#include "core/error.hpp"
#include "grid/grid.hpp"
#include "mesh/geometry.hpp"
#include "mesh/read_surface.hpp"
#include "parallel/agree.hpp"
#include "signals/make_signal.hpp"
#include "simulation/ejection.hpp"
#include "structure/make_body.hpp"
#include "structure/overlap.hpp"
#include "structure/place_bodies.hpp"

namespace pliant {
namespace {
/// A body or one of its copies, at its place.
struct PlacedCopy {
  double probe_reach;
  std::string place;  ///< for messages
  const TriangleMesh& mesh;
  std::vector<Vec3> positions;
};

void check_extent(const CaseConfig& config, const PlacedCopy& copy, std::vector<std::string>& problems) {
  Vec3 lower = copy.positions.front(), upper = lower;
  for (const Vec3 x : copy.positions) {
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  }
  check_extent(config, copy.place, lower, upper, problems);
}

/// How far from its surface the stress is taken that moves a body; 0 for bodies that move without it.
double probe_reach(const BodyConfig& body, double mean_spacing) {
  const bool is_driven =
      body.motion == MotionKind::deformable ||
      (body.loads == LoadSource::probes && (body.motion == MotionKind::rigid || body.motion == MotionKind::hinge));
  const auto traction = resolve(body.traction, body.motion, mean_spacing);
  if (!is_driven || traction.form == TractionForm::none || traction.form == TractionForm::drag) return 0;
  return traction.form == TractionForm::quadratic ? 2 * traction.probe_length : traction.probe_length;
}

/// The flow is taken at the ends of the probes, which have to be in the box as the body has.
void check_probes(const CaseConfig& config, const PlacedCopy& copy, std::vector<std::string>& problems) {
  const double length = copy.probe_reach;
  if (length == 0) return;
  const auto& box = config.box;
  const auto centroids = face_centroids(copy.mesh, copy.positions);
  const auto normals = face_normals(copy.mesh, copy.positions);
  for (int d = 0; d < 3; ++d) {
    if (is_periodic(config.boundary, d)) continue;
    const auto is_outside = [&](std::size_t f) {
      const double end = centroids[f][d] + length * normals[f][d];
      return end < box.origin[d] || end > box.origin[d] + box.size[d];
    };
    std::size_t f = 0;
    while (f < centroids.size() && !is_outside(f)) ++f;
    if (f == centroids.size()) continue;
    problems.push_back(fmt::format(
        "{} is too close to a side of {}: the probes of its traction, of length {:.4g}, end outside the box; shorten "
        "traction.probe_length, move the body, or choose traction.form = \"drag\"",
        copy.place, "xyz"[d], length));
  }
}

/// Whether a ball, `margin` larger, stays off all sides that are not periodic.
bool is_clear_of_sides(const CaseConfig& config, const BoundingSphere& sphere, double margin) {
  for (int d = 0; d < 3; ++d) {
    if (is_periodic(config.boundary, d)) continue;
    const double reach = sphere.radius + margin, begin = config.box.origin[d];
    if (sphere.center[d] - reach < begin || sphere.center[d] + reach > begin + config.box.size[d]) return false;
  }
  return true;
}

bool fits_beside_its_images(const CaseConfig& config, const BoundingSphere& sphere) {
  for (int d = 0; d < 3; ++d)
    if (is_periodic(config.boundary, d) && 2 * sphere.radius > config.box.size[d]) return false;
  return true;
}

void check_copies(const CaseConfig& config, const Grid& grid, std::size_t index, const PlacedBody& placed,
                  std::vector<std::string>& problems) {
  constexpr std::size_t enough = 20;
  const auto& body = config.bodies[index];
  const double reach = probe_reach(body, grid.mean_spacing());
  const auto before = problems.size();
  for (std::size_t i = 0; i < placed.placements.size() && problems.size() < before + enough; ++i) {
    const auto sphere = place(placed.sphere, placed.placements[i]);
    if (is_clear_of_sides(config, sphere, reach) && fits_beside_its_images(config, sphere)) continue;
    auto where = place_of(config, "body." + body.name);
    if (has_copies(body)) where += ", copy " + copy_name(body, i, placed.placements.size()) + ",";
    const PlacedCopy copy{reach, where, placed.shape.mesh, place(placed.shape.positions, placed.placements[i])};
    const auto so_far = problems.size();
    check_extent(config, copy, problems);
    if (problems.size() == so_far) check_probes(config, copy, problems);
  }
}

/// Writes the faces of overlaps beside the working folder's other files; what to tell of it.
std::string write_picture(const CaseConfig& config, SurfaceData picture, bool writes) {
  const auto path = std::filesystem::path(config.file).stem().string() + "-overlaps.ply";
  const auto n_faces = picture.faces.size();
  try {
    if (writes) {
      const int n_vertices = static_cast<int>(picture.positions.size());
      write_surface(path, {TriangleMesh(n_vertices, std::move(picture.faces)), std::move(picture.positions)});
    }
  } catch (const std::exception& error) {
    return fmt::format("a picture of these overlaps could not be written: {}", error.what());
  }
  return fmt::format("the {} faces that overlap are in {}; open it in ParaView, together with the surfaces", n_faces,
                     path);
}

/// The scales that ejection fractions ask for are set on the way.
void check_bodies(CaseConfig& config, bool writes) {
  const auto placed = place_bodies(config);
  const Grid grid(config.box, config.boundary, Communicator(MPI_COMM_SELF));
  std::vector<std::string> problems;
  for (std::size_t b = 0; b < placed.size(); ++b) check_copies(config, grid, b, placed[b], problems);
  SurfaceData picture;
  for (auto& problem : find_overlaps(config, placed, 20, &picture)) problems.push_back(std::move(problem));
  if (!picture.faces.empty()) problems.push_back(write_picture(config, std::move(picture), writes));
  if (!problems.empty()) throw InputError(std::move(problems));
  set_ejection_scales(config, placed);
}
}  // namespace

namespace {
/// `writes`: this rank may write a file that shows what is wrong.
CaseConfig load_and_check(const CaseArguments& arguments, int ranks, bool writes) {
  auto config = read_case(arguments.path, arguments.overrides, ranks, check_signals);
  check_bodies(config, writes);
  return config;
}
}  // namespace

CaseConfig load_case(const CaseArguments& arguments, int ranks) { return load_and_check(arguments, ranks, true); }

CaseConfig load_case(const CaseArguments& arguments, const Communicator& ranks) {
  std::optional<CaseConfig> config;
  std::optional<InputError> error;
  try {
    config = load_and_check(arguments, ranks.size(), ranks.is_root());
  } catch (const InputError& found) { error = found; }
  const int failed = ranks.max(error ? 1 : 0);
  const bool alike = failed == 0 || -ranks.max(error ? -1 : 0) == 1;
  if (alike && error) throw *error;
  if (alike) return *config;
  try {
    agree(ranks, error ? fmt::format("rank {}: {}", ranks.rank(), error->what()) : "");
  } catch (const CollectiveError& first) { throw InputError(first.what()); }
  return *config;
}

}  // namespace pliant
