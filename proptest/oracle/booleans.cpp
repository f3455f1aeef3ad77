#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/classify.hpp"
#include "question.hpp"

namespace halfspace::oracle {
namespace {

/// A block with sides along the axes.
struct Block {
  GridPoint least;
  GridPoint greatest;
};

/// The polygons of a block that face along and against x; of the `n`-th block
/// of a solid, 6 n more.
constexpr PolygonId kAlong = 0;
constexpr PolygonId kAgainst = 1;

/// Separate blocks as one solid.
GridSolid solid_of(const std::vector<Block>& blocks) {
  // A corner by the bits of its number: greatest x, y, z.
  constexpr std::array<std::array<int, 4>, 6> kSides = {{{1, 3, 7, 5},
                                                         {0, 4, 6, 2},
                                                         {2, 6, 7, 3},
                                                         {0, 1, 5, 4},
                                                         {4, 5, 7, 6},
                                                         {0, 2, 3, 1}}};
  SceneData data;
  for (const Block& block : blocks) {
    const auto first = static_cast<VertexId>(data.vertices.size());
    for (int k = 0; k < 8; ++k) {
      data.vertices.push_back({(k & 1) ? block.greatest.x : block.least.x,
                               (k & 2) ? block.greatest.y : block.least.y,
                               (k & 4) ? block.greatest.z : block.least.z});
    }
    for (const auto& side : kSides) {
      for (const int corner : side)
        data.corners.push_back(first + static_cast<VertexId>(corner));
      data.first_corner.push_back(
          static_cast<std::uint32_t>(data.corners.size()));
      data.colors.push_back({});
    }
  }
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  auto solid = make_solid(*std::move(scene));
  HALFSPACE_ASSERT(solid.has_value());
  return *std::move(solid);
}

/// What the fast library does with the face kAlong of `operand`.
Keep kept(BooleanOp operation, const GridSolid& operand, const GridSolid& other,
          bool first_operand) {
  const fast::Solid ours = fast::to_solid(operand);
  const fast::Solid theirs = fast::to_solid(other);
  const fast::Solid result = fast::boolean(
      operation, first_operand ? ours : theirs, first_operand ? theirs : ours);
  for (const fast::Face& face : result.faces) {
    if (face.from_first != first_operand || face.source != kAlong) continue;
    return face.flipped == ours.faces[kAlong].flipped ? Keep::kKeep
                                                      : Keep::kFlip;
  }
  return Keep::kDrop;
}

/// A solid against which the face kAlong of the block from 0 to 4 is of that
/// class.
GridSolid other_of(SolidClass solid_class) {
  switch (solid_class) {
    case SolidClass::kInside:
      return solid_of({{{-1, -1, -1}, {5, 5, 5}}});
    case SolidClass::kOutside:
      return solid_of({{{8, 8, 8}, {9, 9, 9}}});
    case SolidClass::kSame:
      return solid_of({{{2, -1, -1}, {4, 5, 5}}});
    case SolidClass::kOpposite:
      break;
  }
  return solid_of({{{4, -1, -1}, {6, 5, 5}}});
}

/// Which of the two sides of the plane x = 4 a stretch of y is inside on.
struct Stretch {
  std::int64_t from;
  std::int64_t to;
  bool inside_beyond;
  bool inside_before;
};
constexpr Stretch kStretches[] = {{0, 2, false, true},
                                  {4, 6, true, false},
                                  {8, 10, true, true},
                                  {12, 14, false, false}};

/// The class of the part of a face that lies in a stretch, -1 if it is of
/// several classes.
int class_in(const Stretch& stretch,
             const std::vector<ref::Classified>& fragments) {
  std::vector<int> classes;
  for (const ref::Classified& one : fragments) {
    const auto& vertices = one.fragment.vertices;
    const auto [low, high] = std::minmax_element(
        vertices.begin(), vertices.end(),
        [](const ref::Point& p, const ref::Point& q) { return p.y < q.y; });
    const bool overlaps = low->y < stretch.to && high->y > stretch.from;
    if (overlaps) classes.push_back(static_cast<int>(one.solid_class));
  }
  const bool alike = !classes.empty() &&
                     std::count(classes.begin(), classes.end(), classes[0]) ==
                         static_cast<std::ptrdiff_t>(classes.size());
  return alike ? classes[0] : -1;
}

Line line_of(int number) {
  Line line;
  line.add(number);
  return line;
}

/// A face in a plane in which `other` has faces of both directions; the tree
/// takes the first.
void ask_classes_of(Inquiry& inquiry, const GridSolid& other, bool along) {
  BuildOptions options;
  options.rule = RootRule::kFirst;
  const ref::BspTree tree = ref::build(ref::to_solid(other), options);
  const ref::Solid block = ref::to_solid(
      solid_of({{{along ? 0 : 4, 0, 1}, {along ? 4 : 8, 14, 2}}}));
  const PolygonId face = along ? kAlong : kAgainst;
  const auto fragments =
      ref::classify(tree, ref::whole(block, face),
                    block.faces[static_cast<std::size_t>(face)].plane);
  const auto class_of = [](bool inside) {
    return static_cast<int>(inside ? SolidClass::kInside
                                   : SolidClass::kOutside);
  };
  for (const Stretch& stretch : kStretches) {
    const Line answer = line_of(class_in(stretch, fragments));
    // First for a splitter along x, then for one against it.
    Line question = line_of(4);
    question.add(class_of(stretch.inside_beyond));
    question.add(class_of(stretch.inside_before));
    question.add(along ? 1 : 0);
    inquiry.ask(question, {{"ref::classify", answer}});
    question = line_of(4);
    question.add(class_of(stretch.inside_before));
    question.add(class_of(stretch.inside_beyond));
    question.add(along ? 0 : 1);
    inquiry.ask(question, {{"ref::classify", answer}});
  }
}

}  // namespace

void ask_table(Inquiry& inquiry) {
  const GridSolid block = solid_of({{{0, 0, 0}, {4, 4, 4}}});
  for (std::size_t o = 0; o < kBooleanOps.size(); ++o) {
    const BooleanOp operation = kBooleanOps[o];
    for (const SolidClass solid_class :
         {SolidClass::kInside, SolidClass::kOutside, SolidClass::kSame,
          SolidClass::kOpposite}) {
      for (const bool first : {false, true}) {
        Line question = line_of(3);
        question.add(static_cast<int>(o));
        question.add(static_cast<int>(solid_class));
        question.add(first ? 1 : 0);
        const Keep by_ref = ref::keep(operation, solid_class, first);
        const Keep by_fast =
            kept(operation, block, other_of(solid_class), first);
        inquiry.ask(question,
                    {{"ref::keep", line_of(static_cast<int>(by_ref))},
                     {"fast::boolean", line_of(static_cast<int>(by_fast))}});
      }
    }
  }
}

void ask_classes(Inquiry& inquiry) {
  std::vector<Stretch> order(std::begin(kStretches), std::end(kStretches));
  // The first block decides which way the splitter faces.
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::rotate(order.begin(), order.begin() + 1, order.end());
    std::vector<Block> blocks;
    for (const Stretch& s : order) {
      if (!s.inside_before && !s.inside_beyond) continue;
      blocks.push_back({{s.inside_before ? 0 : 4, s.from, 0},
                        {s.inside_beyond ? 8 : 4, s.to, 3}});
    }
    for (const bool along : {false, true})
      ask_classes_of(inquiry, solid_of(blocks), along);
  }
}

}  // namespace halfspace::oracle
