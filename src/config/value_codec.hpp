#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/word.hpp"
#include "core/vec3.hpp"

namespace pliant {

using Json = nlohmann::ordered_json;

enum class Bound { inclusive, exclusive };

/// The legal range of a number, or of every component of a vector.
struct Limits {
  double min = -std::numeric_limits<double>::infinity();
  Bound min_bound = Bound::inclusive;
  double max = std::numeric_limits<double>::infinity();
  Bound max_bound = Bound::inclusive;
};
inline Limits positive() { return {.min = 0, .min_bound = Bound::exclusive}; }
inline Limits at_least(double min) { return {.min = min}; }
inline Limits between(double min, double max) { return {.min = min, .max = max}; }

/// "> 0", ">= 1 and <= 9"; empty when any finite number will do.
std::string describe(const Limits& limits);
/// What is wrong with a number, or nothing.
std::optional<std::string> check_limits(double value, const Limits& limits);
/// "the string \"abc\"", "the number 3", for messages of the form "must be X, not Y".
std::string describe_value(const Json& value);

/// The number in `value`; integers are accepted where a number is asked. Sets `problem` when it is not one.
std::optional<double> read_number(const Json& value, const Limits& limits, std::optional<std::string>& problem);
std::optional<std::int64_t> read_integer(const Json& value, const Limits& limits, std::optional<std::string>& problem);

/// How a C++ type is read from and written to the case file: type_name, legal, read and write.
template <class T>
struct ValueCodec;

template <>
struct ValueCodec<double> {
  static std::string type_name() { return "number"; }
  static std::string legal(const Limits& limits) { return describe(limits); }
  static std::optional<std::string> read(const Json& value, double& out, const Limits& limits) {
    std::optional<std::string> problem;
    if (auto number = read_number(value, limits, problem)) out = *number;
    return problem;
  }
  static Json write(double value) { return value; }
};

template <class T>
requires std::is_integral_v<T>
struct ValueCodec<T> {
  static std::string type_name() { return "integer"; }
  static std::string legal(const Limits& limits) { return describe(limits); }
  static std::optional<std::string> read(const Json& value, T& out, const Limits& limits) {
    std::optional<std::string> problem;
    const auto number = read_integer(value, limits, problem);
    if (!number) return problem;
    if (!std::in_range<T>(*number)) return "is too large: " + std::to_string(*number);
    out = static_cast<T>(*number);
    return std::nullopt;
  }
  static Json write(T value) { return value; }
};

template <>
struct ValueCodec<std::string> {
  static std::string type_name() { return "string"; }
  static std::string legal(const Limits&) { return "not empty"; }
  static std::optional<std::string> read(const Json& value, std::string& out, const Limits&) {
    if (!value.is_string()) return "must be a string, not " + describe_value(value);
    if (value.get_ref<const std::string&>().empty()) return "must not be empty";
    out = value.get<std::string>();
    return std::nullopt;
  }
  static Json write(const std::string& value) { return value; }
};

template <>
struct ValueCodec<std::filesystem::path> {
  static std::string type_name() { return "path"; }
  static std::string legal(const Limits&) { return "relative to the case's folder, or absolute"; }
  static std::optional<std::string> read(const Json& value, std::filesystem::path& out, const Limits& limits) {
    std::string text;
    auto problem = ValueCodec<std::string>::read(value, text, limits);
    if (!problem) out = text;
    return problem;
  }
  static Json write(const std::filesystem::path& value) { return value.string(); }
};

/// Three numbers in a TOML array.
template <class Array, class Scalar>
struct TripleCodec {
  static std::string legal(const Limits& limits) {
    const auto text = describe(limits);
    return text.empty() ? text : "each " + text;
  }
  static std::optional<std::string> read(const Json& value, Array& out, const Limits& limits) {
    const std::string asked = std::is_integral_v<Scalar> ? "3 integers" : "3 numbers";
    if (!value.is_array()) return "must be an array of " + asked + ", not " + describe_value(value);
    if (value.size() != 3)
      return "must be an array of " + asked + " (x, y, z), but has " + std::to_string(value.size());
    Array result;
    for (int d = 0; d < 3; ++d) {
      if (auto problem = ValueCodec<Scalar>::read(value[d], result[d], limits))
        return "component " + std::string(1, "xyz"[d]) + " " + *problem;
    }
    out = result;
    return std::nullopt;
  }
  static Json write(const Array& value) { return Json::array({value[0], value[1], value[2]}); }
};
template <>
struct ValueCodec<Vec3> : TripleCodec<Vec3, double> {
  static std::string type_name() { return "3 numbers"; }
};
template <>
struct ValueCodec<std::array<int, 3>> : TripleCodec<std::array<int, 3>, int> {
  static std::string type_name() { return "3 integers"; }
};

template <>
struct ValueCodec<bool> {
  static std::string type_name() { return "true or false"; }
  static std::string legal(const Limits&) { return "true, false"; }
  static std::optional<std::string> read(const Json& value, bool& out, const Limits&) {
    if (!value.is_boolean()) return "must be true or false, not " + describe_value(value);
    out = value.get<bool>();
    return std::nullopt;
  }
  static Json write(bool value) { return value; }
};

template <>
struct ValueCodec<std::array<double, 2>> {
  using Pair = std::array<double, 2>;
  static std::string type_name() { return "2 numbers"; }
  static std::string legal(const Limits& limits) { return TripleCodec<Pair, double>::legal(limits); }
  static std::optional<std::string> read(const Json& value, Pair& out, const Limits& limits) {
    if (!value.is_array() || value.size() != 2) return "must be an array of 2 numbers, not " + describe_value(value);
    Pair result{};
    for (std::size_t d = 0; d < 2; ++d) {
      if (auto problem = ValueCodec<double>::read(value[d], result[d], limits))
        return (d == 0 ? "first number " : "second number ") + *problem;
    }
    out = result;
    return std::nullopt;
  }
  static Json write(const Pair& value) { return Json::array({value[0], value[1]}); }
};

/// A list of pairs, [[t, v], ...].
template <>
struct ValueCodec<std::vector<std::array<double, 2>>> {
  using Pair = std::array<double, 2>;
  static std::string type_name() { return "list of 2 numbers"; }
  static std::string legal(const Limits&) { return "not empty"; }
  static std::optional<std::string> read(const Json& value, std::vector<Pair>& out, const Limits& limits) {
    if (!value.is_array() || value.empty())
      return "must be a list of pairs [[t, v], ...], not " + describe_value(value);
    std::vector<Pair> result(value.size());
    for (std::size_t n = 0; n < result.size(); ++n) {
      if (auto problem = ValueCodec<Pair>::read(value[n], result[n], limits))
        return "pair " + std::to_string(n + 1) + " " + *problem;
    }
    out = std::move(result);
    return std::nullopt;
  }
  static Json write(const std::vector<Pair>& value) {
    if (value.empty()) return Json();
    auto list = Json::array();
    for (const auto& pair : value) list.push_back(ValueCodec<Pair>::write(pair));
    return list;
  }
};

/// A list of numbers.
template <>
struct ValueCodec<std::vector<double>> {
  static std::string type_name() { return "list of numbers"; }
  static std::string legal(const Limits& limits) { return "each " + describe(limits); }
  static std::optional<std::string> read(const Json& value, std::vector<double>& out, const Limits& limits) {
    if (!value.is_array()) return "must be a list of numbers, [...], not " + describe_value(value);
    std::vector<double> result(value.size());
    for (std::size_t n = 0; n < result.size(); ++n) {
      if (auto problem = ValueCodec<double>::read(value[n], result[n], limits))
        return "entry " + std::to_string(n + 1) + " " + *problem;
    }
    out = std::move(result);
    return std::nullopt;
  }
  static Json write(const std::vector<double>& value) { return value.empty() ? Json() : Json(value); }
};

/// A list of names.
template <>
struct ValueCodec<std::vector<std::string>> {
  static std::string type_name() { return "list of strings"; }
  static std::string legal(const Limits&) { return "each not empty"; }
  static std::optional<std::string> read(const Json& value, std::vector<std::string>& out, const Limits& limits) {
    if (!value.is_array()) return "must be a list of strings, [\"...\", ...], not " + describe_value(value);
    std::vector<std::string> result(value.size());
    for (std::size_t n = 0; n < result.size(); ++n) {
      if (auto problem = ValueCodec<std::string>::read(value[n], result[n], limits))
        return "entry " + std::to_string(n + 1) + " " + *problem;
    }
    out = std::move(result);
    return std::nullopt;
  }
  static Json write(const std::vector<std::string>& value) { return value.empty() ? Json() : Json(value); }
};

/// Words, listed by words_of<E>().
template <class T>
requires std::is_enum_v<T>
struct ValueCodec<T> {
  static std::string type_name() { return "word"; }
  static std::string legal(const Limits&) { return quoted_list(words_of<T>()); }
  static std::optional<std::string> read(const Json& value, T& out, const Limits&) {
    if (!value.is_string()) return "must be one of " + legal({}) + ", not " + describe_value(value);
    const auto& word = value.get_ref<const std::string&>();
    for (const auto& [name, meaning] : words_of<T>()) {
      if (name == word) return out = meaning, std::nullopt;
    }
    return unknown_word(word, quoted_list(words_of<T>()));
  }
  static Json write(T value) { return word_for(value); }
};

template <class T>
struct ValueCodec<std::optional<T>> {
  static std::string type_name() { return ValueCodec<T>::type_name(); }
  static std::string legal(const Limits& limits) { return ValueCodec<T>::legal(limits); }
  static std::optional<std::string> read(const Json& value, std::optional<T>& out, const Limits& limits) {
    T inner{};
    auto problem = ValueCodec<T>::read(value, inner, limits);
    if (!problem) out = inner;
    return problem;
  }
  static Json write(const std::optional<T>& value) { return value ? ValueCodec<T>::write(*value) : Json(); }
};

}  // namespace pliant
