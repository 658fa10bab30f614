#pragma once
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/surface.hpp"

namespace pliant {

/// The vertices for which all that a selection gives holds, ascending; `positions` in the surface's own coordinates.
std::vector<int> select_vertices(const SelectionConfig& selection, const TriangleMesh& mesh,
                                 std::span<const Vec3> positions);

/// The selection of a body by its name: one of the case, or else one that the surface brings along. Throws InputError if
/// there is none, or if it holds no vertex.
std::vector<int> select_vertices(const BodyConfig& body, const std::string& name, const TriangleMesh& mesh,
                                 std::span<const Vec3> positions, std::span<const NamedVertices> of_surface = {});

}  // namespace pliant
