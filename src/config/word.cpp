#include "config/word.hpp"

namespace pliant {

template <>
Words<Axis> words_of<Axis>() {
  return {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};
}

template <>
Words<StretchingLaw> words_of<StretchingLaw>() {
  return {{"uniform", StretchingLaw::uniform}, {"tanh", StretchingLaw::tanh}, {"cluster", StretchingLaw::cluster}};
}

template <>
Words<InflowProfile> words_of<InflowProfile>() {
  return {{"uniform", InflowProfile::uniform}, {"parabolic", InflowProfile::parabolic}};
}

template <>
Words<PatchShape> words_of<PatchShape>() {
  return {{"disc", PatchShape::disc},
          {"annulus", PatchShape::annulus},
          {"rectangle", PatchShape::rectangle},
          {"outside", PatchShape::outside}};
}

template <>
Words<PatchProfile> words_of<PatchProfile>() {
  return {{"uniform", PatchProfile::uniform}, {"parabolic", PatchProfile::parabolic}};
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
Words<Sweeps> words_of<Sweeps>() {
  return {{"plain", Sweeps::plain}, {"fused", Sweeps::fused}};
}
template <>
Words<ViscousMode> words_of<ViscousMode>() {
  return {{"explicit", ViscousMode::explicit_rk3},
          {"implicit-z", ViscousMode::implicit_z},
          {"implicit", ViscousMode::implicit}};
}

template <>
Words<ValveLeaflet> words_of<ValveLeaflet>() {
  return {{"both", ValveLeaflet::both}, {"anterior", ValveLeaflet::anterior}, {"posterior", ValveLeaflet::posterior}};
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
  return {{"auto", TractionForm::automatic},    {"none", TractionForm::none},
          {"drag", TractionForm::drag},         {"one-sided", TractionForm::one_sided},
          {"gradient", TractionForm::gradient}, {"quadratic", TractionForm::quadratic}};
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
  return {{"fixed", MotionKind::fixed},
          {"prescribed", MotionKind::prescribed},
          {"rigid", MotionKind::rigid},
          {"hinge", MotionKind::hinge},
          {"deformable", MotionKind::deformable}};
}

template <>
Words<CouplingKind> words_of<CouplingKind>() {
  return {{"auto", CouplingKind::automatic},
          {"one-way", CouplingKind::one_way},
          {"loose", CouplingKind::loose},
          {"strong", CouplingKind::strong},
          {"force-spreading", CouplingKind::force_spreading},
          {"local-mass", CouplingKind::local_mass}};
}

template <>
Words<LoadSource> words_of<LoadSource>() {
  return {{"momentum-balance", LoadSource::momentum_balance}, {"probes", LoadSource::probes}};
}

template <>
Words<StrongScheme> words_of<StrongScheme>() {
  return {{"auto", StrongScheme::automatic},
          {"aitken", StrongScheme::aitken},
          {"quasi-newton", StrongScheme::quasi_newton},
          {"hamming", StrongScheme::hamming}};
}

template <>
Words<MembraneLaw> words_of<MembraneLaw>() {
  return {{"neo-hookean", MembraneLaw::neo_hookean}, {"skalak", MembraneLaw::skalak}};
}

template <>
Words<PlaneSide> words_of<PlaneSide>() {
  return {{"on", PlaneSide::on}, {"beyond", PlaneSide::beyond}};
}

template <>
Words<CordEnds> words_of<CordEnds>() {
  return {{"each", CordEnds::each}, {"middle", CordEnds::middle}};
}

template <>
Words<PartKind> words_of<PartKind>() {
  return {{"selection", PartKind::selection},
          {"tether", PartKind::tether},
          {"cord", PartKind::cord},
          {"pull", PartKind::pull}};
}

}  // namespace pliant
