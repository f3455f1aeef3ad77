#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "generate/random_scenes.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/scene_file.hpp"

namespace {

/// The allocations of the task that is being watched.
bool is_watched = false;
std::size_t allocations = 0;
std::size_t fails_at = 0;  ///< 0: none does

void* allocate(std::size_t size, std::size_t alignment) {
  if (is_watched && ++allocations == fails_at) throw std::bad_alloc();
  size = (size + alignment - 1) / alignment * alignment;
  void* const memory = alignment <= alignof(std::max_align_t)
                           ? std::malloc(size)
                           : std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// Never inlined: a compiler that sees one of a pair only calls them mismatched.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return allocate(size == 0 ? 1 : size, 1);
}
[[gnu::noinline]] void* operator new(std::size_t size,
                                     std::align_val_t alignment) {
  return allocate(size == 0 ? 1 : size, static_cast<std::size_t>(alignment));
}
// Where it is left to a sanitizer, it does not go with the operators below.
[[gnu::noinline]] void* operator new(std::size_t size,
                                     const std::nothrow_t&) noexcept {
  try {
    return allocate(size == 0 ? 1 : size, 1);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory,
                                       std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t,
                                       std::align_val_t) noexcept {
  std::free(memory);
}

namespace halfspace {
namespace {

/// Something to do, whose result is a text to compare.
struct Task {
  const char* name;
  std::function<std::string()> run;
};

std::string text_of(const ItemImage& image) {
  std::string text;
  for (const PolygonId id : image.pixels) text += std::to_string(id) + " ";
  return text;
}

SceneFile small_view(agree::Kind kind) {
  agree::Draws draws(5);
  SceneFile view;
  view.scene = agree::random_scene(kind, 26, 5, draws, true);
  view.camera = agree::random_camera(kind, view.scene, 9, 7, draws);
  view.options.shading = Shading::kGouraud;
  return view;
}

/// A tetrahedron, as a mesh file.
constexpr const char* kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1.5 0 0\n0 2 0\n0 0 0.25\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

GridSolid tetrahedron() {
  const auto mesh = io::read_mesh(kTetrahedron, io::Format::kOff);
  return *make_solid(io::import_scene(*mesh, {})->scene);
}

std::vector<Task> tasks() {
  const SceneFile view = small_view(agree::Kind::kSmall);
  const GridSolid solid = tetrahedron();
  const std::string text = write_scene(view);
  return {
      {"reading a scene", [text] { return write_scene(*read_scene(text)); }},
      {"importing a mesh",
       [] {
         const auto mesh = io::read_mesh(kTetrahedron, io::Format::kOff);
         return write_scene({io::import_scene(*mesh, {})->scene, {}, {}});
       }},
      {"the reference's image",
       [view] {
         return text_of(ref::render(view.scene, ref::build(view.scene, {}),
                                    *view.camera, view.options)
                            .items);
       }},
      {"the fast library's image",
       [view] {
         return text_of(fast::render(view.scene, fast::build(view.scene, {}),
                                     *view.camera, view.options)
                            .items);
       }},
      {"the image over a tree for display",
       [view] {
         fast::DisplayTreeOptions options;
         options.leaf_size = 1;
         options.threads = 1;
         return text_of(
             fast::render(view.scene,
                          fast::build_display_tree(view.scene, options),
                          *view.camera, view.options)
                 .items);
       }},
      {"the painter's image over an inserted tree",
       [view] {
         fast::BspTree tree;
         for (std::size_t p = 0; p < view.scene.polygon_count(); ++p)
           fast::insert(tree, view.scene, static_cast<PolygonId>(p));
         return text_of(
             fast::paint(view.scene, tree, *view.camera, view.options).items);
       }},
      {"the reference's boolean",
       [solid] {
         const auto a = ref::to_solid(solid);
         const auto both = ref::boolean(BooleanOp::kIntersection, a, a, {});
         return std::to_string(both.faces.size());
       }},
      {"the fast library's boolean",
       [solid] {
         const auto a = fast::to_solid(solid);
         const auto half = fast::half_space(
             {GridPoint{1, 0, 0}, GridPoint{1, 1, 0}, GridPoint{1, 0, 1}}, a);
         const auto part = fast::boolean(BooleanOp::kIntersection, a, half);
         const auto rest = fast::boolean(BooleanOp::kDifference, a, part);
         return std::to_string(part.faces.size()) + " " +
                std::to_string(
                    fast::merge_faces(rest, fast::Merge::kPlane).faces.size());
       }},
  };
}

/// Runs the task with its allocation number `n` failing, none if that is 0;
/// tells whether it ended with bad_alloc.
bool fails(const Task& task, std::size_t n, std::string& result) {
  allocations = 0;
  fails_at = n;
  is_watched = true;
  bool failed = false;
  try {
    result = task.run();
  } catch (const std::bad_alloc&) {
    failed = true;
  }
  is_watched = false;
  return failed;
}

/// Whichever allocation fails, that is what is reported, and nothing else
/// changes: nothing is lost, torn or remembered.
TEST(Faults, EveryAllocationMayFail) {
  for (const Task& task : tasks()) {
    SCOPED_TRACE(task.name);
    std::string expected;
    ASSERT_FALSE(fails(task, 0, expected));
    ASSERT_FALSE(fails(task, 0, expected));
    const std::size_t count = allocations;
    RecordProperty(task.name, std::to_string(count));
    EXPECT_GT(count, 10u);
    EXPECT_FALSE(expected.empty());
    std::size_t failed = 0;
    for (std::size_t n = 1; n <= count; ++n) {
      std::string result;
      if (fails(task, n, result)) {
        ++failed;
      } else {
        // Some do without: std::stable_sort then takes longer.
        ASSERT_EQ(result, expected) << "allocation " << n;
      }
    }
    EXPECT_GT(10 * failed, 9 * count);
    std::string again;
    ASSERT_FALSE(fails(task, 0, again));
    EXPECT_EQ(again, expected);
  }
}

/// Counts that a file only claims take no memory.
TEST(Faults, HugeCountsInHeadersAreRefusedCheaply) {
  const std::string stl = std::string(80, ' ') + "\xff\xff\xff\xff" + "short";
  const std::pair<io::Format, std::string> files[] = {
      {io::Format::kOff, "OFF\n4000000000 4000000000 0\n0 0 0\n"},
      {io::Format::kOff, "OFF\n99999999999999999999 1 0\n0 0 0\n"},
      {io::Format::kOff, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n"},
      {io::Format::kPly,
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
       "property float y\nproperty float z\nelement face 4000000000\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n"},
      {io::Format::kPly,
       "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float "
       "x\nproperty float y\nproperty float z\nelement face 1\nproperty list "
       "uint int vertex_indices\nend_header\n"
       "............\xff\xff\xff\xff...."},
      {io::Format::kStl, stl},
      {io::Format::kObj, "v 0 0 0\nf 999999999999999999999 1 1\n"},
  };
  for (const auto& [format, bytes] : files) {
    SCOPED_TRACE(bytes.substr(0, 40));
    allocations = 0;
    fails_at = 0;
    is_watched = true;
    const auto mesh = io::read_mesh(bytes, format);
    is_watched = false;
    ASSERT_FALSE(mesh.has_value());
    EXPECT_FALSE(mesh.error().message.empty());
    EXPECT_LT(allocations, 200u);
  }
  const auto scene = read_scene(
      "halfspace-scene 1\nunit 2 0\ngrid 26\nv 0 0 0\np 0 99999999999 2 color "
      "0 0 0\nend\n");
  EXPECT_FALSE(scene.has_value());
}

}  // namespace
}  // namespace halfspace
