#include "solid/bucket_order.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "base/radix_sort.hpp"
#include "base/threads.hpp"

namespace halfspace::fast {
namespace {

/// Sorts few pieces of many buckets.
void sort_few(List<const DirectedEdge*>& pieces) {
  List<KeyedIndex> keyed;
  keyed.reserve(pieces.size());
  for (const DirectedEdge* piece : pieces) {
    keyed.push_back({static_cast<std::uint64_t>(piece->bucket),
                     static_cast<std::uint32_t>(keyed.size())});
  }
  sort_by_key(keyed);
  const List<const DirectedEdge*> before(pieces, pieces.get_allocator());
  for (std::size_t i = 0; i < keyed.size(); ++i)
    pieces[i] = before[keyed[i].index];
}

/// Counting sort (KNU98 sec. 5.2), lists in groups of about as many pieces,
/// one for each thread.
class Counting {
 public:
  Counting(std::span<const List<DirectedEdge>> lists,
           std::array<std::size_t, 2> faces, std::size_t pieces,
           std::size_t groups)
      : lists_(lists), second_(2 * faces[0]), first_list_(groups + 1) {
    places_.assign(groups, List<std::uint32_t>(2 * (faces[0] + faces[1])));
    std::size_t list = 0, before = 0;
    for (std::size_t g = 1; g <= groups; ++g) {
      while (list < lists.size() && before < g * pieces / groups)
        before += lists[list++].size();
      first_list_[g] = list;
    }
  }

  void run(List<const DirectedEdge*>& sorted, int threads) {
    for_groups(threads, [&](std::size_t g) {
      for_pieces(g, [&](const DirectedEdge& p) { ++places_[g][slot(p)]; });
    });
    std::uint32_t next = 0;
    for (std::size_t s = 0; s < places_[0].size(); ++s) {
      for (List<std::uint32_t>& of_group : places_) {
        const std::uint32_t count = of_group[s];
        of_group[s] = next;
        next += count;
      }
    }
    for_groups(threads, [&](std::size_t g) {
      for_pieces(g, [&](const DirectedEdge& p) {
        sorted[places_[g][slot(p)]++] = &p;
      });
    });
  }

 private:
  template <class Work>
  void for_groups(int threads, const Work& work) {
    for_blocks(threads, places_.size(), 1,
               [&](std::size_t g, std::size_t, std::size_t) { work(g); });
  }
  template <class Visit>
  void for_pieces(std::size_t g, const Visit& visit) const {
    for (std::size_t list = first_list_[g]; list < first_list_[g + 1]; ++list) {
      for (const DirectedEdge& piece : lists_[list]) visit(piece);
    }
  }
  /// Buckets without gaps.
  std::size_t slot(const DirectedEdge& piece) const {
    constexpr std::int64_t kSecond = std::int64_t{1} << 40;
    return piece.bucket < kSecond
               ? static_cast<std::size_t>(piece.bucket)
               : second_ + static_cast<std::size_t>(piece.bucket - kSecond);
  }

  std::span<const List<DirectedEdge>> lists_;
  std::size_t second_;  ///< the first slot of the second operand
  std::vector<std::size_t> first_list_;  ///< by group
  /// By group and slot: how many pieces; then where the next one comes.
  std::vector<List<std::uint32_t>> places_;
};

}  // namespace

List<const DirectedEdge*> in_order_of_buckets(
    std::span<const List<DirectedEdge>> lists, std::array<std::size_t, 2> faces,
    int threads) {
  std::size_t count = 0;
  for (const List<DirectedEdge>& pieces : lists) count += pieces.size();
  if (!kManyThreads || count < faces[0] + faces[1]) {
    List<const DirectedEdge*> sorted;
    sorted.reserve(count);
    for (const List<DirectedEdge>& pieces : lists) {
      for (const DirectedEdge& piece : pieces) sorted.push_back(&piece);
    }
    sort_few(sorted);
    return sorted;
  }
  List<const DirectedEdge*> sorted(count);
  constexpr std::size_t kFew = std::size_t{1} << 15;  // untuned
  const auto groups =
      count < kFew ? 1 : static_cast<std::size_t>(std::max(threads, 1));
  Counting(lists, faces, count, groups).run(sorted, threads);
  return sorted;
}

}  // namespace halfspace::fast
