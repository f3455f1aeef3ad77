#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include "make_vectors.hpp"
#include "replay_vectors.hpp"

namespace halfspace::vectors {
namespace {

std::string path_of(const std::string& name) {
  return std::string(HALFSPACE_VECTORS "/") + name + ".json";
}

Json read(const std::string& name) {
  std::ifstream in(path_of(name), std::ios::binary);
  EXPECT_TRUE(in) << "cannot read " << path_of(name);
  return Json::parse(in);
}

/// One vector a line, so that a change shows in a comparison of texts.
std::string text_of(const Json& vectors) {
  std::string text = "[";
  const char* before = "\n";
  for (const Json& vector : vectors) {
    text += before + vector.dump();
    before = ",\n";
  }
  return text + "\n]\n";
}

struct File {
  const char* name;
  Json (*make)();
  std::size_t (*replay)(const Json&);
  std::size_t least;  ///< so many comparisons at least
};

void PrintTo(const File& file, std::ostream* out) { *out << file.name; }

constexpr File kFiles[] = {
    {"merges", merge_vectors, replay_merges, 500},
    {"splits", split_vectors, replay_splits, 500},
    {"traversals", traversal_vectors, replay_traversals, 100},
    {"images", image_vectors, replay_images, 100},
    {"booleans", boolean_vectors, replay_booleans, 1000},
};

class Vectors : public ::testing::TestWithParam<File> {};

/// What stands in the file is what the definition says. With
/// HALFSPACE_WRITE_VECTORS set it is written first.
TEST_P(Vectors, AreWhatTheDefinitionSays) {
  const std::string text = text_of(GetParam().make());
  if (std::getenv("HALFSPACE_WRITE_VECTORS") != nullptr)
    std::ofstream(path_of(GetParam().name), std::ios::binary) << text;
  std::ifstream in(path_of(GetParam().name), std::ios::binary);
  const std::string held{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(held == text)
      << path_of(GetParam().name) << " holds something else";
}

TEST_P(Vectors, AreWhatTheImplementationsGive) {
  const std::size_t compared = GetParam().replay(read(GetParam().name));
  RecordProperty("compared", std::to_string(compared));
  EXPECT_GE(compared, GetParam().least);
}

INSTANTIATE_TEST_SUITE_P(Files, Vectors, ::testing::ValuesIn(kFiles),
                         [](const auto& file) {
                           return std::string(file.param.name);
                         });

}  // namespace
}  // namespace halfspace::vectors
