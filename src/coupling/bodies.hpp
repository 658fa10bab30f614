#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/body_blob.hpp"
#include "core/byte_stream.hpp"
#include "coupling/body.hpp"
#include "grid/grid.hpp"
#include "structure/placement.hpp"

namespace pliant {

/// The bodies of a run, shared out over the ranks: a body is held and computed by the rank that holds its mean height
/// (the paper's rule), and moves on to another one when it leaves that slab. No rank knows all bodies; the kinds, a
/// [[body]] each, are known to all.
class Bodies {
 public:
  /// Makes the kinds and this rank's bodies. Throws InputError with the problems of all kinds, on all ranks alike.
  Bodies(const CaseConfig& config, const Grid& grid);

  const Grid& grid() const { return grid_; }
  std::span<const BodyKind> kinds() const { return kinds_; }
  const BodyKind& kind_of(const Body& body) const { return kinds_[body.kind]; }
  /// Bodies of the whole run, and of one kind; ids of a kind follow each other from first_id(kind).
  long count() const { return first_id_.back(); }
  long count(std::size_t kind) const { return first_id_[kind + 1] - first_id_[kind]; }
  long first_id(std::size_t kind) const { return first_id_[kind]; }

  /// This rank's bodies, by id.
  std::span<Body> own() { return bodies_; }
  std::span<const Body> own() const { return bodies_; }
  /// A body, if this rank holds it; else null.
  const Body* find(long id) const;
  Body* find(long id) { return const_cast<Body*>(std::as_const(*this).find(id)); }
  /// Changes, on all ranks alike, whenever a body has changed its rank.
  long arrangement() const { return arrangement_; }

  /// Whether a body, or a kind of bodies, acts on the flow in the present step, as its schedule says. Known to all
  /// ranks.
  bool is_on(std::size_t kind) const { return is_on_[kind]; }
  bool is_on(const Body& body) const { return is_on_[body.kind]; }
  /// Whether bodies that come near are pushed off by it, and it by them and by itself.
  bool touches_others(const Body& body) const { return is_on(body) && kind_of(body).config.contact; }
  /// The present step is one with its middle at this time. Returns the kinds that have come or gone; those that have
  /// gone have no loads any more. Begins at time 0.
  std::vector<std::size_t> follow_schedules(double time);

  /// Hands bodies that have left this rank's slab to their new ranks. Collective. Throws CollectiveError if a body was
  /// lost.
  void migrate();

  /// This rank's bodies as bytes.
  std::vector<BodyBlob> save() const;
  /// Replaces all bodies by saved ones; each rank may hand in any of them. Collective. Throws CollectiveError if they
  /// are not the bodies of this run.
  void restore(const std::vector<BodyBlob>& saved);

 private:
  int home_of(const Body& body) const;
  Body blank_copy(std::size_t kind, long id) const;
  Body make_copy(std::size_t kind, long id, const Placement& placement) const;
  Body read(long id, ByteReader& reader) const;
  void sort_and_count(long n_arrived);

  Grid grid_;
  std::vector<BodyKind> kinds_;
  std::vector<bool> is_on_;  // by kind
  std::vector<long> first_id_;
  std::vector<Body> bodies_;
  long arrangement_ = 0;
};

}  // namespace pliant
