#include "halfspace/fast/tree_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "halfspace/fast/display_tree.hpp"
#include "scenes.hpp"

namespace halfspace::fast {
namespace {

/// Walls across each other, so that trees have cuts.
Scene walls(std::int64_t count, std::int64_t at) {
  SceneData data;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t x = 10 * k + at;
    add_polygon(data, {{x, -500, -500}, {x + 1, 500, -500}, {x, 0, 500}});
    add_polygon(data, {{-500, x, -500}, {500, x + 1, -500}, {0, x, 500}});
  }
  return made(std::move(data));
}

BspTree tree_of(const Scene& scene) {
  DisplayTreeOptions options;
  options.leaf_size = 2;
  options.cut_weight = 0;
  return build_display_tree(scene, options);
}

TEST(TreeFile, GivesBackTheTree) {
  const Scene scene = walls(6, 0);
  const BspTree tree = tree_of(scene);
  ASSERT_FALSE(tree.cut_vertices.empty());
  ASSERT_FALSE(tree.free_planes.empty());
  const auto bytes = encode_tree(tree, scene);
  const Result<BspTree> again = decode_tree(bytes, scene);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(name_of(*again), name_of(tree));
  EXPECT_EQ(again->corners, tree.corners);
  EXPECT_EQ(again->free_planes, tree.free_planes);
  EXPECT_EQ(again->boxes, tree.boxes);
  // Every array is told apart by its bytes.
  EXPECT_EQ(encode_tree(*again, scene), bytes);
}

TEST(TreeFile, HoldsTreesOfRulesAndOfNothing) {
  const Scene scene = walls(5, 0);
  for (const BspTree& tree : {build(scene, {}), BspTree()}) {
    const auto again = decode_tree(encode_tree(tree, scene), scene);
    ASSERT_TRUE(again.has_value()) << again.error().message;
    EXPECT_EQ(name_of(*again), name_of(tree));
    EXPECT_EQ(again->boxes, tree.boxes);
  }
}

TEST(TreeFile, EveryChangedByteIsFound) {
  const Scene scene = walls(3, 0);
  auto bytes = encode_tree(tree_of(scene), scene);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    for (const int change : {1, 0x80, 0xff}) {
      bytes[k] ^= static_cast<std::byte>(change);
      EXPECT_FALSE(decode_tree(bytes, scene).has_value()) << "byte " << k;
      bytes[k] ^= static_cast<std::byte>(change);
    }
  }
  EXPECT_TRUE(decode_tree(bytes, scene).has_value());
}

TEST(TreeFile, EveryShorterOrLongerFileIsFound) {
  const Scene scene = walls(3, 0);
  auto bytes = encode_tree(tree_of(scene), scene);
  const std::span<const std::byte> all(bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto tree = decode_tree(all.first(size), scene);
    ASSERT_FALSE(tree.has_value());
    EXPECT_EQ(tree.error().code, ErrorCode::kTruncated);
  }
  bytes.push_back({});
  const auto longer = decode_tree(bytes, scene);
  ASSERT_FALSE(longer.has_value());
  EXPECT_EQ(longer.error().code, ErrorCode::kSyntax);
}

TEST(TreeFile, SaysWhatIsWrong) {
  const Scene scene = walls(3, 0);
  const auto good = encode_tree(tree_of(scene), scene);
  const auto code_with = [&](std::size_t byte) {
    auto bytes = good;
    bytes[byte] ^= std::byte{1};
    return decode_tree(bytes, scene).error().code;
  };
  EXPECT_EQ(code_with(0), ErrorCode::kUnknownFormat);   // the magic
  EXPECT_EQ(code_with(8), ErrorCode::kUnknownFormat);   // the version
  EXPECT_EQ(code_with(12), ErrorCode::kUnknownFormat);  // the byte order
  EXPECT_EQ(code_with(16), ErrorCode::kSyntax);
  EXPECT_EQ(code_with(300), ErrorCode::kSyntax);
  EXPECT_EQ(decode_tree(good, walls(3, 1)).error().code, ErrorCode::kBadIndex);
  EXPECT_EQ(decode_tree(good, walls(4, 0)).error().code, ErrorCode::kBadIndex);
}

/// What a checksum cannot find: a file written with bad indices.
TEST(TreeFile, IndicesThatLeadNowhereAreFound) {
  const Scene scene = walls(6, 0);
  const BspTree good = tree_of(scene);
  ASSERT_NE(good.nodes[0].positive, kNoNode);
  ASSERT_FALSE(good.free_planes.empty());
  const auto code_with = [&](auto&& spoil) {
    BspTree tree = good;
    spoil(tree);
    const auto read = decode_tree(encode_tree(tree, scene), scene);
    EXPECT_FALSE(read.has_value());
    return read ? ErrorCode::kEmpty : read.error().code;
  };
  using Tree = BspTree&;
  constexpr ErrorCode kBad = ErrorCode::kBadIndex;
  EXPECT_EQ(code_with([](Tree t) { t.nodes[0].positive = 0; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.nodes[0].positive = 1 << 20; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.nodes[0].splitter = 1 << 20; }), kBad);
  EXPECT_EQ(
      code_with([](Tree t) { t.nodes[0].negative = t.nodes[0].positive; }),
      kBad);
  EXPECT_EQ(code_with([](Tree t) { t.fragments[0].next = 0; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.fragments[0].next = 1 << 20; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.fragments[0].source = -1; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.fragments[0].corner_count = 2; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.corners.pop_back(); }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.corners[0].edge = 3; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.corners[0].vertex = 1 << 20; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.free_planes[0].axis = 3; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.free_planes[0].axis = -1; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.boxes.pop_back(); }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.boxes.push_back({}); }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.corners[0].edge = -(1 << 20); }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.corners[0].vertex = -1; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.corners.back().vertex = -1; }), kBad);
  EXPECT_EQ(code_with([](Tree t) { t.fragments[0].first_corner = ~0u; }), kBad);
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  const auto planes = polygons + static_cast<PlaneId>(good.free_planes.size());
  const auto vertices = static_cast<std::int32_t>(scene.data().vertices.size() +
                                                  good.cut_vertices.size());
  EXPECT_EQ(code_with([=](Tree t) { t.fragments[0].source = polygons; }), kBad);
  EXPECT_EQ(code_with([=](Tree t) { t.nodes[0].splitter = planes; }), kBad);
  EXPECT_EQ(code_with([=](Tree t) { t.corners[0].edge = -1 - planes; }), kBad);
  EXPECT_EQ(code_with([=](Tree t) { t.corners[0].vertex = vertices; }), kBad);
}

TEST(TreeFile, LeavesHaveNoChildren) {
  const Scene scene = walls(6, 0);
  BspTree tree = tree_of(scene);
  // The last node becomes the child of a leaf, and of nothing else.
  const auto last = static_cast<NodeId>(tree.nodes.size() - 1);
  Node* leaf = nullptr;
  for (Node& node : tree.nodes) {
    if (node.positive == last) node.positive = kNoNode;
    if (node.negative == last) node.negative = kNoNode;
    if (!leaf && node.splitter == kNoPlane) leaf = &node;
  }
  ASSERT_NE(leaf, nullptr);
  ASSERT_NE(leaf, &tree.nodes.back());
  EXPECT_TRUE(decode_tree(encode_tree(tree, scene), scene).has_value());
  leaf->positive = last;
  const auto read = decode_tree(encode_tree(tree, scene), scene);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().code, ErrorCode::kBadIndex);
}

/// Makes the header's checksum right again.
void seal(std::vector<std::byte>& bytes) {
  std::uint64_t sum = 0x243f6a8885a308d3u;
  for (std::size_t byte = 0; byte <= 248; byte += 8) {
    std::uint64_t word = 0;  // which comes last, too
    if (byte < 248) std::memcpy(&word, bytes.data() + byte, sizeof(word));
    sum = std::rotl((sum ^ word) * 0x9e3779b97f4a7c15u, 29);
  }
  std::memcpy(bytes.data() + 248, &sum, sizeof(sum));
}

TEST(TreeFile, ArraysThatLieOtherwiseAreRefused) {
  const Scene scene = walls(6, 0);
  const auto good = encode_tree(tree_of(scene), scene);
  auto same = good;
  seal(same);
  ASSERT_EQ(same, good);
  for (std::size_t word = 32; word < 176; word += 8) {
    std::uint64_t was = 0;
    std::memcpy(&was, good.data() + word, sizeof(was));
    // One element more or less may fit into a gap.
    const bool is_count = (word - 32) % 24 == 8;
    for (const std::uint64_t is :
         {was + (is_count ? 64 : 1), was - (is_count ? 64 : 1),
          ~std::uint64_t{0}, std::uint64_t{1} << 60, good.size() / 8}) {
      auto bytes = good;
      std::memcpy(bytes.data() + word, &is, sizeof(is));
      seal(bytes);
      const auto read = decode_tree(bytes, scene);
      ASSERT_FALSE(read.has_value()) << word;
      EXPECT_EQ(read.error().code, ErrorCode::kUnknownFormat);
      EXPECT_EQ(read.error().index, 32);
    }
  }
}

TEST(TreeFile, ErrorsNameTheFile) {
  const Scene scene = walls(1, 0);
  const std::string path = ::testing::TempDir() + "tree_file_errors.tree";
  const auto expect = [&](const Error& error, ErrorCode code,
                          std::int64_t index) {
    EXPECT_EQ(error.code, code);
    EXPECT_EQ(error.index, index);
    EXPECT_EQ(error.message.find(path), 0u) << error.message;
  };
  expect(load_tree(path, scene).error(), ErrorCode::kUnreadable, -1);
  expect(save_tree(path + "/none", BspTree(), scene).error(),
         ErrorCode::kUnwritable, -1);
  std::filesystem::create_directory(path);
  expect(load_tree(path, scene).error(), ErrorCode::kUnreadable, -1);
  std::filesystem::remove(path);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_EQ(save_tree("/dev/full", BspTree(), scene).error().code,
              ErrorCode::kUnwritable);
  }
  std::ofstream(path).close();
  expect(load_tree(path, scene).error(), ErrorCode::kTruncated, 0);
  ASSERT_TRUE(save_tree(path, BspTree(), scene).has_value());
  expect(load_tree(path, walls(1, 1)).error(), ErrorCode::kBadIndex, -1);
  std::remove(path.c_str());
}

TEST(TreeFile, IsWrittenAndRead) {
  const Scene scene = walls(4, 0);
  const BspTree tree = tree_of(scene);
  const std::string path = ::testing::TempDir() + "tree_file_test.tree";
  ASSERT_TRUE(save_tree(path, tree, scene).has_value());
  const auto again = load_tree(path, scene);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(encode_tree(*again, scene), encode_tree(tree, scene));
  std::remove(path.c_str());
  EXPECT_EQ(load_tree(path, scene).error().code, ErrorCode::kUnreadable);
  EXPECT_EQ(save_tree(path + "/none", tree, scene).error().code,
            ErrorCode::kUnwritable);
}

/// So that files of today are read tomorrow: these numbers were worked out
/// from the words of the format.
TEST(TreeFile, BytesAreAlwaysTheSame) {
  const Scene scene = walls(1, 0);
  BspTree tree;
  tree.free_planes = {{0, 5}, {2, -7}};
  const auto bytes = encode_tree(tree, scene);
  const auto word_at = [&](std::size_t byte) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + byte, sizeof(word));
    return word;
  };
  ASSERT_EQ(bytes.size(), 256u + 64);  // two planes, and a gap
  for (std::size_t s = 0; s < 6; ++s) {
    EXPECT_EQ(word_at(32 + 24 * s), s < 5 ? 256u : 320u);
    EXPECT_EQ(word_at(40 + 24 * s), s == 4 ? 2u : 0u);
  }
  for (std::size_t byte = 176; byte < 240; ++byte) {
    EXPECT_EQ(bytes[byte], std::byte{0});
  }
  EXPECT_EQ(word_at(16), 0x5c9cb4cc31c0e16au);   // of the scene
  EXPECT_EQ(word_at(240), 0x74ef01ceb6f9b76bu);  // of what follows the header
  EXPECT_EQ(word_at(248), 0x134afa550cfc8b7au);  // of the header
  const auto again = decode_tree(bytes, scene);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->free_planes, tree.free_planes);
}

TEST(TreeFile, SectionsAreAligned) {
  const Scene scene = walls(4, 0);
  const auto bytes = encode_tree(tree_of(scene), scene);
  for (std::size_t s = 0; s < 6; ++s) {
    std::uint64_t offset = 0;
    std::memcpy(&offset, bytes.data() + 32 + 24 * s, sizeof(offset));
    EXPECT_EQ(offset % 64, 0u);
    EXPECT_LE(offset, bytes.size());
  }
}

}  // namespace
}  // namespace halfspace::fast
