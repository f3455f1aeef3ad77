#include "halfspace/io/read_mesh.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

TEST(ReadMesh, CutAnywhereIsAnErrorOrAMeshThatHoldsTogether) {
  for (const auto& [bytes, format] : samples::small_files()) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const Result<Mesh> mesh = read_mesh(bytes.substr(0, size), format);
      if (!mesh) {
        EXPECT_FALSE(mesh.error().message.empty());
        continue;
      }
      for (const VertexId corner : mesh->corners) {
        ASSERT_GE(corner, 0);
        ASSERT_LT(static_cast<std::size_t>(corner), mesh->vertices.size());
      }
      // Only OBJ has no end mark; the others may lack a last blank.
      if (format != Format::kObj) {
        EXPECT_EQ(mesh->face_count(), read_mesh(bytes, format)->face_count())
            << size;
      }
    }
  }
}

TEST(ReadMesh, AnyByteChangedIsAnErrorOrAMeshThatHoldsTogether) {
  for (const auto& [bytes, format] : samples::small_files()) {
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const char other :
           {'\0', ' ', '\n', '9', '-', 'e', '\x7f', '\xff'}) {
        std::string changed = bytes;
        changed[at] = other;
        const Result<Mesh> mesh = read_mesh(changed, format);
        if (!mesh) continue;
        for (const VertexId corner : mesh->corners) {
          ASSERT_GE(corner, 0);
          ASSERT_LT(static_cast<std::size_t>(corner), mesh->vertices.size());
        }
      }
    }
  }
}

TEST(ReadMesh, TellsTheFormatByTheName) {
  EXPECT_EQ(format_of("a/b.OBJ"), Format::kObj);
  EXPECT_EQ(format_of("b.Stl"), Format::kStl);
  EXPECT_EQ(format_of("b.ply.GZ"), Format::kPly);
  EXPECT_EQ(format_of("x.off"), Format::kOff);
  for (const char* name : {"a.abc", "a", "obj", "a.gz", "a.obj.zip", ""}) {
    EXPECT_FALSE(format_of(name)) << name;
  }
}

TEST(ReadMesh, UnpacksGzippedFiles) {
  const samples::TemporaryFile file("cube.ply.gz");
  const std::string bytes = samples::binary_ply(false);
  gzFile packed = gzopen(file.path().c_str(), "wb");
  gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(packed);
  const Result<Mesh> mesh = read_mesh(file.path());
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertices.size(), 4u);

  const std::string whole = *samples::raw_bytes(file.path());
  for (std::size_t size = 2; size + 8 < whole.size(); ++size) {
    samples::write(file.path(), whole.substr(0, size));
    const Result<Mesh> cut = read_mesh(file.path());
    ASSERT_FALSE(cut) << size;
    EXPECT_EQ(cut.error().code, ErrorCode::kTruncated) << size;
  }
  std::string damaged = whole;
  damaged[20] = static_cast<char>(damaged[20] ^ 0x55);
  damaged[21] = static_cast<char>(damaged[21] ^ 0x55);
  samples::write(file.path(), damaged);
  EXPECT_FALSE(read_mesh(file.path()));
}

TEST(ReadMesh, NamesTheFileInEveryError) {
  const samples::TemporaryFile file("bad.obj");
  samples::write(file.path(), "v 1 2\n");
  const struct {
    std::filesystem::path path;
    ErrorCode code;
  } cases[] = {{file.path(), ErrorCode::kSyntax},
               {"/nowhere/at/all.obj", ErrorCode::kUnreadable},
               {std::filesystem::temp_directory_path() / "x.abc",
                ErrorCode::kUnknownFormat}};
  for (const auto& [path, code] : cases) {
    const Result<Mesh> mesh = read_mesh(path);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, code);
    EXPECT_EQ(mesh.error().message.find(path.string()), 0u);
  }
}

}  // namespace
}  // namespace halfspace::io
