#include "laws/law.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "generate/troubles.hpp"
#include "laws/report.hpp"

namespace halfspace::law {
namespace {

namespace fs = std::filesystem;

/// Cases tried since take_case_count(). Laws are checked by one thread.
std::uint64_t case_count = 0;

/// A report looks at one view in this number.
constexpr std::uint64_t kLookedAt = 8;

/// The scene files of a folder, in order of name.
std::vector<fs::path> scene_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".scene") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The scene file to which the laws are to be confined, if any.
const char* only_scene() { return std::getenv("HALFSPACE_REPLAY"); }

/// Ends the test as it stands: what it would go on to say of the number and
/// kinds of its cases is not about one scene.
[[noreturn]] void end_test() {
  using Part = ::testing::TestPartResult;
  throw ::testing::AssertionException(
      Part(Part::kSuccess, __FILE__, __LINE__, "replayed"));
}

/// Replays a property on the saved scenes of a folder, or on the only one.
void replay(const fs::path& folder, bool needs_camera,
            const std::function<void(const SceneFile&)>& property) {
  const std::vector<fs::path> files = only_scene() != nullptr
                                          ? std::vector<fs::path>{only_scene()}
                                          : scene_files(folder);
  EXPECT_FALSE(files.empty()) << "no saved scenes in " << folder;
  for (const fs::path& path : files) {
    const auto file = read_scene(text_of(path));
    if (!file || (needs_camera && !file->camera)) {
      ADD_FAILURE() << path << ": "
                    << (file ? "has no camera" : file.error().message);
      continue;
    }
    ++case_count;
    try {
      property(*file);
    } catch (const Broken& broken) {
      ADD_FAILURE() << path << ": " << broken.what();
    }
  }
}

/// Saves a scene on which the current law fails, and says where. Called again
/// for every smaller one; the last is the smallest.
std::string save(const SceneFile& view) {
  const char* folder = std::getenv("HALFSPACE_COUNTEREXAMPLES");
  const fs::path path =
      fs::path(folder == nullptr ? "." : folder) / (law_name() + ".scene");
  std::ofstream(path, std::ios::binary) << write_scene(view);
  return fs::absolute(path).string();
}

void check_saving(const std::function<SceneFile()>& draw, int count,
                  const std::function<void(const SceneFile&)>& property) {
  check(count, [&] {
    const SceneFile view = draw();
    try {
      property(view);
    } catch (const Broken& broken) {
      throw Broken(broken.what() + ("\nsaved as " + save(view)));
    }
  });
}

}  // namespace

int runs(int count) {
  const char* factor = std::getenv("HALFSPACE_PROPTEST_RUNS");
  return factor == nullptr ? count : count * std::max(1, std::atoi(factor));
}

std::uint64_t take_case_count() { return std::exchange(case_count, 0); }

void note(const std::string& name, std::uint64_t count) {
  if (is_reporting()) Report::instance().note(name, count);
}

bool is_reporting() { return Report::instance().is_wanted(); }

std::string law_name() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  // "S4Screen/0" and "L3LitPixelsAre..." give "s4-l3".
  const auto stem = [](const std::string& name) {
    std::size_t end = 1;
    while (end < name.size() && std::isdigit(name[end]) != 0) ++end;
    return static_cast<char>(std::tolower(name[0])) + name.substr(1, end - 1);
  };
  return stem(info->test_suite_name()) + "-" + stem(info->name());
}

void check(int count, const std::function<void()>& property) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name =
      std::string(info->test_suite_name()) + "/" + info->name();
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = runs(count);
  const auto result = rc::detail::checkTestable(
      [&] {
        ++case_count;
        try {
          property();
        } catch (const Broken& broken) {
          if (is_reporting()) Report::instance().add_failure();
          RC_FAIL(broken.what());
        }
        if (is_reporting()) Report::instance().add_case();
      },
      rc::detail::TestMetadata{name, info->name()}, params);
  if (result.is<rc::detail::SuccessResult>()) return;
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  ADD_FAILURE() << message.str();
}

void for_all(const generate::Views& views, int count,
             const std::function<void(const SceneFile&)>& property) {
  replay(HALFSPACE_REGRESSIONS, /*needs_camera=*/true, property);
  if (only_scene() != nullptr) end_test();
  check_saving([&] { return *views; }, count, property);
}

void for_all_views(const std::function<void(const SceneFile&)>& property,
                   int count) {
  // Few views need not have everything.
  Cases troubles(count < kViews ? std::set<std::string>{}
                                : generate::common_troubles());
  std::uint64_t seen = 0;
  for_all(generate::views(), count, [&](const SceneFile& view) {
    for (const std::string& found :
         generate::troubles_in(view, troubles.missing()))
      troubles.meet(found);
    // To look for all troubles takes as long as many a law.
    if (is_reporting() && seen++ % kLookedAt == 0) {
      note("views looked at");
      for (const auto& found :
           generate::troubles_in(view, generate::all_troubles()))
        note(found);
    }
    property(view);
  });
  troubles.expect_all();
}

void for_all_solids(
    const std::function<void(const generate::SolidPair&)>& property,
    int count) {
  const auto of_file = [&](const SceneFile& file) {
    property(generate::solids_of(file));
  };
  replay(fs::path(HALFSPACE_REGRESSIONS) / "solids", /*needs_camera=*/false,
         of_file);
  if (only_scene() != nullptr) end_test();
  check_saving([] { return generate::both_of(*generate::solid_pairs()); },
               count, of_file);
}

void for_all_soups(const std::function<void(const Scene&)>& property,
                   int count) {
  const auto of_file = [&](const SceneFile& file) { property(file.scene); };
  replay(fs::path(HALFSPACE_REGRESSIONS) / "soups", /*needs_camera=*/false,
         of_file);
  if (only_scene() != nullptr) end_test();
  check_saving([] { return *generate::soups(); }, count, of_file);
}

}  // namespace halfspace::law
