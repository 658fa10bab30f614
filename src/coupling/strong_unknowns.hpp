#pragma once
#include <string>
#include <vector>

#include "coupling/coupled_flow.hpp"
#include "coupling/hamming.hpp"
#include "coupling/quasi_newton.hpp"
#include "coupling/strong_vertices.hpp"

namespace pliant {

/// The motions at the end of a step that strong coupling looks for, as one list of numbers a rank.
///
/// By Newton's law a rigid body has the six velocities at the end of the step, a hinge the rate that the torque of the
/// flow alone would give it: what it makes of that torque, impacts on stops included, is for advance_hinge to say. So a
/// hinge at a stop is at the stop to the bit, and one that is pressed against it has nothing to iterate on.
/// By Hamming's formulas they have the whole state. These need smooth motion: a hinge that is at a stop, or may reach
/// one in the step, takes the step by Newton's law and begins its history anew. Deformable bodies: StrongVertices, or
/// places and velocities of all vertices under Hamming's formulas.
class StrongUnknowns {
 public:
  /// Takes down where the rank's strongly coupled bodies are at the start of the step, and guesses their motion at its
  /// end.
  StrongUnknowns(CoupledFlow& coupled, double step);

  std::vector<double>& values() { return values_; }
  /// Puts deformable bodies back to the start of the step, from where apply() moves them.
  void rewind();
  /// Moves the bodies to where the values say they are at the end of the step. Throws RunError if that is not finite.
  void apply();
  /// The values that the present loads make, G(y).
  std::vector<double> image();
  /// Largest change from the values to `image`, and the largest velocity, of this rank.
  double largest_change(std::span<const double> image) const;
  double largest_velocity() const;
  /// The name of the body of this rank whose velocities change most; empty without bodies.
  std::string body_of_largest_change(std::span<const double> image) const;
  /// The step is done: the bodies keep the state of the last apply(), and their accelerations.
  void accept();
  /// What the bodies have kept of earlier steps for quasi-Newton; nothing if they do not agree. Collective.
  std::vector<Secant> kept_secants() const;
  /// After accept(): each body takes its part along, to other ranks and into checkpoints.
  void keep(std::span<const Secant> secants);

 private:
  struct Item {
    Body* body = nullptr;
    const BodyKind* kind = nullptr;
    std::size_t begin = 0, size = 0;
    double extent = 0;  // turns rates of rotation into velocities
    RigidState start;
    RigidAcceleration start_acceleration;
    HingeState start_hinge;
    double start_hinge_acceleration = 0;
    HingeState hinge_image;  // by Newton's law, from the torque that the image stands for
    StrongScheme scheme = StrongScheme::aitken;
    Hamming hamming;
    StrongVertices vertices;  // of a deformable body
  };
  void guess(Item& item);
  void guess_by_newton(Item& item);
  void guess_by_hamming(Item& item);
  void set_from_velocities(Item& item);
  void set_hinge_from_torque(Item& item);
  double told_torque(const Item& item) const;
  void image_by_newton(Item& item, const RigidLoad& load, std::span<double> image);
  void guess_vertices(Item& item);
  void apply_vertices(Item& item);
  void image_of_vertices(Item& item, std::span<double> image);
  void image_by_hamming(Item& item, const RigidLoad& load, std::span<double> image);
  void accept_hamming(Item& item);
  double largest_change(const Item& item, std::span<const double> image) const;
  double largest_velocity(const Item& item) const;

  CoupledFlow& coupled_;
  double step_;
  std::vector<Item> items_;
  std::vector<double> values_;
};

}  // namespace pliant
