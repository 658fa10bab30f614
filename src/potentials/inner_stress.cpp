#include "potentials/inner_stress.hpp"

#include <limits>

#include "potentials/lane_records.hpp"
#include "potentials/shape_state.hpp"

namespace pliant {

void InnerStress::reset(const TriangleMesh& mesh) {
  const auto edges = static_cast<std::size_t>(mesh.n_edges()), faces = static_cast<std::size_t>(mesh.n_faces());
  pull.assign(padded(edges), 0.0);
  moment.assign(padded(edges), 0.0);
  tension.assign(padded(faces), 0.0);
  pressure = 0;
  corner_forces_.resize(3 * 4 * padded(faces));
}

// All but the pulls of edges act along a face's unit normal n or in its plane across an edge. With x_k the vertices of
// a face, e_k the edge from x_k to x_{k+1}, N = |N| n the face vector, and indices modulo 3:
//
//   dV/dx_k = N / 6 (a closed surface's share of this face),  dA/dx_k = n x e_{k+1} / 2,
//   l dtheta/dx = -(n / |N|) times e_k.e_{k+1} at the start, e_{k+2}.e_k at the end of edge k, |e_k|^2 opposite to it,
//
// for the angle theta of the hinge on edge k, as far as this face turns it. An edge pulls in each of its faces by half.
void InnerStress::add_forces(const ShapeState& shape, std::span<Vec3> forces) {
  const TriangleMesh& mesh = shape.mesh();
  const auto faces_of_edge = mesh.faces_of_edge();
  if (!mesh.is_closed())
    for (std::size_t e = 0; e < faces_of_edge.size(); ++e)
      if (faces_of_edge[e][1] < 0) pull[e] *= 2, moment[e] = 0;

  const auto edges_of_face = mesh.edges_of_face();
  std::array<std::array<int, 3>, n_lanes> rest;
  const double* positions = shape.position_records();
  const double sixth = pressure / 6;
  for_each_batch(mesh.vertices_of_face(), [&](std::size_t begin, const Face* faces, int) {
    LaneVec x[3];
    for (int k = 0; k < 3; ++k) x[k] = gather_records(positions, [&](int l) { return faces[l][k]; }).vector;
    const LaneVec e[3] = {x[1] - x[0], x[2] - x[1], x[0] - x[2]};
    const Lanes e01 = dot(e[0], e[1]), e12 = dot(e[1], e[2]), e20 = dot(e[2], e[0]);
    const Lanes along[3] = {e01, e12, e20};

    const auto* edges = batch_at(edges_of_face, begin, rest);
    Lanes pulls[3], moments[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto index = [&](int l) { return edges[l][k]; };
      pulls[k] = 0.5 * gather_numbers(pull.data(), index);
      moments[k] = gather_numbers(moment.data(), index);
    }
    const LaneRecords face = gather_records(shape.face_records() + 4 * begin, [](int l) { return l; });
    const Lanes inverse = face.number < std::numeric_limits<double>::infinity() ? face.number : Lanes{};
    const LaneVec n = inverse * face.vector;
    const LaneVec half = (0.5 * load_lanes(tension.data() + begin)) * n;
    const LaneVec by_pressure = (sixth + Lanes{}) * face.vector;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3, before = (k + 2) % 3;
      // |e_next|^2 = -e_next.(e_k + e_before), since the edges add up to zero.
      const Lanes square = -along[k] - along[next];
      const Lanes bend = moments[k] * along[k] + moments[before] * along[next] + moments[next] * square;
      const LaneVec force =
          by_pressure + (inverse * bend) * n + cross(e[next], half) + pulls[k] * e[k] - pulls[before] * e[before];
      store_records({force, Lanes{}}, corner_forces_.data() + 4 * (3 * begin + static_cast<std::size_t>(k)), 3);
    }
  });

  const int n_vertices = mesh.n_vertices();
  for (int v = 0; v < n_vertices; ++v) {
    Record total{};
    for (const int corner : mesh.corners_of_vertex(v))
      total += load_record(corner_forces_.data() + 4 * static_cast<std::size_t>(corner));
    forces[static_cast<std::size_t>(v)] += {total[0], total[1], total[2]};
  }
}

}  // namespace pliant
