#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "core/session.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/solid.hpp"

namespace halfspace::viewer {

namespace fs = std::filesystem;

class ViewerSession : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("halfspace-viewer-" + std::string(test->name()) + "-" +
               std::to_string(::getpid()));
    fs::create_directories(folder_);
    ball_ = path("ball.stl");
    box_ = path("box.off");
    ASSERT_TRUE(Solid::sphere(1, 24).save(ball_));
    ASSERT_TRUE(Solid::box({0, 0, 0}, {2, 2, 2}).save(box_));
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  static State state_of(std::initializer_list<std::string> paths) {
    State state;
    for (const std::string& p : paths)
      state.parts.push_back({p, true, std::nullopt, {}});
    return state;
  }

  /// Long enough for a thread to end the work of these tests.
  static void let_threads_work() {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  /// Waits for threads, as a window does.
  static void settle(Session& session) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    session.update();
    if (const auto found = session.take_found()) session.set_camera(*found);
    while (!session.is_settled() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      session.update();
      if (const auto found = session.take_found()) session.set_camera(*found);
    }
    ASSERT_TRUE(session.is_settled());
  }

  /// Sees all of it from a side.
  static void see_from(Session& session, const io::ViewDirection& side) {
    session.seek_side(side);
    settle(session);
  }

  static std::optional<ColorImage> finished(const Session& session) {
    const auto shown = session.shown();
    return shown ? shown->finished : std::nullopt;
  }

  static ItemImage items_of(const Session& session) {
    const PictureRequest picture = session.shown()->picture;
    return fast::render(picture.model->loaded.file.scene, *picture.model->tree,
                        picture.camera, picture.options)
        .items;
  }

  /// What `halfspace render` makes of the `.view` file of the state.
  ColorImage rendered(const State& state) const {
    const std::string file = path("state.view");
    EXPECT_TRUE(write_state(file, state));
    const auto loaded = load_view(file, Sections::kByPlanes);
    EXPECT_TRUE(loaded);
    const auto tree = fast::build_display_tree(loaded->file.scene);
    return fast::render(loaded->file.scene, tree, *loaded->file.camera,
                        loaded->file.options)
        .colors;
  }

  fs::path folder_;
  std::string ball_, box_;
};

inline void ignore() {}

}  // namespace halfspace::viewer
