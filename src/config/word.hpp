#pragma once
#include <string>
#include <utility>
#include <vector>

#include "config/case_config.hpp"

namespace pliant {

/// The words of the case file for the values of an enumeration, in the order of the docs.
template <class E>
using Words = std::vector<std::pair<std::string, E>>;

template <class E>
Words<E> words_of();

template <>
Words<Axis> words_of<Axis>();
template <>
Words<StretchingLaw> words_of<StretchingLaw>();
template <>
Words<InflowProfile> words_of<InflowProfile>();
template <>
Words<PatchShape> words_of<PatchShape>();
template <>
Words<PatchProfile> words_of<PatchProfile>();
template <>
Words<InitialFlow> words_of<InitialFlow>();
template <>
Words<ViscousMode> words_of<ViscousMode>();
template <>
Words<Sweeps> words_of<Sweeps>();
template <>
Words<ValveLeaflet> words_of<ValveLeaflet>();
template <>
Words<CylinderEnds> words_of<CylinderEnds>();
template <>
Words<OrientationKind> words_of<OrientationKind>();
template <>
Words<TractionForm> words_of<TractionForm>();
template <>
Words<DragArea> words_of<DragArea>();
template <>
Words<ReferenceAngle> words_of<ReferenceAngle>();
template <>
Words<MotionKind> words_of<MotionKind>();
template <>
Words<CouplingKind> words_of<CouplingKind>();
template <>
Words<LoadSource> words_of<LoadSource>();
template <>
Words<StrongScheme> words_of<StrongScheme>();
template <>
Words<MembraneLaw> words_of<MembraneLaw>();
template <>
Words<PlaneSide> words_of<PlaneSide>();
template <>
Words<CordEnds> words_of<CordEnds>();
template <>
Words<PartKind> words_of<PartKind>();

/// The word for a value.
template <class E>
std::string word_for(E value) {
  for (const auto& [word, meaning] : words_of<E>()) {
    if (meaning == value) return word;
  }
  return {};
}

/// `"a", "b", "c"`.
template <class E>
std::string quoted_list(const Words<E>& words) {
  std::string text;
  for (const auto& entry : words) text += (text.empty() ? "\"" : ", \"") + entry.first + "\"";
  return text;
}

inline std::string unknown_word(const std::string& word, const std::string& known) {
  return "has the unknown value \"" + word + "\"; known: " + known;
}

}  // namespace pliant
