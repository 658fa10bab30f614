#pragma once
#include <string>
#include <vector>

#include "mesh/surface.hpp"

/// What the built-in shapes share.
namespace pliant {

/// Vertices and faces of a shape as it grows.
struct ShapeParts {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<NamedVertices> selections;

  int add_vertex(Vec3 x) {
    positions.push_back(x);
    return static_cast<int>(positions.size()) - 1;
  }
};

/// Faces between the rings of a disc, counter-clockwise if the rings are. Ring k lists sectors * k + 1 vertices, so a
/// ring that is closed repeats its first vertex at the end; ring 0 is the centre alone. Every sector of ring k is cut
/// into k parts.
void add_ring_faces(const std::vector<std::vector<int>>& rings, int sectors, std::vector<Face>& faces);

/// Vertex j of the m that are spread evenly over a circle in the x-y plane, from the x axis on; j may be a fraction.
/// All shapes with round borders take theirs from here, so that borders of one radius and edge are the same bit for
/// bit.
Vec3 circle_vertex(double radius, int m, double j, double z = 0);

/// Into how many parts of about `edge` a circle is cut: a multiple of six.
int parts_of_circle(double radius, double edge);

/// The surface, its vertices numbered by their first appearance along the faces.
Surface finish_shape(const ShapeParts& parts);

/// Into how many parts of about `edge` a length is cut, at least one.
int parts_of(double length, double edge);

/// Collects what is wrong with the sizes of a shape.
class ShapeChecks {
 public:
  explicit ShapeChecks(std::string shape) : shape_(std::move(shape)) {}
  void positive(const char* name, double value);
  /// Faces are no longer than the shape is thick. An edge is refused if it makes more than ten million faces of a shape
  /// of this area.
  void edge(double given, double thickness, double area);
  /// Throws InputError with every problem.
  void finish() const;

 private:
  std::string shape_;
  std::vector<std::string> problems_;
};

}  // namespace pliant
