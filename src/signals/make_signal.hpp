#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "signals/signal.hpp"

namespace pliant {

/// A signal from its description; `folder` is that of the case, where its file is looked for. Throws InputError with
/// every problem, each beginning with the key: unsorted times, a period shorter than the table, a missing file or a bad
/// line of it, a formula that is none (with the character) or has no finite value somewhere in its period.
Signal make_signal(const SignalConfig& config, const std::filesystem::path& folder);

/// The signal of that name of a case; problems name place and key.
Signal make_signal(const CaseConfig& config, const std::string& name);

/// All signals of a case. Throws InputError with every problem, place and key named.
Signals make_signals(const CaseConfig& config);

/// The signal of that name; else the text is read as a formula of t. Throws InputError, which lists the known signals,
/// when it is neither.
Signal make_signal_or_formula(const std::string& text, const Signals& signals);

/// The first of many samples over [0, end] at which a signal has no finite value, if there is one.
std::optional<double> first_not_finite(const Signal& signal, double end);

/// Everything that is wrong with the signals of a case and with the keys that name one: values that are not finite
/// until the end of the run, unknown names, a phase of a signal without a period. Checks that rest on a key in
/// `suspect` are skipped.
void check_signals(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems);

}  // namespace pliant
