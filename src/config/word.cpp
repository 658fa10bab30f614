#include "config/word.hpp"

namespace pliant {

template <>
Words<Axis> words_of<Axis>() {
  return {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};
}

template <>
Words<StretchingLaw> words_of<StretchingLaw>() {
  return {{"uniform", StretchingLaw::uniform}, {"tanh", StretchingLaw::tanh}};
}

template <>
Words<InflowProfile> words_of<InflowProfile>() {
  return {{"uniform", InflowProfile::uniform}, {"parabolic", InflowProfile::parabolic}};
}

template <>
Words<InitialFlow> words_of<InitialFlow>() {
  return {{"rest", InitialFlow::rest},
          {"uniform", InitialFlow::uniform},
          {"couette", InitialFlow::couette},
          {"poiseuille", InitialFlow::poiseuille},
          {"taylor-green", InitialFlow::taylor_green},
          {"perturbed", InitialFlow::perturbed}};
}

template <>
Words<ViscousMode> words_of<ViscousMode>() {
  return {{"explicit", ViscousMode::explicit_rk3},
          {"implicit-z", ViscousMode::implicit_z},
          {"implicit", ViscousMode::implicit}};
}

template <>
Words<CylinderEnds> words_of<CylinderEnds>() {
  return {{"capped", CylinderEnds::capped}, {"open", CylinderEnds::open}};
}

template <>
Words<OrientationKind> words_of<OrientationKind>() {
  return {{"given", OrientationKind::given}, {"random", OrientationKind::random}};
}

template <>
Words<TractionForm> words_of<TractionForm>() {
  return {{"none", TractionForm::none},
          {"drag", TractionForm::drag},
          {"one-sided", TractionForm::one_sided},
          {"gradient", TractionForm::gradient}};
}

template <>
Words<DragArea> words_of<DragArea>() {
  return {{"reference", DragArea::reference}, {"current", DragArea::current}};
}

template <>
Words<ReferenceAngle> words_of<ReferenceAngle>() {
  return {{"initial", ReferenceAngle::initial}, {"flat", ReferenceAngle::flat}};
}

template <>
Words<MotionKind> words_of<MotionKind>() {
  return {{"fixed", MotionKind::fixed}, {"deformable", MotionKind::deformable}};
}

template <>
Words<CouplingKind> words_of<CouplingKind>() {
  return {{"one-way", CouplingKind::one_way}};
}

}  // namespace pliant
