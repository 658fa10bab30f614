#include "mesh/read_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/error.hpp"
#include "mesh/formats/gts.hpp"
#include "mesh/formats/obj.hpp"
#include "mesh/formats/ply.hpp"
#include "mesh/formats/stl.hpp"

namespace pliant {
namespace {

struct Format {
  const char* extension;
  SurfaceData (*read)(std::istream&, const std::string&);
  void (*write)(std::ostream&, const Surface&);
};
void write_text_ply(std::ostream& output, const Surface& surface) { write_ply(output, surface, PlyEncoding::ascii); }

constexpr Format formats[] = {{".gts", read_gts, write_gts},
                              {".stl", read_stl, write_stl},
                              {".obj", read_obj, write_obj},
                              {".ply", read_ply, write_text_ply}};

const Format& format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const Format& format : formats)
    if (extension == format.extension) return format;
  throw InputError(fmt::format("{}: unknown surface format '{}'; known extensions: .gts, .stl, .obj, .ply",
                               path.string(), extension));
}

std::string last_error() { return std::strerror(errno); }

}  // namespace

SurfaceData read_surface_data(const std::filesystem::path& path) {
  const Format& format = format_of(path);
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(fmt::format("{}: this is a folder; give the file of the surface", path.string()));
  errno = 0;
  std::ifstream input(path, std::ios::binary);
  if (!input)
    throw InputError(fmt::format("{}: the surface cannot be opened ({}); check the path", path.string(), last_error()));
  return format.read(input, path.string());
}

Surface read_surface(const std::filesystem::path& path, Closure closure) {
  return make_surface(read_surface_data(path), closure);
}

void write_surface(const std::filesystem::path& path, const Surface& surface) {
  const Format& format = format_of(path);
  const std::filesystem::path temporary = path.string() + ".tmp";
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw RunError(fmt::format("{}: the surface cannot be written ({})", path.string(), why));
  };
  errno = 0;
  std::ofstream output(temporary, std::ios::binary);
  if (!output) fail(last_error());
  format.write(output, surface);
  output.close();
  if (!output) fail(last_error());
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) fail(error.message());
}

}  // namespace pliant
