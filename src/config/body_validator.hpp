#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "config/validate.hpp"

namespace pliant {

/// What validators of bodies share: they go through the bodies one by one, leave keys alone that are suspect already, and
/// complain with the place of a key.
class BodyValidator {
 protected:
  BodyValidator(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems)
      : config_(config), suspect_(suspect), problems_(problems) {}

  /// check(body) for all bodies that have a name and a motion.
  template <class Check>
  void for_each_body(Check check) {
    for (const auto& body : config_.bodies) {
      if (body.name.empty()) continue;
      prefix_ = "body." + body.name;
      if (trusted("motion")) check(body);
    }
  }

  /// Keys of the present body that have not been complained about.
  bool trusted(const std::string& key) const { return suspect_.count(prefix_ + "." + key) == 0; }
  bool trusted(std::initializer_list<const char*> keys) const {
    return std::all_of(keys.begin(), keys.end(), [&](const char* key) { return trusted(std::string(key)); });
  }

  void complain(const std::string& key, const std::string& what) {
    const auto path = prefix_ + "." + key;
    // A default has no place of its own; its body has.
    const bool is_given = config_.origins.count(path) > 0;
    problems_.push_back(is_given ? fmt::format("{} {}", place_of(config_, path), what)
                                 : fmt::format("{}.{} {}", place_of(config_, prefix_), key, what));
  }

  const CaseConfig& config_;
  const std::set<std::string>& suspect_;
  std::vector<std::string>& problems_;
  std::string prefix_;
};

}  // namespace pliant
