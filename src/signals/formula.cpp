#include "signals/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <mutex>
#include <numbers>

#include "core/error.hpp"

namespace pliant {

struct Formula::Parsed {
  std::mutex mutex;  // an evaluation goes through the variable
  double t = 0, phase = 0;
  mu::Parser parser;
};

Formula::Formula(const std::string& text, Variables variables) : parsed_(std::make_shared<Parsed>()) {
  try {
    auto& parser = parsed_->parser;
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineVar("t", &parsed_->t);
    if (variables == Variables::t_and_phase) parser.DefineVar("phase", &parsed_->phase);
    parser.SetExpr(text);
    int results = 0;
    constexpr double probe = 0.5;
    parsed_->t = probe;
    parser.Eval(results);
    if (results != 1)
      throw InputError(fmt::format("the formula \"{}\" has {} results; it must have one", text, results));
    if (parsed_->t != probe)
      throw InputError(fmt::format("the formula \"{}\" changes t; = is not a comparison, == is", text));
  } catch (const mu::ParserError& error) {
    const auto message = error.GetMsg();
    if (error.GetPos() < 0) throw InputError(fmt::format("the formula \"{}\" is wrong: {}", text, message));
    // muParser counts its own end mark.
    const auto character = std::min(static_cast<std::size_t>(error.GetPos()), text.size()) + 1;
    throw InputError(fmt::format("the formula \"{}\" is wrong at character {}: {}", text, character, message));
  }
}

double Formula::value(double t, double phase) const {
  const std::lock_guard lock(parsed_->mutex);
  parsed_->t = t;
  parsed_->phase = phase;
  return parsed_->parser.Eval();
}

}  // namespace pliant
