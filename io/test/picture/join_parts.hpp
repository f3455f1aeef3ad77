#pragma once

#include <gtest/gtest.h>

#include "halfspace/io/join.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io::samples {

using Paths = std::vector<std::filesystem::path>;

/// A folder for the parts and the whole of an image.
class JoinTest : public ::testing::Test {
 protected:
  std::filesystem::path at(const std::string& name) const {
    return folder_.path().parent_path() / name;
  }
  std::filesystem::path path() const { return folder_.path(); }

  /// The whole's name in front of the message.
  std::string about(const std::filesystem::path& path,
                    const std::string& what) const {
    return path.string() + ": " + what;
  }

  /// Checks that the parts became one image of that size and those bytes.
  void expect_whole(const Result<JoinedSize>& size, std::int32_t width_px,
                    std::int32_t height_px,
                    const std::optional<std::string>& bytes) const {
    ASSERT_TRUE(size) << size.error().message;
    EXPECT_EQ(size->width_px, width_px);
    EXPECT_EQ(size->height_px, height_px);
    EXPECT_EQ(raw_bytes(path()), bytes);
  }

 private:
  TemporaryFile folder_{"whole"};
};

}  // namespace halfspace::io::samples
