// All that is made of CGAL's templates is in this file.
#ifdef PLIANT_HAVE_CGAL
#include "remesh/remesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/check_mesh.hpp"

namespace pliant {
namespace {
namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// Pieces smaller than this part of the largest one are stray.
constexpr double stray = 0.01;

class Mender {
 public:
  Mender(SurfaceData data, const RemeshOptions& options) : data_(std::move(data)), options_(options) {}

  RemeshResult run() {
    // Some of CGAL's searches shuffle: the same input shall give the same bits.
    CGAL::get_default_random() = CGAL::Random(0);
    check();
    build();
    tell(pmp::stitch_borders(mesh_), "pairs of border edges were stitched");
    drop_stray_pieces();
    drop_flat_faces();
    fill_holes();
    untangle();
    orient();
    split_evenly();
    return {surface(), std::move(mended_)};
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(data_.source + ": " + what); }
  void tell(std::size_t count, const std::string& what) {
    if (count > 0) mended_.push_back(fmt::format("{} {}", count, what));
  }

  void check() const {
    if (!(options_.edge > 0) || !std::isfinite(options_.edge)) throw InputError("remesh: --edge must be positive");
    if (data_.faces.empty()) refuse("the surface has no faces");
    for (const Vec3 x : data_.positions)
      if (!std::isfinite(x.x + x.y + x.z)) refuse("a vertex is not finite; correct it");
    double area = 0;
    for (const Face& face : data_.faces)
      area += 0.5 * norm(cross(data_.positions[face[1]] - data_.positions[face[0]],
                               data_.positions[face[2]] - data_.positions[face[0]]));
    constexpr double most_faces = 1e7;
    if (const double n = area / (std::sqrt(0.1875) * options_.edge * options_.edge); !(n <= most_faces))
      refuse(fmt::format("--edge {} makes about {:.2g} faces, more than {:.0e}; give a longer edge", options_.edge, n,
                         most_faces));
  }

  void build() {
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> faces;
    for (const Vec3 x : data_.positions) points.emplace_back(x.x, x.y, x.z);
    for (const Face& face : data_.faces)
      faces.push_back(
          {static_cast<std::size_t>(face[0]), static_cast<std::size_t>(face[1]), static_cast<std::size_t>(face[2])});
    const auto count = [&](const char* what, auto&& change) {
      const auto n_points = points.size(), n_faces = faces.size();
      change();
      tell(n_points - std::min(n_points, points.size()), std::string("vertices ") + what);
      tell(n_faces - std::min(n_faces, faces.size()), std::string("faces ") + what);
    };
    count("without use were dropped", [&] { pmp::remove_isolated_points_in_polygon_soup(points, faces); });
    count("at the place of another were merged", [&] { pmp::merge_duplicate_points_in_polygon_soup(points, faces); });
    count("that are double, or name a vertex twice, were dropped", [&] { pmp::repair_polygon_soup(points, faces); });
    const auto before = faces;
    const auto n_points = points.size();
    pmp::orient_polygon_soup(points, faces);
    std::size_t turned = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto at = std::find(faces[f].begin(), faces[f].end(), before[f][0]) - faces[f].begin();
      turned += faces[f][(at + 1) % 3] != before[f][1] && points.size() == n_points;
    }
    tell(std::min(turned, faces.size() - turned), "faces were turned to the side of their neighbours");
    tell(points.size() - n_points, "vertices or edges that more than two faces share were taken apart");
    if (!pmp::is_polygon_soup_a_polygon_mesh(faces))
      refuse("the faces cannot be made a surface; clean the mesh by hand");
    pmp::polygon_soup_to_polygon_mesh(points, faces, mesh_);
  }

  void drop_stray_pieces() {
    auto piece = mesh_.add_property_map<Mesh::Face_index, std::size_t>("f:piece", 0).first;
    const auto n = pmp::connected_components(mesh_, piece);
    std::vector<double> area(n, 0.0);
    for (const auto f : mesh_.faces()) area[piece[f]] += pmp::face_area(f, mesh_);
    const double largest = *std::max_element(area.begin(), area.end());
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < n; ++i)
      if (area[i] >= stray * largest) kept.push_back(i);
    if (kept.size() < n) pmp::keep_connected_components(mesh_, kept, piece);
    tell(n - kept.size(), "stray pieces were dropped");
    mesh_.remove_property_map(piece);
  }

  void drop_flat_faces() {
    const auto before = CGAL::num_faces(mesh_);
    if (!pmp::remove_degenerate_faces(mesh_))
      refuse("it has faces without area that cannot be taken away; mend it by hand");
    mesh_.collect_garbage();
    tell(before - std::min<std::size_t>(before, CGAL::num_faces(mesh_)), "faces without area were taken away");
  }

  void fill_holes() {
    if (!options_.fill_holes) return;
    std::vector<Mesh::Halfedge_index> borders;
    pmp::extract_boundary_cycles(mesh_, std::back_inserter(borders));
    std::size_t filled = 0;
    for (const auto h : borders) {
      if (pmp::face_border_length(h, mesh_) > *options_.fill_holes) continue;
      std::vector<Mesh::Face_index> patch;
      pmp::triangulate_hole(mesh_, h, std::back_inserter(patch));
      if (patch.empty()) refuse("a hole cannot be filled; mend it by hand, or leave it open");
      ++filled;
    }
    tell(filled, "holes were filled");
  }

  void untangle() {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    pmp::self_intersections(mesh_, std::back_inserter(pairs));
    if (pairs.empty()) return;
    const double before = pmp::area(mesh_);
    pmp::experimental::remove_self_intersections(mesh_);
    mesh_.collect_garbage();
    refuse_crossings("that could not be taken away; cut the surface apart there by hand");
    tell(pairs.size(),
         fmt::format("crossings of the surface with itself were taken away; its area was {:.4g} and is {:.4g}", before,
                     pmp::area(mesh_)));
  }
  void refuse_crossings(const std::string& advice) const {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    pmp::self_intersections(mesh_, std::back_inserter(pairs));
    if (pairs.empty()) return;
    const auto face = pairs.front().first;
    const Point x = mesh_.point(mesh_.target(mesh_.halfedge(face)));
    refuse(fmt::format("the surface crosses itself in {} pairs of faces, the first at ({:.6g}, {:.6g}, {:.6g}), {}",
                       pairs.size(), x.x(), x.y(), x.z(), advice));
  }

  void orient() {
    if (!CGAL::is_closed(mesh_) || pmp::is_outward_oriented(mesh_)) return;
    pmp::reverse_face_orientations(mesh_);
    mended_.push_back("the normals, which pointed inward, were turned outward");
  }

  void split_evenly() {
    auto kept = mesh_.add_property_map<Mesh::Edge_index, bool>("e:kept", false).first;
    pmp::detect_sharp_edges(mesh_, options_.sharp_angle, kept);
    for (const auto e : mesh_.edges())
      if (mesh_.is_border(e)) kept[e] = true;
    pmp::isotropic_remeshing(mesh_.faces(), options_.edge, mesh_,
                             CGAL::parameters::number_of_iterations(options_.iterations)
                                 .number_of_relaxation_steps(3)
                                 .edge_is_constrained_map(kept));
    mesh_.collect_garbage();
    refuse_crossings("after remeshing: its parts come closer than an edge; give a shorter --edge");
  }

  Surface surface() const {
    SurfaceData made;
    made.source = data_.source + ", remeshed";
    for (const auto v : mesh_.vertices()) {
      const Point& x = mesh_.point(v);
      made.positions.push_back({x.x(), x.y(), x.z()});
    }
    for (const auto f : mesh_.faces()) {
      Face face;
      int k = 0;
      for (const auto v : CGAL::vertices_around_face(mesh_.halfedge(f), mesh_)) face[k++] = static_cast<int>(v.idx());
      made.faces.push_back(face);
    }
    return make_surface(std::move(made), Closure::any);
  }

  SurfaceData data_;
  RemeshOptions options_;
  Mesh mesh_;
  std::vector<std::string> mended_;
};
}  // namespace

RemeshResult remesh(SurfaceData data, const RemeshOptions& options) { return Mender(std::move(data), options).run(); }

}  // namespace pliant
#endif
