#include "config/validate_patches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "config/key_table.hpp"
#include "config/patch_geometry.hpp"
#include "config/validate.hpp"

namespace pliant {
namespace {
/// A hole of fewer faces has no shape.
constexpr int fewest_faces = 4;

class PatchValidator {
 public:
  PatchValidator(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems)
      : config_(config), suspect_(suspect), problems_(problems), plane_(patch_plane(config.box, config.boundary)) {}

  void run() {
    for (int side = 0; side < 6; ++side) {
      const auto* patches = patches_of(config_.boundary[static_cast<std::size_t>(side)]);
      if (patches == nullptr || patches->empty()) continue;
      for (const auto& patch : *patches) {
        check_name(side, patch);
        check_flow(side, patch);
      }
      if (side < 4)
        complain(fmt::format("boundary.{}", side_names()[static_cast<std::size_t>(side)]),
                 "has patches, which only the sides \"z-\" and \"z+\" may have; turn the box so that they lie there");
      else check_side(side, *patches);
    }
    check_balance();
  }

 private:
  bool trusted(const std::string& prefix) const {
    return std::none_of(suspect_.begin(), suspect_.end(),
                        [&](const std::string& key) { return key.rfind(prefix, 0) == 0; });
  }
  bool trusted(int side, const PatchConfig& patch) const {
    return !patch.name.empty() && trusted(patch_key(side, patch) + ".");
  }
  void complain(const std::string& key, const std::string& what) {
    problems_.push_back(place_of(config_, key) + " " + what);
  }

  void check_name(int side, const PatchConfig& patch) {
    if (patch.name.empty()) return;
    const auto key = patch_key(side, patch) + ".name";
    const bool plain = std::all_of(patch.name.begin(), patch.name.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
    if (!plain) complain(key, "names a column of history.csv: use only letters, digits, - and _");
    const auto [first, is_new] = seen_.emplace(patch.name, side);
    if (!is_new)
      complain(key, fmt::format("is the name of another patch too (on {}); give each patch its own name",
                                side_names()[static_cast<std::size_t>(first->second)]));
  }

  void check_flow(int side, const PatchConfig& patch) {
    if (!trusted(side, patch)) return;
    const auto key = patch_key(side, patch);
    if (!patch.balance && patch.flow_rate.empty())
      complain(key, "has no flow_rate; name a signal or write a formula of t, or set balance = true");
    if (patch.profile == PatchProfile::parabolic && patch.shape == PatchShape::outside)
      complain(key + ".profile", "is \"parabolic\", which is not known for the shape \"outside\"; use \"uniform\"");
    if (patch.phase && (*patch.phase)[0] >= (*patch.phase)[1])
      complain(key + ".phase", fmt::format("begins at {} and ends at {}; it must end after it begins",
                                           (*patch.phase)[0], (*patch.phase)[1]));
  }

  // The patches of one side: each by itself, then on the grid, then against each other.
  void check_side(int side, const std::vector<PatchConfig>& patches) {
    if (!trusted("box.") || !trusted("boundary.x") || !trusted("boundary.y")) return;
    bool sound = true;
    for (const auto& patch : patches) sound &= trusted(side, patch) && check_shape(side, patch);
    if (std::count_if(patches.begin(), patches.end(), is_rest) > 1)
      complain(fmt::format("boundary.{}", side_names()[static_cast<std::size_t>(side)]),
               "has two patches of the shape \"outside\" without radius; only one can take the rest of the side");
    if (!sound) return;
    check_overlaps(side, patches);
    const auto owners = patch_of_faces(patches, plane_);
    for (std::size_t p = 0; p < patches.size(); ++p) {
      const auto faces = std::count(owners.begin(), owners.end(), static_cast<int>(p));
      if (faces < fewest_faces)
        complain(patch_key(side, patches[p]),
                 fmt::format("covers {} face{} of the grid (cells of {:.4g} x {:.4g}), and needs at least {}; make it "
                             "larger, or the grid finer",
                             faces, faces == 1 ? "" : "s", plane_.spacing(0), plane_.spacing(1), fewest_faces));
    }
  }

  bool check_shape(int side, const PatchConfig& patch) {
    const auto key = patch_key(side, patch);
    const auto before = problems_.size();
    const double cell = std::min(plane_.spacing(0), plane_.spacing(1));
    const bool round = patch.shape == PatchShape::disc || patch.shape == PatchShape::annulus;
    if (round && !patch.radius) complain(key, "has no radius");
    if (patch.shape == PatchShape::annulus && patch.inner_radius == 0) complain(key, "has no inner_radius");
    if (patch.shape == PatchShape::annulus && patch.radius && patch.inner_radius >= *patch.radius)
      complain(key + ".inner_radius",
               fmt::format("is {}, not less than the radius {}", patch.inner_radius, *patch.radius));
    else if (patch.shape == PatchShape::annulus && patch.radius && *patch.radius - patch.inner_radius < cell)
      complain(key, fmt::format("is a ring {:.4g} wide, less than a cell ({:.4g}); make it wider, or the grid finer",
                                *patch.radius - patch.inner_radius, cell));
    if (patch.shape == PatchShape::rectangle) {
      if (patch.size[0] == 0) complain(key, "has no size");
      for (std::size_t d = 0; d < 2 && patch.size[0] > 0; ++d)
        if (patch.size[d] < plane_.spacing(d) * (1 - 1e-9))
          complain(key + ".size",
                   fmt::format("is {} along {}, less than a cell ({:.4g}); make it larger, or the grid finer",
                               patch.size[d], "xy"[d], plane_.spacing(d)));
    }
    if (problems_.size() == before && patch.shape != PatchShape::outside) check_reach(key, patch);
    return problems_.size() == before;
  }

  void check_reach(const std::string& key, const PatchConfig& patch) {
    for (std::size_t d = 0; d < 2; ++d) {
      const double half = patch.shape == PatchShape::rectangle ? 0.5 * patch.size[d] : *patch.radius;
      const double lower = patch.center[d] - half, upper = patch.center[d] + half;
      const double begin = plane_.origin[d], end = begin + plane_.size[d], slack = 1e-9 * plane_.size[d];
      if (plane_.periodic[d]) {
        if (2 * half > plane_.size[d] + slack)
          complain(key, fmt::format("is {} long along {}, more than the periodic box ({})", 2 * half, "xy"[d],
                                    plane_.size[d]));
      } else if (lower < begin - slack || upper > end + slack) {
        complain(key,
                 fmt::format("reaches from {} to {} along {}, beyond the side ({} to {}); move it or make it smaller",
                             lower, upper, "xy"[d], begin, end));
      }
    }
  }

  // By points four to a cell and direction, since shapes may meet between the centres of the faces.
  void check_overlaps(int side, const std::vector<PatchConfig>& patches) {
    PatchPlane raster = plane_;
    for (std::size_t d = 0; d < 2; ++d) raster.cells[d] = std::clamp(4 * plane_.cells[d], 64, 1024);
    std::set<std::pair<std::size_t, std::size_t>> found;
    for (int j = 0; j < raster.cells[1]; ++j)
      for (int i = 0; i < raster.cells[0]; ++i) {
        const auto point = raster.face_center(i, j);
        std::size_t first = patches.size();
        for (std::size_t p = 0; p < patches.size(); ++p) {
          if (is_rest(patches[p]) || !is_in_shape(patches[p], plane_, point)) continue;
          if (first == patches.size()) first = p;
          else if (found.emplace(first, p).second)
            complain(patch_key(side, patches[p]),
                     fmt::format("overlaps with the patch \"{}\" near ({:.4g}, {:.4g}); move them apart or make one of "
                                 "them smaller",
                                 patches[first].name, point[0], point[1]));
        }
      }
  }

  void check_balance() {
    std::vector<std::string> balances, carriers;
    bool has_outflow = false;
    for (int side = 0; side < 6; ++side) {
      const auto& spec = config_.boundary[static_cast<std::size_t>(side)];
      has_outflow |= std::holds_alternative<OutflowSide>(spec);
      const auto* patches = patches_of(spec);
      if (patches == nullptr) continue;
      for (const auto& patch : *patches) {
        if (!trusted(side, patch)) return;
        (patch.balance ? balances : carriers).push_back(patch_key(side, patch));
      }
    }
    if (balances.empty() && !carriers.empty() && !has_outflow)
      complain(
          carriers.front(),
          "carries a flow, but nothing lets it out again; set balance = true on one patch, or give another side type "
          "= \"outflow\"");
    for (std::size_t n = 1; n < balances.size(); ++n)
      complain(balances[n] + ".balance",
               fmt::format("is true, and so is {}.balance; only one patch can balance the flow", balances.front()));
    if (!balances.empty() && has_outflow)
      complain(
          balances.front() + ".balance",
          "is true, but an outflow side balances the flow already; give the patch a flow_rate, or the side another "
          "type");
  }

  const CaseConfig& config_;
  const std::set<std::string>& suspect_;
  std::vector<std::string>& problems_;
  PatchPlane plane_;
  std::map<std::string, int> seen_;
};
}  // namespace

void check_patches(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems) {
  PatchValidator(config, suspect, problems).run();
}

bool lets_out(const BoundarySpec& side) {
  const auto* patches = patches_of(side);
  return std::holds_alternative<OutflowSide>(side) ||
         (patches != nullptr && std::any_of(patches->begin(), patches->end(), [](const auto& p) { return p.balance; }));
}

std::string patch_key(int side, const PatchConfig& patch) {
  return fmt::format("boundary.{}.patches.{}", side_names()[static_cast<std::size_t>(side)], patch.name);
}

}  // namespace pliant
