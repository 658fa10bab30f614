#pragma once
#include <string>
#include <vector>

#include "coupling/bodies.hpp"

namespace pliant {

/// Columns of the table of a [[body]] after step and time; a table of copies has the copy's number, from 1, as its
/// first.
std::vector<std::string> body_columns(const BodyKind& kind, long copies);

/// A body's values in these columns.
std::vector<double> body_row(const Body& body, const BodyKind& kind, bool is_on, long copy, long copies);

}  // namespace pliant
