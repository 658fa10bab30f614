#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/dimension.hpp"
#include "config/value_codec.hpp"

namespace pliant {

enum class Presence { optional, required };

/// One key of the case file: the single source for the reader, the defaults, the resolved print-out and the docs.
/// `Config` is the struct it lives in: CaseConfig, or BodyConfig for the keys of one [[body]].
template <class Config>
struct Key {
  std::string path;    ///< within `Config`, dotted: "box.size"
  std::string unit;    ///< physical dimension, as parse_key_unit() reads it; empty for pure numbers and words
  std::string doc;     ///< one line
  std::string type;    ///< for people: "number", "3 integers", ...
  std::string legal;   ///< for people: "> 0", a list of words, ...
  Json default_value;  ///< null: no default
  Presence presence = Presence::optional;
  std::vector<std::string> excludes = {};  ///< keys that say the same thing another way
  std::string condition = {};              ///< for people: when the key applies; empty means always
  /// Stores a value; returns what is wrong with it, or nothing. Leaves the config alone when it returns a complaint.
  std::function<std::optional<std::string>(Config&, const Json&)> set = {};
  /// The value as it stands; null when the key does not apply or an optional value is not set.
  std::function<Json(const Config&)> get = {};
  /// Whether the key means anything in this config; asked after all keys are set. Empty: always.
  std::function<bool(const Config&)> applies = {};

  /// What a text with a unit is turned into; nothing where it makes no sense.
  std::optional<KeyUnit> quantity() const { return parse_key_unit(unit); }
};

/// The content of an optional group: made on the spot for a mutable config, null when absent in a constant one.
template <class T>
T* member(std::optional<T>& group) {
  return group ? &*group : &group.emplace();
}
template <class T>
const T* member(const std::optional<T>& group) {
  return group ? &*group : nullptr;
}

/// What the docs say of a key, given to make_key in one piece.
struct KeyText {
  std::string path, unit, doc;
};

/// A key whose value is one member. `access(config)` returns a pointer to it, or null where it does not exist (another
/// alternative of a variant, an optional group not given); for a mutable config it may create the group.
template <class Config, class Access>
Key<Config> make_key(KeyText text, Access access, Limits limits = {}) {
  using Pointer = decltype(access(std::declval<Config&>()));
  using Codec = ValueCodec<std::remove_pointer_t<Pointer>>;
  Key<Config> key;
  key.path = std::move(text.path);
  key.unit = std::move(text.unit);
  key.doc = std::move(text.doc);
  key.type = Codec::type_name();
  key.legal = Codec::legal(limits);
  Config fresh;
  if (auto* member = access(fresh)) key.default_value = Codec::write(*member);
  key.set = [access, limits](Config& config, const Json& value) -> std::optional<std::string> {
    auto* member = access(config);
    if (!member) return std::nullopt;
    return Codec::read(value, *member, limits);
  };
  key.get = [access](const Config& config) -> Json {
    const auto* member = access(config);
    return member ? Codec::write(*member) : Json();
  };
  return key;
}

/// Restricts a key to the configs for which `applies` holds; `condition` says so to people: `initial.flow is
/// "uniform"`.
template <class Config>
Key<Config> only_when(Key<Config> key, std::string condition, std::function<bool(const Config&)> applies) {
  key.condition = std::move(condition);
  key.get = [get = std::move(key.get), applies](const Config& config) {
    return applies(config) ? get(config) : Json();
  };
  key.applies = std::move(applies);
  return key;
}

template <class Config>
Key<Config> required(Key<Config> key) {
  key.presence = Presence::required;
  return key;
}

/// Marks other keys as another way of saying the same thing: only one of them may be given.
template <class Config>
Key<Config> instead_of(Key<Config> key, std::vector<std::string> others) {
  key.excludes = std::move(others);
  return key;
}

}  // namespace pliant
