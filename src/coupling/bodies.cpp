#include "coupling/bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/angles.hpp"
#include "core/error.hpp"
#include "coupling/body_stream.hpp"
#include "coupling/make_body_kind.hpp"
#include "mesh/geometry.hpp"
#include "parallel/agree.hpp"
#include "parallel/sparse_exchange.hpp"
#include "structure/place_bodies.hpp"
#include "structure/schedule_of_body.hpp"

namespace pliant {
namespace {

Quaternion to_quaternion(const Mat3& m) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = m[i][j];
  const Eigen::Quaterniond q(rotation);
  return normalized(Quaternion{q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

Bodies::Bodies(const CaseConfig& config, const Grid& grid) : grid_(grid), first_id_(1, 0) {
  auto placed = place_bodies(config);
  std::vector<std::string> problems;
  for (std::size_t k = 0; k < config.bodies.size(); ++k) {
    try {
      kinds_.push_back(make_body_kind(config, k, std::move(placed[k].shape), grid));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  for (const auto& body : placed) first_id_.push_back(first_id_.back() + static_cast<long>(body.placements.size()));
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    for (std::size_t c = 0; c < placed[k].placements.size(); ++c) {
      Body body = make_copy(k, first_id_[k] + static_cast<long>(c), placed[k].placements[c]);
      if (home_of(body) == grid.ranks().rank()) bodies_.push_back(std::move(body));
    }
  is_on_.assign(kinds_.size(), true);
  follow_schedules(0);
}

std::vector<std::size_t> Bodies::follow_schedules(double time) {
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const auto& schedule = kinds_[k].config.schedule;
    const bool is_on = !schedule || pliant::is_on(*schedule, time);
    if (is_on != is_on_[k]) changed.push_back(k);
    is_on_[k] = is_on;
  }
  for (Body& body : bodies_)
    if (!is_on(body)) {
      body.loads = {};
      body.slip = {};
      body.stresses = {};
      body.carried_forces.clear();
    }
  return changed;
}

Body Bodies::blank_copy(std::size_t kind, long id) const {
  Body body;
  body.id = id;
  body.kind = kind;
  body.surface = kinds_[kind].prototype;
  body.surface.name = copy_name(kinds_[kind].config, static_cast<std::size_t>(id - first_id_[kind]),
                                static_cast<std::size_t>(count(kind)));
  return body;
}

Body Bodies::make_copy(std::size_t k, long id, const Placement& placement) const {
  const BodyKind& kind = kinds_[k];
  const auto& config = kind.config;
  Body body = blank_copy(k, id);
  body.origin = placement.center;
  body.start = placement.center + placement.rotation * kind.centroid;
  body.start_orientation = to_quaternion(placement.rotation);
  body.pose.center = body.start;
  body.pose.orientation = body.start_orientation;
  if (config.motion == MotionKind::rigid) {
    body.pose.velocity = config.rigid.velocity;
    body.pose.angular_velocity = config.rigid.angular_velocity;
  }
  if (config.motion == MotionKind::hinge) {
    body.hinge = {degree * config.hinge.angle, degree * config.hinge.rate};
    body.pose = hinged_pose(body, kind);
  }
  if (config.motion == MotionKind::prescribed) body.pose = prescribed_pose(body, kind, 0);
  if (kind.has_pose()) follow_pose(body, kind);
  else body.surface.positions = place(body.surface.positions, placement);
  body.surface.reference = body.surface.positions;
  body.surface.origin = body.origin;
  body.surface.orientation = body.start_orientation;
  body.told = body.told_before = body.met = body.pose;
  return body;
}

int Bodies::home_of(const Body& body) const {
  const double lower = grid_.origin().z, height = grid_.size().z;
  double z = mean_position(body.surface.positions).z;
  if (grid_.is_periodic(2)) z -= height * std::floor((z - lower) / height);
  return rank_of_plane(grid_.cells()[2], grid_.ranks().size(), grid_.plane_of_height(z));
}

const Body* Bodies::find(long id) const {
  const auto found =
      std::lower_bound(bodies_.begin(), bodies_.end(), id, [](const Body& b, long wanted) { return b.id < wanted; });
  return found != bodies_.end() && found->id == id ? &*found : nullptr;
}

void Bodies::migrate() {
  if (grid_.ranks().size() == 1 || count() == 0) return;
  std::vector<std::vector<std::byte>> outgoing(static_cast<std::size_t>(grid_.ranks().size()));
  std::vector<ByteWriter> writers(outgoing.size());
  std::erase_if(bodies_, [&](const Body& body) {
    const int home = home_of(body);
    if (home == grid_.ranks().rank()) return false;
    auto& writer = writers[static_cast<std::size_t>(home)];
    writer.write(body.id);
    write_body(body, kind_of(body), writer);
    return true;
  });
  for (std::size_t r = 0; r < writers.size(); ++r) outgoing[r] = writers[r].take();
  long n_arrived = 0;
  for (const auto& bytes : exchange_bytes(grid_.ranks(), outgoing)) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0) {
      const auto id = reader.read<long>();
      bodies_.push_back(read(id, reader));
      ++n_arrived;
    }
  }
  sort_and_count(n_arrived);
}

void Bodies::sort_and_count(long n_arrived) {
  std::sort(bodies_.begin(), bodies_.end(), [](const Body& a, const Body& b) { return a.id < b.id; });
  std::array<double, 2> sums{static_cast<double>(bodies_.size()), static_cast<double>(n_arrived)};
  grid_.ranks().sum(sums);
  if (sums[1] > 0) ++arrangement_;
  if (sums[0] != static_cast<double>(count()))
    throw CollectiveError(fmt::format("{} of {} bodies are left: bodies were lost between ranks", sums[0], count()));
}

Body Bodies::read(long id, ByteReader& reader) const {
  const auto after = std::upper_bound(first_id_.begin(), first_id_.end(), id);
  if (id < 0 || after == first_id_.end()) throw ByteStreamError(fmt::format("there is no body number {}", id));
  const auto kind = static_cast<std::size_t>(after - first_id_.begin()) - 1;
  Body body = blank_copy(kind, id);
  read_body(reader, kinds_[kind], body);
  return body;
}

std::vector<BodyBlob> Bodies::save() const {
  std::vector<BodyBlob> saved;
  for (const Body& body : bodies_) {
    ByteWriter writer;
    write_body(body, kind_of(body), writer);
    saved.push_back({body.id, writer.take()});
  }
  return saved;
}

void Bodies::restore(const std::vector<BodyBlob>& saved) {
  std::vector<Body> bodies;
  std::string problem;
  try {
    for (const auto& blob : saved) {
      ByteReader reader(blob.bytes);
      bodies.push_back(read(blob.id, reader));
      reader.expect_end();
    }
  } catch (const std::exception& error) {
    problem = fmt::format("the saved bodies are not those of this case: {}", error.what());
  }
  agree(grid_.ranks(), problem);
  bodies_ = std::move(bodies);
  if (grid_.ranks().size() > 1) migrate();
  else sort_and_count(0);
}

}  // namespace pliant
