#include "coupling/strong_unknowns.hpp"

#include <algorithm>
#include <cmath>

#include "structure/rigid_vector.hpp"

namespace pliant {
namespace {

constexpr std::size_t n_rigid_velocities = 6, n_hinge_velocities = 1;

bool is_rigid(const BodyKind& kind) { return kind.config.motion == MotionKind::rigid; }

std::span<const double> part(std::span<const double> all, std::size_t begin, std::size_t size) {
  return all.subspan(begin, size);
}

double extent_of(const BodyKind& kind) {
  double largest = 0;
  for (const Vec3& x : kind.reference) largest = std::max(largest, norm(x));
  return largest;
}

void write(Vec3 v, std::span<double> to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
Vec3 read(std::span<const double> from) { return {from[0], from[1], from[2]}; }

}  // namespace

StrongUnknowns::StrongUnknowns(CoupledFlow& coupled, double step)
    : coupled_(coupled), step_(step), scheme_(coupled.settings().scheme) {
  for (Body& body : coupled.bodies().own()) {
    const auto& kind = coupled.bodies().kind_of(body);
    if (kind.coupling != CouplingKind::strong) continue;
    Item item;
    item.body = &body;
    item.kind = &kind;
    item.begin = values_.size();
    item.extent = extent_of(kind);
    item.start = body.pose;
    item.start_acceleration = body.acceleration;
    item.start_hinge = body.hinge;
    item.start_hinge_acceleration = body.hinge_acceleration;
    const bool hamming = scheme_ == StrongScheme::hamming;
    item.size = is_rigid(kind) ? (hamming ? rigid_vector_size : n_rigid_velocities)
                               : (hamming ? hinge_vector_size : n_hinge_velocities);
    values_.resize(values_.size() + item.size);
    guess(item);
    items_.push_back(std::move(item));
  }
}

void StrongUnknowns::guess(Item& item) {
  const auto values = std::span(values_).subspan(item.begin, item.size);
  const Body& body = *item.body;
  if (scheme_ == StrongScheme::hamming) {
    std::vector<double> y(item.size), f(item.size);
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
    std::copy(predicted.begin(), predicted.end(), values.begin());
    return;
  }
  if (is_rigid(*item.kind)) {
    write(item.start.velocity + step_ * item.start_acceleration.linear, values.subspan(0, 3));
    write(item.start.angular_velocity + step_ * item.start_acceleration.angular, values.subspan(3, 3));
  } else {
    values[0] = item.start_hinge.rate + step_ * item.start_hinge_acceleration;
  }
}

// Places by the mean of the velocities at both ends.
void StrongUnknowns::set_from_velocities(Item& item) {
  const auto values = part(values_, item.begin, item.size);
  Body& body = *item.body;
  const double inverse = 1 / step_;
  if (is_rigid(*item.kind)) {
    RigidState end = item.start;
    end.velocity = read(values.subspan(0, 3));
    end.angular_velocity = read(values.subspan(3, 3));
    end.center += 0.5 * step_ * (item.start.velocity + end.velocity);
    const Vec3 turn = 0.5 * step_ * (item.start.angular_velocity + end.angular_velocity);
    end.orientation = normalized(from_rotation_vector(turn) * item.start.orientation);
    body.acceleration = {inverse * (end.velocity - item.start.velocity),
                         inverse * (end.angular_velocity - item.start.angular_velocity)};
    body.pose = end;
  } else {
    const auto& hinge = item.kind->hinge;
    const double angle = item.start_hinge.angle + 0.5 * step_ * (item.start_hinge.rate + values[0]);
    body.hinge = {std::clamp(angle, hinge.min_angle, hinge.max_angle), values[0]};
    body.hinge_acceleration = inverse * (values[0] - item.start_hinge.rate);
  }
}

void StrongUnknowns::apply() {
  for (Item& item : items_) {
    Body& body = *item.body;
    if (scheme_ == StrongScheme::aitken) {
      set_from_velocities(item);
    } else if (is_rigid(*item.kind)) {
      body.pose = unpack_rigid(part(values_, item.begin, item.size));
    } else {
      body.hinge = unpack_hinge(part(values_, item.begin, item.size));
      body.hinge.angle = std::clamp(body.hinge.angle, item.kind->hinge.min_angle, item.kind->hinge.max_angle);
    }
    if (!is_rigid(*item.kind)) {
      body.pose = hinged_pose(body, *item.kind);
      body.acceleration = acceleration_of(item.kind->hinge, body.hinge, body.hinge_acceleration, body.start);
    }
    require_finite(body);
    follow_pose(body, *item.kind);
  }
}

void StrongUnknowns::image_by_newton(Item& item, const RigidLoad& load, std::span<double> image) {
  const Body& body = *item.body;
  if (is_rigid(*item.kind)) {
    RigidState end = item.start;
    // Virtual terms act on the change between iterations and vanish as these agree.
    RigidAcceleration acceleration = body.acceleration;
    advance_rigid(end, acceleration, item.kind->rigid, load, step_);
    write(end.velocity, image.subspan(0, 3));
    write(end.angular_velocity, image.subspan(3, 3));
    return;
  }
  HingeState end = item.start_hinge;
  double acceleration = body.hinge_acceleration;
  advance_hinge(end, acceleration, item.kind->hinge, torque_about_axis(item.kind->hinge, load, body.pose.center),
                step_);
  image[0] = end.rate;
}

void StrongUnknowns::image_by_hamming(Item& item, const RigidLoad& load, std::span<double> image) {
  Body& body = *item.body;
  std::vector<double> rates(item.size);
  if (is_rigid(*item.kind)) {
    body.acceleration = rigid_acceleration(item.kind->rigid, body.pose, load);
    pack_rates(body.pose, body.acceleration, rates);
  } else {
    const double torque = torque_about_axis(item.kind->hinge, load, body.pose.center);
    body.hinge_acceleration = hinge_acceleration(item.kind->hinge, body.hinge, torque);
    pack_rates(body.hinge, body.hinge_acceleration, rates);
  }
  const auto corrected = item.hamming.correct(rates);
  std::copy(corrected.begin(), corrected.end(), image.begin());
  if (is_rigid(*item.kind)) return;
  const auto& hinge = item.kind->hinge;
  if (image[0] <= hinge.min_angle && image[1] < 0) image[0] = hinge.min_angle, image[1] = -hinge.restitution * image[1];
  if (image[0] >= hinge.max_angle && image[1] > 0) image[0] = hinge.max_angle, image[1] = -hinge.restitution * image[1];
}

std::vector<double> StrongUnknowns::image() {
  std::vector<double> image(values_.size());
  for (Item& item : items_) {
    const auto of_item = std::span(image).subspan(item.begin, item.size);
    const auto load = coupled_.load_on(*item.body);
    if (scheme_ == StrongScheme::hamming) image_by_hamming(item, load, of_item);
    else image_by_newton(item, load, of_item);
  }
  return image;
}

// visit(index, factor): where a velocity stands and what turns it into one of the surface.
template <class Visit>
void StrongUnknowns::for_each_velocity(const Item& item, Visit visit) const {
  const bool hamming = scheme_ == StrongScheme::hamming;
  if (!is_rigid(*item.kind)) {
    visit(item.begin + (hamming ? 1 : 0), item.extent);
    return;
  }
  const std::size_t first = item.begin + (hamming ? 7 : 0);
  for (std::size_t n = 0; n < n_rigid_velocities; ++n) visit(first + n, n < 3 ? 1.0 : item.extent);
}

double StrongUnknowns::largest_change(std::span<const double> image) const {
  double largest = 0;
  for (const Item& item : items_)
    for_each_velocity(item, [&](std::size_t n, double factor) {
      const double change = factor * std::abs(image[n] - values_[n]);
      if (!(change <= largest)) largest = change;  // what is not a number is kept
    });
  return largest;
}

std::string StrongUnknowns::body_of_largest_change(std::span<const double> image) const {
  double largest = -1;
  std::string name;
  for (const Item& item : items_)
    for_each_velocity(item, [&](std::size_t n, double factor) {
      const double change = factor * std::abs(image[n] - values_[n]);
      if (change <= largest || std::isnan(largest)) return;
      largest = change;
      name = item.body->name();
    });
  return name;
}

double StrongUnknowns::largest_velocity() const {
  double largest = 0;
  for (const Item& item : items_)
    for_each_velocity(
        item, [&](std::size_t n, double factor) { largest = std::max(largest, factor * std::abs(values_[n])); });
  return largest;
}

void StrongUnknowns::accept() {
  if (scheme_ != StrongScheme::hamming) return;
  for (Item& item : items_) {
    Body& body = *item.body;
    item.hamming.accept();
    std::vector<double> y(item.size);
    if (is_rigid(*item.kind)) {
      body.pose = unpack_rigid(item.hamming.value());
      pack(body.pose, y);
    } else {
      body.hinge = unpack_hinge(item.hamming.value());
      body.pose = hinged_pose(body, *item.kind);
      pack(body.hinge, y);
    }
    follow_pose(body, *item.kind);
    body.scheme = item.hamming.state();
    body.scheme.insert(body.scheme.end(), y.begin(), y.end());
  }
}

}  // namespace pliant
