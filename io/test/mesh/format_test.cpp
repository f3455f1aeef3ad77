#include "halfspace/io/format.hpp"

#include <gtest/gtest.h>

#include "mesh/format_table.hpp"

namespace halfspace::io {
namespace {

TEST(Formats, EachEntryStandsAtItsEnumerator) {
  for (const FormatEntry& entry : format_table()) {
    EXPECT_EQ(entry_of(entry.format), &entry) << entry.name;
    EXPECT_EQ(format_of("a" + std::string(entry.extension)), entry.format);
  }
  EXPECT_EQ(entry_of(static_cast<Format>(99)), nullptr);
}

TEST(Formats, ListsNameEveryFormat) {
  EXPECT_EQ(format_extensions(), ".obj, .stl, .ply, .off, .3mf, .glb or .gltf");
  EXPECT_EQ(format_extensions(".scene"),
            ".obj, .stl, .ply, .off, .3mf, .glb, .gltf or .scene");
  EXPECT_EQ(format_names(), "OBJ, STL, PLY, OFF, 3MF, GLB, glTF");
}

}  // namespace
}  // namespace halfspace::io
