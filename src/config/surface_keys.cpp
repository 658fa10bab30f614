#include "config/key_table.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;
using SurfaceWord = std::pair<const char*, SurfaceSpec>;

std::vector<SurfaceWord> shapes() {
  return {{"sphere", SphereSurface{}},
          {"ellipsoid", EllipsoidSurface{}},
          {"red-cell", RedCellSurface{}},
          {"plate", PlateSurface{}},
          {"disc", DiscSurface{}},
          {"half-disc", HalfDiscSurface{}},
          {"cylinder", CylinderSurface{}},
          {"box", BoxSurface{}},
          {"channel", ChannelSurface{}},
          {"plate-with-holes", PlateWithHolesSurface{}},
          {"ventricle", VentricleSurface{}},
          {"mechanical-leaflet", MechanicalLeafletSurface{}},
          {"natural-valve", NaturalValveSurface{}}};
}

std::string known_shapes() {
  std::string text;
  for (const auto& [word, fresh] : shapes()) text += (text.empty() ? "\"" : ", \"") + std::string(word) + "\"";
  return text;
}

/// For a member that only some surfaces have, a function from a body to the member, or to null.
template <class Value, class Get>
constexpr auto where_present(Get get) {
  return [get](auto& body) {
    using Member = std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(body)>>, const Value, Value>;
    return std::visit(
        [get](auto& surface) -> Member* {
          if constexpr (std::is_invocable_v<Get, decltype(surface)>) return get(surface);
          else return nullptr;
        },
        body.surface);
  };
}

/// A key of those surfaces that have the member; `which` names them.
template <class Access, class Value>
BodyKey surface_key(KeyText text, const std::string& which, Access access, Value default_value, Limits limits = {}) {
  auto key = make_key<BodyConfig>(std::move(text), access, limits);
  key.default_value = ValueCodec<Value>::write(default_value);
  return only_when<BodyConfig>(std::move(key), "surface.shape is " + which,
                               [access](const BodyConfig& body) { return access(body) != nullptr; });
}

constexpr auto frequency_of = where_present<int>([](auto& s) -> decltype(&s.frequency) { return &s.frequency; });
constexpr auto radius_of = where_present<double>([](auto& s) -> decltype(&s.radius) { return &s.radius; });
constexpr auto edge_of = where_present<double>([](auto& s) -> decltype(&s.edge) { return &s.edge; });
constexpr auto height_of = where_present<double>([](auto& s) -> decltype(&s.height) { return &s.height; });
constexpr auto ends_of = where_present<CylinderEnds>([](auto& s) -> decltype(&s.ends) { return &s.ends; });
constexpr auto axes_of = where_present<Vec3>([](auto& s) -> decltype(&s.semi_axes) { return &s.semi_axes; });
constexpr auto scale_of = where_present<double>([](auto& s) -> decltype(&s.scale) { return &s.scale; });
constexpr auto holes_of =
    where_present<std::vector<std::array<double, 3>>>([](auto& s) -> decltype(&s.holes) { return &s.holes; });
constexpr auto hole_edge_of = where_present<double>([](auto& s) -> decltype(&s.hole_edge) { return &s.hole_edge; });
constexpr auto apex_edge_of = where_present<double>([](auto& s) -> decltype(&s.apex_edge) { return &s.apex_edge; });
constexpr auto hinge_offset_of =
    where_present<double>([](auto& s) -> decltype(&s.hinge_offset) { return &s.hinge_offset; });
constexpr auto clearance_of = where_present<double>([](auto& s) -> decltype(&s.clearance) { return &s.clearance; });
constexpr auto closed_angle_of =
    where_present<double>([](auto& s) -> decltype(&s.closed_angle) { return &s.closed_angle; });
constexpr auto opening_of = where_present<double>([](auto& s) -> decltype(&s.opening) { return &s.opening; });
constexpr auto free_edge_of = where_present<double>([](auto& s) -> decltype(&s.free_edge) { return &s.free_edge; });
constexpr auto commissure_of = where_present<double>([](auto& s) -> decltype(&s.commissure) { return &s.commissure; });
constexpr auto posterior_length_of =
    where_present<double>([](auto& s) -> decltype(&s.posterior_length) { return &s.posterior_length; });
constexpr auto leaflet_of = where_present<ValveLeaflet>([](auto& s) -> decltype(&s.leaflet) { return &s.leaflet; });

constexpr auto round_shapes =
    "\"sphere\", \"red-cell\", \"disc\", \"half-disc\", \"cylinder\", \"channel\", \"ventricle\", "
    "\"mechanical-leaflet\" or \"natural-valve\"";

bool is_file(const BodyConfig& body) { return std::holds_alternative<FileSurface>(body.surface); }

/// surface.shape and surface.file choose the alternative, so they make it; the other keys only fill it in.
BodyKey shape_key() {
  BodyKey key;
  key.path = "surface.shape";
  key.doc =
      "a built-in surface about its origin: a geodesic sphere of 10 f^2 + 2 vertices, or one scaled to an ellipsoid or "
      "laid on a red blood cell; a "
      "box; a cylinder along z; open ones in the x-y plane: a plate, a disc, the half of a disc at x >= 0, a plate "
      "with "
      "round holes; or parts of a heart: a channel, a ventricle, a leaflet of a mechanical valve, the leaflets of a "
      "natural one (docs/geometry.md)";
  key.type = "word";
  key.legal = known_shapes();
  key.set = [](BodyConfig& body, const Json& value) -> std::optional<std::string> {
    if (!value.is_string()) return "must be a word, not " + describe_value(value);
    for (const auto& [word, fresh] : shapes())
      if (value == word) return body.surface = fresh, std::nullopt;
    return unknown_word(value.get<std::string>(), known_shapes());
  };
  key.get = [](const BodyConfig& body) {
    for (const auto& [word, fresh] : shapes())
      if (fresh.index() == body.surface.index()) return Json(word);
    return Json();
  };
  return key;
}

BodyKey file_key() {
  using Codec = ValueCodec<std::filesystem::path>;
  BodyKey key;
  key.path = "surface.file";
  key.doc = "a triangle mesh read from a file (GTS, STL, OBJ or PLY)";
  key.type = Codec::type_name();
  key.legal = Codec::legal({});
  key.excludes = {"surface.shape",        "surface.frequency",  "surface.radius",           "surface.diameter",
                  "surface.semi_axes",    "surface.size",       "surface.height",           "surface.edge",
                  "surface.ends",         "surface.holes",      "surface.hole_edge",        "surface.apex_edge",
                  "surface.hinge_offset", "surface.clearance",  "surface.closed_angle",     "surface.opening",
                  "surface.free_edge",    "surface.commissure", "surface.posterior_length", "surface.leaflet"};
  key.set = [](BodyConfig& body, const Json& value) {
    FileSurface surface;
    auto problem = Codec::read(value, surface.file, {});
    if (!problem) body.surface = surface;
    return problem;
  };
  key.get = [](const BodyConfig& body) {
    const auto* surface = std::get_if<FileSurface>(&body.surface);
    return surface ? Json(surface->file.string()) : Json();
  };
  return key;
}

BodyKey diameter_key() {
  BodyKey key;
  key.path = "surface.diameter";
  key.unit = "length";
  key.doc = "another way to give the radius";
  key.type = "number";
  key.legal = describe(positive());
  key.excludes = {"surface.radius"};
  key.set = [](BodyConfig& body, const Json& value) {
    double diameter = 0;
    auto problem = ValueCodec<double>::read(value, diameter, positive());
    double* radius = radius_of(body);
    if (!problem && radius) *radius = diameter / 2;
    return problem;
  };
  key.get = [](const BodyConfig&) { return Json(); };
  return only_when<BodyConfig>(std::move(key), std::string("surface.shape is ") + round_shapes,
                               [](const BodyConfig& body) { return radius_of(body) != nullptr; });
}

/// The size of a plate, with or without holes; null for other shapes.
template <class Surface>
auto plate_size(Surface& surface) -> decltype(&std::get_if<PlateSurface>(&surface)->size) {
  if (auto* plate = std::get_if<PlateSurface>(&surface)) return &plate->size;
  if (auto* plate = std::get_if<PlateWithHolesSurface>(&surface)) return &plate->size;
  return nullptr;
}

/// Two numbers for a plate, three for a box.
BodyKey size_key() {
  BodyKey key;
  key.path = "surface.size";
  key.unit = "length";
  key.doc = "of a plate along x and y, of a box along x, y and z; default: 1 each";
  key.type = "2 or 3 numbers";
  key.legal = "each " + describe(positive());
  key.set = [](BodyConfig& body, const Json& value) -> std::optional<std::string> {
    if (auto* box = std::get_if<BoxSurface>(&body.surface)) return ValueCodec<Vec3>::read(value, box->size, positive());
    auto* size_of_plate = plate_size(body.surface);
    if (!size_of_plate) return std::nullopt;
    if (!value.is_array() || value.size() != 2)
      return "must be an array of 2 numbers (x, y) for a plate, not " + describe_value(value);
    auto size = *size_of_plate;
    for (std::size_t d = 0; d < 2; ++d)
      if (auto problem = ValueCodec<double>::read(value[d], size[d], positive()))
        return "component " + std::string(1, "xy"[d]) + " " + *problem;
    *size_of_plate = size;
    return std::nullopt;
  };
  key.get = [](const BodyConfig& body) {
    if (const auto* box = std::get_if<BoxSurface>(&body.surface)) return ValueCodec<Vec3>::write(box->size);
    const auto* size = plate_size(body.surface);
    return size ? Json::array({(*size)[0], (*size)[1]}) : Json();
  };
  return only_when<BodyConfig>(std::move(key), "surface.shape is \"plate\", \"plate-with-holes\" or \"box\"",
                               [](const BodyConfig& body) {
                                 return plate_size(body.surface) || std::holds_alternative<BoxSurface>(body.surface);
                               });
}

BodyKey holes_key() {
  BodyKey key;
  key.path = "surface.holes";
  key.unit = "length";
  key.doc = "round holes, [[x, y, radius], ...]";
  key.type = "list of 3 numbers";
  key.legal = "each radius " + describe(positive());
  key.set = [](BodyConfig& body, const Json& value) -> std::optional<std::string> {
    auto* holes = holes_of(body);
    if (!holes) return std::nullopt;
    if (!value.is_array()) return "must be a list [[x, y, radius], ...], not " + describe_value(value);
    std::vector<std::array<double, 3>> result(value.size());
    for (std::size_t n = 0; n < result.size(); ++n) {
      const auto which = "hole " + std::to_string(n + 1) + " ";
      if (!value[n].is_array() || value[n].size() != 3)
        return which + "must be 3 numbers [x, y, radius], not " + describe_value(value[n]);
      for (std::size_t d = 0; d < 3; ++d)
        if (auto problem = ValueCodec<double>::read(value[n][d], result[n][d], d == 2 ? positive() : Limits{}))
          return which + std::array{"x ", "y ", "radius "}[d] + *problem;
    }
    *holes = std::move(result);
    return std::nullopt;
  };
  key.get = [](const BodyConfig& body) {
    const auto* holes = holes_of(body);
    if (!holes || holes->empty()) return Json();
    auto list = Json::array();
    for (const auto& [x, y, radius] : *holes) list.push_back(Json::array({x, y, radius}));
    return list;
  };
  return only_when<BodyConfig>(std::move(key), "surface.shape is \"plate-with-holes\"",
                               [](const BodyConfig& body) { return holes_of(body) != nullptr; });
}

void add_heart_keys(std::vector<BodyKey>& keys) {
  const auto add = [&](const char* name, const char* unit, const std::string& doc, const char* shape,
                       const auto& access, auto fallback, Limits limits = {}) {
    keys.push_back(surface_key({std::string("surface.") + name, unit, doc}, std::string("\"") + shape + "\"", access,
                               fallback, limits));
  };
  add("hole_edge", "length", "of the edges at the holes, from where they grow by a quarter of the distance; 0: as edge",
      "plate-with-holes", hole_edge_of, PlateWithHolesSurface{}.hole_edge, at_least(0));
  add("apex_edge", "length", "of the edges at the apex, changing with the height to edge at the rim; 0: as edge",
      "ventricle", apex_edge_of, VentricleSurface{}.apex_edge, at_least(0));
  const MechanicalLeafletSurface mechanical;
  add("hinge_offset", "diameters",
      "of the hinge axis, the surface's y axis, from the channel's axis, which is at x < 0", "mechanical-leaflet",
      hinge_offset_of, mechanical.hinge_offset, positive());
  add("clearance", "diameters", "left to the channel's wall at all angles, and to the other leaflet when closed",
      "mechanical-leaflet", clearance_of, mechanical.clearance, at_least(0));
  add("closed_angle", "degrees", "from the annulus's plane at which the leaflet fills its half of the channel",
      "mechanical-leaflet", closed_angle_of, mechanical.closed_angle, between(0, 80));
  const NaturalValveSurface natural;
  const auto valve = "natural-valve";
  add("leaflet", "", "one of the two leaflets, or both as one surface", valve, leaflet_of, natural.leaflet);
  add("opening", "diameters", "between the middles of the free edges at rest, along x", valve, opening_of,
      natural.opening, at_least(0));
  add("free_edge", "diameters", "length of the two free edges together", valve, free_edge_of, natural.free_edge,
      positive());
  add("commissure", "diameters", "how far below the annulus the leaflets part", valve, commissure_of,
      natural.commissure, positive());
  add("posterior_length", "diameters", "of the posterior leaflet in its middle; the anterior one follows", valve,
      posterior_length_of, natural.posterior_length, positive());
}

BodyKey open_key() {
  BodyKey key;
  key.path = "surface.open";
  key.doc = "true: the mesh of the file has borders; false: it must be closed";
  key.type = "true or false";
  key.default_value = FileSurface{}.open;
  key.set = [](BodyConfig& body, const Json& value) -> std::optional<std::string> {
    if (!value.is_boolean()) return "must be true or false, not " + describe_value(value);
    if (auto* surface = std::get_if<FileSurface>(&body.surface)) surface->open = value.get<bool>();
    return std::nullopt;
  };
  key.get = [](const BodyConfig& body) {
    const auto* surface = std::get_if<FileSurface>(&body.surface);
    return surface ? Json(surface->open) : Json();
  };
  return only_when<BodyConfig>(std::move(key), "surface.file is given", is_file);
}
}  // namespace

bool is_open_surface(const SurfaceSpec& surface) {
  if (const auto* file = std::get_if<FileSurface>(&surface)) return file->open;
  if (const auto* cylinder = std::get_if<CylinderSurface>(&surface)) return cylinder->ends == CylinderEnds::open;
  return !std::holds_alternative<SphereSurface>(surface) && !std::holds_alternative<EllipsoidSurface>(surface) &&
         !std::holds_alternative<RedCellSurface>(surface) && !std::holds_alternative<BoxSurface>(surface);
}

std::vector<std::string> selections_of_shape(const SurfaceSpec& surface) {
  if (std::holds_alternative<ChannelSurface>(surface)) return {"lower-rim", "upper-rim"};
  if (std::holds_alternative<VentricleSurface>(surface)) return {"rim", "apex"};
  if (std::holds_alternative<MechanicalLeafletSurface>(surface)) return {"hinge-axis", "straight-edge", "arc"};
  if (const auto* plate = std::get_if<PlateWithHolesSurface>(&surface)) {
    std::vector<std::string> names{"border", "holes"};
    for (std::size_t i = 1; i <= plate->holes.size(); ++i) names.push_back("hole-" + std::to_string(i));
    return names;
  }
  if (const auto* valve = std::get_if<NaturalValveSurface>(&surface)) {
    std::vector<std::string> names{"annulus", "free-edge", "commissure"};
    if (valve->leaflet != ValveLeaflet::posterior) names.push_back("anterior-edge");
    if (valve->leaflet != ValveLeaflet::anterior) names.push_back("posterior-edge");
    return names;
  }
  return {};
}

void add_surface_keys(std::vector<Key<BodyConfig>>& keys) {
  keys.push_back(shape_key());
  keys.push_back(surface_key({"surface.frequency", "", "each edge of the icosahedron is cut in so many parts"},
                             "\"sphere\", \"ellipsoid\" or \"red-cell\"", frequency_of, SphereSurface{}.frequency,
                             between(1, 1000)));
  keys.push_back(
      surface_key({"surface.radius", "length", "of the sphere, cell, disc, cylinder, rim, channel or annulus"},
                  round_shapes, radius_of, SphereSurface{}.radius, positive()));
  keys.push_back(diameter_key());
  keys.push_back(surface_key({"surface.semi_axes", "length", "along x, y and z"}, "\"ellipsoid\"", axes_of,
                             EllipsoidSurface{}.semi_axes, positive()));
  keys.push_back(size_key());
  keys.push_back(surface_key({"surface.height", "length", "along z"}, "\"cylinder\", \"channel\" or \"ventricle\"",
                             height_of, CylinderSurface{}.height, positive()));
  keys.push_back(surface_key({"surface.ends", "", "a cylinder is closed by caps, or an open tube"}, "\"cylinder\"",
                             ends_of, CylinderSurface{}.ends));
  keys.push_back(
      surface_key({"surface.edge", "length", "about how long the edges of the faces are"},
                  "\"plate\", \"disc\", \"half-disc\", \"cylinder\", \"box\", \"channel\", \"plate-with-holes\", "
                  "\"ventricle\", \"mechanical-leaflet\" or \"natural-valve\"",
                  edge_of, PlateSurface{}.edge, positive()));
  keys.push_back(holes_key());
  add_heart_keys(keys);
  keys.push_back(file_key());
  auto scale = make_key<BodyConfig>(
      {"surface.scale", "length", "factor on the coordinates in the file: what is 1 there, such as \"1 mm\""}, scale_of,
      positive());
  scale.default_value = FileSurface{}.scale;
  keys.push_back(only_when<BodyConfig>(std::move(scale), "surface.file is given", is_file));
  keys.push_back(open_key());
}

}  // namespace pliant
