#include "boolean/arrangement.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "boolean/common_faces.hpp"
#include "boolean/conform.hpp"
#include "halfspace/assert.hpp"
#include "intersect/meet_pairs.hpp"

namespace halfspace::fast {

Arrangement::Arrangement(BooleanOp op, const Solid& a, const Solid& b,
                         TableLease& lease, int threads)
    : operation(op),
      table(lease.table()),
      scratch(lease.scratch<BooleanScratch>()),
      threads_(threads) {
  // Both operands are in the leased table.
  HALFSPACE_ASSERT(a.table == lease.shared());
  HALFSPACE_ASSERT(b.table == lease.shared());
  operands[0].solid = &a;
  operands[1].solid = &b;
  is_conforming_ = {is_known_conforming(a), is_known_conforming(b)};
}

Arrangement::Arrangement(BooleanOp op, const Solid& a, const Solid& b,
                         TableLease& lease, const Whole& whole)
    : Arrangement(op, a, b, lease) {
  operands[0].whole = whole.solid;
  operands[0].index = whole.index;
  operands[0].blocks = whole.part_blocks;
  operands[0].whole_blocks = whole.blocks;
  operands[0].extent = whole.extent;
}

void Arrangement::find_contacts() {
  prepare(operands[0], operands[1], scratch);
  if constexpr (kFindsCommonFaces)
    find_common_faces(operands[0], operands[1], scratch);
  const auto pairs = candidate_pairs(operands[0], operands[1], threads_);
  constexpr std::size_t kFew = 2048;  // untuned
  const int threads = pairs.size() < kFew ? 1 : threads_;
  for_blocks(threads, 2, 1, [&](std::size_t o, std::size_t, std::size_t) {
    add_edges(operands[o], table);
  });
  meet_pairs(operands[0], operands[1], pairs, table, segments, threads_);
  for (std::size_t o = 0; o < 2; ++o) {
    conforms_[o] =
        is_conforming_[o] || conform_contacts(o, operands, segments, table);
  }
}

/// Brings the cuts and covers of each edge together.
void Arrangement::sort_records(std::size_t o) {
  Operand& operand = operands[o];
  const auto index = [&](const auto& records,
                         std::vector<std::uint32_t>& first) {
    first.assign(operand.edges.size() + 1, 0);
    for (const auto& record : records)
      ++first[static_cast<std::size_t>(record.edge) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
  };
  std::sort(operand.cuts.begin(), operand.cuts.end(),
            [](const EdgeFaceIntersection& x, const EdgeFaceIntersection& y) {
              return std::tie(x.edge, x.vertex, x.face) <
                     std::tie(y.edge, y.vertex, y.face);
            });
  std::sort(operand.covers.begin(), operand.covers.end(),
            [](const EdgeInFace& x, const EdgeInFace& y) {
              return std::tie(x.edge, x.face) < std::tie(y.edge, y.face);
            });
  index(operand.cuts, first_cut_[o]);
  index(operand.covers, first_cover_[o]);
}

/// Marks all faces of an edge that meets something: one of them reports it. For
/// a face within another in its plane this is the only record.
void Arrangement::mark_touched(std::size_t o) {
  const Operand& operand = operands[o];
  for (std::size_t e = 0; e < operand.edges.size(); ++e) {
    const OperandEdge& edge = operand.edges[e];
    const auto id = static_cast<std::int32_t>(e);
    if (operand.is_on_other(edge.low) || operand.is_on_other(edge.high) ||
        !cuts_of(o, id).empty() || !covers_of(o, id).empty())
      touch_faces_at(o, edge);
  }
}

void Arrangement::touch_faces_at(std::size_t o, const OperandEdge& edge) {
  Operand& operand = operands[o];
  for (std::uint32_t u = 0; u < edge.use_count; ++u) {
    const EdgeUse& use = operand.uses[edge.first_use + u];
    operand.touched[static_cast<std::size_t>(use.face)] = 1;
  }
}

std::span<const EdgeFaceIntersection> Arrangement::cuts_of(
    std::size_t o, std::int32_t edge) const {
  const auto e = static_cast<std::size_t>(edge);
  return std::span(operands[o].cuts)
      .subspan(first_cut_[o][e], first_cut_[o][e + 1] - first_cut_[o][e]);
}

std::span<const EdgeFaceIntersection> Arrangement::cuts_at(
    std::size_t o, std::int32_t edge, std::int32_t vertex) const {
  const auto cuts = cuts_of(o, edge);
  const auto first = std::partition_point(
      cuts.begin(), cuts.end(), [vertex](const EdgeFaceIntersection& cut) {
        return cut.vertex < vertex;
      });
  const auto last = std::partition_point(
      first, cuts.end(), [vertex](const EdgeFaceIntersection& cut) {
        return cut.vertex == vertex;
      });
  return {first, last};
}

std::span<const EdgeInFace> Arrangement::covers_of(std::size_t o,
                                                   std::int32_t edge) const {
  const auto e = static_cast<std::size_t>(edge);
  return std::span(operands[o].covers)
      .subspan(first_cover_[o][e], first_cover_[o][e + 1] - first_cover_[o][e]);
}

void Arrangement::index() {
  HALFSPACE_ASSERT(conforms_[0] && conforms_[1]);
  constexpr std::size_t kFew = 8192;  // untuned
  const std::size_t edges = operands[0].edges.size() + operands[1].edges.size();
  const int threads = edges < kFew ? 1 : threads_;
  for_blocks(threads, 2, 1, [&](std::size_t o, std::size_t, std::size_t) {
    sort_records(o);
    mark_touched(o);
  });
  for (std::size_t o = 0; o < 2; ++o) {
    for (const EdgeFaceIntersection& cut : operands[o].cuts)
      HALFSPACE_CHECK(is_touched(1 - o, cut.face));
    for (const EdgeInFace& cover : operands[o].covers)
      HALFSPACE_CHECK(cover.left || cover.right);
  }
}

}  // namespace halfspace::fast
