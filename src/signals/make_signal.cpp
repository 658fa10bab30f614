#include "signals/make_signal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "config/validate.hpp"
#include "core/error.hpp"
#include "signals/formula.hpp"
#include "signals/pchip.hpp"
#include "signals/read_table.hpp"

namespace pliant {
namespace {
using Table = std::vector<std::array<double, 2>>;
/// The beginning of a message about a key of the signal.
using PlaceOf = std::function<std::string(const std::string& key)>;

void check_times(const Table& table, const PlaceOf& place, std::vector<std::string>& problems) {
  for (std::size_t n = 1; n < table.size(); ++n)
    if (table[n][0] <= table[n - 1][0])
      problems.push_back(fmt::format("{} has the time {} after {}; sort the pairs by their times", place("table"),
                                     table[n][0], table[n - 1][0]));
}

void check_period(const Table& table, double period, const PlaceOf& place, std::vector<std::string>& problems) {
  const double length = table.back()[0] - table.front()[0];
  if (length > period * (1 + 1e-9))
    problems.push_back(fmt::format("{} is {}, shorter than the table, which runs from {} to {}", place("period"),
                                   period, table.front()[0], table.back()[0]));
  else if (table.size() > 1 && length > period * (1 - 1e-9) && table.front()[1] != table.back()[1])
    problems.push_back(fmt::format("{} is {}, the length of the table, but its last value {} is not its first, {}",
                                   place("period"), period, table.back()[1], table.front()[1]));
}

Signal make_table_signal(const SignalConfig& config, const Table& table) {
  const auto curve = std::make_shared<const Pchip>(table, config.period);
  return Signal([curve, scale = config.scale](double t) { return scale * curve->value(t); }, config.period);
}

Signal make_formula_signal(const SignalConfig& config) {
  const Formula formula(config.formula);
  const double scale = config.scale;
  if (!config.period) return Signal([formula, scale](double t) { return scale * formula.value(t); });
  return Signal([formula, scale, period = *config.period](double t) { return scale * formula.value(wrap(t, period)); },
                config.period);
}

Signal make_signal_at(const SignalConfig& config, const std::filesystem::path& folder, const PlaceOf& place) {
  std::vector<std::string> problems;
  std::optional<Signal> signal;
  try {
    if (!config.formula.empty()) {
      signal = make_formula_signal(config);
    } else {
      const Table table = config.csv.empty() ? config.table : read_table(folder / config.csv);
      if (table.empty()) problems.push_back(place("table") + " is empty; give it pairs [[t, v], ...]");
      check_times(table, place, problems);
      if (problems.empty() && config.period) check_period(table, *config.period, place, problems);
      if (problems.empty()) signal = make_table_signal(config, table);
    }
  } catch (const InputError& error) {
    const std::string key = config.formula.empty() ? "csv" : "formula";
    for (const auto& problem : error.problems()) problems.push_back(fmt::format("{}: {}", place(key), problem));
  }
  if (signal && config.period) {
    if (const auto time = first_not_finite(*signal, *config.period))
      problems.push_back(fmt::format("{} has no finite value at t = {:.6g}", place("formula"), *time));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return *signal;
}
}  // namespace

double Signal::phase(double t) const { return period_ ? wrap(t, *period_) / *period_ : 0; }

std::optional<double> first_not_finite(const Signal& signal, double end) {
  constexpr int samples = 2000;
  for (int n = 0; n <= samples; ++n) {
    const double t = end * n / samples;
    if (!std::isfinite(signal.value(t))) return t;
  }
  return std::nullopt;
}

Signal make_signal(const SignalConfig& config, const std::filesystem::path& folder) {
  return make_signal_at(config, folder, [](const std::string& key) { return key; });
}

Signal make_signal(const CaseConfig& config, const std::string& name) {
  return make_signal_at(config.signals.at(name), config.folder,
                        [&](const std::string& key) { return place_of(config, "signals." + name + "." + key); });
}

Signals make_signals(const CaseConfig& config) {
  Signals signals;
  std::vector<std::string> problems;
  for (const auto& entry : config.signals) {
    try {
      signals.emplace(entry.first, make_signal(config, entry.first));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return signals;
}

Signal make_signal_or_formula(const std::string& text, const Signals& signals) {
  if (const auto found = signals.find(text); found != signals.end()) return found->second;
  try {
    SignalConfig formula;
    formula.formula = text;
    return make_formula_signal(formula);
  } catch (const InputError& error) {
    std::string known;
    for (const auto& entry : signals) known += (known.empty() ? "" : ", ") + entry.first;
    throw InputError(fmt::format("\"{}\" is neither a signal ({}) nor a formula of t: {}", text,
                                 known.empty() ? "the case has none" : "the case has: " + known,
                                 error.problems().front()));
  }
}

}  // namespace pliant
