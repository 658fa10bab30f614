#include "mesh/formats/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_problems = 20;
constexpr long most_items = 500'000'000;

struct TypeName {
  PlyType type;
  const char *name, *sized_name;
};
constexpr TypeName type_names[] = {{PlyType::int8, "char", "int8"},        {PlyType::uint8, "uchar", "uint8"},
                                   {PlyType::int16, "short", "int16"},     {PlyType::uint16, "ushort", "uint16"},
                                   {PlyType::int32, "int", "int32"},       {PlyType::uint32, "uint", "uint32"},
                                   {PlyType::float32, "float", "float32"}, {PlyType::float64, "double", "float64"}};

constexpr PlyEncoding encodings[] = {PlyEncoding::ascii, PlyEncoding::binary_little_endian,
                                     PlyEncoding::binary_big_endian};

std::optional<PlyType> type_named(std::string_view word) {
  for (const TypeName& entry : type_names)
    if (word == entry.name || word == entry.sized_name) return entry.type;
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(LineReader& lines, const std::string& source) : lines_(lines), source_(source) {}

  PlyHeader read() {
    if (!lines_.next()) throw InputError(source_ + ": the file is empty; a PLY file begins with the line 'ply'");
    if (lines_.words().size() != 1 || lines_.words()[0] != "ply") {
      problem(fmt::format("'{}' is no first line of a PLY file; that is 'ply'", printable(lines_.line())));
      throw InputError(std::move(problems_));
    }
    bool ended = false;
    while (!ended && problems_.size() < most_problems && next_line()) {
      const std::string_view keyword = lines_.words()[0];
      if (keyword == "end_header") ended = true;
      else if (keyword == "format") read_format();
      else if (keyword == "element") read_element();
      else if (keyword == "property") read_property();
      else if (keyword != "comment" && keyword != "obj_info")
        problem(
            fmt::format("'{}' is no line of a PLY header; it begins with 'format', 'comment', 'obj_info', "
                        "'element', 'property' or 'end_header'",
                        printable(lines_.line())));
    }
    if (ended) {
      if (!has_format_) problem("the header has no line 'format'; add 'format ascii 1.0' or what the data is");
      check_vertex();
      check_face();
    }
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(header_);
  }

 private:
  void problem(const std::string& what) { problem_at(lines_.number(), what); }
  void problem_at(long line, const std::string& what) {
    problems_.push_back(fmt::format("{}:{}: {}", source_, line, what));
  }

  bool next_line() {
    if (!lines_.next()) {
      problem("the file ends within the header; a line 'end_header' must close it");
      return false;
    }
    // What follows is data: each line of it would be one more problem.
    if (double number = 0; parse_number(lines_.words()[0], number)) {
      problem(fmt::format("'{}' is no line of a PLY header; a line 'end_header' must come before the data",
                          printable(lines_.line())));
      return false;
    }
    return true;
  }

  void read_format() {
    const auto& words = lines_.words();
    if (has_format_) problem("the format is given twice; remove one of the lines");
    has_format_ = true;
    const auto found = std::find_if(std::begin(encodings), std::end(encodings), [&](PlyEncoding encoding) {
      return words.size() == 3 && words[1] == name_of(encoding);
    });
    if (found == std::end(encodings) || words[2] != "1.0")
      problem(
          fmt::format("'{}' is no known format; give 'format ascii 1.0', or 'binary_little_endian' or "
                      "'binary_big_endian' for 'ascii'",
                      printable(lines_.line())));
    else header_.encoding = *found;
  }

  void read_element() {
    const auto& words = lines_.words();
    PlyElement element{words.size() > 1 ? std::string(words[1]) : "", 0, lines_.number(), {}};
    if (words.size() != 3 || !parse_number(words[2], element.count) || element.count < 0 || element.count > most_items)
      problem(fmt::format("'{}' is no element; give 'element', its name and its count from 0 to {}",
                          printable(lines_.line()), most_items));
    else if (find(element.name))
      problem(fmt::format("the element '{}' is declared twice; remove one of them", printable(element.name)));
    // A wrong one is kept as well: its properties that follow are none of the element before.
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    const auto& words = lines_.words();
    if (header_.elements.empty()) {
      problem("a property comes before the first element; put a line 'element' before it");
      return;
    }
    const bool is_list = words.size() > 1 && words[1] == "list";
    const std::size_t n_words = is_list ? 5 : 3;
    std::optional<PlyType> type, count_type;
    if (words.size() == n_words) type = type_named(words[n_words - 2]);
    if (words.size() == n_words && is_list) count_type = type_named(words[2]);
    if (!type || (is_list && !count_type)) {
      problem(
          fmt::format("'{}' is no property; give 'property TYPE NAME' or 'property list COUNT_TYPE TYPE NAME', "
                      "with the types char, uchar, short, ushort, int, uint, float and double",
                      printable(lines_.line())));
      // Its name is kept: it is not missing, only wrong.
      if (words.size() > 2) wrong_names_.emplace_back(words.back());
      return;
    }
    if (count_type && !is_integer(*count_type))
      problem(fmt::format("the count of a list cannot be {}; give an integer type", words[2]));
    const std::string name(words.back());
    auto& properties = header_.elements.back().properties;
    if (std::any_of(properties.begin(), properties.end(), [&](const auto& other) { return other.name == name; }))
      problem(fmt::format("the property '{}' is declared twice in the element '{}'; remove one of them",
                          printable(name), printable(header_.elements.back().name)));
    properties.push_back({name, *type, count_type});
  }

  const PlyElement* find(const std::string& name) const {
    for (const PlyElement& element : header_.elements)
      if (element.name == name) return &element;
    return nullptr;
  }

  bool was_wrong(const std::string& name) const {
    return std::find(wrong_names_.begin(), wrong_names_.end(), name) != wrong_names_.end();
  }

  void check_vertex() {
    const PlyElement* vertex = find("vertex");
    if (!vertex) {
      problem("the header has no element 'vertex'; add it, with the properties x, y and z");
      return;
    }
    for (const std::string name : {"x", "y", "z"}) {
      const auto& all = vertex->properties;
      const auto found = std::find_if(all.begin(), all.end(), [&](const auto& other) { return other.name == name; });
      if (found == all.end() ? !was_wrong(name) : found->count_type.has_value())
        problem_at(vertex->line, fmt::format("the element 'vertex' needs a number '{0}'; add 'property double {0}' "
                                             "and the values, or correct its line",
                                             name));
    }
  }

  void check_face() {
    const PlyElement* face = find("face");
    if (!face) {
      problem("the header has no element 'face'; add it, with the property 'list uchar int vertex_indices'");
      return;
    }
    int n_lists = 0;
    for (const PlyProperty& property : face->properties) {
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      ++n_lists;
      if (!property.count_type || !is_integer(property.type))
        problem_at(face->line,
                   fmt::format("the property '{}' of the element 'face' must be a list of integers", property.name));
    }
    if (n_lists > 1)
      problem_at(face->line, "the element 'face' has both vertex_indices and vertex_index; remove one of them");
    if (n_lists == 0 && !was_wrong("vertex_indices") && !was_wrong("vertex_index"))
      problem_at(face->line, "the element 'face' needs the property 'list uchar int vertex_indices'; add it");
  }

  LineReader& lines_;
  const std::string& source_;
  PlyHeader header_{};
  bool has_format_ = false;
  std::vector<std::string> problems_, wrong_names_;
};

}  // namespace

const char* name_of(PlyEncoding encoding) {
  switch (encoding) {
    case PlyEncoding::ascii:
      return "ascii";
    case PlyEncoding::binary_little_endian:
      return "binary_little_endian";
    case PlyEncoding::binary_big_endian:
      return "binary_big_endian";
  }
  return "";
}

const char* name_of(PlyType type) { return type_names[static_cast<int>(type)].name; }

PlyHeader read_ply_header(LineReader& lines, const std::string& source) { return HeaderReader(lines, source).read(); }

}  // namespace pliant
