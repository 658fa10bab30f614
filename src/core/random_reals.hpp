#pragma once
#include <cstdint>
#include <random>
#include <string_view>

namespace pliant {

/// Uniform numbers in [0, 1) of 53 bits, the same on every platform: the standard fixes the generator, and the step to
/// reals is our own.
class RandomReals {
 public:
  explicit RandomReals(std::uint64_t seed) : generator_(seed) {}
  double next() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 generator_;
};

/// A seed for the stream of one name, so that bodies with the same seed differ (FNV-1a hash of the name, mixed in).
inline std::uint64_t seed_for(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash ^ (seed * 0x9e3779b97f4a7c15u);
}

}  // namespace pliant
