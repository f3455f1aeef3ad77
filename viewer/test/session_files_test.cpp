#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "core/combine.hpp"
#include "core/measure.hpp"
#include "core/moves.hpp"
#include "core/session.hpp"
#include "viewer_session.hpp"

namespace halfspace::viewer {
namespace {

const io::ViewDirection kTop = {{0, 0, 1}, {0, 1, 0}};

TEST_F(ViewerSession, ABadFileTakesNothingFromTheState) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  session.change([](State& s) { s.looks.cull = true; });
  session.change([](State& s) {
    s.sections.push_back({{1, 0, 0}, 0.5, true});
  });
  session.change([](State& s) { s.looks.background = {1, 2, 3}; });
  session.set_camera(orbited(*session.camera(), {30, 0}));
  settle(session);
  const State before = session.state();
  const auto picture = finished(session);
  for (const char* name : {"bad.off", "gone.view", "bad.view"}) {
    std::ofstream(path("bad.off")) << "OFF\n3 1 0\n1 2\n";
    std::ofstream(path("bad.view")) << "{\"parts\": 1}";
    session.open({path(name)});
    settle(session);
    EXPECT_NE(session.message().find(name), std::string::npos);
    EXPECT_TRUE(have_same_scene(session.state(), before)) << name;
    EXPECT_EQ(session.state().looks, before.looks) << name;
    EXPECT_EQ(session.state().sections, before.sections) << name;
    EXPECT_TRUE(is_same(*session.camera(), *before.camera)) << name;
    EXPECT_EQ(finished(session), picture) << name;
    EXPECT_EQ(rendered(session.state()), *picture) << name;
  }
  // What is read again afterwards is seen from where the camera is.
  session.reload();
  settle(session);
  EXPECT_TRUE(is_same(*session.camera(), *before.camera));
  session.undo();
  settle(session);
  EXPECT_EQ(session.state().looks.background, (Rgb{255, 255, 255}));
  session.undo();
  EXPECT_TRUE(session.state().sections.empty());
}

TEST_F(ViewerSession, PipesAndFilesWithoutEndAreLeft) {
  ASSERT_EQ(::mkfifo(path("pipe.stl").c_str(), 0600), 0);
  {
    Session session(state_of({path("pipe.stl")}), nullptr, ignore);
    settle(session);
    EXPECT_NE(session.message().find("is a pipe"), std::string::npos);
  }
  // Gigabytes that are not there: whoever leaves does not wait for them.
  for (const char* name : {"huge.stl", "huge.ply", "huge.scene"}) {
    std::ofstream(path(name)).close();
    fs::resize_file(path(name), std::uintmax_t{3} << 30);
    const auto start = std::chrono::steady_clock::now();
    Session session(state_of({path(name)}), nullptr, ignore);
    let_threads_work();
    session.cancel_loading();
    settle(session);
    EXPECT_FALSE(session.model());
    EXPECT_EQ(session.message(), "");
    session.open({box_});
    settle(session);
    EXPECT_TRUE(session.model());
    EXPECT_LT(std::chrono::steady_clock::now() - start,
              std::chrono::seconds(5));
  }
}

/// A tetrahedron of floats whose numbers are far apart.
void write_floats(const std::string& path) {
  const float points[4][3] = {
      {0, 0, 0}, {128, 0, 0}, {0, 128, 0}, {1e-9f, 0.1f, 77.7f}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::ofstream file(path, std::ios::binary);
  file << std::string(80, ' ');
  const std::uint32_t count = 4;
  file.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& face : faces) {
    const float normal[3] = {0, 0, 0};
    file.write(reinterpret_cast<const char*>(normal), sizeof normal);
    for (const int corner : face) {
      file.write(reinterpret_cast<const char*>(points[corner]),
                 sizeof points[corner]);
    }
    file.write("\0", 2);
  }
}

TEST_F(ViewerSession, FloatsAreMeasuredAndCombinedWithCutsByDecimals) {
  write_floats(path("floats.stl"));
  State state = state_of({path("floats.stl"), box_});
  state.sections.push_back({{0, 0, 1}, 0.3, true});
  const auto go_on = [](const std::string&, double) { return true; };
  const auto measures = measures_of(state, go_on);
  ASSERT_TRUE(measures) << measures.error().message;
  EXPECT_NE(measures->find("section of area"), std::string::npos) << *measures;
  EXPECT_NE(measures->find("rounded by"), std::string::npos) << *measures;
  state.combination = Combination::kDifference;
  ASSERT_TRUE(save_combined(state, path("result.stl"), go_on));
  Session session(state, nullptr, ignore);
  settle(session);
  EXPECT_EQ(session.message(), "");
  EXPECT_TRUE(session.model());
}

TEST_F(ViewerSession, AFileThatFailsInsideAGestureKeepsTheLastThatWasShown) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  const auto moved = [](double by) {
    return [by](State& s) { s.parts[0].shift = {by, 0, 0}; };
  };
  session.change(moved(1), 7);
  settle(session);
  session.change([&](State& s) { s.parts[0].path = path("gone.off"); }, 7);
  settle(session);
  EXPECT_EQ(session.state().parts[0].shift[0], 1);
  EXPECT_EQ(session.state().parts[0].path, box_);
  session.undo();
  settle(session);
  EXPECT_EQ(session.state().parts[0].shift[0], 0);
  EXPECT_FALSE(session.can_undo());
}

TEST_F(ViewerSession, AViewBringsItsState) {
  State saved = state_of({ball_, box_});
  saved.looks.background = {9, 8, 7};
  ASSERT_TRUE(write_state(path("saved.view"), saved));
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  session.open({path("saved.view")});
  EXPECT_EQ(session.state().parts.size(), 1u);
  settle(session);
  EXPECT_EQ(session.state().parts, saved.parts);
  EXPECT_EQ(session.state().looks, saved.looks);
  EXPECT_EQ(finished(session), rendered(session.state()));
  session.undo();
  settle(session);
  EXPECT_EQ(session.state().parts.size(), 1u);
  session.redo();
  settle(session);
  EXPECT_EQ(session.state().parts, saved.parts);
  // A camera of its own is taken, in the window's size.
  saved = session.state();
  saved.camera = orbited(*session.camera(), {50, 9});
  saved.camera->width_px = 99;
  ASSERT_TRUE(write_state(path("saved.view"), saved));
  session.set_size(320, 200);
  session.open({path("saved.view")});
  settle(session);
  EXPECT_EQ(session.camera()->eye, saved.camera->eye);
  EXPECT_EQ(session.camera()->width_px, 320);
}

TEST_F(ViewerSession, NothingIsSeenWhereNoFileIsLeft) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  const auto before = finished(session);
  session.change([](State& s) { s.parts.clear(); });
  settle(session);
  EXPECT_FALSE(session.model());
  EXPECT_FALSE(session.shown());
  session.seek_fit();
  EXPECT_FALSE(session.is_seeking());
  session.undo();
  settle(session);
  EXPECT_EQ(finished(session), before);
  // Also where it is still being read.
  session.open({ball_});
  session.change([](State& s) { s.parts.clear(); });
  settle(session);
  let_threads_work();
  session.update();
  EXPECT_FALSE(session.model());
}

TEST_F(ViewerSession, OtherFilesAreNotAskedForTheNumbersOfTheFirst) {
  std::ofstream(path("heat.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
         "property float y\nproperty float z\nproperty float heat\n"
         "element face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 4\n3 0 1 2\n";
  Session session(state_of({path("heat.ply")}), nullptr, ignore);
  settle(session);
  EXPECT_EQ(session.model()->scalar_names,
            (std::vector<std::string>{"heat", "x", "y", "z"}));
  session.change([](State& s) {
    s.looks.scalar.emplace();
    s.looks.scalar->source = "heat";
  });
  settle(session);
  session.open({box_});
  settle(session);
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(session.state().parts[0].path, box_);
  EXPECT_TRUE(session.model()->scalar_names.empty());
  session.undo();
  settle(session);
  EXPECT_TRUE(session.state().looks.scalar);
  EXPECT_TRUE(session.model()->numbers);
}

TEST_F(ViewerSession, CamerasThatSeeAllAreLookedForBesideIt) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  const io::ViewOptions first = *session.camera();
  session.seek_side(kTop);
  EXPECT_TRUE(session.is_seeking());
  EXPECT_FALSE(session.is_settled());
  settle(session);
  EXPECT_FALSE(session.is_seeking());
  const auto top = fitted(session.model()->loaded.file.scene, first, kTop);
  ASSERT_TRUE(top);
  EXPECT_TRUE(is_same(*session.camera(), *top));
  // A hand that moves the camera meanwhile is not taken back.
  session.seek_first();
  session.stop_seeking();
  settle(session);
  EXPECT_TRUE(is_same(*session.camera(), *top));
  session.seek_first();
  settle(session);
  EXPECT_TRUE(is_same(*session.camera(), first));
  // In another size there is another first view.
  session.set_size(200, 600);
  session.seek_first();
  settle(session);
  Session other(state_of({box_}), nullptr, ignore);
  other.set_size(200, 600);
  settle(other);
  EXPECT_TRUE(is_same(*session.camera(), *other.camera()));
}

}  // namespace
}  // namespace halfspace::viewer
