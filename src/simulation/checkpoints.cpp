#include "simulation/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>

#include "core/error.hpp"
#include "parallel/agree.hpp"
#include "simulation/case_identity.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

// Of what a slow disk writes in a second, until a checkpoint has been timed.
constexpr double slow_disk = 50e6;  // bytes / s

fs::path path_of(const fs::path& folder, long step) { return folder / fmt::format("step_{:06d}.checkpoint", step); }

// Those in a folder, by step.
std::map<long, fs::path> list(const fs::path& folder) {
  const std::regex pattern("step_([0-9]{6,})\\.checkpoint");
  std::map<long, fs::path> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    std::smatch parts;
    if (std::regex_match(name, parts, pattern)) found[std::stol(parts[1])] = entry.path();
  }
  return found;
}

// The newest first, as the root sees them. Collective.
std::vector<fs::path> list_newest_first(const fs::path& folder, const Communicator& ranks) {
  std::string names;
  do_on_root(ranks, [&] {
    for (const auto& [step, path] : list(folder)) names = path.filename().string() + "\n" + names;
  });
  names = ranks.broadcast(names);
  std::vector<fs::path> paths;
  for (std::size_t begin = 0; begin < names.size();) {
    const auto end = names.find('\n', begin);
    paths.push_back(folder / names.substr(begin, end - begin));
    begin = end + 1;
  }
  return paths;
}

void require_same_case(const CheckpointHead& head, const Json& identity) {
  const auto then = Json::parse(head.case_text, nullptr, false);
  if (!then.is_object()) throw CheckpointRefused("has a case that cannot be read");
  const auto found = differences(identity, then);
  if (found.empty()) return;
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t n = 0; n < std::min(most, found.size()); ++n) text += (n > 0 ? "; " : "") + found[n];
  if (found.size() > most) text += fmt::format("; and {} more", found.size() - most);
  throw CheckpointRefused("is of another case: " + text);
}

// A good checkpoint, or why it is not.
struct Attempt {
  std::unique_ptr<CheckpointReader> reader;
  std::string reason;
};

Attempt try_to_open(const fs::path& path, const Json& identity, const Communicator& ranks) {
  try {
    auto reader = std::make_unique<CheckpointReader>(path, ranks);
    require_same_case(reader->head(), identity);
    reader->verify();
    return {std::move(reader), ""};
  } catch (const CheckpointRefused& refused) { return {nullptr, refused.what()}; }
}

std::string describe_older(const fs::path& refused, const Json& identity, const Communicator& ranks) {
  for (const auto& path : list_newest_first(refused.parent_path(), ranks)) {
    if (path.filename() >= refused.filename()) continue;
    const auto attempt = try_to_open(path, identity, ranks);
    if (attempt.reader)
      return fmt::format("; the one before it is good: --restart {} continues from step {}", path.string(),
                         attempt.reader->head().step);
  }
  return "";
}

}  // namespace

Checkpoints::Checkpoints(const fs::path& output, const CheckpointConfig& config, const Communicator& ranks)
    : folder_(output / "checkpoints"), config_(config), ranks_(ranks) {}

bool Checkpoints::is_due_by_step(long step) const {
  return are_wanted() && config_.every && step % *config_.every == 0 && step != last_step_;
}

bool Checkpoints::is_due_by_clock() const {
  return are_wanted() && config_.minutes &&
         Clock::now() - last_time_ >= std::chrono::duration<double>(60 * *config_.minutes);
}

fs::path Checkpoints::last_path() const { return path_of(folder_, last_step_); }

void Checkpoints::write(const CheckpointHead& head, const FlowSolver& flow, const std::vector<BodyBlob>& bodies,
                        const std::vector<StoredTable>& more) {
  if (!are_wanted() || head.step == last_step_) return;
  const auto begin = Clock::now();
  write_checkpoint(path_of(folder_, head.step), head, flow, bodies, more);
  do_on_root(ranks_, [&] {
    const auto all = list(folder_);
    auto surplus = static_cast<long>(all.size()) - config_.keep;
    for (auto oldest = all.begin(); surplus > 0; --surplus, ++oldest) fs::remove(oldest->second);
  });
  last_step_ = head.step;
  last_time_ = Clock::now();
  slowest_ = std::max(slowest_, std::chrono::duration<double>(last_time_ - begin).count());
}

void Checkpoints::resume_after(long step) {
  do_on_root(ranks_, [&] {
    for (const auto& [later, path] : list(folder_))
      if (later > step) fs::remove(path);
  });
  last_step_ = step;
}

double Checkpoints::expected_seconds(const FlowSolver& flow) const {
  if (slowest_ > 0) return slowest_;
  const auto& n = flow.grid().cells();
  return 4 * sizeof(double) * static_cast<double>(n[0]) * n[1] * n[2] / slow_disk;
}

OpenCheckpoint open_checkpoint(const RestartRequest& request, const fs::path& output, const CaseConfig& config,
                               const Communicator& ranks, const Log& log) {
  const auto identity = case_identity(config);
  if (!request.file.empty()) {
    auto attempt = try_to_open(request.file, identity, ranks);
    if (attempt.reader) return {request.file, std::move(attempt.reader)};
    throw InputError(
        fmt::format("{} {}{}", request.file.string(), attempt.reason, describe_older(request.file, identity, ranks)));
  }
  std::vector<std::string> problems;
  for (const auto& path : list_newest_first(output / "checkpoints", ranks)) {
    auto attempt = try_to_open(path, identity, ranks);
    if (attempt.reader) {
      for (const auto& problem : problems) log.warn("{}", problem);
      if (!problems.empty()) log.warn("continuing from the one before: {}", path.string());
      return {path, std::move(attempt.reader)};
    }
    problems.push_back(fmt::format("{} {}", path.string(), attempt.reason));
  }
  if (problems.empty())
    problems.push_back(fmt::format("{} holds no checkpoint to continue from; run without --restart, or name a file",
                                   (output / "checkpoints").string()));
  throw InputError(std::move(problems));
}

}  // namespace pliant
