#include "config/validate_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "config/validate.hpp"

namespace pliant {
namespace {

class OutputValidator {
 public:
  OutputValidator(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems)
      : config_(config), suspect_(suspect), problems_(problems) {}

  void run() {
    const auto& output = config_.output;
    if (!output.period && suspect_.count("output.period") == 0) {
      for (const auto& [key, is_given] : {std::pair{"output.fields.phases", !output.fields.phases.empty()},
                                          {"output.surfaces.phases", !output.surfaces.phases.empty()},
                                          {"output.phase_average.bins", output.phase_average.has_value()}})
        if (is_given) complain(key, "goes by the phase of a cycle, but output.period is not given");
    }
    for (const auto& cavity : config_.cavities) check(cavity);
  }

 private:
  void complain(const std::string& key, const std::string& what) {
    problems_.push_back(place_of(config_, key) + " " + what);
  }

  void check(const CavityConfig& cavity) {
    const auto key = "cavity." + cavity.name;
    const bool is_plain =
        !cavity.name.empty() && std::all_of(cavity.name.begin(), cavity.name.end(),
                                            [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
    if (!is_plain) complain(key, "names a file: use only letters, digits, - and _");
    if (suspect_.count(key + ".body") == 0) check_body(key + ".body", cavity.body);
    if (cavity.jet && !(norm(cavity.jet->axis) > 0)) complain(key + ".jet.axis", "must not be 0: give its direction");
    if (cavity.ejection_fraction && suspect_.count(key + ".flow") == 0 && config_.signals.count(cavity.flow) == 0)
      complain(key + ".ejection_fraction",
               "sets the scale of a signal, but flow does not name one; write [signals.NAME] and flow = \"NAME\"");
    for (const auto& other : config_.cavities)
      if (&other < &cavity && other.ejection_fraction && cavity.ejection_fraction && other.flow == cavity.flow)
        complain(key + ".ejection_fraction",
                 fmt::format("sets the scale of the signal \"{}\", and so does cavity.{}; only one can", cavity.flow,
                             other.name));
  }

  void check_body(const std::string& key, const std::string& name) {
    std::string known;
    for (const auto& body : config_.bodies) {
      known += (known.empty() ? "\"" : ", \"") + body.name + "\"";
      if (body.name != name) continue;
      if (body.placement.count || body.placement.positions)
        complain(key, fmt::format("names \"{}\", which stands for copies; name a body of its own", name));
      return;
    }
    complain(key, fmt::format("names \"{}\", which is no body; the case has {}", name, known.empty() ? "none" : known));
  }

  const CaseConfig& config_;
  const std::set<std::string>& suspect_;
  std::vector<std::string>& problems_;
};

}  // namespace

void check_outputs(const CaseConfig& config, const std::set<std::string>& suspect, std::vector<std::string>& problems) {
  OutputValidator(config, suspect, problems).run();
}

}  // namespace pliant
