#pragma once
#include <array>
#include <span>
#include <vector>

#include "structure/deformable_body.hpp"
#include "structure/repulsion.hpp"

namespace pliant {

/// Contact of surfaces whose vertices move by themselves. At gap g < range they press on each other with about
///   p(g) = strength (range - g) / (g - floor),
/// floor = range / 5, but not more than half the gap at the start of a step of the fluid: no pressure brings surfaces
/// to touch, and no step takes more than half of what little is between them.
struct ContactLaw {
  double range = 0;
  double strength = 0;  ///< the pressure at a gap of 0.6 ranges
  bool with_itself = true;
};

/// What of other bodies' surfaces is near a body, at the beginning of a step.
struct Obstacles {
  std::vector<Vec3> positions, velocities;
  std::vector<double> areas;  ///< a third of the area of the faces around a vertex
  std::vector<Face> faces;
  /// Bodies in the order of their numbers; a body may come twice, as itself and as its image through a periodic side.
  struct Part {
    long body = 0;
    bool yields = false;  ///< it is deformable too
    int vertices_end = 0, faces_end = 0;
  };
  std::vector<Part> parts;
};

/// What a substep of the structure would do without contact.
struct ContactMotion {
  std::span<const Vec3> positions;     ///< at its beginning
  std::span<const Vec3> velocities;    ///< those that would move the vertices through it
  std::span<const double> mobilities;  ///< change of those velocities by a unit of force; step / mass without drag
  double elapsed = 0;                  ///< since the obstacles were as told
  double step = 0;
  std::span<const double> masses = {};  ///< that move with the vertices, of fluid too; none: the body's own
};

/// Contact of one deformable body with others, with walls and with itself.
///
/// Vertices touch faces and edges touch edges, each by its nearest points; forces act along the line that joins those,
/// by their weights on the corners. Within a substep the gap closes by what all vertices would do without contact, and
/// opens by the force that is sought: with W the velocity at which a unit of force opens the gap, the gap g' at the end
/// is the positive root of
///   g' = g + h v + h W K (range / g' - 1),  K the strength times the share of area,
/// so any step is stable and no gap is closed within it. Touches that share vertices are settled in turns, until forces
/// hardly change.
///
/// Two deformable bodies are advanced apart from each other. Each takes the other to deviate from the motion at the
/// beginning of the step as itself does, mirrored: seen so from both sides a gap that is positive for both is positive
/// in fact, up to what directions turn within the step, for which there is the floor; and neither pushes twice. Nothing
/// but the own body has to be known but for what `begin` is told.
class SurfaceContact {
 public:
  SurfaceContact(const ContactLaw& law, const RepulsionBox& walls) : law_(law), walls_(walls) {}

  /// Beyond the range, what comes near within a step is followed; faces further off than this at the start are not.
  static double skin(double range) { return 0.25 * range; }

  /// A new step of length `span`: obstacles as they are now. Looks for pairs of the surface with itself if it has
  /// changed enough.
  void begin(const DeformableBody& body, Obstacles obstacles, double span);

  /// Adds to the forces on the vertices. Velocities at the end of the substep are then those without contact plus
  /// mobility times these forces.
  void add_forces(const ContactMotion& motion, std::span<Vec3> forces);

  const Obstacles& obstacles() const { return obstacles_; }
  /// Force times time since `begin`: on each vertex by other deformable bodies; on each vertex of the obstacles.
  std::span<const Vec3> impulses_of_yielding() const { return own_impulses_; }
  std::span<const Vec3> impulses_on_obstacles() const { return obstacle_impulses_; }
  /// Of each vertex in the last substep: the mass, and the drag over velocity that the mobilities say.
  std::span<const double> masses() const { return masses_; }
  std::span<const double> resistances() const { return resistances_; }

  /// The least gap that the last substep began with; more than the range: none within it.
  double least_gap() const { return least_gap_; }

 private:
  enum class Partner { itself, yielding, posed };
  /// Corners of the two elements; own vertices first, obstacles behind. A vertex and a face, or two edges.
  struct Pair {
    std::array<int, 4> nodes;
    int part = -1;  // of the obstacles; -1: itself
    Partner partner = Partner::itself;
    double share = 0;  // strength times area
    double range = 0;
    Vec3 direction;     // from the second to the first element, when last looked at; 0: never
    double floor = -1;  // below which this step does not bring the gap; negative: not yet known
  };
  struct Touch {
    std::array<int, 4> nodes;
    std::array<double, 4> weights;  // of the gap's change with the nodes' positions, along the normal
    Vec3 normal;
    double gap;
    double free_room, room;  // above the floor: at the end without contact, and at the range
    double share;
    Partner partner;
    double force = 0;
  };

  struct Nodes;
  Nodes nodes_of(const ContactMotion& motion);
  std::vector<char> find_bent(std::span<const Vec3> positions) const;
  void find_own_pairs(std::span<const Vec3> positions);
  void find_foreign_pairs(const Nodes& nodes, double remaining);
  void renew_pairs(const Nodes& nodes, double elapsed);
  bool look(const Nodes& nodes, Pair& pair, bool edges, Touch& touch) const;
  void touch_points(const Nodes& nodes, std::vector<Pair>& pairs);
  void touch_edges(const Nodes& nodes, std::vector<Pair>& pairs);
  void touch_walls(const Nodes& nodes);
  double settle(Touch& touch, const ContactMotion& motion);
  void add_touch(const Touch& touch, double step, int n_own, std::span<Vec3> forces);

  ContactLaw law_;
  RepulsionBox walls_;
  TriangleMesh mesh_;
  std::vector<Vec3> reference_;
  std::vector<double> areas_;
  std::vector<Vec3> start_, start_velocities_;
  double span_ = 0;
  Obstacles obstacles_;
  std::vector<std::array<int, 2>> obstacle_edges_;
  std::vector<int> part_of_vertex_, part_of_edge_, part_of_face_;

  std::vector<Vec3> listed_at_;                       // where the body was when its own pairs were found
  std::vector<Pair> own_points_, own_edges_;          // with itself
  std::vector<Vec3> deviation_listed_;                // from the motion at the start, when foreign pairs were found
  std::vector<Pair> foreign_points_, foreign_edges_;  // with obstacles

  std::vector<Vec3> mirrored_, mirrored_velocities_, moved_obstacles_;
  std::vector<Touch> touches_, group_;
  std::vector<Vec3> settled_;  // velocities with contact
  std::vector<Vec3> own_impulses_, obstacle_impulses_;
  std::vector<double> resistances_, masses_;
  double least_gap_ = 0;
};

}  // namespace pliant
