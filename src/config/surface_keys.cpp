#include "config/key_table.hpp"

namespace pliant {
namespace {
using BodyKey = Key<BodyConfig>;
using SurfaceWord = std::pair<const char*, SurfaceSpec>;

std::vector<SurfaceWord> shapes() {
  return {{"sphere", SphereSurface{}},     {"ellipsoid", EllipsoidSurface{}},
          {"red-cell", RedCellSurface{}},  {"plate", PlateSurface{}},
          {"disc", DiscSurface{}},         {"half-disc", HalfDiscSurface{}},
          {"cylinder", CylinderSurface{}}, {"box", BoxSurface{}}};
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

constexpr auto round_shapes = "\"sphere\", \"red-cell\", \"disc\", \"half-disc\" or \"cylinder\"";

bool is_file(const BodyConfig& body) { return std::holds_alternative<FileSurface>(body.surface); }

/// surface.shape and surface.file choose the alternative, so they make it; the other keys only fill it in.
BodyKey shape_key() {
  BodyKey key;
  key.path = "surface.shape";
  key.doc =
      "a built-in surface about its origin: a geodesic sphere of 10 f^2 + 2 vertices, or one scaled to an ellipsoid or "
      "laid on a red blood cell; a "
      "box; a cylinder along z; or open ones in the x-y plane: a plate, a disc, or the half of a disc at x >= 0";
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
  key.excludes = {"surface.shape", "surface.frequency", "surface.radius", "surface.diameter", "surface.semi_axes",
                  "surface.size",  "surface.height",    "surface.edge",   "surface.ends"};
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
    auto* plate = std::get_if<PlateSurface>(&body.surface);
    if (!plate) return std::nullopt;
    if (!value.is_array() || value.size() != 2)
      return "must be an array of 2 numbers (x, y) for a plate, not " + describe_value(value);
    auto size = plate->size;
    for (std::size_t d = 0; d < 2; ++d)
      if (auto problem = ValueCodec<double>::read(value[d], size[d], positive()))
        return "component " + std::string(1, "xy"[d]) + " " + *problem;
    plate->size = size;
    return std::nullopt;
  };
  key.get = [](const BodyConfig& body) {
    if (const auto* box = std::get_if<BoxSurface>(&body.surface)) return ValueCodec<Vec3>::write(box->size);
    const auto* plate = std::get_if<PlateSurface>(&body.surface);
    return plate ? Json::array({plate->size[0], plate->size[1]}) : Json();
  };
  return only_when<BodyConfig>(std::move(key), "surface.shape is \"plate\" or \"box\"", [](const BodyConfig& body) {
    return std::holds_alternative<PlateSurface>(body.surface) || std::holds_alternative<BoxSurface>(body.surface);
  });
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
  return std::holds_alternative<PlateSurface>(surface) || std::holds_alternative<DiscSurface>(surface) ||
         std::holds_alternative<HalfDiscSurface>(surface);
}

void add_surface_keys(std::vector<Key<BodyConfig>>& keys) {
  keys.push_back(shape_key());
  keys.push_back(surface_key({"surface.frequency", "", "each edge of the icosahedron is cut in so many parts"},
                             "\"sphere\", \"ellipsoid\" or \"red-cell\"", frequency_of, SphereSurface{}.frequency,
                             between(1, 1000)));
  keys.push_back(surface_key({"surface.radius", "length", "of the sphere, cell, disc or cylinder"}, round_shapes,
                             radius_of, SphereSurface{}.radius, positive()));
  keys.push_back(diameter_key());
  keys.push_back(surface_key({"surface.semi_axes", "length", "along x, y and z"}, "\"ellipsoid\"", axes_of,
                             EllipsoidSurface{}.semi_axes, positive()));
  keys.push_back(size_key());
  keys.push_back(surface_key({"surface.height", "length", "along z"}, "\"cylinder\"", height_of,
                             CylinderSurface{}.height, positive()));
  keys.push_back(surface_key({"surface.ends", "", "a cylinder is closed by caps, or an open tube"}, "\"cylinder\"",
                             ends_of, CylinderSurface{}.ends));
  keys.push_back(surface_key({"surface.edge", "length", "about how long the edges of the faces are"},
                             "\"plate\", \"disc\", \"half-disc\", \"cylinder\" or \"box\"", edge_of,
                             PlateSurface{}.edge, positive()));
  keys.push_back(file_key());
  auto scale = make_key<BodyConfig>(
      {"surface.scale", "length", "factor on the coordinates in the file: what is 1 there, such as \"1 mm\""}, scale_of,
      positive());
  scale.default_value = FileSurface{}.scale;
  keys.push_back(only_when<BodyConfig>(std::move(scale), "surface.file is given", is_file));
  keys.push_back(open_key());
}

}  // namespace pliant
