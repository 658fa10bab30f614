#include "simulation/hinge_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "simulation/cycles.hpp"

namespace pliant {
namespace {

constexpr double reach = 1;  // degrees
// A body that rattles for a long time does not fill the memory: the newest stay.
constexpr std::size_t most_events = 1000;
constexpr std::size_t most_lines = 10;

}  // namespace

HingeTimes::HingeTimes(const Bodies& bodies, std::optional<double> period) : period_(period) {
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k) {
    const auto& config = bodies.kinds()[k].config;
    if (config.motion != MotionKind::hinge) continue;
    std::vector<double> stops;
    for (const auto& stop : {config.hinge.min_angle, config.hinge.max_angle})
      if (stop) stops.push_back(*stop);
    if (stops.empty()) continue;
    for (long copy = 0; copy < bodies.count(k); ++copy)
      hinges_.push_back({bodies.first_id(k) + copy,
                         bodies.count(k) == 1 ? config.name : fmt::format("{} {}", config.name, copy + 1),
                         stops,
                         {}});
  }
}

void HingeTimes::observe(double time, const Bodies& bodies) {
  if (hinges_.empty()) return;
  std::vector<double> angles;
  for (const auto& hinge : hinges_) {
    const Body* body = bodies.find(hinge.body);
    angles.push_back(body == nullptr ? 0 : body->hinge.angle / degree);
  }
  bodies.grid().ranks().sum(angles);
  if (!angles_.empty() && time > last_time_)
    for (std::size_t n = 0; n < hinges_.size(); ++n) note(hinges_[n], angles_[n], angles[n], last_time_, time);
  angles_ = std::move(angles);
  last_time_ = time;
}

void HingeTimes::note(Hinge& hinge, double before, double now, double time_before, double time) const {
  for (const double stop : hinge.stops) {
    const double off_before = std::abs(before - stop), off = std::abs(now - stop);
    if ((off_before <= reach) == (off <= reach)) continue;
    const double share = std::clamp((reach - off_before) / (off - off_before), 0.0, 1.0);
    hinge.events.push_back({time_before + share * (time - time_before), stop, off <= reach});
  }
  // Away from one stop to the other within a step.
  std::stable_sort(hinge.events.begin(), hinge.events.end(), [](auto& a, auto& b) { return a.time < b.time; });
  if (hinge.events.size() > most_events) hinge.events.erase(hinge.events.begin());
}

std::vector<std::string> HingeTimes::describe() const {
  constexpr std::ptrdiff_t shown = 8;
  std::vector<std::string> lines;
  for (const auto& hinge : hinges_) {
    if (lines.size() == most_lines) {
      lines.push_back(fmt::format("and {} hinges more: run.json has them", hinges_.size() - most_lines));
      break;
    }
    const auto count = static_cast<std::ptrdiff_t>(hinge.events.size());
    auto text = fmt::format("hinge {}:", hinge.name);
    if (count == 0) text += " neither left a stop nor came to one";
    if (count > shown) text += " ...";
    for (auto event = hinge.events.end() - std::min(count, shown); event != hinge.events.end(); ++event) {
      text += fmt::format("{} {} {:.4g} deg at t = {:.5g}", text.back() == ':' || text.back() == '.' ? "" : ",",
                          event->arrives ? "comes to" : "leaves", event->stop, event->time);
      if (period_) text += fmt::format(" (phase {:.4f})", cycle_time(event->time, *period_).phase);
    }
    lines.push_back(std::move(text));
  }
  return lines;
}

Json HingeTimes::results() const {
  auto all = Json::object();
  for (const auto& hinge : hinges_) {
    auto events = Json::array();
    for (const auto& event : hinge.events) {
      Json entry{{"what", event.arrives ? "comes to" : "leaves"}, {"stop", event.stop}, {"time", event.time}};
      if (period_) {
        const auto [cycle, phase] = cycle_time(event.time, *period_);
        entry["cycle"] = cycle + 1;
        entry["phase"] = phase;
      }
      events.push_back(std::move(entry));
    }
    all[hinge.name] = std::move(events);
  }
  return all;
}

void HingeTimes::write(ByteWriter& out) const {
  out.write(last_time_);
  out.write(angles_);
  for (const auto& hinge : hinges_) out.write(hinge.events);
}

void HingeTimes::read(ByteReader& in) {
  in.read(last_time_);
  in.read(angles_);
  for (auto& hinge : hinges_) in.read(hinge.events);
}

}  // namespace pliant
