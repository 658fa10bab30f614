#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace pliant {

/// A number that varies in time, the same bits on every rank. Cheap to copy.
class Signal {
 public:
  explicit Signal(std::function<double(double)> curve, std::optional<double> period = std::nullopt)
      : curve_(std::move(curve)), period_(period) {}

  double value(double t) const { return curve_(t); }
  const std::optional<double>& period() const { return period_; }
  /// How far t is into its period, in [0, 1); 0 without a period.
  double phase(double t) const;

 private:
  std::function<double(double)> curve_;
  std::optional<double> period_;
};

/// The signals of a case by name.
using Signals = std::map<std::string, Signal>;

}  // namespace pliant
