#include "signals/make_signal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "config/validate.hpp"
#include "core/error.hpp"
#include "signals/balance.hpp"
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
  const double scale = config.scale * config.value_unit;
  return Signal([curve, scale](double t) { return scale * curve->value(t); }, config.period);
}

Signal make_formula_signal(const SignalConfig& config) {
  const Formula formula(config.formula, config.period ? Formula::Variables::t_and_phase : Formula::Variables::t);
  const double scale = config.scale * config.value_unit, unit = config.time_unit;
  if (!config.period) return Signal([formula, scale, unit](double t) { return scale * formula.value(t / unit); });
  return Signal(
      [formula, scale, unit, period = *config.period](double t) {
        const double now = wrap(t, period);
        return scale * formula.value(now / unit, now / period);
      },
      config.period);
}

/// Brings the parts above and below zero to the sizes that are asked for.
Signal adjust(const SignalConfig& config, const Signal& signal, const PlaceOf& place,
              std::vector<std::string>& problems) {
  for (const auto& [key, is_given] : {std::pair{"balance", config.balance}, {"volume", config.volume.has_value()}})
    if (is_given && !config.period)
      problems.push_back(
          fmt::format("{} speaks of a period, but the signal has none; give it the key period", place(key)));
  if ((!config.balance && !config.volume) || !config.period) return signal;
  const auto [positive, negative] = parts_of_period(signal);
  if (config.volume && !(positive > 0))
    problems.push_back(fmt::format("{} is to be carried by positive values, but the signal has none", place("volume")));
  if (config.balance && !(positive > 0 && negative > 0))
    problems.push_back(fmt::format("{} scales negative values against positive ones, but the signal has no {} ones",
                                   place("balance"), positive > 0 ? "negative" : "positive"));
  const double up = config.volume ? *config.volume / positive : 1;
  const double down = config.balance ? up * positive / negative : up;
  return Signal(
      [signal, up, down](double t) {
        const double value = signal.value(t);
        return (value > 0 ? up : down) * value;
      },
      config.period);
}

Signal make_signal_at(const SignalConfig& config, const std::filesystem::path& folder, const PlaceOf& place) {
  std::vector<std::string> problems;
  std::optional<Signal> signal;
  try {
    if (!config.formula.empty()) {
      signal = make_formula_signal(config);
    } else {
      Table table = config.csv.empty() ? config.table : read_table(folder / config.csv);
      if (table.empty()) problems.push_back(place("table") + " is empty; give it pairs [[t, v], ...]");
      check_times(table, place, problems);
      for (auto& point : table) point[0] *= config.time_unit;
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
  if (signal && problems.empty()) signal = adjust(config, *signal, place, problems);
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
