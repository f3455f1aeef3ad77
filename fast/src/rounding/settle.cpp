#include "rounding/settle.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "rounding/grid_hash.hpp"
#include "rounding/mesh_index.hpp"
#include "rounding/resolve_mesh.hpp"
#include "rounding/untangle.hpp"

namespace halfspace::fast {
namespace {

/// How rounding goes on where what it moved meets. The second way begins again
/// from the exact surface where the first came to no end.
enum class Way : std::uint8_t {
  kNear,   ///< in vain, what meets is coarsened a bit
  kMerge,  ///< in vain, by the width that makes most of it fall together
};
/// The widths of coarsening, in spacings.
constexpr std::int64_t kFirstWidth = 4;
constexpr std::int64_t kLastNear = 64;
/// How often merging is tried in vain with one least width.
constexpr std::size_t kSameWidth = 4;
/// Coarsening makes contacts fewer by a good share if by this factor. More than
/// so many take longer to resolve than to be counted anew.
constexpr std::size_t kFewer = 3;
constexpr std::size_t kMany = 1000;

class Settler {
 public:
  Settler(const LooseMesh& start, const FileGrid& grid, int threads)
      : start_(start), grid_(grid), threads_(threads) {}

  Settled run() {
    result_.end = Settling::kNoEnd;
    for (const Way way : {Way::kNear, Way::kMerge}) {
      if (round(way)) result_.end = Settling::kDone;
      if (result_.end != Settling::kNoEnd) break;
    }
    return std::move(result_);
  }

 private:
  void note_move(const LargestMove& move);
  bool coarsen(MeshContacts& contacts, std::int64_t first, std::int64_t last);
  bool go_on(Way way, MeshContacts& contacts, std::size_t in_vain);
  void note_contacts(const MeshContacts& contacts);
  std::vector<std::uint8_t> may_move(const MeshContacts& contacts) const;
  MeshContacts rounded(const std::vector<LoosePoint>& loose);
  bool round(Way way);

  const LooseMesh& start_;
  const FileGrid& grid_;
  int threads_;
  Settled result_;
  MeshIndex index_;
  double farthest_move_ = 0;
};

/// A surface point moves no farther than the farthest vertex, in each round.
void Settler::note_move(const LargestMove& move) {
  result_.max_move += move.distance;
  if (move.distance <= farthest_move_) return;
  farthest_move_ = move.distance;
  result_.farthest = move.to;
}

/// Coarsens what meets, by the least width of up to `last` with which far fewer
/// triangles meet, or else by that which leaves the fewest. Sheets that nearly
/// coincide fall together where the width is more than their distance, and
/// cross the more where it is less. False: too many are left even so.
/// `contacts` become those of the coarser surface.
bool Settler::coarsen(MeshContacts& contacts, std::int64_t first,
                      std::int64_t last) {
  GridMesh best;
  MeshContacts best_contacts;
  LargestMove best_move;
  std::size_t fewest = static_cast<std::size_t>(-1);
  for (std::int64_t width = first; width <= last; width *= 4) {
    GridMesh mesh = result_.mesh;
    const LargestMove move =
        coarsened(mesh, contacts, grid_, width * grid_.spacing());
    clean(mesh);
    index_.follow(mesh);
    MeshContacts left = contacts_of(mesh, threads_, index_);
    const std::size_t count = left.size();
    if (count >= fewest) continue;
    best = std::move(mesh);
    best_contacts = std::move(left);
    best_move = move;
    fewest = count;
    if (kFewer * count <= contacts.size()) break;
  }
  if (fewest > kMany && fewest > 2 * contacts.size()) return false;
  result_.mesh = std::move(best);
  index_.follow(result_.mesh);
  contacts = std::move(best_contacts);
  note_move(best_move);
  return true;
}

/// Does something against contacts that do not become fewer for the `in_vain`th
/// time. False: nothing is left to be done.
bool Settler::go_on(Way way, MeshContacts& contacts, std::size_t in_vain) {
  if (way == Way::kNear) {
    const std::int64_t width = kFirstWidth << (in_vain - 1);
    return width <= kLastNear && coarsen(contacts, width, width);
  }
  // The least width grows, lest the same is done again and again.
  const std::int64_t first = kFirstWidth << (in_vain / kSameWidth);
  return first <= grid_.widest() && coarsen(contacts, first, grid_.widest());
}

void Settler::note_contacts(const MeshContacts& contacts) {
  const GridMesh& mesh = result_.mesh;
  result_.collapsed = true;
  contacts.for_triangles([&](std::int32_t t) {
    result_.contact =
        mesh.at(mesh.triangles[static_cast<std::size_t>(t)].corners[0]);
  });
  if (result_.rounds > 1) return;
  result_.first_contacts = contacts.size();
  if (!is_closed(start_.mesh)) result_.end = Settling::kOpen;
}

/// By point: whether it is a corner of triangles that meet, in a place where no
/// point was that rounding did not move. Where a solid touches itself it stays
/// as it is.
std::vector<std::uint8_t> Settler::may_move(
    const MeshContacts& contacts) const {
  const GridMesh& mesh = result_.mesh;
  std::vector<std::uint8_t> may(mesh.points.size());
  std::unordered_set<GridPoint, GridPointHash> places;
  contacts.for_triangles([&](std::int32_t t) {
    for (const std::int32_t c :
         mesh.triangles[static_cast<std::size_t>(t)].corners) {
      may[static_cast<std::size_t>(c)] = 1;
      places.insert(mesh.at(c));
    }
  });
  std::vector<std::uint8_t> is_off(start_.mesh.points.size());
  for (const LoosePoint& p : start_.loose) {
    is_off[static_cast<std::size_t>(p.point)] =
        distance(p.at, grid_.rounded(p.at, grid_.spacing())) > 0 ? 1 : 0;
  }
  for (std::size_t p = 0; p < is_off.size(); ++p) {
    if (is_off[p] == 0) places.erase(start_.mesh.points[p]);
  }
  for (std::size_t p = 0; p < may.size(); ++p) {
    if (may[p] != 0 && !places.contains(mesh.points[p])) may[p] = 0;
  }
  return may;
}

/// Rounds the loose points, to places where few triangles meet. Returns which
/// do.
MeshContacts Settler::rounded(const std::vector<LoosePoint>& loose) {
  GridMesh& mesh = result_.mesh;
  ++result_.rounds;
  if (!loose.empty()) result_.max_move += start_.error;
  LargestMove move = snap(mesh, loose, grid_);
  const Collapse collapse = clean(mesh);
  if (collapse.points + collapse.triangles > 0) result_.collapsed = true;
  index_.follow(mesh);
  MeshContacts contacts = contacts_of(mesh, threads_, index_);
  if (!contacts.empty()) note_contacts(contacts);
  if (!contacts.pairs.empty() && result_.end != Settling::kOpen) {
    index_.keep_up(mesh);
    const Untangled done =
        untangle(mesh, contacts, may_move(contacts), loose, index_, grid_);
    if (done.farthest.distance > move.distance) move = done.farthest;
    index_.follow(mesh, done.changed);
    contacts = contacts_after(contacts, mesh, done.changed, threads_, index_);
  }
  note_move(move);
  return contacts;
}

/// Whether it came to an end. Contacts become fewer from round to round, or
/// something else is done, which is not done for ever.
bool Settler::round(Way way) {
  GridMesh& mesh = result_.mesh;
  mesh = start_.mesh;
  index_ = {};
  result_.max_move = farthest_move_ = 0;
  std::vector<LoosePoint> loose = start_.loose;
  std::size_t fewest = static_cast<std::size_t>(-1);
  std::size_t in_vain = 0;
  while (true) {
    MeshContacts contacts = rounded(loose);
    if (contacts.empty()) return true;
    if (result_.end == Settling::kOpen) return false;
    const std::size_t count = contacts.size();
    const bool too_many = count > std::max(kMany, 2 * mesh.triangles.size());
    if ((too_many || fewest <= count) && !go_on(way, contacts, ++in_vain))
      return false;
    fewest = std::min(fewest, count);
    loose = resolve_mesh(mesh, contacts, index_, grid_, threads_);
    if (loose.empty()) return true;
  }
}

}  // namespace

Settled settle(const LooseMesh& start, const FileGrid& grid, int threads) {
  return Settler(start, grid, thread_count(threads)).run();
}

}  // namespace halfspace::fast
