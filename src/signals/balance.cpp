#include "signals/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pliant {
namespace {

/// Gauss and Kronrod, 7 and 15 points: positive nodes, both weights.
struct Node {
  double x, kronrod, gauss;
};
constexpr std::array<Node, 8> nodes{
    {{0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0},
     {0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.129484966168869693270611432679082},
     {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
     {0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.279705391489276667901467771423780},
     {0.586087235467691130294144445693013, 0.169004726639267902826583426598550, 0},
     {0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.381830050505118944950369775488975},
     {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
     {0, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327}}};

struct Sums {
  PeriodParts parts;
  double error = 0, size = 0;
};

Sums sums_over(const Signal& signal, double a, double b) {
  const double half = 0.5 * (b - a), middle = 0.5 * (a + b);
  PeriodParts kronrod, gauss;
  const auto add = [&](double t, const Node& node) {
    const double value = half * signal.value(t), up = std::max(value, 0.0), down = std::max(-value, 0.0);
    kronrod.positive += node.kronrod * up;
    kronrod.negative += node.kronrod * down;
    gauss.positive += node.gauss * up;
    gauss.negative += node.gauss * down;
  };
  for (const Node& node : nodes) {
    add(middle + half * node.x, node);
    if (node.x > 0) add(middle - half * node.x, node);
  }
  const double error = std::abs(kronrod.positive - gauss.positive) + std::abs(kronrod.negative - gauss.negative);
  return {kronrod, error, kronrod.positive + kronrod.negative};
}

void add_parts(const Signal& signal, double a, double b, double tolerance, int depth, PeriodParts& parts) {
  const auto sums = sums_over(signal, a, b);
  if (sums.error > tolerance && depth > 0) {
    add_parts(signal, a, 0.5 * (a + b), 0.5 * tolerance, depth - 1, parts);
    add_parts(signal, 0.5 * (a + b), b, 0.5 * tolerance, depth - 1, parts);
    return;
  }
  parts.positive += sums.parts.positive;
  parts.negative += sums.parts.negative;
}

}  // namespace

PeriodParts parts_of_period(const Signal& signal) {
  // So many pieces that no wave of a curve is passed over, and steps of a formula are closed in on by halves.
  constexpr int pieces = 64, deepest = 40;
  const double length = *signal.period() / pieces;
  double size = 0;
  for (int n = 0; n < pieces; ++n) size += sums_over(signal, n * length, (n + 1) * length).size;
  PeriodParts parts;
  for (int n = 0; n < pieces; ++n) add_parts(signal, n * length, (n + 1) * length, 1e-14 * size, deepest, parts);
  return parts;
}

SignalRange range_of(const Signal& signal, double end) {
  constexpr int samples = 2000;
  SignalRange range{signal.value(0), 0, signal.value(0), 0};
  for (int n = 1; n <= samples; ++n) {
    const double t = end * n / samples, value = signal.value(t);
    if (value > range.largest) range.largest = value, range.largest_at = t;
    if (value < range.least) range.least = value, range.least_at = t;
  }
  return range;
}

}  // namespace pliant
