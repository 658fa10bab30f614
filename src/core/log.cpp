#include "core/log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

namespace pliant {
namespace {

// "warning: " and "error: " in front of what needs attention, nothing in front of the rest.
class LevelPrefix : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const auto put = [&out](std::string_view text) { out.append(text.data(), text.data() + text.size()); };
    if (message.level == spdlog::level::warn) put("warning: ");
    if (message.level >= spdlog::level::err) put("error: ");
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LevelPrefix>(); }
};

std::shared_ptr<spdlog::logger> make_logger(Speaker speaker) {
  if (speaker == Speaker::silent)
    return std::make_shared<spdlog::logger>("pliant", std::make_shared<spdlog::sinks::null_sink_mt>());
  auto logger = std::make_shared<spdlog::logger>("pliant", std::make_shared<spdlog::sinks::stdout_sink_mt>());
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<LevelPrefix>('*').set_pattern("%*%v");
  logger->set_formatter(std::move(formatter));
  // A line that is not flushed is lost when a batch system kills the run.
  logger->flush_on(spdlog::level::info);
  return logger;
}

}  // namespace

Log::Log(Speaker speaker) : sink_(make_logger(speaker)) {}

}  // namespace pliant
