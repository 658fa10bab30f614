#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/dimension.hpp"
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
  double scale = 1.0;            ///< factor on the value
  bool balance = false;          ///< the negative part is scaled so that the mean over the period is zero
  std::optional<double> volume;  ///< what the positive part is scaled to carry in a period
  /// Units of the table, file or formula; empty: the case's own.
  struct Units {
    std::string t, v;
  } units;
  double time_unit = 1, value_unit = 1;  ///< what these are in the case's own units
  std::optional<Dimension> dimension;    ///< of the values, where a unit tells it
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

enum class StretchingLaw { uniform, tanh, cluster };
struct StretchingConfig {
  StretchingLaw law = StretchingLaw::uniform;
  double strength = 2.0;  ///< of the tanh law: larger packs more cells at both ends
  double center = 0;      ///< of the cluster law: middle of the range of equal cells
  double width = 0;       ///< of the cluster law: length of that range
  double growth = 0.05;   ///< of the cluster law: each cell outside is longer than the one before it by this part
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
  Vec3 gravity{0, 0, 0};                      ///< bodies feel it times their mass less that of the fluid they displace
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
/// How a step goes through the fields: one loop an operator, or few passes. Same results but for round-off.
enum class Sweeps { plain, fused };
struct TimeConfig {
  double end = 1.0;
  std::optional<long> max_steps;
  double cfl = 0.5;
  std::optional<double> step;  ///< fixed step; else it follows cfl
  double max_step = 0;         ///< upper bound on the adaptive step; 0: none
  ViscousMode viscous = ViscousMode::implicit;
  Sweeps sweeps = Sweeps::fused;
};

struct SphereSurface {
  int frequency = 8;
  double radius = 1.0;
};
struct EllipsoidSurface {
  int frequency = 8;
  Vec3 semi_axes{1, 1, 1};
};
struct RedCellSurface {
  int frequency = 8;
  double radius = 1.0;
};
struct PlateSurface {
  std::array<double, 2> size{1, 1};  ///< along x and y
  double edge = 0.1;
};
struct DiscSurface {
  double radius = 1.0, edge = 0.1;
};
struct HalfDiscSurface {
  double radius = 1.0, edge = 0.1;
};
enum class CylinderEnds { capped, open };
struct CylinderSurface {
  double radius = 1.0, height = 1.0, edge = 0.1;
  CylinderEnds ends = CylinderEnds::capped;
};
struct BoxSurface {
  Vec3 size{1, 1, 1};
  double edge = 0.1;
};
struct ChannelSurface {
  double radius = 1.0, height = 1.0, edge = 0.1;
};
struct PlateWithHolesSurface {
  std::array<double, 2> size{1, 1};          ///< along x and y
  std::vector<std::array<double, 3>> holes;  ///< x, y, radius
  double edge = 0.1;
  double hole_edge = 0;  ///< at the holes; 0: as everywhere
};
struct VentricleSurface {
  double radius = 1.0, height = 1.0, edge = 0.1;
  double apex_edge = 0;  ///< at the apex; 0: as everywhere
};
/// Its lengths but the radius and the edge are fractions of the channel's diameter.
struct MechanicalLeafletSurface {
  double radius = 1.0, edge = 0.1;
  double hinge_offset = 0.1, clearance = 0.02;
  double closed_angle = 25;  ///< degrees
};
enum class ValveLeaflet { both, anterior, posterior };
/// Its lengths but the radius and the edge are fractions of the annulus's diameter.
struct NaturalValveSurface {
  double radius = 1.0, edge = 0.1;
  double opening = 0.2, free_edge = 2.4, commissure = 0.2, posterior_length = 0.5;
  ValveLeaflet leaflet = ValveLeaflet::both;
};
struct FileSurface {
  std::filesystem::path file;  ///< relative to the case's folder
  double scale = 1.0;
  bool open = false;  ///< the mesh has borders
};
using SurfaceSpec = std::variant<SphereSurface, EllipsoidSurface, RedCellSurface, PlateSurface, DiscSurface,
                                 HalfDiscSurface, CylinderSurface, BoxSurface, ChannelSurface, PlateWithHolesSurface,
                                 VentricleSurface, MechanicalLeafletSurface, NaturalValveSurface, FileSurface>;

/// Whether a surface has borders: plates, discs, half-discs, tubes, sacks, leaflets, and files that are said to.
bool is_open_surface(const SurfaceSpec& surface);

/// The selections that a shape brings along; none for a file, whose selections are known once it is read.
std::vector<std::string> selections_of_shape(const SurfaceSpec& surface);

/// Turns a surface about its origin.
struct RotationConfig {
  Vec3 axis{0, 0, 1};
  double angle = 0;  ///< degrees
};

enum class OrientationKind { given, random };
/// Copies of a body: count of them at random places, or at the positions of a file; neither: one, at its center.
struct PlacementConfig {
  std::optional<int> count;
  std::optional<std::filesystem::path> positions;  ///< relative to the case's folder
  std::uint64_t seed = 1;
  double gap = 0;  ///< least distance of a copy from other bodies and from bounded sides
  std::optional<Vec3> region_lower, region_upper;  ///< the copies lie in it; none: in the box
  OrientationKind orientation = OrientationKind::given;
};

/// automatic: quadratic for bodies that act on the flow, one-sided for deformable ones.
enum class TractionForm { automatic, none, drag, one_sided, gradient, quadratic };
/// Whose area a vertex's drag counts: a network's drag belongs to its material, a liquid interface's to its present
/// area.
enum class DragArea { reference, current };
struct TractionConfig {
  TractionForm form = TractionForm::automatic;
  double coefficient = 100.0;  ///< drag: c_d in c = c_d mu A_node / R
  DragArea area = DragArea::reference;
  double probe_length = 0.0;  ///< of all forms but drag: 0 means the mean grid spacing, times 1.5 for quadratic
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
  double mesh_control = 0;  ///< stiffness of tangential springs between vertices; 0: by the coupling
};
enum class MembraneLaw { neo_hookean, skalak };
struct MembraneConfig {
  MembraneLaw law = MembraneLaw::neo_hookean;
  double shear = 0;  ///< G_s, force / length
  double ratio = 1;  ///< C of Skalak's law
};
struct PressureConfig {
  double value = 0;  ///< inside over outside
};
struct PotentialsConfig {
  std::optional<EdgeConfig> edge;
  std::optional<MembraneConfig> membrane;
  std::optional<BendingConfig> bending;
  std::optional<VolumeConfig> volume;
  std::optional<PressureConfig> pressure;
  std::optional<AreaConfig> area;  ///< per face
  std::optional<AreaConfig> total_area;
  std::optional<SurfaceTensionConfig> surface_tension;
};

enum class PlaneSide { on, beyond };
/// Vertices of a body by a name: those for which all that is given holds. Points and directions are those of the
/// surface before `rotation` and `center`, and go along with it.
struct SelectionConfig {
  std::string name;
  bool border = false;              ///< at a free border
  std::optional<Vec3> border_near;  ///< at the border that comes nearest to this point
  struct Sphere {
    Vec3 center;
    double radius = 0;
  };
  struct Box {
    Vec3 lower, upper;
  };
  struct Cylinder {
    Vec3 point, axis{0, 0, 1};
    double radius = 0;
  };
  struct Plane {
    Vec3 point, normal{0, 0, 1};
    PlaneSide side = PlaneSide::on;
    std::optional<double> tolerance;  ///< default: a hundredth of the mean edge
  };
  struct Extreme {
    Vec3 direction{1, 0, 0};
    double fraction = 0;
  };
  std::optional<Sphere> sphere;
  std::optional<Box> box;
  std::optional<Cylinder> cylinder;
  std::optional<Plane> plane;
  std::optional<Extreme> extreme;  ///< the part of all vertices that lies farthest along a direction

  bool has_condition() const { return border || border_near || sphere || box || cylinder || plane || extreme; }
};

/// Springs from the vertices of a selection to their places at the start.
struct TetherConfig {
  std::string name, selection;
  double stiffness = 0, damping = 0;  ///< of each vertex
};

/// each: a cord from every vertex; middle: one cord from the mean of the vertices.
enum class CordEnds { each, middle };
/// Cords that pull and never push.
struct CordConfig {
  std::string name, from;
  std::string to;             ///< a selection; empty: the point
  std::optional<Vec3> point;  ///< fixed, in the surface's coordinates
  CordEnds ends = CordEnds::each;
  double stiffness = 0;
  std::optional<double> rest_length;
  double rest_fraction = 1;  ///< of the length at the start, unless rest_length is given
};

/// A constant force, shared evenly by the vertices of a selection.
struct PullConfig {
  std::string name, selection;
  Vec3 force;  ///< turned along with the surface
};

enum class MotionKind { fixed, prescribed, rigid, hinge, deformable };
/// one-way: the flow does not feel the body; loose, strong: who moves when, once a step or until they agree;
/// force-spreading, local-mass: deformable bodies move with the flow in each substep; automatic: by the mass ratio.
enum class CouplingKind { automatic, one_way, loose, strong, force_spreading, local_mass };
/// Vertices of a deformable body so coupled move by Newton's law, which wants a mass.
constexpr bool moves_by_newton(CouplingKind coupling) {
  return coupling == CouplingKind::one_way || coupling == CouplingKind::loose || coupling == CouplingKind::strong;
}
/// The tables of named things within a [[body]].
enum class PartKind { selection, tether, cord, pull };
/// What moves a rigid or hinged body: the momentum balance of its forcing, or the stress at the ends of its probes.
enum class LoadSource { momentum_balance, probes };

/// motion = "prescribed": where the body is at time t, from its place in the case file. Texts are formulas or names of
/// signals; empty: 0.
struct PathConfig {
  std::string x, y, z;  ///< displacement
  std::string angle;    ///< degrees, about the axis through the pivot
  Vec3 axis{0, 0, 1};
  std::optional<Vec3> pivot;  ///< default: the body's center; moves along with the displacement
};

/// What a body is made of.
struct MaterialConfig {
  std::optional<double> density;  ///< default: the fluid's
  double thickness = 0;           ///< of the wall; 0: a solid
  std::optional<double> young;    ///< of deformable bodies; along the fibre, if there is one
  double poisson = 1.0 / 3.0;
  std::optional<Vec3> fibre;           ///< direction in the surface before `rotation`
  std::optional<double> young_across;  ///< Young's modulus across the fibre; default: young
  std::optional<double> mass;          ///< instead of density times volume; scales the inertia
  std::optional<Vec3> inertia;         ///< principal moments along the axes of the surface's file, before `rotation`
};

/// motion = "rigid".
struct RigidConfig {
  Vec3 velocity, angular_velocity;  ///< at the start
  Vec3 free_translation{1, 1, 1};   ///< 1: may move along this axis of the box; 0: may not
  Vec3 free_rotation{1, 1, 1};      ///< the same about this axis
  double virtual_mass = 0;          ///< fraction of the displaced fluid's mass added on both sides of Newton's law
};

/// motion = "hinge".
struct HingeConfig {
  Vec3 point, axis{0, 1, 0};
  double angle = 0, rate = 0;                         ///< degrees, and degrees a time, at the start
  std::optional<double> min_angle, max_angle;         ///< degrees; none: no stop
  double restitution = 0;                             ///< of the stops
  std::optional<double> inertia;                      ///< about the axis; else from the material
  double damping = 0, stiffness = 0, rest_angle = 0;  ///< torque -damping rate - stiffness (angle - rest_angle)
  double virtual_inertia = 0;                         ///< added on both sides of the equation of motion
};
/// When a body acts on the flow: in a part of each period, from phase[0] on and not from phase[1] on; over the end of
/// the period if phase[0] is the larger one.
struct ScheduleConfig {
  double period = 0;
  std::array<double, 2> phase{0, 1};
};
struct BodyConfig {
  std::string name;
  SurfaceSpec surface;
  RotationConfig rotation;
  Vec3 center{0, 0, 0};
  PlacementConfig placement;
  MotionKind motion = MotionKind::deformable;
  CouplingKind coupling = CouplingKind::automatic;
  PathConfig path;
  bool contact = true;                     ///< takes part in repulsion
  std::optional<ScheduleConfig> schedule;  ///< none: it always acts
  MaterialConfig material;
  RigidConfig rigid;
  HingeConfig hinge;
  LoadSource loads = LoadSource::momentum_balance;
  int marker_refinement = 0;                ///< markers along the edge of a face; 0: as many as the grid asks for
  std::optional<double> marker_retraction;  ///< spacings; default: transfer's, 0 for deformable bodies
  bool tight = false;                       ///< of a fixed open body: no net flow passes it
  std::vector<std::string> tight_parts;     ///< selections that this holds for one by one, and for the rest
  bool thin_sheet = true;                   ///< of an open surface: forces along it as a sheet without thickness takes
  std::optional<double> mass_per_vertex;    ///< default: from thickness and density; else 1 one-way, 0 two-way
  bool held = false;                        ///< its mean velocity is kept zero
  bool separates = false;                   ///< an open body that moves with the flow: see the key
  bool volume_correction = true;            ///< of a closed body that moves with the flow
  double damping = 0.0;                     ///< force = -damping * velocity of the vertex
  double inner_damping = 0.0;               ///< force along an edge = -inner_damping * rate of its length
  std::optional<int> substeps;              ///< within a fluid step; else found from the stability limit
  TractionConfig traction;
  PotentialsConfig potentials;
  std::vector<SelectionConfig> selections;
  std::vector<std::string> pinned;  ///< selections whose vertices stay where they are
  std::vector<std::string> watch;   ///< selections whose mean place and motion the body's table has
  std::vector<TetherConfig> tethers;
  std::vector<CordConfig> cords;
  std::vector<PullConfig> pulls;
};

struct ImmersedBoundaryConfig {
  int forcing_iterations = 1;
  bool carry_forces = false;
};

/// automatic: quasi-newton where deformable bodies are coupled strongly, else aitken.
enum class StrongScheme { automatic, aitken, quasi_newton, hamming };
struct CouplingConfig {
  StrongScheme scheme = StrongScheme::automatic;
  /// Largest change of a velocity between iterations, over the largest velocity. Interpolation jumps by about 1e-5
  /// where a marker changes its nodes, and light bodies multiply that by their added mass.
  double tolerance = 1e-4;
  int max_iterations = 50;
  double relaxation = 0.5;  ///< of the first iteration of a step
  int reuse = 2;            ///< steps whose secants serve in the present one
};

struct RepulsionConfig {
  double range = 0;         ///< 0: none
  double strength = 0;      ///< pressure scale
  bool with_itself = true;  ///< deformable bodies
};

struct HistoryConfig {
  long every = 10;
};
struct SeriesConfig {
  std::optional<double> interval;  ///< in time
  std::optional<long> every;       ///< in steps
  std::vector<double> phases;      ///< of every cycle; none of the three: not written
};
struct FieldsConfig : SeriesConfig {
  bool vorticity = false;
};
/// Means of the flow over all cycles, by phase.
struct PhaseAverageConfig {
  int bins = 0;     ///< equal parts of the cycle
  double from = 0;  ///< time before which nothing counts
  long every = 1;   ///< steps between two samples
};
struct OutputConfig {
  std::optional<double> period;  ///< of the cycle, which begins at time 0
  HistoryConfig history;
  FieldsConfig fields;
  SeriesConfig surfaces;
  std::optional<PhaseAverageConfig> phase_average;
};

/// How far below a point fast fluid reaches in a cavity.
struct JetConfig {
  Vec3 origin, axis{0, 0, -1};
  double threshold = 0;  ///< of the velocity along the axis
};
/// The inside of a body, or what it and flat lids on its borders enclose, followed over time.
struct CavityConfig {
  std::string name, body;
  std::string flow;              ///< what comes in, to compare with: a signal's name or a formula of t; empty: nothing
  double flow_factor = 1;        ///< on it
  std::optional<double> period;  ///< default: the signal's, else output.period
  std::optional<double> ejection_fraction;  ///< sets the scale of the signal
  std::optional<JetConfig> jet;
};

struct CheckpointConfig {
  std::optional<long> every;      ///< in steps
  std::optional<double> minutes;  ///< of wall-clock time; neither: only when the run stops
  int keep = 2;                   ///< the newest that stay; 0: none are written
};

/// Quantities that are 1 in the case's own units, as texts such as "25 mm": length, density, and velocity or time.
struct UnitsConfig {
  std::string length, velocity, time, density;
};

struct CaseConfig {
  std::string title = "untitled";
  std::optional<UnitsConfig> units;
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
  ImmersedBoundaryConfig immersed_boundary;
  CouplingConfig coupling;
  RepulsionConfig repulsion;
  std::vector<BodyConfig> bodies;
  std::vector<CavityConfig> cavities;
  OutputConfig output;
  CheckpointConfig checkpoint;
};

}  // namespace pliant
