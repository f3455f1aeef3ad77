#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "generate/random_scenes.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/fast/tree_file.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/scene_file.hpp"

/// Prints hashes of what the libraries make: the same bytes whatever compiled
/// them, how far it optimised, and how many threads work.
namespace halfspace {
namespace {

/// FNV-1a of 64 bits.
class Hash {
 public:
  void add(std::uint64_t value) {
    for (int k = 0; k < 8; ++k, value >>= 8) {
      state_ = (state_ ^ (value & 255)) * 0x100000001b3u;
    }
  }
  void add(const std::string& text) {
    add(text.size());
    for (const char c : text) add(static_cast<unsigned char>(c));
  }
  void add(const ItemImage& image) {
    for (const PolygonId id : image.pixels)
      add(static_cast<std::uint64_t>(id) + 1);
  }
  void add(const ColorImage& image) {
    for (const Rgb c : image.pixels)
      add(std::uint64_t{c.r} << 16 | std::uint64_t{c.g} << 8 | c.b);
  }
  void add(const TreeName& tree) {
    for (const NodeName& node : tree) {
      add(static_cast<std::uint64_t>(node.splitter));
      add(static_cast<std::uint64_t>(node.positive) + 1);
      add(static_cast<std::uint64_t>(node.negative) + 1);
      for (const FragmentName& fragment : node.coincident) {
        add(static_cast<std::uint64_t>(fragment.source));
        for (const EdgeName edge : fragment.edges) {
          add(static_cast<std::uint64_t>(edge.kind) << 32 |
              static_cast<std::uint32_t>(edge.index));
        }
      }
    }
  }
  void add(const fast::FilterStats& stats) {
    add(stats.filtered);
    add(stats.exact);
    add(stats.zero);
  }
  std::string text() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(state_));
    return text;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

struct View {
  Scene scene;
  Camera camera;
  ImageOptions options;
};

View view_of(agree::Kind kind, int bits, std::uint64_t seed, int polygons,
             std::int32_t size) {
  agree::Draws draws(seed);
  View view;
  view.scene = agree::random_scene(kind, bits, polygons, draws, true);
  view.camera = agree::random_camera(kind, view.scene, size, size, draws);
  view.options.shading = seed % 2 == 0 ? Shading::kGouraud : Shading::kFlat;
  return view;
}

/// What the reference and the fast library make of small views.
void hash_small(agree::Kind kind, bool with_inner, std::ostream& out) {
  Hash scenes, trees, images, decisions;
  for (const int bits : kGridBits) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const View v = view_of(kind, bits, seed, 10, 24);
      scenes.add(write_scene({v.scene, v.camera, v.options}));
      BuildOptions build;
      build.rule = static_cast<RootRule>(seed % 9);
      const auto tree = ref::build(v.scene, build);
      trees.add(ref::name_of(tree));
      fast::FilterStats stats;
      const auto other = fast::build(v.scene, build, stats);
      trees.add(fast::name_of(other));
      decisions.add(stats);
      const auto one = ref::render(v.scene, tree, v.camera, v.options);
      const auto two = fast::render(v.scene, other, v.camera, v.options);
      const auto three = fast::paint(v.scene, other, v.camera, v.options);
      for (const auto* image : {&one.items, &two.items, &three.items})
        images.add(*image);
      for (const auto* image : {&one.colors, &two.colors, &three.colors})
        images.add(*image);
    }
  }
  out << "scenes " << agree::name_of(kind) << ' ' << scenes.text() << '\n'
      << "trees " << agree::name_of(kind) << ' ' << trees.text() << '\n'
      << "images " << agree::name_of(kind) << ' ' << images.text() << '\n';
  if (with_inner) {
    out << "decisions " << agree::name_of(kind) << ' ' << decisions.text()
        << '\n';
  }
}

/// What the fast library makes of a larger one: by one thread and by several,
/// with the loops of this machine and with those of every machine. All the
/// same hash.
void hash_large(bool with_inner, std::ostream& out) {
  const View v = view_of(agree::Kind::kWide, 40, 8, 400, 300);
  for (const int threads : {1, 2, 4}) {
    fast::DisplayTreeOptions display;
    display.threads = threads;
    const auto tree = fast::build_display_tree(v.scene, display);
    Hash saved;
    saved.add(tree.nodes.size());
    saved.add(tree.fragments.size());
    saved.add(tree.corners.size());
    if (with_inner) {
      out << "display tree, " << threads << " threads " << saved.text() << '\n';
    }
    constexpr std::pair<fast::SimdLevel, const char*> kAll[] = {
        {fast::SimdLevel::kBest, " "},
        {fast::SimdLevel::kAvx2, ", AVX2 "},
        {fast::SimdLevel::kPortable, ", portable "}};
    for (const auto& [level, name] : kAll) {
      fast::RenderOptions options;
      options.threads = threads;
      options.simd = level;
      const auto rendering =
          fast::render(v.scene, tree, v.camera, v.options, options);
      Hash hash;
      hash.add(rendering.items);
      hash.add(rendering.colors);
      out << "large image, " << threads << " threads" << name << hash.text()
          << '\n';
    }
  }
}

/// What an import and booleans make.
void hash_solids(std::ostream& out) {
  const std::string off =
      "OFF\n4 4 0\n0 0 0\n1.5 0 0\n0 2 0\n0 0 0.25\n"
      "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const auto mesh = io::read_mesh(off, io::Format::kOff);
  const Scene scene = io::import_scene(*mesh, {})->scene;
  Hash imported;
  imported.add(write_scene({scene, {}, {}}));
  SceneData data = scene.data();
  for (GridPoint& p : data.vertices) p = {p.y, p.z + 1, p.x};
  const auto a = ref::to_solid(*make_solid(scene));
  const auto b = ref::to_solid(*make_solid(*make_scene(data)));
  Hash booleans;
  for (const BooleanOp operation :
       {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference}) {
    const auto result = ref::boolean(operation, a, b, {});
    for (const ref::Face& face : result.faces) {
      for (const ref::Point& p : face.vertices) {
        for (const ref::Rational* value : {&p.x, &p.y, &p.z})
          booleans.add(value->big().str());
      }
    }
  }
  out << "import " << imported.text() << '\n'
      << "booleans " << booleans.text() << '\n';
}

/// Random heights over a field of squares, closed below. `turned`: stood on
/// its edge, across one that lies.
GridSolid field(std::uint64_t seed, bool turned) {
  constexpr int kSquares = 20;
  agree::Draws draws(seed);
  SceneData data;
  for (int i = 0; i <= kSquares; ++i) {
    for (int j = 0; j <= kSquares; ++j) {
      const std::int64_t height = draws.from_to(1, 6000);
      for (const std::int64_t z : {std::int64_t{0}, height}) {
        const GridPoint p{1000 * i, 1000 * j, z};
        data.vertices.push_back(turned ? GridPoint{p.z + 7137, p.x, p.y - 9333}
                                       : p);
      }
    }
  }
  const auto add = [&](const std::vector<VertexId>& corners) {
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  };
  const auto low = [](int i, int j) { return 2 * (i * (kSquares + 1) + j); };
  const auto high = [&](int i, int j) { return low(i, j) + 1; };
  for (int i = 0; i < kSquares; ++i) {
    for (int j = 0; j < kSquares; ++j) {
      add({high(i, j), high(i + 1, j), high(i + 1, j + 1)});
      add({high(i, j), high(i + 1, j + 1), high(i, j + 1)});
      add({low(i, j), low(i, j + 1), low(i + 1, j + 1), low(i + 1, j)});
    }
    const int n = kSquares, k = i + 1;
    add({low(i, 0), low(k, 0), high(k, 0), high(i, 0)});
    add({low(k, n), low(i, n), high(i, n), high(k, n)});
    add({low(0, k), low(0, i), high(0, i), high(0, k)});
    add({low(n, i), low(n, k), high(n, k), high(n, i)});
  }
  return *make_solid(*make_scene(std::move(data)));
}

/// Booleans of the fast library by one thread and by several. The points where
/// something turns are those of the result; what polygons it is made of is not.
void hash_fast_booleans(bool with_inner, std::ostream& out) {
  const fast::Solid a = fast::to_solid(field(1, false));
  for (const int threads : {1, 2, 4}) {
    const auto name = std::to_string(threads) + " threads ";
    Hash points, polygons;
    const auto add = [&](const fast::Solid& solid) {
      const auto least = fast::to_mesh(
          fast::merge_faces(solid, fast::Merge::kPlane), {.triangles = true});
      for (const auto& vertex : least.vertices) {
        for (const double c : vertex)
          points.add(std::bit_cast<std::uint64_t>(c));
      }
      const auto mesh = fast::to_mesh(solid, {.threads = threads});
      for (const VertexId corner : mesh.corners)
        polygons.add(static_cast<std::uint64_t>(corner));
      for (const std::uint32_t first : mesh.first_corner) polygons.add(first);
    };
    const fast::Solid b = fast::to_solid(field(2, true), a);
    add(fast::boolean(BooleanOp::kSymmetricDifference, a, b, threads));
    for (const BooleanOp operation :
         {BooleanOp::kUnion, BooleanOp::kIntersection,
          BooleanOp::kDifference}) {
      add(fast::boolean(operation, a, b, threads));
    }
    add(fast::boolean_all(BooleanOp::kDifference,
                          std::vector{a, b, fast::to_solid(field(3, true))},
                          threads));
    out << "fast booleans, " << name << points.text() << '\n';
    if (with_inner)
      out << "their polygons, " << name << polygons.text() << '\n';
  }
}

}  // namespace
}  // namespace halfspace

/// Prints the hashes. With a file's name: compares them with those in it. With
/// --all: also those of what no clause fixes, how decisions were taken and what
/// the tree for display looks like. They may change from version to version,
/// not from compiler to compiler.
int main(int count, char** words) {
  const bool with_inner = count > 1 && std::strcmp(words[1], "--all") == 0;
  std::ostringstream out;
  for (const auto kind : halfspace::agree::kKinds)
    halfspace::hash_small(kind, with_inner, out);
  halfspace::hash_large(with_inner, out);
  halfspace::hash_solids(out);
  halfspace::hash_fast_booleans(with_inner, out);
  std::fputs(out.str().c_str(), stdout);
  if (count < 2 || with_inner) return 0;
  std::ifstream in(words[1]);
  const std::string expected{std::istreambuf_iterator<char>(in), {}};
  if (expected == out.str()) return 0;
  std::fprintf(stderr, "%s holds other hashes:\n%s", words[1],
               expected.c_str());
  return 1;
}
