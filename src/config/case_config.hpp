#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/vec3.hpp"

/// What a case file says, as plain structs whose member initialisers are the documented defaults.
namespace pliant {

enum class Axis { x, y, z };

/// A number that varies in time: exactly one of table, csv and formula.
struct SignalConfig {
  std::vector<std::array<double, 2>> table;  ///< [time, value], times growing
  std::filesystem::path csv;                 ///< the same as a file; relative to the case's folder
  std::string formula;                       ///< of t
  std::optional<double> period;
  double scale = 1.0;  ///< factor on the value
};

enum class PatchShape { disc, annulus, rectangle, outside };
enum class PatchProfile { uniform, parabolic };
/// A part of a z side through which a given flow passes. Points of the side are [x, y].
struct PatchConfig {
  std::string name;
  PatchShape shape = PatchShape::disc;
  std::array<double, 2> center{0, 0};
  std::optional<double> radius;                ///< outside: of the hole; none: all that other patches leave
  double inner_radius = 0;                     ///< annulus
  std::array<double, 2> size{0, 0};            ///< rectangle
  std::string flow_rate;                       ///< into the box: a signal's name or a formula of t
  std::optional<std::array<double, 2>> phase;  ///< part of the signal's period in which fluid passes
  PatchProfile profile = PatchProfile::uniform;
  bool balance = false;  ///< lets out what else comes in
};

struct PeriodicSide {};
struct WallSide {
  Vec3 velocity;  ///< of the wall; its component normal to the wall must be 0
  std::vector<PatchConfig> patches = {};
};
struct FreeSlipSide {
  std::vector<PatchConfig> patches = {};
};
enum class InflowProfile { uniform, parabolic };
struct InflowSide {
  Vec3 velocity;  ///< must point into the box
  InflowProfile profile = InflowProfile::uniform;
  double ramp = 0;          ///< time over which the velocity grows from 0; 0: at once
  std::string signal = {};  ///< factor on the velocity: a signal's name or a formula of t; empty: 1
};
/// Convective outflow; all outflow sides together let out what comes in.
struct OutflowSide {};
/// The condition on one side of the box; the two sides of a direction are both periodic or both not.
using BoundarySpec = std::variant<PeriodicSide, WallSide, FreeSlipSide, InflowSide, OutflowSide>;

/// Sides in the order x-, x+, y-, y+, z-, z+.
using BoundaryConfig = std::array<BoundarySpec, 6>;

/// The patches of a side; null where it can have none.
std::vector<PatchConfig>* patches_of(BoundarySpec& side);
const std::vector<PatchConfig>* patches_of(const BoundarySpec& side);

enum class StretchingLaw { uniform, tanh };
struct StretchingConfig {
  StretchingLaw law = StretchingLaw::uniform;
  double strength = 2.0;  ///< of the tanh law: larger packs more cells at both ends
};

struct BoxConfig {
  Vec3 size{1, 1, 1};
  Vec3 origin{0, 0, 0};
  std::array<int, 3> cells{32, 32, 32};
  StretchingConfig stretching_z;
};

struct FluidConfig {
  double density = 1.0;
  double viscosity = 1.0;  ///< dynamic
};

struct ForcingConfig {
  Vec3 acceleration{0, 0, 0};  ///< force per unit mass of fluid
  struct BulkVelocity {
    Axis axis = Axis::x;
    double value = 1.0;
  };
  std::optional<BulkVelocity> bulk_velocity;  ///< constant mass flux along a periodic axis
};

enum class InitialFlow { rest, uniform, couette, poiseuille, taylor_green, perturbed };
struct InitialConfig {
  InitialFlow flow = InitialFlow::rest;
  Vec3 velocity{0, 0, 0};    ///< uniform: the velocity; perturbed: the mean velocity
  double amplitude = 1.0;    ///< poiseuille: centre velocity; taylor-green, perturbed: velocity scale
  Axis direction = Axis::x;  ///< poiseuille: of the flow
  Axis normal = Axis::z;     ///< couette, poiseuille: of the walls; taylor-green: of the plane of the vortices
  std::uint64_t seed = 1;    ///< perturbed
};

enum class ViscousMode { explicit_rk3, implicit_z, implicit };
struct TimeConfig {
  double end = 1.0;
  std::optional<long> max_steps;
  double cfl = 0.5;
  std::optional<double> step;  ///< fixed step; else it follows cfl
  double max_step = 0;         ///< upper bound on the adaptive step; 0: none
  ViscousMode viscous = ViscousMode::implicit;
};

struct SphereSurface {
  int frequency = 8;
  double radius = 1.0;
};
struct FileSurface {
  std::filesystem::path file;  ///< relative to the case's folder
  double scale = 1.0;
};
using SurfaceSpec = std::variant<SphereSurface, FileSurface>;

enum class TractionForm { none, drag, one_sided, gradient };
/// Whose area a vertex's drag counts: a network's drag belongs to its material, a liquid interface's to its present
/// area.
enum class DragArea { reference, current };
struct TractionConfig {
  TractionForm form = TractionForm::one_sided;
  double coefficient = 100.0;  ///< drag: c_d in c = c_d mu A_node / R
  DragArea area = DragArea::reference;
  double probe_length = 0.0;  ///< one-sided, gradient: 0 means the mean grid spacing
};

struct EdgeConfig {
  double stiffness = 0;
  double rest_length = 1.0;  ///< fraction of the initial length
};
enum class ReferenceAngle { initial, flat };
struct BendingConfig {
  double stiffness = 0;
  ReferenceAngle reference = ReferenceAngle::initial;
};
struct VolumeConfig {
  double stiffness = 0;
};
struct AreaConfig {
  double stiffness = 0;
};
struct SurfaceTensionConfig {
  double sigma = 0;
  double mesh_control = 0;  ///< stiffness of the tangential springs that keep the mesh even; 0: a fraction of sigma
};
struct PotentialsConfig {
  std::optional<EdgeConfig> edge;
  std::optional<BendingConfig> bending;
  std::optional<VolumeConfig> volume;
  std::optional<AreaConfig> area;  ///< per face
  std::optional<AreaConfig> total_area;
  std::optional<SurfaceTensionConfig> surface_tension;
};

enum class MotionKind { fixed, deformable };
enum class CouplingKind { one_way };
struct BodyConfig {
  std::string name;
  SurfaceSpec surface;
  Vec3 center{0, 0, 0};
  MotionKind motion = MotionKind::deformable;
  CouplingKind coupling = CouplingKind::one_way;
  double mass_per_vertex = 1.0;
  double damping = 0.0;         ///< force = -damping * velocity of the vertex
  std::optional<int> substeps;  ///< within a fluid step; else found from the stability limit
  TractionConfig traction;
  PotentialsConfig potentials;
};

struct HistoryConfig {
  long every = 10;
};
struct SeriesConfig {
  std::optional<double> interval;  ///< in time
  std::optional<long> every;       ///< in steps; neither: not written
};
struct OutputConfig {
  HistoryConfig history;
  SeriesConfig fields;
  SeriesConfig surfaces;
};

struct CaseConfig {
  std::string title = "untitled";
  std::filesystem::path folder;  ///< of the case file; relative paths start here
  std::filesystem::path file;
  std::map<std::string, std::string> origins;  ///< key path to where it was set: "case.toml:12" or "--set ..."
  BoxConfig box;
  FluidConfig fluid;
  ForcingConfig forcing;
  std::map<std::string, SignalConfig> signals;
  BoundaryConfig boundary;
  InitialConfig initial;
  TimeConfig time;
  std::vector<BodyConfig> bodies;
  OutputConfig output;
};

}  // namespace pliant
