#include "mesh/formats/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <istream>
#include <limits>
#include <ostream>

#include "core/error.hpp"
#include "mesh/formats/ply_data.hpp"

namespace pliant {
namespace {

constexpr std::size_t most_problems = 20;

class PlyReader {
 public:
  PlyReader(std::istream& input, const std::string& source)
      : source_(source),
        lines_(input, ""),
        header_(read_ply_header(lines_, source)),
        items_(open_ply_data(header_.encoding, lines_, input, source)) {}

  SurfaceData read() {
    data_.source = source_;
    data_.first_number = 0;
    for (const PlyElement& element : header_.elements)
      if (!element.properties.empty() && !stopped_) read_items(element);
    if (!stopped_)
      if (const std::string sentence = items_->left_over(); !sentence.empty()) problem(sentence);
    if (count_ > most_problems)
      problems_.push_back(fmt::format("{}: and {} more problems", source_, count_ - most_problems));
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(data_);
  }

 private:
  void problem(const std::string& sentence) {
    if (++count_ <= most_problems) problems_.push_back(sentence);
  }

  void read_items(const PlyElement& element) {
    for (long number = 0; number < element.count && !stopped_; ++number) {
      std::string wrong;
      if (!items_->next_item()) {
        wrong =
            fmt::format("the file ends after {} of {} items '{}'; correct the counts in the header or restore the rest",
                        number, element.count, printable(element.name));
        stopped_ = true;
      } else {
        try {
          if (element.name == "vertex") read_vertex(element);
          else if (element.name == "face") wrong = read_face(element);
          else
            for (const PlyProperty& property : element.properties) pass(property);
          items_->end_item();
        } catch (const BadPlyItem& bad) {
          wrong = bad.what;
          stopped_ = !items_->can_resume();
        }
      }
      if (!wrong.empty()) problem(items_->place(printable(element.name), number) + ": " + wrong);
    }
  }

  void read_vertex(const PlyElement& element) {
    Vec3 x;
    for (const PlyProperty& property : element.properties)
      if (property.name == "x") x.x = items_->read(property.type);
      else if (property.name == "y") x.y = items_->read(property.type);
      else if (property.name == "z") x.z = items_->read(property.type);
      else pass(property);
    data_.positions.push_back(x);
    if (items_->line() > 0) data_.vertex_lines.push_back(items_->line());
  }

  /// Empty, or why the face is no triangle though its data could be read.
  std::string read_face(const PlyElement& element) {
    Face face{};
    std::string wrong;
    for (const PlyProperty& property : element.properties) {
      if (property.name != "vertex_indices" && property.name != "vertex_index") {
        pass(property);
        continue;
      }
      const long n = read_count(property);
      if (n != 3) {
        wrong = fmt::format("the face has {} vertices; it needs three: triangulate the surface", n);
        items_->skip(property.type, n);
        continue;
      }
      for (int& corner : face) {
        const double index = items_->read(property.type);
        // Only an unsigned type can hold more than an int.
        if (index > std::numeric_limits<int>::max())
          wrong = fmt::format("the face names vertex {:.0f}, more than any surface has; correct the index", index);
        else corner = static_cast<int>(index);
      }
    }
    data_.faces.push_back(face);
    if (items_->line() > 0) data_.face_lines.push_back(items_->line());
    return wrong;
  }

  long read_count(const PlyProperty& list) {
    const long count = static_cast<long>(items_->read(*list.count_type));
    if (count < 0)
      throw BadPlyItem{fmt::format("the list '{}' has the count {}; give one from 0", printable(list.name), count)};
    return count;
  }

  void pass(const PlyProperty& property) {
    items_->skip(property.type, property.count_type ? read_count(property) : 1);
  }

  const std::string& source_;
  LineReader lines_;
  PlyHeader header_;
  std::unique_ptr<PlyData> items_;
  SurfaceData data_;
  std::vector<std::string> problems_;
  std::size_t count_ = 0;
  bool stopped_ = false;
};

template <class Value>
void append(fmt::memory_buffer& out, Value value, std::endian order) {
  std::array<char, sizeof value> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.data() + bytes.size());
}

void append_text(fmt::memory_buffer& text, const Surface& surface) {
  const auto out = std::back_inserter(text);
  for (const Vec3& x : surface.positions) fmt::format_to(out, "{:.17g} {:.17g} {:.17g}\n", x.x, x.y, x.z);
  for (const auto& [a, b, c] : surface.mesh.vertices_of_face()) fmt::format_to(out, "3 {} {} {}\n", a, b, c);
}

void append_binary(fmt::memory_buffer& out, const Surface& surface, std::endian order) {
  for (const Vec3& x : surface.positions)
    for (int d = 0; d < 3; ++d) append(out, x[d], order);
  for (const Face& face : surface.mesh.vertices_of_face()) {
    append(out, std::uint8_t{3}, order);
    for (int corner : face) append(out, static_cast<std::int32_t>(corner), order);
  }
}

}  // namespace

SurfaceData read_ply(std::istream& input, const std::string& source) { return PlyReader(input, source).read(); }

void write_ply(std::ostream& output, const Surface& surface, PlyEncoding encoding) {
  fmt::memory_buffer bytes;
  fmt::format_to(std::back_inserter(bytes),
                 "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                 "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                 name_of(encoding), surface.mesh.n_vertices(), surface.mesh.n_faces());
  if (encoding == PlyEncoding::ascii) append_text(bytes, surface);
  else
    append_binary(bytes, surface, encoding == PlyEncoding::binary_big_endian ? std::endian::big : std::endian::little);
  output.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace pliant
