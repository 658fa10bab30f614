#pragma once
#include <memory>
#include <string>

namespace pliant {

/// A formula of one variable t, in the language of muParser with the constant pi. Copies share the parsed form.
class Formula {
 public:
  /// Throws InputError when the text is no formula: what is wrong, and at which character.
  explicit Formula(const std::string& text);

  /// May be called from several threads.
  double value(double t) const;

 private:
  struct Parsed;
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace pliant
