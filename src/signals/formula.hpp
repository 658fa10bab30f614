#pragma once
#include <memory>
#include <string>

namespace pliant {

/// A formula of t and, where there is a period, of phase, the part of it that has passed; in the language of muParser
/// with the constant pi. Copies share the parsed form.
class Formula {
 public:
  enum class Variables { t, t_and_phase };
  /// Throws InputError when the text is no formula: what is wrong, and at which character.
  explicit Formula(const std::string& text, Variables variables = Variables::t);

  /// May be called from several threads.
  double value(double t, double phase = 0) const;

 private:
  struct Parsed;
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace pliant
