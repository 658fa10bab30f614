#include "potentials/shape_state.hpp"

#include "potentials/lane_records.hpp"

namespace pliant {

ShapeState::ShapeState(const TriangleMesh& mesh)
    : mesh_(&mesh),
      position_records_(4 * static_cast<std::size_t>(mesh.n_vertices())),
      face_records_(4 * padded(static_cast<std::size_t>(mesh.n_faces()))),
      face_areas_(padded(static_cast<std::size_t>(mesh.n_faces()))),
      inverse_edge_lengths_(padded(static_cast<std::size_t>(mesh.n_edges()))) {
  for (auto& component : edge_vectors_) component.resize(inverse_edge_lengths_.size());
}

void ShapeState::update(std::span<const Vec3> positions) {
  positions_ = positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Record record = {positions[v].x, positions[v].y, positions[v].z, 0};
    std::memcpy(position_records_.data() + 4 * v, &record, sizeof(record));
  }
  update_faces();
  update_edges();
}

void ShapeState::update_faces() {
  Lanes twice_area{}, six_volumes{};
  const Vec3 apex = positions_.empty() ? Vec3{} : positions_[0];
  for_each_batch(mesh_->vertices_of_face(), [&](std::size_t begin, const Face* faces, int count) {
    LaneVec x[3];
    for (int k = 0; k < 3; ++k)
      x[k] = gather_records(position_records_.data(), [&](int l) { return faces[l][k]; }).vector;
    const LaneVec vector = cross(x[1] - x[0], x[2] - x[0]);
    const Lanes length = square_root(dot(vector, vector));
    store(0.5 * length, face_areas_.data() + begin);
    store_records({vector, 1 / length}, face_records_.data() + 4 * begin, 1);
    const Lanes volumes = dot(x[0] - LaneVec{apex.x + Lanes{}, apex.y + Lanes{}, apex.z + Lanes{}}, vector);
    twice_area += without_lanes_from(count, length);
    six_volumes += without_lanes_from(count, volumes);
  });
  area_ = 0.5 * sum(twice_area);
  volume_ = sum(six_volumes) / 6.0;
}

void ShapeState::update_edges() {
  for_each_batch(mesh_->vertices_of_edge(), [&](std::size_t begin, const std::array<int, 2>* edges, int) {
    const auto end = [&](std::size_t k) {
      return gather_records(position_records_.data(), [&](int l) { return edges[l][k]; }).vector;
    };
    const LaneVec vector = end(1) - end(0);
    store(vector.x, edge_vectors_[0].data() + begin);
    store(vector.y, edge_vectors_[1].data() + begin);
    store(vector.z, edge_vectors_[2].data() + begin);
    store(1 / square_root(dot(vector, vector)), inverse_edge_lengths_.data() + begin);
  });
}

}  // namespace pliant
