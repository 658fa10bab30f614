#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/vec3.hpp"

namespace pliant {

/// Holds a vertex at a point: -stiffness (x - anchor) - damping v.
struct Tether {
  int vertex = 0;
  Vec3 anchor;
  double stiffness = 0, damping = 0;
};

/// Pulls two ends together with stiffness (l - rest_length) when it is longer than that. An end is the mean of some
/// vertices, which share its force evenly, or a fixed point.
struct Cord {
  std::vector<int> from, to;  ///< no `to`: the point
  Vec3 point;
  double stiffness = 0, rest_length = 0;
};

/// A constant force that vertices share evenly.
struct Pull {
  std::vector<int> vertices;
  Vec3 force;
};

/// What holds and pulls a body besides its potentials and the flow; copies share it. Points and directions are in the
/// coordinates of the surface.
struct Attachments {
  std::shared_ptr<const std::vector<Tether>> tethers;
  std::shared_ptr<const std::vector<Cord>> cords;
  std::shared_ptr<const std::vector<Pull>> pulls;

  bool any() const { return tethers || cords || pulls; }
};

/// The items of a list that may be missing.
template <class Item>
std::span<const Item> items_of(const std::shared_ptr<const std::vector<Item>>& list) {
  return list ? std::span<const Item>(*list) : std::span<const Item>();
}

}  // namespace pliant
