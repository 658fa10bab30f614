#include "mesh/formats/ply_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <istream>
#include <iterator>
#include <limits>

namespace pliant {
namespace {

/// Calls `use` with a zero of the C++ type.
template <class Use>
auto with_type(PlyType type, Use use) {
  switch (type) {
    case PlyType::int8:
      return use(std::int8_t{});
    case PlyType::uint8:
      return use(std::uint8_t{});
    case PlyType::int16:
      return use(std::int16_t{});
    case PlyType::uint16:
      return use(std::uint16_t{});
    case PlyType::int32:
      return use(std::int32_t{});
    case PlyType::uint32:
      return use(std::uint32_t{});
    case PlyType::float32:
      return use(float{});
    case PlyType::float64:
      break;
  }
  return use(double{});
}

/// One item a line.
class TextData : public PlyData {
 public:
  TextData(LineReader& lines, const std::string& source) : lines_(lines), source_(source) {}

  bool next_item() override {
    at_ = 0;
    return lines_.next();
  }

  double read(PlyType type) override {
    const std::string_view word = next_word();
    double value = 0;
    bool good = false;
    if (is_integer(type)) {
      long integer = 0;
      good = parse_number(word, integer) && with_type(type, [&](auto zero) {
               using Limits = std::numeric_limits<decltype(zero)>;
               return integer >= static_cast<long>(Limits::lowest()) && integer <= static_cast<long>(Limits::max());
             });
      value = static_cast<double>(integer);
    } else {
      good = parse_number(word, value);
    }
    if (!good)
      throw BadPlyItem{
          fmt::format("'{}' is no {}; correct it or its type in the header", printable(word), name_of(type))};
    return value;
  }

  void skip(PlyType, long count) override {
    if (static_cast<long>(lines_.words().size() - at_) < count) throw too_few();
    at_ += static_cast<std::size_t>(count);
  }

  void end_item() override {
    if (at_ < lines_.words().size())
      throw BadPlyItem{
          fmt::format("'{}' has {} values, but by the header {}; correct the line, or the counts and "
                      "properties in the header",
                      printable(lines_.line()), lines_.words().size(), at_)};
  }

  bool can_resume() const override { return true; }
  std::string place(const std::string&, long) const override { return fmt::format("{}:{}", source_, lines_.number()); }
  long line() const override { return lines_.number(); }

  std::string left_over() override {
    if (!lines_.next()) return "";
    return fmt::format("{}:{}: a line is left over after the last item; correct the counts in the header or remove it",
                       source_, lines_.number());
  }

 private:
  BadPlyItem too_few() const {
    return {fmt::format("'{}' has too few values; correct the line, or the counts and properties in the header",
                        printable(lines_.line()))};
  }
  std::string_view next_word() {
    if (at_ >= lines_.words().size()) throw too_few();
    return lines_.words()[at_++];
  }

  LineReader& lines_;
  const std::string& source_;
  std::size_t at_ = 0;
};

/// Values back to back.
class BinaryData : public PlyData {
 public:
  BinaryData(std::istream& input, long header_bytes, std::endian order, const std::string& source)
      : bytes_{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()},
        header_bytes_(header_bytes),
        order_(order),
        source_(source) {}

  bool next_item() override {
    item_ = at_;
    return at_ < bytes_.size();
  }

  double read(PlyType type) override {
    return with_type(type, [&](auto value) {
      std::array<char, sizeof value> bytes;
      need(sizeof value);
      std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), sizeof value, bytes.begin());
      if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
      std::memcpy(&value, bytes.data(), sizeof value);
      at_ += sizeof value;
      return static_cast<double>(value);
    });
  }

  void skip(PlyType type, long count) override {
    const auto size = with_type(type, [](auto zero) { return sizeof zero; }) * static_cast<std::size_t>(count);
    need(size);
    at_ += size;
  }

  void end_item() override {}
  bool can_resume() const override { return false; }
  std::string place(const std::string& kind, long number) const override {
    return fmt::format("{}, {} {} (byte {})", source_, kind, number, header_bytes_ + static_cast<long>(item_));
  }
  long line() const override { return 0; }

  std::string left_over() override {
    if (at_ == bytes_.size()) return "";
    return fmt::format("{}, byte {}: {} bytes are left over after the last item; correct the counts in the header",
                       source_, header_bytes_ + static_cast<long>(at_), bytes_.size() - at_);
  }

 private:
  void need(std::size_t size) const {
    if (bytes_.size() - at_ < size)
      throw BadPlyItem{"the file ends within it; restore the rest, or correct the counts and properties in the header"};
  }

  std::string bytes_;
  long header_bytes_;
  std::endian order_;
  const std::string& source_;
  std::size_t at_ = 0, item_ = 0;
};

}  // namespace

std::unique_ptr<PlyData> open_ply_data(PlyEncoding encoding, LineReader& lines, std::istream& input,
                                       const std::string& source) {
  if (encoding == PlyEncoding::ascii) return std::make_unique<TextData>(lines, source);
  const auto order = encoding == PlyEncoding::binary_big_endian ? std::endian::big : std::endian::little;
  return std::make_unique<BinaryData>(input, lines.bytes(), order, source);
}

}  // namespace pliant
