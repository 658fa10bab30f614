#pragma once
#include <optional>
#include <string>
#include <vector>

#include "config/value_codec.hpp"
#include "core/byte_stream.hpp"
#include "coupling/bodies.hpp"

namespace pliant {

/// When hinged bodies leave their stops and come to them, to a degree: opening and closing times of valves. All ranks
/// know the same. Times between steps are interpolated.
class HingeTimes {
 public:
  struct Event {
    double time = 0;
    double stop = 0;  ///< degrees
    bool arrives = false;
  };

  /// `period` of the cycle; none: times have no phase.
  HingeTimes(const Bodies& bodies, std::optional<double> period);

  bool any() const { return !hinges_.empty(); }
  /// Looks at the angles: at the start, and after every step. Collective, if there are any.
  void observe(double time, const Bodies& bodies);

  /// Lines for people: the last events of each.
  std::vector<std::string> describe() const;
  Json results() const;

  /// What a checkpoint needs.
  void write(ByteWriter& out) const;
  void read(ByteReader& in);

 private:
  struct Hinge {
    long body = 0;
    std::string name;
    std::vector<double> stops;  ///< degrees
    std::vector<Event> events;
  };
  void note(Hinge& hinge, double before, double now, double time_before, double time) const;

  std::optional<double> period_;
  std::vector<Hinge> hinges_;
  std::vector<double> angles_;  ///< degrees, at the last look
  double last_time_ = 0;
};

}  // namespace pliant
