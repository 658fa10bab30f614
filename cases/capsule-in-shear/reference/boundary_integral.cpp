// A capsule in unbounded plane shear flow without inertia, equal viscosities, by a boundary integral:
//
//   u(x) = (z, 0, 0) + 1/(8 pi mu) * integral over the surface of (I/r + r r / r^3) f,
//
// f the force of the membrane a present area, linear on flat faces: forces at vertices over the thirds of the faces
// around them. Faces at the point itself are integrated in polar coordinates about it, near ones in parts, all by Gauss
// points. Vertices move with u (midpoint rule); once a step the volume is restored by scaling about the centroid of a
// symmetric shape, 0. Units: radius, shear rate and viscosity are 1. It shares no code with Pliant, which it is there
// to judge.
//
//   boundary_integral MESH.obj neo-hookean|springs CA_G END STEP FRAMES    writes the positions of FRAMES + 1 moments,
//   as doubles
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {
struct Vec {
  double x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double norm(Vec a) { return std::sqrt(dot(a, a)); }

using Positions = std::vector<Vec>;
using Face = std::array<int, 3>;

struct Surface {
  Positions points;
  std::vector<Face> faces;
};

Surface read_surface(const char* file) {
  Surface surface;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec p;
      words >> p.x >> p.y >> p.z;
      surface.points.push_back(p);
    } else if (kind == "f") {
      Face face;
      for (int& v : face) {
        words >> kind;
        v = std::atoi(kind.c_str()) - 1;
      }
      surface.faces.push_back(face);
    }
  }
  return surface;
}

double volume(const Positions& x, const std::vector<Face>& faces) {
  double v = 0;
  for (const Face& t : faces) v += dot(x[t[0]], cross(x[t[1]], x[t[2]])) / 6;
  return v;
}

class Membrane {
 public:
  Membrane(const Surface& rest, bool springs, double shear) : faces_(rest.faces), springs_(springs), shear_(shear) {
    for (const Face& t : faces_) {
      const Vec s = rest.points[t[1]] - rest.points[t[0]], r = rest.points[t[2]] - rest.points[t[0]];
      const double a = norm(s), height = norm(cross(s, r)) / a;
      rest_.push_back({a, dot(s, r) / a, height, a * height / 2});
      for (int k = 0; k < 3; ++k) {
        const int p = std::min(t[k], t[(k + 1) % 3]), q = std::max(t[k], t[(k + 1) % 3]);
        edges_[{p, q}] = norm(rest.points[p] - rest.points[q]);
      }
    }
  }

  Positions forces(const Positions& x) const {
    Positions f(x.size());
    springs_ ? add_springs(x, f) : add_rubber(x, f);
    return f;
  }

 private:
  // Equal springs k (l - l0)^2 / 2 with G = sqrt(3) k / 4.
  void add_springs(const Positions& x, Positions& f) const {
    for (const auto& [ends, length0] : edges_) {
      const Vec d = x[ends.second] - x[ends.first];
      const double length = norm(d);
      const Vec pull = (4 / std::sqrt(3.0) * shear_ * (length - length0) / length) * d;
      f[ends.first] = f[ends.first] + pull;
      f[ends.second] = f[ends.second] - pull;
    }
  }

  // W = G/2 (tr C + 1/det C - 3) a rest area: second stress G (1 - C^-1 / det C).
  void add_rubber(const Positions& x, Positions& f) const {
    for (std::size_t n = 0; n < faces_.size(); ++n) {
      const auto [a, b, height, area] = rest_[n];
      const Face& t = faces_[n];
      const Vec s = x[t[1]] - x[t[0]], r = x[t[2]] - x[t[0]];
      const Vec g1 = (1 / a) * s, g2 = (1 / height) * (r - (b / a) * s);
      const double c11 = dot(g1, g1), c12 = dot(g1, g2), c22 = dot(g2, g2), det = c11 * c22 - c12 * c12;
      const double s11 = shear_ * (1 - c22 / det / det), s22 = shear_ * (1 - c11 / det / det),
                   s12 = shear_ * c12 / det / det;
      const Vec p1 = s11 * g1 + s12 * g2, p2 = s12 * g1 + s22 * g2;
      const Vec second = (-area) * ((1 / a) * p1 - (b / a / height) * p2), third = (-area / height) * p2;
      f[t[1]] = f[t[1]] + second;
      f[t[2]] = f[t[2]] + third;
      f[t[0]] = f[t[0]] - (second + third);
    }
  }

  const std::vector<Face>& faces_;
  bool springs_;
  double shear_;
  std::vector<std::array<double, 4>> rest_;  // first side, second side along and across it, area
  std::map<std::pair<int, int>, double> edges_;
};

struct GaussPoint {
  std::array<double, 3> at;
  double weight;
};
constexpr double p1 = 0.0597158717898, q1 = 0.4701420641051, w1 = 0.1323941527885;
constexpr double p2 = 0.7974269853531, q2 = 0.1012865073235, w2 = 0.1259391805448;
const GaussPoint three[] = {
    {{2 / 3., 1 / 6., 1 / 6.}, 1 / 3.}, {{1 / 6., 2 / 3., 1 / 6.}, 1 / 3.}, {{1 / 6., 1 / 6., 2 / 3.}, 1 / 3.}};
const GaussPoint seven[] = {{{1 / 3., 1 / 3., 1 / 3.}, 0.225},
                            {{p1, q1, q1}, w1},
                            {{q1, p1, q1}, w1},
                            {{q1, q1, p1}, w1},
                            {{p2, q2, q2}, w2},
                            {{q2, p2, q2}, w2},
                            {{q2, q2, p2}, w2}};
const double line_at[] = {0.0469100770307, 0.2307653449472, 0.5, 0.7692346550528, 0.9530899229693};
const double line_weight[] = {0.1184634425281, 0.2393143352497, 0.2844444444444, 0.2393143352497, 0.1184634425281};

struct Corners {
  std::array<Vec, 3> x, f;
};

Vec stokeslet(Vec d, Vec f) {
  const double inverse = 1 / norm(d);
  return inverse * (f + (dot(f, d) * inverse * inverse) * d);
}

Vec by_points(Vec x, const Corners& c, double area, const GaussPoint* points, int n) {
  Vec sum;
  for (int k = 0; k < n; ++k) {
    const auto& a = points[k].at;
    sum = sum + points[k].weight * stokeslet(x - (a[0] * c.x[0] + a[1] * c.x[1] + a[2] * c.x[2]),
                                             a[0] * c.f[0] + a[1] * c.f[1] + a[2] * c.f[2]);
  }
  return area * sum;
}

// Seven points on each of 4^depth parts.
Vec by_parts(Vec x, const Corners& c, double area, int depth) {
  if (depth == 0) return by_points(x, c, area, seven, 7);
  Corners m;
  for (int k = 0; k < 3; ++k) {
    m.x[k] = 0.5 * (c.x[(k + 1) % 3] + c.x[(k + 2) % 3]);
    m.f[k] = 0.5 * (c.f[(k + 1) % 3] + c.f[(k + 2) % 3]);
  }
  Vec sum = by_parts(x, m, area / 4, depth - 1);
  for (int k = 0; k < 3; ++k) {
    Corners part = m;
    part.x[k] = c.x[k];
    part.f[k] = c.f[k];
    sum = sum + by_parts(x, part, area / 4, depth - 1);
  }
  return sum;
}

// The point is corner 0: with y = x0 + r e, dS = 2 area r dr dm, the factor r cancels and e runs along the far side.
Vec about_corner(const Corners& c, double area) {
  Vec sum;
  for (int k = 0; k < 5; ++k) {
    const double m = line_at[k];
    const Vec e = (1 - m) * (c.x[1] - c.x[0]) + m * (c.x[2] - c.x[0]), far = (1 - m) * c.f[1] + m * c.f[2];
    sum = sum + line_weight[k] * stokeslet(e, 0.5 * (c.f[0] + far));
  }
  return 2 * area * sum;
}

Positions velocity(const Membrane& membrane, const std::vector<Face>& faces, const Positions& x) {
  Positions f = membrane.forces(x), u(x.size());
  std::vector<double> area(faces.size()), around(x.size(), 0.0);
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Face& t = faces[n];
    area[n] = norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 2;
    for (int v : t) around[v] += area[n] / 3;
  }
  for (std::size_t i = 0; i < x.size(); ++i) f[i] = (1 / around[i]) * f[i];
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const Face& t = faces[n];
    const Corners c{{x[t[0]], x[t[1]], x[t[2]]}, {f[t[0]], f[t[1]], f[t[2]]}};
    const Vec middle = (1 / 3.0) * (c.x[0] + c.x[1] + c.x[2]);
    double side = 0;
    for (int k = 0; k < 3; ++k) side = std::max(side, norm(c.x[k] - c.x[(k + 1) % 3]));
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec d = x[i] - middle;
      const double distance = dot(d, d) / (side * side);
      int own = -1;
      if (distance < 1)
        for (int k = 0; k < 3; ++k)
          if (t[k] == int(i)) own = k;
      if (own >= 0) {
        const int a = (own + 1) % 3, b = (own + 2) % 3;
        u[i] = u[i] + about_corner({{c.x[own], c.x[a], c.x[b]}, {c.f[own], c.f[a], c.f[b]}}, area[n]);
      } else {
        u[i] = u[i] + (distance > 6 ? by_points(x[i], c, area[n], three, 3)
                                    : by_parts(x[i], c, area[n], distance > 2 ? 0 : 2));
      }
    }
  }
  for (std::size_t i = 0; i < x.size(); ++i) u[i] = Vec{x[i].z, 0, 0} + (1 / (8 * M_PI)) * u[i];
  return u;
}
}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) return std::fputs("MESH.obj neo-hookean|springs CA_G END STEP FRAMES\n", stderr), 2;
  const Surface rest = read_surface(argv[1]);
  const Membrane membrane(rest, !std::strcmp(argv[2], "springs"), 1 / std::atof(argv[3]));
  const double end = std::atof(argv[4]);
  const int frames = std::atoi(argv[6]), between = int(std::ceil(end / std::atof(argv[5]) / frames));
  const double step = end / frames / between, volume0 = volume(rest.points, rest.faces);
  Positions x = rest.points, middle(x.size());
  for (int n = 0; n <= frames * between; ++n) {
    if (n % between == 0) std::fwrite(x.data(), sizeof(Vec), x.size(), stdout);
    Positions u = velocity(membrane, rest.faces, x);
    for (std::size_t i = 0; i < x.size(); ++i) middle[i] = x[i] + (step / 2) * u[i];
    u = velocity(membrane, rest.faces, middle);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + step * u[i];
    const double scale = std::cbrt(volume0 / volume(x, rest.faces));
    for (Vec& p : x) p = scale * p;
  }
}
