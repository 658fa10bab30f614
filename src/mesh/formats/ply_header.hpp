#pragma once
#include <optional>
#include <string>
#include <vector>

#include "mesh/formats/text_lines.hpp"

namespace pliant {

enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

/// The name of the encoding, as in the line "format".
const char* name_of(PlyEncoding encoding);
/// The name of the type, as in the line "property".
const char* name_of(PlyType type);

/// One value, or with a `count_type` a list: a count and as many values.
struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count_type;
};

struct PlyElement {
  std::string name;
  long count;
  long line;  ///< where the element is declared
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding;
  std::vector<PlyElement> elements;  ///< in the order of their data
};

/// Reads a PLY header up to and with its line "end_header". The header returned has one element "vertex" with the
/// numbers x, y and z, and one element "face" with one list of integers vertex_indices or vertex_index.
/// Throws InputError with every line that is wrong (about twenty at most).
PlyHeader read_ply_header(LineReader& lines, const std::string& source);

}  // namespace pliant
