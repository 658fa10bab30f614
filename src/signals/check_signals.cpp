#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "config/key_table.hpp"
#include "config/validate.hpp"
#include "config/validate_patches.hpp"
#include "core/error.hpp"
#include "signals/make_signal.hpp"

namespace pliant {
namespace {
class SignalValidator {
 public:
  SignalValidator(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems)
      : config_(config), suspect_(suspect), problems_(problems) {}

  void run() {
    for (const auto& entry : config_.signals) check_signal(entry.first);
    for (int side = 0; side < 6; ++side) {
      const auto& spec = config_.boundary[static_cast<std::size_t>(side)];
      if (const auto* inflow = std::get_if<InflowSide>(&spec); inflow != nullptr && !inflow->signal.empty())
        check_use("boundary." + side_names()[static_cast<std::size_t>(side)] + ".signal", inflow->signal, {});
      const auto* patches = patches_of(spec);
      if (patches == nullptr) continue;
      for (const auto& patch : *patches)
        if (!patch.balance && !patch.flow_rate.empty()) check_patch(patch_key(side, patch), patch);
    }
    for (const auto& cavity : config_.cavities)
      if (!cavity.flow.empty()) check_use("cavity." + cavity.name + ".flow", cavity.flow, {3, -1, 0});
    for (const auto& body : config_.bodies)
      if (body.motion == MotionKind::prescribed && !body.name.empty())
        check_path("body." + body.name + ".path.", body.path);
  }

 private:
  bool trusted(const std::string& prefix) const {
    return std::none_of(suspect_.begin(), suspect_.end(),
                        [&](const std::string& key) { return key.rfind(prefix, 0) == 0; });
  }
  void complain(const std::string& key, const std::string& what) {
    problems_.push_back(place_of(config_, key) + " " + what);
  }

  void check_signal(const std::string& name) {
    const auto key = "signals." + name;
    const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '_' || c == '-';
    });
    if (!plain || name == "t" || name == "pi")
      complain(key, "cannot be told from a formula; use letters, digits, - and _ for its name, but not t or pi alone");
    if (!trusted(key)) return;
    try {
      const auto signal = make_signal(config_, name);
      if (const auto time = first_not_finite(signal, config_.time.end))
        complain(key, fmt::format("has no finite value at t = {:.6g}", *time));
      else sound_.emplace(name, signal);
    } catch (const InputError& error) {
      problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
    }
  }

  void check_patch(const std::string& key, const PatchConfig& patch) {
    const auto signal = check_use(key + ".flow_rate", patch.flow_rate, {3, -1, 0});
    if (signal && patch.phase && !signal->period())
      complain(key + ".phase", fmt::format("is part of a period, but the flow rate \"{}\" has none; name a signal with "
                                           "the key period",
                                           patch.flow_rate));
  }

  void check_path(const std::string& prefix, const PathConfig& path) {
    const std::pair<const char*, const std::string*> functions[] = {
        {"x", &path.x}, {"y", &path.y}, {"z", &path.z}, {"angle", &path.angle}};
    for (const auto& [name, text] : functions)
      if (!text->empty())
        check_use(prefix + name, *text, std::string_view(name) == "angle" ? Dimension{} : Dimension{1, 0, 0});
  }

  std::optional<Signal> check_use(const std::string& key, const std::string& text, Dimension wanted) {
    if (!trusted(key)) return std::nullopt;
    const auto named = config_.signals.find(text);
    if (named != config_.signals.end() && named->second.dimension && *named->second.dimension != wanted) {
      complain(key, fmt::format("is the signal \"{}\", whose unit makes it {}, but must be {}", text,
                                describe(*named->second.dimension), describe(wanted)));
      return std::nullopt;
    }
    // Already complained about where it is written.
    if (config_.signals.count(text) > 0 && sound_.count(text) == 0) return std::nullopt;
    try {
      const auto signal = make_signal_or_formula(text, sound_);
      if (const auto time = first_not_finite(signal, config_.time.end))
        complain(key, fmt::format("\"{}\" has no finite value at t = {:.6g}", text, *time));
      else return signal;
    } catch (const InputError& error) { complain(key, error.problems().front()); }
    return std::nullopt;
  }

  const CaseConfig& config_;
  const std::set<std::string>& suspect_;
  std::vector<std::string>& problems_;
  Signals sound_;
};
}  // namespace

void check_signals(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems) {
  SignalValidator(config, suspect, problems).run();
}

}  // namespace pliant
