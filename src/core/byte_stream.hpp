#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pliant {

/// Bytes that end too early or say impossible things: a damaged file, or a reader that does not match its writer.
class ByteStreamError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What may be written as its own bytes. Not a pointer: it would mean nothing to the reader.
template <class T>
concept PlainValue = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// Puts values behind each other as bytes, in this machine's own representation; ByteReader takes them out in the same
/// order, bit for bit. Vectors and texts carry their length in front, as 64 bits.
class ByteWriter {
 public:
  template <PlainValue T>
  void write(const T& value) {
    append(&value, sizeof(T));
  }
  template <PlainValue T>
  void write(const std::vector<T>& values) {
    static_assert(!std::is_same_v<T, bool>, "a vector of bool has no bytes of its own");
    write(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }
  void write(const std::string& text) {
    write(static_cast<std::uint64_t>(text.size()));
    append(text.data(), text.size());
  }
  /// A text literal: without this its address would be taken for a value.
  void write(const char* text) { write(std::string(text)); }

  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::exchange(bytes_, {}); }

 private:
  void append(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t end = bytes_.size();
    bytes_.resize(end + size);
    std::memcpy(bytes_.data() + end, data, size);
  }
  std::vector<std::byte> bytes_;
};

/// Takes values out of bytes that stay with the caller and must outlive the reader. Reading past the end throws
/// ByteStreamError and takes nothing.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <PlainValue T>
  T read() {
    T value{};
    std::memcpy(&value, take(sizeof(T), 1), sizeof(T));
    return value;
  }
  template <PlainValue T>
  void read(T& value) {
    value = read<T>();
  }
  template <PlainValue T>
  void read(std::vector<T>& values) {
    const std::size_t start = at_;
    const auto size = read<std::uint64_t>();
    try {
      const auto* from = take(sizeof(T), size);
      values.resize(static_cast<std::size_t>(size));
      if (size > 0) std::memcpy(values.data(), from, values.size() * sizeof(T));
    } catch (const ByteStreamError&) {
      at_ = start;
      throw;
    }
  }
  void read(std::string& text) {
    std::vector<char> letters;
    read(letters);
    text.assign(letters.begin(), letters.end());
  }
  template <PlainValue T>
  std::vector<T> read_vector() {
    std::vector<T> values;
    read(values);
    return values;
  }
  std::string read_text() {
    std::string text;
    read(text);
    return text;
  }

  std::size_t remaining() const { return bytes_.size() - at_; }
  /// For after the last value: throws ByteStreamError if there are bytes that nobody asked for.
  void expect_end() const {
    if (remaining() != 0)
      throw ByteStreamError(std::to_string(remaining()) + " bytes more than expected, of " +
                            std::to_string(bytes_.size()));
  }

 private:
  const std::byte* take(std::size_t size, std::uint64_t count) {
    if (count > remaining() / size)
      throw ByteStreamError("the bytes end too early: " + std::to_string(count) + " values of " + std::to_string(size) +
                            " bytes wanted, " + std::to_string(remaining()) + " bytes left");
    const auto* from = bytes_.data() + at_;
    at_ += size * static_cast<std::size_t>(count);
    return from;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace pliant
