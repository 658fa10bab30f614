#pragma once
#include "app/node_support.hpp"

namespace pliant {

/// A number for each node a + 3 b + 9 c.
using GenericStencil = std::array<double, 27>;

/// Ways to get the stencils of a support by a 4 x 4 solve: weights of the value, and of the fitted gradient.
struct GenericMethod {
  void (*values)(const NodeSupport& support, GenericStencil& values);
  void (*gradients)(const NodeSupport& support, std::array<GenericStencil, 3>& gradients);
};

/// Node by node, with the inverse of the moment matrix: GenericMls, the tests' reference.
extern const GenericMethod plain_method;
/// By products of matrices of fixed size and a factorisation, no more than asked for: about as fast as a 4 x 4 solve
/// gets without use of what is special about the weights.
extern const GenericMethod lean_method;

}  // namespace pliant
