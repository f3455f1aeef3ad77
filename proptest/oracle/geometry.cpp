#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include "generate/random_scenes.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/split.hpp"
#include "halfspace/ref/traverse.hpp"
#include "question.hpp"

namespace halfspace::oracle {
namespace {

using agree::Draws;

constexpr int kPolygons = 7;
constexpr int kEyes = 24;

/// Index of the member that `is_it` knows, -1 for none.
template <class Members, class IsIt>
std::int64_t index_if(const Members& members, IsIt&& is_it) {
  const auto it = std::find_if(members.begin(), members.end(), is_it);
  return it == members.end() ? -1 : std::distance(members.begin(), it);
}

/// A part by what its edges were in the whole, and its vertices if they are
/// exact: rounded ones can be equal by chance. An edge of the splitter's name
/// is new: the whole has none, since it spans the plane.
template <class Fragment>
void add_part(Line& line, const Fragment& whole, const Fragment& part) {
  line.add(static_cast<std::int64_t>(part.edges.size()));
  for (std::size_t k = 0; k < part.edges.size(); ++k) {
    line.add(index_if(whole.edges, [&](const EdgeName& name) {
      return name == part.edges[k];
    }));
    if constexpr (std::is_same_v<Fragment, ref::Fragment>) {
      line.add(index_if(whole.vertices, [&](const ref::Point& vertex) {
        return vertex == part.vertices[k];
      }));
    }
  }
}

/// What a library made of the fragment; parts count only if it spans.
template <class Fragment, class Parts>
Line line_of(Relation relation, const Fragment& whole, const Parts& parts) {
  Line line;
  line.add(static_cast<int>(relation));
  if (relation == Relation::kSpanning) {
    add_part(line, whole, parts.positive);
    add_part(line, whole, parts.negative);
  }
  return line;
}

/// The question about a fragment whose vertices lie so, with vertices in the
/// answer or without.
Line question_of(const std::vector<int>& sides, bool with_vertices) {
  Line line;
  line.add(with_vertices ? 1 : 5);
  line.add_list(sides, [&line](int side) { line.add(side); });
  return line;
}

/// The same fragment of either library.
struct Twin {
  ref::Fragment exact;
  fast::Fragment quick;
};

/// Asks about the fragment against the plane of a polygon. If it is cut, its
/// parts are added to `parts`.
void ask_split(Inquiry& inquiry, const Scene& scene, const ref::Plane& plane,
               PolygonId splitter, const Twin& twin, std::vector<Twin>& parts) {
  std::vector<int> sides;
  for (const ref::Point& vertex : twin.exact.vertices)
    sides.push_back(static_cast<int>(ref::side_of(plane, vertex)));
  fast::FilterStats stats;
  const Relation exact = ref::relation(twin.exact, plane);
  const Relation quick = fast::relation(scene, twin.quick, splitter, stats);
  ref::SplitResult by_ref;
  fast::SplitResult by_fast;
  if (exact == Relation::kSpanning && quick == exact) {
    by_ref = ref::split(twin.exact, plane, splitter);
    by_fast = fast::split(scene, twin.quick, splitter, stats);
    parts.push_back({by_ref.positive, by_fast.positive});
    parts.push_back({by_ref.negative, by_fast.negative});
  }
  inquiry.ask(question_of(sides, true),
              {{"ref::split", line_of(exact, twin.exact, by_ref)}});
  inquiry.ask(question_of(sides, false),
              {{"fast::split", line_of(quick, twin.quick, by_fast)}});
}

/// Every polygon against the planes of all others, one after another.
void ask_splits(Inquiry& inquiry, const Scene& scene) {
  const std::vector<ref::Plane> planes = ref::planes_of(scene);
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const auto polygon = static_cast<PolygonId>(p);
    std::vector<Twin> pieces = {
        {ref::whole(scene, polygon), fast::whole(scene, polygon)}};
    for (std::size_t q = 0; q < planes.size(); ++q) {
      std::vector<Twin> next;
      for (const Twin& piece : pieces) {
        const std::size_t before = next.size();
        ask_split(inquiry, scene, planes[q], static_cast<PolygonId>(q), piece,
                  next);
        if (next.size() == before) next.push_back(piece);
      }
      pieces = std::move(next);
    }
  }
}

/// The fragments of a tree, numbered in pre-order.
class Numbers {
 public:
  explicit Numbers(const ref::BspTree& tree) {
    for (const NodeName& node : ref::name_of(tree)) {
      names_.insert(names_.end(), node.coincident.begin(),
                    node.coincident.end());
    }
  }
  std::int64_t of(const FragmentName& name) const {
    return index_if(names_, [&](const FragmentName& n) { return n == name; });
  }

 private:
  std::vector<FragmentName> names_;
};

/// The tree as the oracle reads it. No recursion: a stack of nodes.
Line question_of(const ref::BspTree& tree, const Numbers& numbers,
                 const Camera& camera) {
  Line line;
  line.add(2);
  std::vector<NodeId> ahead = {tree.nodes.empty() ? kNoNode : 0};
  while (!ahead.empty()) {
    const NodeId id = ahead.back();
    ahead.pop_back();
    if (id == kNoNode) {
      line.add(0);
      continue;
    }
    const ref::Node& node = tree.nodes[static_cast<std::size_t>(id)];
    line.add(1);
    line.add(static_cast<int>(ref::side_of_eye(node.plane, camera)));
    line.add_list(node.coincident, [&](const ref::Fragment& fragment) {
      line.add(numbers.of(ref::name_of(fragment)));
    });
    ahead.push_back(node.negative);
    ahead.push_back(node.positive);
  }
  return line;
}

FragmentName name_of(const fast::BspTree& tree,
                     const fast::TreeFragment& fragment) {
  std::vector<EdgeName> edges;
  for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
    const std::int32_t edge = tree.corners[fragment.first_corner + k].edge;
    edges.push_back(edge >= 0 ? EdgeName{EdgeName::Kind::kSource, edge}
                              : EdgeName{EdgeName::Kind::kSplitter, -1 - edge});
  }
  return {fragment.source, rotated_to_least(std::move(edges))};
}

Line line_of(const std::vector<std::int64_t>& near_first,
             const std::vector<std::int64_t>& far_first) {
  Line line;
  const auto add = [&line](std::int64_t number) { line.add(number); };
  line.add_list(near_first, add);
  line.add_list(far_first, add);
  return line;
}

/// The orders of one tree for many eyes.
void ask_orders(Inquiry& inquiry, agree::Kind kind, const Scene& scene,
                Draws& draws) {
  BuildOptions options;
  options.seed = draws.next();
  const ref::BspTree exact = ref::build(scene, options);
  const fast::BspTree quick = fast::build(scene, options);
  const Numbers numbers(exact);
  for (int k = 0; k < kEyes; ++k) {
    const Camera camera = agree::random_camera(kind, scene, 16, 16, draws);
    std::vector<std::int64_t> shown;
    const ref::Visitor by_ref = [&](const ref::Node&, const ref::Fragment& f) {
      shown.push_back(numbers.of(ref::name_of(f)));
      return true;
    };
    const fast::Visitor by_fast = [&](const fast::Node&,
                                      const fast::TreeFragment& f) {
      shown.push_back(numbers.of(name_of(quick, f)));
      return true;
    };
    const auto taken = [&shown] { return std::exchange(shown, {}); };
    ref::front_to_back(exact, camera, by_ref);
    const auto ref_near = taken();
    ref::back_to_front(exact, camera, by_ref);
    const auto ref_far = taken();
    fast::front_to_back(quick, scene, camera, by_fast);
    const auto fast_near = taken();
    fast::back_to_front(quick, scene, camera, by_fast);
    const auto fast_far = taken();
    inquiry.ask(question_of(exact, numbers, camera),
                {{"ref::front_to_back", line_of(ref_near, ref_far)},
                 {"fast::front_to_back", line_of(fast_near, fast_far)}});
  }
}

}  // namespace

std::uint64_t ask_geometry(Inquiry& inquiry, std::uint64_t seed,
                           std::uint64_t count) {
  Draws draws(seed);
  const std::uint64_t before = inquiry.asked();
  while (inquiry.asked() - before < count) {
    for (const agree::Kind kind : agree::kKinds) {
      for (const int bits : kGridBits) {
        const Scene scene = agree::random_scene(kind, bits, kPolygons, draws);
        ask_splits(inquiry, scene);
        ask_orders(inquiry, kind, scene, draws);
      }
    }
  }
  return inquiry.asked() - before;
}

}  // namespace halfspace::oracle
