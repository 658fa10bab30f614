#include "potentials/membrane.hpp"

#include "mesh/geometry.hpp"
#include "potentials/lane_records.hpp"

namespace pliant {
namespace {

/// Energy a reference area, and its derivatives by s = l1^2 + l2^2 and j = l1^2 l2^2.
template <class Number>
struct Response {
  Number energy, by_sum, by_square;
};

template <class Number>
Response<Number> respond(const NeoHookean& law, Number sum, Number square) {
  const Number inverse = 1.0 / square;
  const double half = 0.5 * law.shear;
  return {half * (sum - 3.0 + inverse), half + Number{}, -half * inverse * inverse};
}

template <class Number>
Response<Number> respond(const Skalak& law, Number sum, Number square) {
  const Number i1 = sum - 2.0, i2 = square - 1.0;
  const double quarter = 0.25 * law.shear;
  return {quarter * (i1 * i1 + 2.0 * i1 - 2.0 * i2 + law.ratio * i2 * i2), quarter * (2.0 * i1 + 2.0),
          quarter * (2.0 * law.ratio * i2 - 2.0)};
}

}  // namespace

Membrane Membrane::about_shape(const TriangleMesh& mesh, std::span<const Vec3> reference, const SheetLaw& law) {
  Membrane membrane;
  membrane.law = law;
  membrane.reference_area = face_areas(mesh, reference);
  for (std::size_t f = 0; f < membrane.reference_area.size(); ++f) {
    const Face& face = mesh.vertices_of_face()[f];
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 apex = reference[face[(k + 2) % 3]];
      const double product = dot(reference[face[k]] - apex, reference[face[(k + 1) % 3]] - apex);
      weights[k] = product / (4.0 * membrane.reference_area[f] * membrane.reference_area[f]);
    }
    membrane.weights.push_back(weights);
  }
  return membrane;
}

double Membrane::energy(const ShapeState& shape) const {
  const auto faces = shape.mesh().vertices_of_face();
  double total = 0;
  for (std::size_t f = 0; f < weights.size(); ++f) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = shape.positions()[faces[f][(k + 1) % 3]] - shape.positions()[faces[f][k]];
      sum += weights[f][k] * dot(edge, edge);
    }
    const double stretch = 0.5 * norm(shape.face_vector(f)) / reference_area[f];
    const double square = stretch * stretch;
    total += reference_area[f] * std::visit([&](const auto& l) { return respond(l, sum, square).energy; }, law);
  }
  return total;
}

// Of its arguments the sum depends on the lengths of edges, the square on the area of the face.
void Membrane::add_stress(const ShapeState& shape, InnerStress& stress) const {
  const auto edges_of_face = shape.mesh().edges_of_face();
  std::visit(
      [&](const auto& sheet) {
        for_each_batch(edges_of_face, [&](std::size_t begin, const std::array<int, 3>* edges, int count) {
          std::array<std::array<double, 3>, n_lanes> rest;
          const auto* weight = batch_at(std::span<const std::array<double, 3>>(weights), begin, rest);
          Lanes sum{};
          for (std::size_t k = 0; k < 3; ++k) {
            const Lanes inverse = gather_numbers(shape.inverse_edge_lengths(), [&](int l) { return edges[l][k]; });
            const Lanes w = {weight[0][k], weight[1][k], weight[2][k], weight[3][k],
                             weight[4][k], weight[5][k], weight[6][k], weight[7][k]};
            sum += w / (inverse * inverse);
          }
          std::array<double, n_lanes> last;
          const double* areas = reference_area.data() + begin;
          if (count < n_lanes) {
            for (int l = 0; l < n_lanes; ++l) last[l] = areas[std::min(l, count - 1)];
            areas = last.data();
          }
          const Lanes area0 = load_lanes(areas), stretch = load_lanes(shape.face_areas() + begin) / area0;
          const auto response = respond(sheet, sum, stretch * stretch);
          double tension[n_lanes], pull[n_lanes];
          store(2.0 * response.by_square * stretch, tension);
          store(2.0 * area0 * response.by_sum, pull);
          for (int l = 0; l < count; ++l) {
            stress.tension[begin + l] += tension[l];
            for (std::size_t k = 0; k < 3; ++k) stress.pull[edges[l][k]] += pull[l] * weight[l][k];
          }
        });
      },
      law);
}

void Membrane::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

}  // namespace pliant
