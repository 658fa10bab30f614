#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "boundary/flow_patch.hpp"
#include "boundary/side_rules.hpp"
#include "field/field.hpp"
#include "field/row_table.hpp"

namespace pliant {

/// The velocity that open sides read.
struct VelocityViews {
  ConstView<FaceX> u;
  ConstView<FaceY> v;
  ConstView<FaceZ> w;
};

/// What flows into the box through a patch.
struct PatchFlowRate {
  std::string name;
  double value = 0;
};

/// How much the values of one component on the six sides changed in the last advance; null where a side is closed.
/// At (a, b) along a side: values[a + b * stride], as SideRule.
struct SideChanges {
  std::array<const double*, 6> values{};
  std::array<std::ptrdiff_t, 6> strides{};

  double at(std::size_t side, int a, int b) const { return values[side][a + b * strides[side]]; }
};

/// The values that vary along the sides through which fluid passes, for all three components.
///
/// Inflow: the given profile times its ramp, 1/2 (1 - cos(pi t / ramp)), and its signal. Outflow: du/dt + U du/dn = 0
/// by one explicit upwind step a substep, U the mean velocity through the side; then the normal velocity of all outflow
/// sides is shifted alike, so that the net flux through the box vanishes to round-off. Patches of a wall or free-slip
/// side in z: the flow rate of the time, spread over the faces of the patch by its profile when it enters and
/// convective when it leaves; the balance patch is an outflow of its own and takes the shift alone.
class OpenSides {
 public:
  /// Throws InputError: a signal that is not known, a patch without faces.
  OpenSides(const Grid& grid, const BoundaryConfig& boundary, const Signals& signals = {});

  bool any() const { return !sides_.empty(); }
  /// Lends the values of a component to its rules. They stay with this object, which must neither move nor die.
  void lend_values(FieldRules& rules, int component) const;
  SideChanges changes(int component) const;

  /// Values at the start of a run: inflow of that time, outflow as the interior next to it. Collective.
  void start(const VelocityViews& velocity, double time);
  /// Values at the end of a substep: `velocity` with its ghosts as at the beginning, `time` as at the end. Collective.
  void advance(const VelocityViews& velocity, double time, double dt_alpha);

  /// Net flux out of the box after the last start or advance, as summed over the faces. Collective.
  double net_outward_flux() const;
  /// Of all patches, in the order of the case, summed over their faces after the last start or advance. Collective.
  std::vector<PatchFlowRate> patch_flow_rates() const;
  /// The largest convective rate, velocity over spacing, that patches and inflows with a signal ask for until `end`
  /// (sampled; of a balance patch a bound).
  double largest_rate(double end) const;

  /// All that an advance needs of those before it, in memory. Copies of one object fit each other.
  struct Snapshot {
    std::vector<double> values;         ///< of all sides and components, behind each other
    std::vector<double> mean_outwards;  ///< a side each
  };
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

  /// The same for a file: a table for each component of each open side, without the edges, and the mean velocities.
  std::vector<RowTable> tables() const;
  /// Copies table `t` of tables(), this rank's rows of it, out of this object or into it.
  void save_table(std::size_t t, double* values) const;
  void load_table(std::size_t t, const double* values);
  std::vector<double> mean_outwards() const;
  /// After all tables are loaded: the values beyond the edges, and the mean velocities as mean_outwards() gave them.
  void finish_loading(const std::vector<double>& means);

 private:
  struct Side {
    int number = 0;  ///< 0 .. 5, x- to z+
    const InflowSide* inflow = nullptr;
    std::optional<Signal> signal;    ///< of the inflow
    std::vector<FlowPatch> patches;  ///< neither inflow nor patches: outflow
    std::vector<int> owners;         ///< the patch at each face, -1: none; indexed as values
    double given = 0;                ///< flow rate into the box of all patches but the one that balances
    bool here = false;               ///< this rank's slab touches it
    int na = 0, nb = 0;
    std::ptrdiff_t stride = 0;
    double area = 0;                               ///< of the whole side, or of its balance patch
    double mean_outward = 0;                       ///< mean velocity out of the box through this area
    std::array<bool, 3> varies{true, true, true};  ///< whether a component's rule takes its values from here
    std::array<std::vector<double>, 3> values, changes;

    int direction() const { return number / 2; }
    double outwards() const { return number % 2 == 0 ? -1 : 1; }
    const FlowPatch* balance_patch() const;
    bool is_outflow() const { return inflow == nullptr && patches.empty(); }
    bool balances() const { return is_outflow() || balance_patch() != nullptr; }
    std::size_t index(int a, int b) const {
      return static_cast<std::size_t>(a + 1) + static_cast<std::size_t>(b + 1) * static_cast<std::size_t>(stride);
    }
  };

  /// What passes a patch in a substep.
  struct PatchMotion {
    double rate = 0;   ///< into the box
    double cells = 0;  ///< how far it goes, in cells across the side
    bool leaves() const { return rate < 0; }
  };

  void set_inflow(Side& side, double time) const;
  void set_outflow(Side& side, const VelocityViews& velocity, double dt_alpha) const;
  void set_patches(Side& side, const VelocityViews& velocity, double time, double dt_alpha) const;
  void set_normal_values(Side& side, const FlowPatch& patch, const PatchMotion& motion, ConstView<FaceZ> w) const;
  template <class Location>
  void set_tangential_values(Side& side, const std::vector<PatchMotion>& motions, int component,
                             ConstView<Location> field) const;
  void set_side(Side& side, const VelocityViews& velocity, double time, double dt_alpha) const;
  void extend(Side& side) const;
  void balance();
  double face_area(const Side& side, int b) const;
  std::vector<double> outward_fluxes() const;
  /// One upwind step from an old value towards the one next to it.
  static double towards(double old, double courant, double neighbour);

  Grid grid_;
  BoundaryConfig boundary_;
  std::vector<Side> sides_;
};

}  // namespace pliant
