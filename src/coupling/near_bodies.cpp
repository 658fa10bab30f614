#include "coupling/near_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/box_cells.hpp"
#include "mesh/geometry.hpp"
#include "parallel/sparse_exchange.hpp"
#include "structure/quaternion.hpp"

namespace pliant {
namespace {

/// What the ranks around a body are told of it.
struct Card {
  long body;
  int rank, yields;
  Box box;
};

using Outbox = std::vector<ByteWriter>;

std::vector<std::vector<std::byte>> exchange(const Communicator& ranks, Outbox& outbox) {
  std::vector<std::vector<std::byte>> bytes;
  for (auto& writer : outbox) bytes.push_back(writer.take());
  return exchange_bytes(ranks, bytes);
}

Outbox outbox_for(const Communicator& ranks) { return Outbox(static_cast<std::size_t>(ranks.size())); }

/// Ranks whose planes lie between two heights.
std::vector<int> ranks_between(const Grid& grid, double lower, double upper) {
  const int n = grid.cells()[2];
  const double origin = grid.origin().z, height = grid.size().z;
  const auto plane = [&](double z) {
    if (!grid.is_periodic(2)) return grid.plane_of_height(std::clamp(z, origin, origin + height));
    const double periods = std::floor((z - origin) / height);
    return grid.plane_of_height(z - periods * height) + n * static_cast<int>(periods);
  };
  const int first = plane(lower), last = std::min(plane(upper), first + n - 1);
  std::vector<int> found;
  for (int p = first; p <= last; ++p) {
    const int rank = rank_of_plane(n, grid.ranks().size(), ((p % n) + n) % n);
    if (std::find(found.begin(), found.end(), rank) == found.end()) found.push_back(rank);
  }
  return found;
}

/// Calls visit(image, shift) for the images of the box, 0 to 26, of which 13 is itself.
template <class Visit>
void for_each_image(const Grid& grid, Visit&& visit) {
  for (int image = 0; image < 27; ++image) {
    const std::array<int, 3> of{image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
    Vec3 shift;
    bool is_one = true;
    for (int d = 0; d < 3; ++d) {
      is_one &= of[static_cast<std::size_t>(d)] == 0 || grid.is_periodic(d);
      shift[d] = of[static_cast<std::size_t>(d)] * grid.size()[d];
    }
    if (is_one) visit(image, shift);
  }
}

/// By whole periods, so that `x` comes nearest to `to`.
Vec3 periods_towards(const Grid& grid, Vec3 x, Vec3 to) {
  Vec3 shift;
  for (int d = 0; d < 3; ++d)
    if (grid.is_periodic(d)) shift[d] = grid.size()[d] * std::round((to[d] - x[d]) / grid.size()[d]);
  return shift;
}

Vec3 middle_of(const Box& box) { return 0.5 * (box.lower + box.upper); }

/// Pairs of neighbours, each once or more, of which one yields.
template <class Visit>
void for_each_neighbours(const Grid& grid, const std::vector<Card>& cards, Visit&& visit) {
  std::vector<Box> boxes;
  const Vec3 middle = grid.origin() + 0.5 * grid.size();
  for (const Card& card : cards) boxes.push_back(card.box.shifted(periods_towards(grid, middle_of(card.box), middle)));
  const BoxCells cells(boxes);
  for (std::size_t a = 0; a < cards.size(); ++a)
    for_each_image(grid, [&](int, Vec3 shift) {
      cells.for_each_meeting(boxes[a].shifted(shift), [&](int found) {
        const auto b = static_cast<std::size_t>(found);
        if (cards[a].body < cards[b].body && (cards[a].yields || cards[b].yields)) visit(cards[a], cards[b]);
      });
    });
}

}  // namespace

/// A surface as the step begins, and the box of all that it may touch within it: half of what is between it and
/// another, and its own way.
struct NearBodies::Start {
  std::vector<Vec3> positions, velocities;
  double margin;
  Box box;
};

NearBodies::Start NearBodies::start_of(const Body& body, const BodyKind& kind, double step, PosedBodies posed) const {
  Start start{body.surface.positions, body.surface.velocities, 0, {}};
  if (kind.has_pose() && posed == PosedBodies::at_its_end)
    for (std::size_t v = 0; v < start.positions.size(); ++v) {
      start.positions[v] = body.met.center + rotate(body.met.orientation, kind.reference[v]);
      start.velocities[v] = (body.surface.positions[v] - start.positions[v]) / step;
    }
  double fastest = 0;
  for (const Vec3& v : start.velocities) fastest = std::max(fastest, dot(v, v));
  start.margin = 0.5 * range_ + SurfaceContact::skin(range_) + step * std::sqrt(fastest);
  start.box = box_around(start.positions).inflated(start.margin);
  return start;
}

/// Another body's: to be told what of a body's surface is within its box.
struct NearBodies::Wish {
  long own, other;
  int rank;
  Box box;
  bool operator<(const Wish& w) const { return std::tie(own, other) < std::tie(w.own, w.other); }
  bool operator==(const Wish& w) const { return own == w.own && other == w.other; }
};

std::vector<std::vector<NearBodies::Wish>> NearBodies::introduce(const Bodies& bodies,
                                                                 std::span<const Start> starts) const {
  const auto& ranks = grid_.ranks();
  auto outbox = outbox_for(ranks);
  for (std::size_t b = 0; b < starts.size(); ++b) {
    const Body& body = bodies.own()[b];
    if (!bodies.touches_others(body)) continue;
    const Box& box = starts[b].box;
    const Card card{body.id, ranks.rank(), !bodies.kind_of(body).has_pose(), box};
    for (const int r : ranks_between(grid_, box.lower.z, box.upper.z)) outbox[static_cast<std::size_t>(r)].write(card);
  }
  std::vector<Card> cards;
  for (const auto& bytes : exchange(ranks, outbox)) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0) cards.push_back(reader.read<Card>());
  }
  const auto wish = [&](const Card& of, const Card& asked) {
    if (of.yields) outbox[static_cast<std::size_t>(asked.rank)].write(Wish{asked.body, of.body, of.rank, of.box});
  };
  for_each_neighbours(grid_, cards, [&](const Card& a, const Card& b) {
    wish(a, b);
    wish(b, a);
  });
  std::vector<Wish> wishes;
  for (const auto& bytes : exchange(ranks, outbox)) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0) wishes.push_back(reader.read<Wish>());
  }
  std::sort(wishes.begin(), wishes.end());
  wishes.erase(std::unique(wishes.begin(), wishes.end()), wishes.end());
  std::vector<std::vector<Wish>> by_body(bodies.own().size());
  for (const Wish& w : wishes) {
    const auto at = bodies.find(w.own) - bodies.own().data();
    by_body[static_cast<std::size_t>(at)].push_back(w);
  }
  return by_body;
}

std::vector<Obstacles> NearBodies::find(const Bodies& bodies, double step, PosedBodies posed) {
  std::vector<Start> starts;
  for (const Body& body : bodies.own()) starts.push_back(start_of(body, bodies.kind_of(body), step, posed));
  const auto wishes = introduce(bodies, starts);
  auto outbox = outbox_for(grid_.ranks());
  std::vector<int> number;
  std::vector<Vec3> positions, velocities;
  std::vector<double> areas;
  for (std::size_t b = 0; b < wishes.size(); ++b) {
    if (wishes[b].empty()) continue;
    const Body& body = bodies.own()[b];
    const auto& surface = body.surface;
    const bool yields = !bodies.kind_of(body).has_pose();
    const auto& start = starts[b].positions;
    const auto all_areas = vertex_areas(surface.mesh, start);
    const Box& around = starts[b].box;
    for (const Wish& wish : wishes[b]) {
      const Vec3 towards = periods_towards(grid_, middle_of(around), middle_of(wish.box));
      for_each_image(grid_, [&](int image, Vec3 periods) {
        const Vec3 shift = towards + periods;
        if (!around.shifted(shift).meets(wish.box)) return;
        const Box within = wish.box.shifted(-shift).inflated(starts[b].margin);
        number.assign(start.size(), -1);
        std::vector<Face> faces;
        for (const Face& face : surface.mesh.vertices_of_face()) {
          if (!box_around(face, start).meets(within)) continue;
          faces.push_back(face);
          for (const int v : face) number[static_cast<std::size_t>(v)] = 0;
        }
        if (faces.empty()) return;
        std::vector<int> vertices;
        positions.clear(), velocities.clear(), areas.clear();
        for (std::size_t v = 0; v < start.size(); ++v) {
          if (number[v] < 0) continue;
          number[v] = static_cast<int>(vertices.size());
          vertices.push_back(static_cast<int>(v));
          positions.push_back(start[v] + shift);
          velocities.push_back(starts[b].velocities[v]);
          areas.push_back(all_areas[v]);
        }
        for (Face& face : faces)
          for (int& v : face) v = number[static_cast<std::size_t>(v)];
        auto& out = outbox[static_cast<std::size_t>(wish.rank)];
        out.write(wish.other);
        out.write(body.id);
        out.write(image);
        out.write(yields);
        out.write(vertices);
        out.write(positions);
        out.write(velocities);
        out.write(areas);
        out.write(faces);
      });
    }
  }

  struct Arrival {
    Source source;
    bool yields;
    std::vector<Vec3> positions, velocities;
    std::vector<double> areas;
    std::vector<Face> faces;
  };
  std::vector<std::vector<Arrival>> arrivals(bodies.own().size());
  const auto received = exchange(grid_.ranks(), outbox);
  for (std::size_t r = 0; r < received.size(); ++r) {
    ByteReader in(received[r]);
    while (in.remaining() > 0) {
      const auto at = bodies.find(in.read<long>()) - bodies.own().data();
      Arrival& part = arrivals[static_cast<std::size_t>(at)].emplace_back();
      in.read(part.source.body);
      in.read(part.source.image);
      part.source.rank = static_cast<int>(r);
      in.read(part.yields);
      in.read(part.source.vertices);
      in.read(part.positions);
      in.read(part.velocities);
      in.read(part.areas);
      in.read(part.faces);
    }
  }

  std::vector<Obstacles> obstacles(bodies.own().size());
  sources_.assign(bodies.own().size(), {});
  for (std::size_t b = 0; b < arrivals.size(); ++b) {
    std::sort(arrivals[b].begin(), arrivals[b].end(), [](const Arrival& x, const Arrival& y) {
      return std::tie(x.source.body, x.source.image) < std::tie(y.source.body, y.source.image);
    });
    auto& all = obstacles[b];
    for (Arrival& part : arrivals[b]) {
      const auto first = static_cast<int>(all.positions.size());
      all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
      all.velocities.insert(all.velocities.end(), part.velocities.begin(), part.velocities.end());
      all.areas.insert(all.areas.end(), part.areas.begin(), part.areas.end());
      for (const Face& face : part.faces) all.faces.push_back({first + face[0], first + face[1], first + face[2]});
      all.parts.push_back(
          {part.source.body, part.yields, static_cast<int>(all.positions.size()), static_cast<int>(all.faces.size())});
      sources_[b].push_back(std::move(part.source));
    }
  }
  return obstacles;
}

std::vector<std::vector<Vec3>> NearBodies::bring_back(const Bodies& bodies,
                                                      std::span<const std::span<const Vec3>> impulses) {
  auto outbox = outbox_for(grid_.ranks());
  for (std::size_t b = 0; b < sources_.size(); ++b) {
    std::size_t at = 0;
    for (const Source& source : sources_[b]) {
      auto& out = outbox[static_cast<std::size_t>(source.rank)];
      const auto of_part = impulses[b].subspan(at, source.vertices.size());
      at += source.vertices.size();
      out.write(source.body);
      out.write(bodies.own()[b].id);
      out.write(source.image);
      out.write(source.vertices);
      out.write(std::vector<Vec3>(of_part.begin(), of_part.end()));
    }
  }
  struct Return {
    long body, from;
    int image;
    std::vector<int> vertices;
    std::vector<Vec3> impulses;
  };
  std::vector<Return> returns;
  for (const auto& bytes : exchange(grid_.ranks(), outbox)) {
    ByteReader in(bytes);
    while (in.remaining() > 0) {
      Return& part = returns.emplace_back();
      in.read(part.body);
      in.read(part.from);
      in.read(part.image);
      in.read(part.vertices);
      in.read(part.impulses);
    }
  }
  std::sort(returns.begin(), returns.end(), [](const Return& x, const Return& y) {
    return std::tie(x.body, x.from, x.image) < std::tie(y.body, y.from, y.image);
  });
  std::vector<std::vector<Vec3>> sums;
  for (const Body& body : bodies.own()) sums.emplace_back(body.surface.positions.size());
  for (const Return& part : returns) {
    const auto body = static_cast<std::size_t>(bodies.find(part.body) - bodies.own().data());
    for (std::size_t n = 0; n < part.vertices.size(); ++n)
      sums[body][static_cast<std::size_t>(part.vertices[n])] += part.impulses[n];
  }
  return sums;
}

}  // namespace pliant
