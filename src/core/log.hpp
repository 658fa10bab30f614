#pragma once
#include <spdlog/spdlog.h>

#include <memory>

namespace pliant {

/// Who speaks: in a parallel run only the root does.
enum class Speaker { this_rank, silent };

/// The run's messages for people: plain lines on standard output, warnings and errors with their level in front.
/// A copy speaks to the same place.
class Log {
 public:
  explicit Log(Speaker speaker = Speaker::this_rank);

  template <class... Args>
  void info(fmt::format_string<Args...> text, Args&&... args) const {
    sink_->info(text, std::forward<Args>(args)...);
  }
  template <class... Args>
  void warn(fmt::format_string<Args...> text, Args&&... args) const {
    sink_->warn(text, std::forward<Args>(args)...);
  }
  template <class... Args>
  void error(fmt::format_string<Args...> text, Args&&... args) const {
    sink_->error(text, std::forward<Args>(args)...);
  }
  void set_level(spdlog::level::level_enum level) const { sink_->set_level(level); }

 private:
  std::shared_ptr<spdlog::logger> sink_;
};

}  // namespace pliant
