#include "intersect/meet_pairs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/parallel.hpp"
#include "base/threads.hpp"
#include "intersect/face_intersection.hpp"

namespace halfspace::fast {
namespace {

/// Pairs in a row that one thread works on, and how many of these blocks have
/// their points named at once. Untuned.
constexpr std::size_t kBlock = 512;
constexpr std::size_t kBlocks = 64;

/// Makes room in the table for the points of the pairs to come, if they are as
/// many as those of the ones before: lists that grow by doubling take twice the
/// memory, all of which the system clears.
class Foresight {
 public:
  Foresight(GeometryTable& table, std::size_t pairs)
      : table_(table), pairs_(pairs), begin_(table.vertex_count()) {}

  /// After each so many pairs, `done` in all.
  void look_ahead(std::size_t done) {
    if (done < next_ || done >= pairs_) return;
    next_ = 2 * done;
    const double share =
        static_cast<double>(pairs_ - done) / static_cast<double>(done);
    const auto more = static_cast<double>(table_.vertex_count() - begin_);
    constexpr double kMore = 1.05;  // untuned
    table_.reserve_meets(static_cast<std::size_t>(share * more * kMore));
  }

 private:
  GeometryTable& table_;
  std::size_t pairs_;
  std::size_t begin_;
  std::size_t next_ = 0;
};

/// Where the records of a pair end.
struct RecordEnds {
  std::array<std::size_t, 2> cuts{}, covers{}, on_other{};
  std::size_t segments = 0;

  explicit RecordEnds(const ContactRecords& of) : segments(of.segments.size()) {
    for (std::size_t o = 0; o < 2; ++o) {
      cuts[o] = of.cuts[o].size();
      covers[o] = of.covers[o].size();
      on_other[o] = of.on_other[o].size();
    }
  }
};

/// What threads know of some pairs in a row.
struct PairBlock {
  PendingLines pending;
  /// Of the pairs that are left to one thread, and where each one's end.
  ContactRecords left;
  std::vector<RecordEnds> left_ends;
  ContactRecords records;  ///< of all, in order
};

template <class Items>
void append(Items& to, const Items& from, std::size_t first, std::size_t end) {
  to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first),
            from.begin() + static_cast<std::ptrdiff_t>(end));
}

class PairMeeter {
 public:
  PairMeeter(Operand& a, Operand& b, GeometryTable& table,
             List<IntersectionSegment>& segments)
      : operands_{&a, &b},
        table_(table),
        segments_(segments),
        intersector_(a, b, table, segments),
        intersectors_([&, this] {
          return FaceIntersector(*operands_[0], *operands_[1], table_,
                                 segments_);
        }),
        blocks_(kBlocks) {}

  void run(std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
           int threads) {
    Foresight foresight(table_, pairs.size());
    for (std::size_t at = 0; at < pairs.size(); at += kBlock * kBlocks) {
      const auto some =
          pairs.subspan(at, std::min(pairs.size() - at, kBlock * kBlocks));
      const std::size_t count = (some.size() + kBlock - 1) / kBlock;
      // Step 1: which events there are on each line.
      for_blocks(threads, some.size(), kBlock,
                 [&](std::size_t number, std::size_t first, std::size_t last) {
                   begin(some.subspan(first, last - first), blocks_[number]);
                 });
      // Step 2: the points' ids, in order.
      for (std::size_t k = 0; k < count; ++k) name_points(blocks_[k]);
      // Step 3: what the events come to.
      for_blocks(threads, count, 1,
                 [&](std::size_t number, std::size_t, std::size_t) {
                   end(blocks_[number]);
                 });
      for (std::size_t k = 0; k < count; ++k) add(blocks_[k].records);
      foresight.look_ahead(at + some.size());
    }
  }

 private:
  void begin(std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
             PairBlock& block) {
    FaceIntersector& contact = intersectors_.local();
    contact.begin_block(block.pending);
    for (const auto& [f, g] : pairs) contact.begin_meet(f, g);
  }

  void name_points(PairBlock& block) {
    PendingLines& pending = block.pending;
    block.left.clear();
    block.left_ends.clear();
    intersector_.record_in(&block.left);
    for (const PendingLine& line : pending.lines) {
      if (!line.is_left) continue;
      add_points(pending, line.asked_end);
      intersector_.meet(line.faces[0], line.faces[1]);
      block.left_ends.emplace_back(block.left);
    }
    add_points(pending, pending.asked.size());
  }

  void add_points(PendingLines& pending, std::size_t end) {
    constexpr std::size_t kAhead = 8;
    while (pending.ids.size() < end) {
      const std::size_t i = pending.ids.size();
      if (i + kAhead < pending.asked.size())
        table_.prefetch_asked(pending.asked[i + kAhead]);
      pending.ids.push_back(table_.add_asked(pending.asked[i], pending.words));
    }
  }

  void end(PairBlock& block) {
    FaceIntersector& contact = intersectors_.local();
    block.records.clear();
    RecordEnds before{ContactRecords{}};
    auto after = block.left_ends.begin();
    for (std::size_t i = 0; i < block.pending.lines.size(); ++i) {
      if (!block.pending.lines[i].is_left) {
        contact.end_meet(block.pending, i, block.records);
        continue;
      }
      add_left(block, before, *after);
      before = *after++;
    }
  }

  static void add_left(PairBlock& block, const RecordEnds& from,
                       const RecordEnds& to) {
    ContactRecords& records = block.records;
    const ContactRecords& left = block.left;
    for (std::size_t o = 0; o < 2; ++o) {
      append(records.cuts[o], left.cuts[o], from.cuts[o], to.cuts[o]);
      append(records.covers[o], left.covers[o], from.covers[o], to.covers[o]);
      append(records.on_other[o], left.on_other[o], from.on_other[o],
             to.on_other[o]);
    }
    append(records.segments, left.segments, from.segments, to.segments);
  }

  void add(const ContactRecords& records) {
    for (std::size_t o = 0; o < 2; ++o) {
      Operand& operand = *operands_[o];
      append(operand.cuts, records.cuts[o], 0, records.cuts[o].size());
      append(operand.covers, records.covers[o], 0, records.covers[o].size());
      for (const std::int32_t v : records.on_other[o]) operand.put_on_other(v);
    }
    append(segments_, records.segments, 0, records.segments.size());
  }

  std::array<Operand*, 2> operands_;
  GeometryTable& table_;
  List<IntersectionSegment>& segments_;
  FaceIntersector intersector_;
  threads::PerThread<FaceIntersector> intersectors_;
  std::vector<PairBlock> blocks_;
};

}  // namespace

void meet_pairs(Operand& a, Operand& b,
                std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                GeometryTable& table, List<IntersectionSegment>& segments,
                int threads) {
  constexpr std::size_t kFew = 2 * kBlock;  // untuned
  if constexpr (kManyThreads) {
    if (threads > 1 && pairs.size() > kFew) {
      PairMeeter(a, b, table, segments).run(pairs, threads);
      return;
    }
  }
  FaceIntersector contact(a, b, table, segments);
  Foresight foresight(table, pairs.size());
  for (std::size_t at = 0; at < pairs.size(); at += kBlock * kBlocks) {
    const auto some =
        pairs.subspan(at, std::min(pairs.size() - at, kBlock * kBlocks));
    for (const auto& [f, g] : some) contact.meet(f, g);
    foresight.look_ahead(at + some.size());
  }
}

}  // namespace halfspace::fast
