#include "coupling/strong_unknowns.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/nodal_forces.hpp"
#include "mesh/geometry.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/rigid_vector.hpp"

namespace pliant {
namespace {

constexpr std::size_t n_rigid_velocities = 6, n_hinge_velocities = 1;
void pack(std::span<const Vec3> places, std::span<const Vec3> velocities, std::span<double> y) {
  for (std::size_t v = 0; v < places.size(); ++v)
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 3 * v + static_cast<std::size_t>(c);
      y[at] = places[v][c];
      y[3 * places.size() + at] = velocities[v][c];
    }
}

void unpack(std::span<const double> y, DeformableBody& body) {
  const std::size_t n = body.positions.size();
  for (std::size_t v = 0; v < n; ++v) {
    if (body.is_pinned(v)) continue;
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 3 * v + static_cast<std::size_t>(c);
      body.positions[v][c] = y[at];
      body.velocities[v][c] = y[3 * n + at];
    }
  }
}

constexpr std::size_t first_velocity_of_vector = 7;  // of a rigid body, pack()

bool is_rigid(const BodyKind& kind) { return kind.config.motion == MotionKind::rigid; }

std::span<const double> part(std::span<const double> all, std::size_t begin, std::size_t size) {
  return all.subspan(begin, size);
}

/// Turns rates of rotation into velocities: a hinge turns about its axis, a rigid body about its centre.
double extent_of(const Body& body, const BodyKind& kind) {
  double largest = 0;
  for (const Vec3& x : kind.reference) largest = std::max(largest, norm(x));
  if (is_rigid(kind)) return largest;
  return largest + norm(cross(kind.hinge.axis, body.start - kind.hinge.point));
}

void write(Vec3 v, std::span<double> to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
Vec3 read(std::span<const double> from) { return {from[0], from[1], from[2]}; }

bool is_at_stop(const HingeModel& hinge, double angle) { return angle <= hinge.min_angle || angle >= hinge.max_angle; }

/// What is not a number is not lost in this comparison.
double larger(double a, double b) { return b <= a ? a : b; }

/// What the hinge makes of a step under the torque of the flow.
HingeState after_step(HingeModel hinge, HingeState state, double torque, double step, double& acceleration) {
  hinge.virtual_inertia = 0;
  advance_hinge(state, acceleration, hinge, torque, step);
  return state;
}

}  // namespace

StrongUnknowns::StrongUnknowns(CoupledFlow& coupled, double step) : coupled_(coupled), step_(step) {
  for (Body& body : coupled.bodies().own()) {
    const auto& kind = coupled.bodies().kind_of(body);
    if (kind.coupling != CouplingKind::strong) continue;
    Item item;
    item.body = &body;
    item.kind = &kind;
    item.begin = values_.size();
    if (kind.has_pose()) item.extent = extent_of(body, kind);
    item.start = body.pose;
    item.start_acceleration = body.acceleration;
    item.start_hinge = body.hinge;
    item.start_hinge_acceleration = body.hinge_acceleration;
    item.scheme = coupled.settings().scheme == StrongScheme::hamming ? StrongScheme::hamming : StrongScheme::aitken;
    guess(item);
    items_.push_back(std::move(item));
  }
}

void StrongUnknowns::guess(Item& item) {
  if (!item.kind->has_pose()) return guess_vertices(item);
  if (item.scheme == StrongScheme::hamming) guess_by_hamming(item);
  if (item.scheme == StrongScheme::aitken) guess_by_newton(item);
}

// Under Hamming's formulas the layer of fluid at the wall counts with the mass, as image_of_vertices has it.
void StrongUnknowns::guess_vertices(Item& item) {
  Body& body = *item.body;
  const auto& surface = body.surface;
  const std::size_t n = surface.positions.size();
  body.flow_forces.resize(n);
  body.accelerations.resize(n);
  const double layer = coupled_.fluid().density * coupled_.flow().grid().mean_spacing();
  item.vertices = StrongVertices(body, layer, step_);
  if (item.scheme == StrongScheme::aitken) {
    item.size = item.vertices.size();
    values_.resize(item.begin + item.size);
    item.vertices.write(body, std::span(values_).subspan(item.begin, item.size));
    return;
  }
  std::vector<double> y(6 * n), f(6 * n);
  pack(surface.positions, surface.velocities, y);
  pack(surface.velocities, body.accelerations, f);
  const std::span<const double> kept = body.scheme;
  const bool continues =
      kept.size() > y.size() && std::equal(y.begin(), y.end(), kept.end() - static_cast<std::ptrdiff_t>(y.size()));
  item.hamming = continues ? Hamming::from_state(kept.first(kept.size() - y.size())) : Hamming(y, f);
  const auto predicted = item.hamming.predict(step_);
  item.size = y.size();
  values_.insert(values_.end(), predicted.begin(), predicted.end());
}

void StrongUnknowns::apply_vertices(Item& item) {
  Body& body = *item.body;
  const auto values = part(values_, item.begin, item.size);
  if (item.scheme == StrongScheme::aitken) {
    item.vertices.apply(body, *item.kind, coupled_.nodal_surroundings(), coupled_.contact_of(body), values);
    return;
  }
  unpack(values, body.surface);
  body.pose.center = mean_position(body.surface.positions);
  pliant::require_finite(body.surface);
}

void StrongUnknowns::image_of_vertices(Item& item, std::span<double> image) {
  Body& body = *item.body;
  if (item.scheme == StrongScheme::aitken) return item.vertices.write(body, image);
  auto& surface = body.surface;
  const std::size_t n = surface.positions.size();
  ShapeState shape(surface.mesh, surface.positions);
  const auto around = coupled_.nodal_surroundings();
  find_nodal_forces(body, *item.kind, shape, around.gravity, around.fluid_density, surface.forces);
  const double layer = around.fluid_density * coupled_.flow().grid().mean_spacing();
  const auto& start = item.vertices.start_velocities();
  for (std::size_t v = 0; v < n; ++v) {
    surface.forces[v] += body.flow_forces[v];
    const double added = layer * surface.reference_areas[v];
    const Vec3 inertia = (added / step_) * (surface.velocities[v] - start[v]);
    body.accelerations[v] = surface.is_pinned(v) ? Vec3{} : (surface.forces[v] + inertia) / (surface.masses[v] + added);
  }
  std::vector<double> rates(item.size);
  pack(surface.velocities, body.accelerations, rates);
  const auto corrected = item.hamming.correct(rates);
  std::copy(corrected.begin(), corrected.end(), image.begin());
}

void StrongUnknowns::guess_by_newton(Item& item) {
  item.size = is_rigid(*item.kind) ? n_rigid_velocities : n_hinge_velocities;
  values_.resize(item.begin + item.size);
  const auto values = std::span(values_).subspan(item.begin, item.size);
  if (is_rigid(*item.kind)) {
    write(item.start.velocity + step_ * item.start_acceleration.linear, values.subspan(0, 3));
    write(item.start.angular_velocity + step_ * item.start_acceleration.angular, values.subspan(3, 3));
    return;
  }
  // The torque of the step before, if there is one.
  const auto& hinge = item.kind->hinge;
  const double torque = torque_about_axis(hinge, coupled_.load_on(*item.body), item.start.center);
  values[0] = item.start_hinge.rate + (std::isfinite(torque) ? step_ * torque / hinge.inertia : 0.0);
}

// Changes the item's scheme where Hamming's formulas do not hold.
void StrongUnknowns::guess_by_hamming(Item& item) {
  const Body& body = *item.body;
  std::vector<double> y(is_rigid(*item.kind) ? rigid_vector_size : hinge_vector_size), f(y.size());
  if (is_rigid(*item.kind)) {
    pack(item.start, y);
    pack_rates(item.start, item.start_acceleration, f);
  } else {
    pack(item.start_hinge, y);
    pack_rates(item.start_hinge, item.start_hinge_acceleration, f);
  }
  // A body that something else has moved begins anew.
  const std::span<const double> kept = body.scheme;
  const bool continues =
      kept.size() > y.size() && std::equal(y.begin(), y.end(), kept.end() - static_cast<std::ptrdiff_t>(y.size()));
  item.hamming = continues ? Hamming::from_state(kept.first(kept.size() - y.size())) : Hamming(y, f);
  const auto predicted = item.hamming.predict(step_);
  if (!is_rigid(*item.kind)) {
    const auto& [angle, rate] = item.start_hinge;
    const auto& hinge = item.kind->hinge;
    const double far = angle + 2 * step_ * rate;
    if (is_at_stop(hinge, angle) || is_at_stop(hinge, far) || is_at_stop(hinge, predicted[0])) {
      item.scheme = StrongScheme::aitken;
      return;
    }
  }
  item.size = y.size();
  values_.insert(values_.end(), predicted.begin(), predicted.end());
}

// Places by the mean of the velocities at both ends.
void StrongUnknowns::set_from_velocities(Item& item) {
  const auto values = part(values_, item.begin, item.size);
  Body& body = *item.body;
  const double inverse = 1 / step_;
  RigidState end = item.start;
  end.velocity = read(values.subspan(0, 3));
  end.angular_velocity = read(values.subspan(3, 3));
  end.center += 0.5 * step_ * (item.start.velocity + end.velocity);
  const Vec3 turn = 0.5 * step_ * (item.start.angular_velocity + end.angular_velocity);
  end.orientation = normalized(from_rotation_vector(turn) * item.start.orientation);
  body.acceleration = {inverse * (end.velocity - item.start.velocity),
                       inverse * (end.angular_velocity - item.start.angular_velocity)};
  body.pose = end;
}

double StrongUnknowns::told_torque(const Item& item) const {
  return (values_[item.begin] - item.start_hinge.rate) * item.kind->hinge.inertia / step_;
}

void StrongUnknowns::set_hinge_from_torque(Item& item) {
  Body& body = *item.body;
  body.hinge = after_step(item.kind->hinge, item.start_hinge, told_torque(item), step_, body.hinge_acceleration);
}

void StrongUnknowns::rewind() {
  for (Item& item : items_)
    if (!item.kind->has_pose()) item.vertices.rewind(*item.body);
}

void StrongUnknowns::apply() {
  for (Item& item : items_) {
    Body& body = *item.body;
    if (!item.kind->has_pose()) {
      apply_vertices(item);
      continue;
    }
    const bool hamming = item.scheme == StrongScheme::hamming;
    const auto values = part(values_, item.begin, item.size);
    if (is_rigid(*item.kind)) {
      if (hamming) body.pose = unpack_rigid(values);
      else set_from_velocities(item);
    } else {
      if (hamming) {
        body.hinge = unpack_hinge(values);
        body.hinge.angle = std::clamp(body.hinge.angle, item.kind->hinge.min_angle, item.kind->hinge.max_angle);
      } else {
        set_hinge_from_torque(item);
      }
      body.pose = hinged_pose(body, *item.kind);
      body.acceleration = acceleration_of(item.kind->hinge, body.hinge, body.hinge_acceleration, body.start);
    }
    require_finite(body);
    follow_pose(body, *item.kind);
  }
}

// Virtual terms act on the change between iterations and vanish as these agree.
void StrongUnknowns::image_by_newton(Item& item, const RigidLoad& load, std::span<double> image) {
  const Body& body = *item.body;
  if (is_rigid(*item.kind)) {
    RigidState end = item.start;
    RigidAcceleration acceleration = body.acceleration;
    advance_rigid(end, acceleration, item.kind->rigid, load, step_);
    write(end.velocity, image.subspan(0, 3));
    write(end.angular_velocity, image.subspan(3, 3));
    return;
  }
  const auto& hinge = item.kind->hinge;
  const double torque = torque_about_axis(hinge, load, body.pose.center);
  double acceleration = 0;
  item.hinge_image = after_step(hinge, item.start_hinge, torque, step_, acceleration);
  image[0] = values_[item.begin] + step_ * (torque - told_torque(item)) / (hinge.inertia + hinge.virtual_inertia);
}

// The load holds the reaction of the fluid that moves along, to the mean acceleration of the step, where the formulas
// take rates at its end: with an added mass beyond 7/9 of the body's own that alone would ring. So as much of it as is
// known is taken out of the load and put to the body's own mass.
void StrongUnknowns::image_by_hamming(Item& item, const RigidLoad& load, std::span<double> image) {
  Body& body = *item.body;
  const auto& kind = *item.kind;
  std::vector<double> rates(item.size);
  if (is_rigid(kind)) {
    RigidModel model = kind.rigid;
    const double mass = std::max(model.virtual_mass, kind.added_mass_ratio * model.mass),
                 inertia = model.virtual_inertia;
    RigidLoad free = load;
    free.force += (mass / step_) * (body.pose.velocity - item.start.velocity);
    free.torque += (inertia / step_) * (body.pose.angular_velocity - item.start.angular_velocity);
    model.mass += mass;
    for (int d = 0; d < 3; ++d) model.inertia[d][d] += inertia;
    body.acceleration = rigid_acceleration(model, body.pose, free);
    pack_rates(body.pose, body.acceleration, rates);
  } else {
    HingeModel model = kind.hinge;
    const double inertia = std::max(model.virtual_inertia, kind.added_mass_ratio * model.inertia);
    const double torque = torque_about_axis(model, load, body.pose.center);
    model.inertia += inertia;
    body.hinge_acceleration =
        hinge_acceleration(model, body.hinge, torque + inertia * (body.hinge.rate - item.start_hinge.rate) / step_);
    pack_rates(body.hinge, body.hinge_acceleration, rates);
  }
  const auto corrected = item.hamming.correct(rates);
  std::copy(corrected.begin(), corrected.end(), image.begin());
}

std::vector<double> StrongUnknowns::image() {
  std::vector<double> image(values_.size());
  for (Item& item : items_) {
    const auto of_item = std::span(image).subspan(item.begin, item.size);
    if (!item.kind->has_pose()) {
      image_of_vertices(item, of_item);
      continue;
    }
    const auto load = coupled_.load_on(*item.body);
    if (item.scheme == StrongScheme::hamming) image_by_hamming(item, load, of_item);
    else image_by_newton(item, load, of_item);
  }
  return image;
}

double StrongUnknowns::largest_change(const Item& item, std::span<const double> image) const {
  const auto change = [&](std::size_t n) { return std::abs(image[item.begin + n] - values_[item.begin + n]); };
  const bool hamming = item.scheme == StrongScheme::hamming;
  if (!item.kind->has_pose()) {
    double largest = 0;
    for (std::size_t n = hamming ? item.size / 2 : 0; n < item.size; ++n) largest = larger(largest, change(n));
    return largest;
  }
  if (!is_rigid(*item.kind)) {
    if (hamming) return item.extent * change(1);
    const auto& [angle, rate] = item.body->hinge;
    return item.extent *
           larger(std::abs(item.hinge_image.rate - rate), std::abs(item.hinge_image.angle - angle) / step_);
  }
  const std::size_t first = hamming ? first_velocity_of_vector : 0;
  double largest = 0;
  for (std::size_t n = 0; n < n_rigid_velocities; ++n)
    largest = larger(largest, (n < 3 ? 1.0 : item.extent) * change(first + n));
  return largest;
}

double StrongUnknowns::largest_change(std::span<const double> image) const {
  double largest = 0;
  for (const Item& item : items_) largest = larger(largest, largest_change(item, image));
  return largest;
}

double StrongUnknowns::largest_velocity(const Item& item) const {
  if (!item.kind->has_pose()) {
    double largest = 0;
    for (const Vec3& velocity : item.body->surface.velocities) largest = std::max(largest, norm(velocity));
    return largest;
  }
  if (!is_rigid(*item.kind)) return item.extent * std::abs(item.body->hinge.rate);
  const auto& pose = item.body->pose;
  double largest = 0;
  for (int d = 0; d < 3; ++d)
    largest = std::max({largest, std::abs(pose.velocity[d]), item.extent * std::abs(pose.angular_velocity[d])});
  return largest;
}

std::string StrongUnknowns::body_of_largest_change(std::span<const double> image) const {
  double largest = -1;
  std::string name;
  for (const Item& item : items_) {
    const double change = largest_change(item, image);
    if (change <= largest || std::isnan(largest)) continue;
    largest = change;
    name = item.body->name();
  }
  return name;
}

double StrongUnknowns::largest_velocity() const {
  double largest = 0;
  for (const Item& item : items_) largest = std::max(largest, largest_velocity(item));
  return largest;
}

// Hamming's last value differs from what the flow was told by less than the tolerance.
void StrongUnknowns::accept_hamming(Item& item) {
  Body& body = *item.body;
  item.hamming.accept();
  std::vector<double> y(item.size);
  if (!item.kind->has_pose()) {
    unpack(item.hamming.value(), body.surface);
    pack(body.surface.positions, body.surface.velocities, y);
    body.scheme = item.hamming.state();
    body.scheme.insert(body.scheme.end(), y.begin(), y.end());
    return;
  }
  if (is_rigid(*item.kind)) {
    body.pose = unpack_rigid(item.hamming.value());
    pack(body.pose, y);
  } else {
    const auto& hinge = item.kind->hinge;
    body.hinge = unpack_hinge(item.hamming.value());
    if (is_at_stop(hinge, body.hinge.angle)) {
      // An impact that nothing announced.
      const bool outwards = body.hinge.angle <= hinge.min_angle ? body.hinge.rate < 0 : body.hinge.rate > 0;
      body.hinge.angle = std::clamp(body.hinge.angle, hinge.min_angle, hinge.max_angle);
      if (outwards) body.hinge.rate *= -hinge.restitution;
    }
    body.pose = hinged_pose(body, *item.kind);
    pack(body.hinge, y);
  }
  follow_pose(body, *item.kind);
  body.scheme = item.hamming.state();
  body.scheme.insert(body.scheme.end(), y.begin(), y.end());
}

void StrongUnknowns::accept() {
  for (Item& item : items_) {
    if (item.scheme == StrongScheme::hamming) accept_hamming(item);
    else item.body->scheme.clear();
  }
}

// A body's part: the number of secants, their ages, and residuals and images one secant after the other.
void StrongUnknowns::keep(std::span<const Secant> secants) {
  for (Item& item : items_) {
    auto& kept = item.body->scheme;
    kept.assign(1, static_cast<double>(secants.size()));
    for (const Secant& secant : secants) kept.push_back(secant.age);
    for (const Secant& secant : secants)
      for (const auto* column : {&secant.residual, &secant.image}) {
        const auto own = part(*column, item.begin, item.size);
        kept.insert(kept.end(), own.begin(), own.end());
      }
  }
}

std::vector<Secant> StrongUnknowns::kept_secants() const {
  const auto& ranks = coupled_.flow().grid().ranks();
  std::array<double, QuasiNewton::most_secants + 1> head{};
  for (const Item& item : items_)
    for (std::size_t n = 0; n < std::min(head.size(), item.body->scheme.size()); ++n)
      head[n] = std::max(head[n], n <= item.body->scheme[0] ? item.body->scheme[n] : 0.0);
  head[0] = ranks.max(head[0]);
  const auto count = std::min(static_cast<std::size_t>(head[0]), head.size() - 1);
  for (std::size_t n = 1; n <= count; ++n) head[n] = ranks.max(head[n]);
  bool agree = true;
  for (const Item& item : items_) {
    const auto& kept = item.body->scheme;
    agree = agree && kept.size() == 1 + count + 2 * count * item.size &&
            std::equal(head.begin(), head.begin() + 1 + static_cast<std::ptrdiff_t>(count), kept.begin());
  }
  if (count == 0 || ranks.max(agree ? 0.0 : 1.0) > 0) return {};
  std::vector<Secant> secants(count);
  for (std::size_t n = 0; n < count; ++n) {
    secants[n].age = static_cast<int>(head[n + 1]);
    for (const Item& item : items_) {
      const auto begin = item.body->scheme.begin() + static_cast<std::ptrdiff_t>(1 + count + 2 * n * item.size);
      const auto size = static_cast<std::ptrdiff_t>(item.size);
      secants[n].residual.insert(secants[n].residual.end(), begin, begin + size);
      secants[n].image.insert(secants[n].image.end(), begin + size, begin + 2 * size);
    }
  }
  return secants;
}

}  // namespace pliant
