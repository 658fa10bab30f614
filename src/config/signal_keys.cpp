#include "config/key_table.hpp"

namespace pliant {
namespace {
using SignalKey = Key<SignalConfig>;

/// A text that is not given is empty, and stays out of the print-out.
template <class Text>
SignalKey text_key(KeyText text, Text SignalConfig::*member) {
  auto key = make_key<SignalConfig>(std::move(text), [member](auto& s) { return &(s.*member); });
  key.default_value = Json();
  key.get = [member](const SignalConfig& signal) {
    return (signal.*member).empty() ? Json() : ValueCodec<Text>::write(signal.*member);
  };
  return key;
}

SignalKey unit_key(const std::string& name, const std::string& doc, std::string SignalConfig::Units::*text) {
  auto key = make_key<SignalConfig>({"unit." + name, "", doc}, [text](auto& s) { return &(s.units.*text); });
  key.default_value = Json();
  key.legal = "a unit";
  key.get = [text](const SignalConfig& s) { return (s.units.*text).empty() ? Json() : Json(s.units.*text); };
  return key;
}
}  // namespace

std::vector<Key<SignalConfig>> signal_keys() {
  std::vector<SignalKey> keys;
  keys.push_back(instead_of(make_key<SignalConfig>({"table", "",
                                                    "[[t, v], ...], times growing; between them a monotone cubic, "
                                                    "before and after them the first and the last value"},
                                                   [](auto& s) { return &s.table; }),
                            {"csv", "formula"}));
  keys.push_back(instead_of(
      text_key({"csv", "", "a file with such a table: lines `t, v`; a header line and # comments are skipped"},
               &SignalConfig::csv),
      {"formula"}));
  keys.push_back(text_key({"formula", "",
                           "of t, such as `0.5*(1-cos(pi*t))`, and with a period of phase, the part of it that has "
                           "passed: arithmetic, `^`, comparisons, `a ? b : c`, pi, and sin, cos, tan, "
                           "asin, acos, atan, sinh, cosh, tanh, exp, ln, log10, sqrt, abs, sign, rint, min, max"},
                          &SignalConfig::formula));
  keys.push_back(make_key<SignalConfig>(
      {"period", "time", "a table is repeated with it; a formula gets t modulo it"}, [](auto& s) { return &s.period; },
      positive()));
  keys.push_back(make_key<SignalConfig>({"scale", "of the values",
                                         "factor on the values; a text such as \"80 mL/s\" gives "
                                         "them their unit"},
                                        [](auto& s) { return &s.scale; }));
  keys.push_back(
      make_key<SignalConfig>({"balance", "", "true: negative values are scaled so that the mean over the period is 0"},
                             [](auto& s) { return &s.balance; }));
  keys.push_back(
      instead_of(make_key<SignalConfig>(
                     {"volume", "volume",
                      "of a flow rate: all values are scaled so that the positive ones carry this in a period, the "
                      "stroke volume"},
                     [](auto& s) { return &s.volume; }, positive()),
                 {"scale"}));
  keys.push_back(unit_key("t", "of the times in the table, the file or the formula; default: the case's own",
                          &SignalConfig::Units::t));
  keys.push_back(
      unit_key("v", "of the values there, such as \"mL/s\"; default: the case's own", &SignalConfig::Units::v));
  return keys;
}

}  // namespace pliant
