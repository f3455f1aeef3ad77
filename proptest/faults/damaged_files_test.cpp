#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "generate/random_scenes.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The files of a corpus that have names; what a fuzzer found has a hash.
std::vector<std::string> corpus(const char* name) {
  constexpr std::size_t kHashLength = 40;
  std::vector<fs::path> paths;
  for (const auto& entry :
       fs::directory_iterator(fs::path(HALFSPACE_CORPUS) / name)) {
    if (entry.path().filename().string().size() < kHashLength)
      paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const fs::path& path : paths) files.push_back(bytes_of(path));
  return files;
}

/// Calls visit(bytes) for the file cut off after every byte, and with every
/// byte changed, in a low bit, in the case of letters, and in the highest bit.
template <class Visit>
void for_all_damages(const std::string& file, const Visit& visit) {
  for (std::size_t k = 0; k < file.size(); ++k) {
    visit(file.substr(0, k));
    for (const int change : {0x01, 0x20, 0x80}) {
      std::string bytes = file;
      bytes[k] = static_cast<char>(bytes[k] ^ change);
      visit(bytes);
    }
  }
}

TEST(Faults, EveryDamagedSceneIsReadExactlyOrRefused) {
  std::size_t read = 0, refused = 0;
  for (const std::string& file : corpus("read_scene")) {
    for_all_damages(file, [&](const std::string& bytes) {
      const auto scene = read_scene(bytes);
      if (!scene) {
        EXPECT_FALSE(scene.error().message.empty());
        ++refused;
        return;
      }
      const auto again = read_scene(write_scene(*scene));
      ASSERT_TRUE(again.has_value()) << bytes;
      ASSERT_TRUE(*again == *scene) << bytes;
      ++read;
    });
  }
  EXPECT_GT(read, 500u);
  EXPECT_GT(refused, 5000u);
}

io::Format format_of(char name) {
  return name == 'o'   ? io::Format::kObj
         : name == 's' ? io::Format::kStl
         : name == 'p' ? io::Format::kPly
         : name == '3' ? io::Format::k3mf
         : name == 'g' ? io::Format::kGlb
         : name == 'j' ? io::Format::kGltf
                       : io::Format::kOff;
}

TEST(Faults, EveryDamagedMeshIsImportedValidOrRefused) {
  std::size_t read = 0, refused = 0;
  for (const std::string& file : corpus("read_mesh")) {
    if (file.empty()) continue;
    const io::Format format = format_of(file[0]);
    for_all_damages(file.substr(1), [&](const std::string& bytes) {
      const auto mesh = io::read_mesh(bytes, format);
      const auto imported = mesh ? io::import_scene(*mesh, {})
                                 : Result<io::Imported>(mesh.error());
      if (!imported) {
        EXPECT_FALSE(imported.error().message.empty());
        ++refused;
        return;
      }
      const auto scene = make_scene(imported->scene.data());
      ASSERT_TRUE(scene.has_value()) << bytes;
      ++read;
    });
  }
  EXPECT_GT(read, 1000u);
  EXPECT_GT(refused, 1000u);
}

/// Writing that is cut off leaves what was there, and nothing beside it.
TEST(Faults, AnInterruptedPictureLeavesTheOldOne) {
  const fs::path folder =
      fs::temp_directory_path() / ("halfspace-" + std::to_string(::getpid()));
  fs::create_directory(folder);
  const fs::path path = folder / "ids.npy";
  const ItemImage small(4, 4, 7);
  ASSERT_TRUE(io::write_npy(path, small).has_value());
  const std::string before = bytes_of(path);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit limited = old;
  limited.rlim_cur = 4096;
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  const auto done = io::write_npy(path, ItemImage(100, 100, 8));
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(done.has_value());
  EXPECT_EQ(done.error().code, ErrorCode::kUnwritable);
  EXPECT_EQ(bytes_of(path), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  // And one that is not cut off replaces it.
  ASSERT_TRUE(io::write_npy(path, ItemImage(100, 100, 8)).has_value());
  EXPECT_GT(bytes_of(path).size(), 40000u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  fs::remove_all(folder);
}

/// The largest image, of which only a corner is asked for, and sizes that are
/// none.
TEST(Faults, ImageSizesAtAndBeyondTheirLimits) {
  agree::Draws draws(3);
  const Scene scene =
      agree::random_scene(agree::Kind::kSmall, 26, 5, draws, false);
  CameraData data =
      agree::random_camera(agree::Kind::kSmall, scene, 8, 8, draws).data();
  for (const std::int32_t size : {0, -1, kMaxImageSize + 1, 2147483647}) {
    for (const bool wide : {true, false}) {
      CameraData bad = data;
      (wide ? bad.width_px : bad.height_px) = size;
      const auto camera = make_camera(bad, scene.grid_bits());
      ASSERT_FALSE(camera.has_value());
      EXPECT_EQ(camera.error().code, ErrorCode::kOutOfRange);
    }
  }
  const Camera small = *make_camera(data, scene.grid_bits());
  const auto expected =
      ref::render(scene, ref::build(scene, {}), small, {}).items;
  // The small image as the last corner of the largest one.
  const std::int32_t moved = kMaxImageSize - 8;
  data.s0 = {data.s0.x - moved * (data.sx.x + data.sy.x),
             data.s0.y - moved * (data.sx.y + data.sy.y),
             data.s0.z - moved * (data.sx.z + data.sy.z)};
  data.width_px = data.height_px = kMaxImageSize;
  const auto large = make_camera(data, scene.grid_bits());
  ASSERT_TRUE(large.has_value()) << large.error().message;
  fast::RenderOptions options;
  options.rectangle = {moved, moved, kMaxImageSize, kMaxImageSize};
  EXPECT_EQ(
      fast::render(scene, fast::build(scene, {}), *large, {}, options).items,
      expected);
}

}  // namespace
}  // namespace halfspace
