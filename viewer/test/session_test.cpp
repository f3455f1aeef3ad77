#include "core/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "core/background.hpp"
#include "core/measure.hpp"
#include "core/moves.hpp"
#include "core/saving.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/solid.hpp"
#include "halfspace/visible_map.hpp"
#include "viewer_session.hpp"

namespace halfspace::viewer {
namespace {

TEST_F(ViewerSession, IsNotSettledUntilTheModelIsTaken) {
  // A script that looks between the end of loading and update() would else
  // see a session without a model, and nothing to wait for.
  Session session(state_of({box_}), nullptr, ignore);
  let_threads_work();
  EXPECT_TRUE(session.is_loading());
  EXPECT_FALSE(session.is_settled());
  settle(session);
  EXPECT_TRUE(session.model());
  EXPECT_FALSE(session.is_loading());
}

TEST(Background, IsBusyUntilTheResultIsTaken) {
  Background background([] {});
  EXPECT_FALSE(background.is_busy());
  background.start([](const Report&) { return std::string("done"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_TRUE(background.is_busy());
  while (!background.take()) std::this_thread::yield();
  EXPECT_FALSE(background.is_busy());
}

TEST_F(ViewerSession, EveryPictureIsThatOfItsViewFile) {
  Session session(state_of({ball_, box_}), nullptr, ignore);
  session.set_size(161, 123);
  settle(session);
  const std::vector<std::function<void()>> moves = {
      [] {},
      [&] {
        session.set_camera(orbited(*session.camera(), {40, 9}));
      },
      [&] {
        session.set_camera(zoomed(*session.camera(), 0.3, {9, 99}));
      },
      [&] { session.set_camera(with_projection(*session.camera(), true)); },
      [&] { session.change([](State& s) { s.looks.is_smooth = true; }); },
      [&] { session.change([](State& s) {
              s.looks.light = {1, 1, 1};
            }); },
      [&] {
        session.change([](State& s) { s.parts[0].color = Rgb{9, 99, 9}; });
      },
      [&] { session.change([](State& s) {
              s.parts[1].shift = {.1, 0, 0};
            }); },
      [&] {
        session.change(
            [](State& s) { s.combination = Combination::kDifference; });
      },
      [&] {
        session.change([](State& s) {
          s.sections.push_back({{1, 0, -0.5}, 0.4, true});
        });
      },
      [&] { session.undo(); },
      [&] { session.change([](State& s) { s.parts[1].is_visible = false; }); },
      [&] { session.set_size(77, 200); }};
  for (std::size_t i = 0; i < moves.size(); ++i) {
    moves[i]();
    settle(session);
    const auto picture = finished(session);
    ASSERT_TRUE(picture);
    EXPECT_EQ(*picture, rendered(session.state())) << "after move " << i;
  }
}

TEST_F(ViewerSession, ThePolygonUnderTheCursorIsThatOfTheItemImage) {
  Session session(state_of({ball_, box_}), nullptr, ignore);
  session.set_size(97, 71);
  settle(session);
  const ItemImage items = items_of(session);
  for (std::int32_t y = 0; y < 71; y += 2) {
    for (std::int32_t x = 0; x < 97; x += 3) {
      const auto picked = session.pick(x, y);
      EXPECT_EQ(picked ? picked->polygon : kBackground, items.at(x, y));
    }
  }
  EXPECT_FALSE(session.pick(-1, 3));
  EXPECT_FALSE(session.pick(97, 3));
}

TEST_F(ViewerSession, ExactSolidsAreShownAndCombined) {
  const std::string exact = path("box.hsolid");
  ASSERT_TRUE(
      (Solid::box({0, 0, 0}, {1, 3, 1}) & Solid::box({0, 0, 0}, {2, 2, 2}))
          .save(exact));
  Session session(state_of({exact}), nullptr, ignore);
  session.set_size(90, 70);
  settle(session);
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(*finished(session), rendered(session.state()));
  session.add({ball_});
  session.change([](State& s) { s.combination = Combination::kDifference; });
  settle(session);
  EXPECT_EQ(session.message(), "");
  EXPECT_EQ(*finished(session), rendered(session.state()));
  // What is no solid is a message.
  std::ofstream(path("bad.hsolid")) << "nonsense";
  session.open({path("bad.hsolid")});
  settle(session);
  EXPECT_NE(session.message().find("bad.hsolid"), std::string::npos)
      << session.message();
}

TEST_F(ViewerSession, CornersArePickedInFull) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  see_from(session, {{0, 0, 1}, {0, 1, 0}});
  const auto picked = session.pick(330, 230);
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->exact_corner, (std::array<std::string, 3>{"2", "2", "2"}));
  EXPECT_NEAR(picked->point.z, 2, 1e-9);
}

TEST_F(ViewerSession, ABadFileIsAMessageAndTheModelStays) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  const auto before = session.model();
  std::ofstream(path("bad.off")) << "OFF\n3 1 0\n1 2\n";
  session.open({path("bad.off")});
  settle(session);
  EXPECT_EQ(session.model(), before);
  EXPECT_NE(session.message().find("bad.off"), std::string::npos);
  session.open({path("vanished.stl")});
  settle(session);
  EXPECT_EQ(session.model(), before);
  EXPECT_NE(session.message().find("vanished.stl"), std::string::npos);
  session.open({ball_});
  settle(session);
  EXPECT_NE(session.model(), before);
  EXPECT_EQ(session.message(), "");
}

TEST_F(ViewerSession, UndoGivesBackPartsAndLooksButNotTheCamera) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  session.change([](State& s) { s.looks.cull = true; });
  session.add({ball_});
  settle(session);
  session.set_camera(orbited(*session.camera(), {30, 0}));
  const io::ViewOptions camera = *session.camera();
  session.undo();
  session.undo();
  settle(session);
  EXPECT_FALSE(session.can_undo());
  EXPECT_FALSE(session.state().looks.cull);
  EXPECT_EQ(session.state().parts.size(), 1u);
  EXPECT_TRUE(is_same(*session.camera(), camera));
  session.redo();
  session.redo();
  EXPECT_FALSE(session.can_redo());
  EXPECT_EQ(session.state().parts.size(), 2u);
}

TEST_F(ViewerSession, AFileThatChangedIsReadAgainAndTheViewStays) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  session.set_camera(orbited(*session.camera(), {30, 0}));
  const io::ViewOptions camera = *session.camera();
  const auto before = session.model();
  session.reload_if_changed();
  settle(session);
  EXPECT_EQ(session.model(), before);
  ASSERT_TRUE(Solid::box({0, 0, 0}, {2, 2, 1.5}).save(box_));
  fs::last_write_time(
      box_, fs::file_time_type::clock::now() + std::chrono::seconds(5));
  session.reload_if_changed();
  settle(session);
  EXPECT_NE(session.model(), before);
  EXPECT_TRUE(is_same(*session.camera(), camera));
}

TEST_F(ViewerSession, ACameraBeyondTheLatticeIsNotTaken) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  io::ViewOptions far = *session.camera();
  far.eye *= 1e30;
  EXPECT_FALSE(session.set_camera(far));
  far.eye = far.target;
  EXPECT_FALSE(session.set_camera(far));
  EXPECT_NE(session.camera()->eye, far.eye);
}

TEST_F(ViewerSession, ABooleanOfAnOpenSurfaceIsAMessage) {
  std::ofstream(path("open.off"))
      << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  Session session(state_of({box_, path("open.off")}), nullptr, ignore);
  settle(session);
  const auto before = session.model();
  session.change([](State& s) { s.combination = Combination::kUnion; });
  settle(session);
  EXPECT_EQ(session.model(), before);
  EXPECT_NE(session.message(), "");
}

TEST_F(ViewerSession, ASectionIsClosedByACapThatCanBePicked) {
  State state = state_of({box_});
  state.sections.push_back({{0, 0, 1}, 0.5, true});
  Session session(state, nullptr, ignore);
  settle(session);
  see_from(session, {{0, 0, 1}, {0, 1, 0}});
  const auto picked = session.pick(320, 240);
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->part, kCapPart);
  EXPECT_NEAR(picked->point.z, 0.5, 1e-9);
  const auto measures = measures_of(
      session.state(), [](const std::string&, double) { return true; });
  ASSERT_TRUE(measures);
  EXPECT_NE(measures->find("volume 2 = 2\n"), std::string::npos) << *measures;
  EXPECT_NE(measures->find("section of area 4"), std::string::npos)
      << *measures;
}

TEST_F(ViewerSession, CapsOfPartsAreToldApart) {
  State state = state_of({box_, box_});
  state.parts[1].shift = {1, 0, 0};
  state.sections.push_back({{0, 0, 1}, 0.5, true});
  Session session(state, nullptr, ignore);
  settle(session);
  see_from(session, {{0, 0, 1}, {0, 1, 0}});
  const auto left = session.pick(170, 240);
  const auto middle = session.pick(320, 240);
  const auto right = session.pick(470, 240);
  ASSERT_TRUE(left && middle && right);
  EXPECT_EQ(left->part, kCapPart);
  EXPECT_EQ(left->cap_part, 0u);
  EXPECT_EQ(right->cap_part, 1u);
  EXPECT_FALSE(middle->cap_part);
  EXPECT_TRUE(middle->is_overlap);
  EXPECT_FALSE(left->is_overlap);
  const auto measures = measures_of(
      session.state(), [](const std::string&, double) { return true; });
  ASSERT_TRUE(measures);
  const std::string name = std::filesystem::path(box_).filename().string();
  EXPECT_NE(
      measures->find("section of area 6\n  " + name + " 4\n  " + name + " 4"),
      std::string::npos)
      << *measures;
  // Only what is closed by itself is told apart.
  session.change([](State& s) { s.combination = Combination::kUnion; });
  settle(session);
  EXPECT_EQ(session.model()->cap_parts, nullptr);
}

TEST_F(ViewerSession, ASectionMovesWithoutAnotherModel) {
  Session session(state_of({ball_, box_}), nullptr, ignore);
  settle(session);
  const auto model = session.model();
  const auto whole = finished(session);
  for (int i = 0; i < 10; ++i) {
    session.change([i](State& s) {
      s.sections = {{{1, 0.25, 0}, 0.1 * i, true}};
    });
    EXPECT_FALSE(session.is_loading());
    settle(session);
    EXPECT_EQ(session.model(), model);
    EXPECT_EQ(*finished(session), rendered(session.state()));
  }
  session.change([](State& s) { s.sections[0].is_on = false; });
  settle(session);
  EXPECT_EQ(finished(session), whole);
}

TEST_F(ViewerSession, AnOpenSurfaceIsCutWithoutCaps) {
  std::ofstream(path("open.off"))
      << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  State state = state_of({path("open.off")});
  state.sections.push_back({{1, 0, 0}, 0.5, true});
  Session session(state, nullptr, ignore);
  settle(session);
  EXPECT_EQ(session.message(), "");
  const ItemImage items = items_of(session);
  EXPECT_EQ(*std::max_element(items.pixels.begin(), items.pixels.end()), 0);
}

TEST_F(ViewerSession, NumbersColourAFile) {
  std::ofstream(path("heat.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
         "property float y\nproperty float z\nproperty float heat\n"
         "element face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 nan\n3 0 1 2\n";
  Session session(state_of({path("heat.ply")}), nullptr, ignore);
  settle(session);
  const auto plain = finished(session);
  ScalarLook look;
  look.source = "heat";
  look.has_legend = false;
  session.change([&look](State& s) { s.looks.scalar = look; });
  settle(session);
  ASSERT_EQ(session.message(), "");
  ASSERT_TRUE(session.model()->numbers);
  EXPECT_EQ(session.model()->numbers->extent, (std::array<double, 2>{1, 2}));
  EXPECT_TRUE(session.model()->numbers->has_gaps);
  const auto colored = finished(session);
  EXPECT_NE(colored, plain);
  // The range needs no other model.
  const auto model = session.model();
  session.change([](State& s) { s.looks.scalar->has_legend = true; });
  EXPECT_FALSE(session.is_loading());
  settle(session);
  EXPECT_EQ(session.model(), model);
  EXPECT_NE(finished(session), colored);
  // What is not there is a message, and the numbers stay.
  session.change([](State& s) { s.looks.scalar->source = "cold"; });
  settle(session);
  EXPECT_NE(session.message().find("no property 'cold'"), std::string::npos)
      << session.message();
  session.change([](State& s) { s.looks.scalar.reset(); });
  settle(session);
  EXPECT_EQ(finished(session), plain);
}

TEST_F(ViewerSession, WorkIsStoppedInsideAllStages) {
  const std::string many = path("many.off");
  {
    constexpr int kCount = 12000;
    std::ofstream file(many);
    file << "OFF\n" << 3 * kCount << ' ' << kCount << " 0\n";
    for (int i = 0; i < kCount; ++i) {
      const int x = i % 110, y = i / 110;
      file << x << ' ' << y << " 0\n"
           << x + 1 << ' ' << y << " 0\n"
           << x << ' ' << y + 1 << " 1\n";
    }
    for (int i = 0; i < kCount; ++i)
      file << "3 " << 3 * i << ' ' << 3 * i + 1 << ' ' << 3 * i + 2 << '\n';
  }
  const State state = state_of({many});
  // How often each stage asks.
  std::map<std::string, int> counts;
  std::vector<std::string> stages;
  MeshCache cache;
  const auto whole =
      make_model(state, cache, nullptr, [&](const std::string& work, double) {
        ++counts[work];
        stages.push_back(work);
        return true;
      });
  ASSERT_TRUE(whole);
  ASSERT_EQ(counts.size(), 3u);
  EXPECT_GT(counts["reading " + many], 50);
  EXPECT_GT(counts["import"], 30);
  EXPECT_GT(counts["building the tree"], 10);
  // Wherever the answer is to stop, nothing more is asked or made.
  for (std::size_t at = 0; at < stages.size(); at += 1 + stages.size() / 9) {
    MeshCache fresh;
    std::size_t asked = 0;
    const auto model =
        make_model(state, fresh, nullptr,
                   [&](const std::string&, double) { return asked++ < at; });
    ASSERT_FALSE(model) << "stopped at " << at;
    EXPECT_EQ(model.error().code, ErrorCode::kStopped) << stages[at];
    EXPECT_EQ(asked, at + 1) << stages[at];
  }
}

TEST_F(ViewerSession, OneDragOfAWidgetIsUndoneAsOne) {
  Session session(state_of({box_}), nullptr, ignore);
  settle(session);
  for (int i = 1; i < 5; ++i) {
    session.change(
        [i](State& s) {
          s.parts[0].shift = {0.5 * i, 0, 0};
        },
        /*gesture=*/7);
  }
  session.undo();
  settle(session);
  EXPECT_EQ(session.state().parts[0].shift, (std::array<double, 3>{}));
  EXPECT_FALSE(session.can_undo());
}

TEST_F(ViewerSession, LinesAreDrawnOverThePicture) {
  Session session(state_of({box_}), nullptr, ignore);
  session.set_size(160, 120);
  settle(session);
  const auto plain = finished(session);
  session.change([](State& s) { s.looks.lines = Lines::kFeatures; });
  EXPECT_FALSE(session.is_settled());
  settle(session);
  const auto shown = session.shown();
  ASSERT_TRUE(shown && shown->finished);
  EXPECT_NE(shown->finished, plain);
  const auto drawing = lines_for(shown->picture, Lines::kFeatures);
  ASSERT_TRUE(drawing);
  ColorImage expected = *plain;
  fast::add_lines(**drawing, shown->picture.line_style, {}, expected);
  EXPECT_EQ(*shown->finished, expected);
  // Those of a section are the edges of what is left and of the cap.
  session.change([](State& s) { s.sections = {{{1, 0, 0}, 1, true}}; });
  settle(session);
  const auto cut = session.shown();
  ASSERT_TRUE(cut && cut->finished);
  ASSERT_EQ(cut->picture.options.clips.size(), 1u);
  ASSERT_TRUE(cut->picture.options.caps);
  const auto edges_of_cut = lines_for(cut->picture, Lines::kFeatures);
  ASSERT_TRUE(edges_of_cut);
  const auto sections = std::count_if(
      (*edges_of_cut)->edges.begin(), (*edges_of_cut)->edges.end(),
      [](const auto& e) { return e.edge_class == EdgeClass::kSection; });
  EXPECT_GE(sections, 4);
  ColorImage cut_expected = rendered(cut->state);
  fast::add_lines(**edges_of_cut, cut->picture.line_style, {}, cut_expected);
  EXPECT_EQ(*cut->finished, cut_expected);
  session.undo();
  settle(session);
  EXPECT_EQ(*finished(session), expected);
}

TEST_F(ViewerSession, ColoursArePartsAndFacesAndBackSides) {
  Session session(state_of({box_, ball_}), nullptr, ignore);
  session.set_size(160, 120);
  settle(session);
  const auto own = finished(session);
  const auto tree = session.model()->tree;
  session.change([](State& s) { s.looks.coloring = Coloring::kParts; });
  settle(session);
  const auto parts = finished(session);
  EXPECT_EQ(*parts, rendered(session.state()));
  session.change([](State& s) { s.looks.coloring = Coloring::kFaces; });
  settle(session);
  const auto faces = finished(session);
  EXPECT_EQ(*faces, rendered(session.state()));
  session.change([](State& s) {
    s.looks.coloring = Coloring::kFile;
    s.looks.ambient = 0.7;
  });
  settle(session);
  EXPECT_EQ(*finished(session), rendered(session.state()));
  EXPECT_NE(parts, own);
  EXPECT_NE(faces, own);
  EXPECT_NE(faces, parts);
  EXPECT_NE(finished(session), own);
  EXPECT_EQ(session.model()->tree, tree);
  // From inside, all is seen from behind.
  io::ViewOptions camera = *session.camera();
  camera.eye = {0.5, 0.25, 0.1};
  camera.target = {1.5, 1, 0.4};
  ASSERT_TRUE(session.set_camera(camera));
  settle(session);
  const auto inside = finished(session);
  session.change([](State& s) { s.looks.back_color = Rgb{255, 0, 0}; });
  settle(session);
  const auto marked = finished(session);
  for (std::size_t k = 0; k < marked->pixels.size(); ++k) {
    const Rgb before = inside->pixels[k];
    const int light = std::max({before.r, before.g, before.b});
    const auto red = static_cast<std::uint8_t>((256 + light) / 2);
    ASSERT_EQ(marked->pixels[k], (Rgb{red, 0, 0}));
  }
  // Marks are blended, too: of the box alone one face over the background.
  Session alone(state_of({box_}), nullptr, ignore);
  alone.set_size(160, 120);
  settle(alone);
  ASSERT_TRUE(alone.set_camera(camera));
  alone.change([](State& s) { s.looks.back_color = Rgb{255, 0, 0}; });
  settle(alone);
  const auto opaque = finished(alone);
  alone.change([](State& s) { s.looks.alpha = 100; });
  settle(alone);
  const auto blended = finished(alone);
  const Rgb ground = alone.state().looks.background;
  for (std::size_t k = 0; k < opaque->pixels.size(); ++k) {
    ASSERT_EQ(blended->pixels[k],
              composed_color(opaque->pixels[k], ground, 100));
  }
}

TEST_F(ViewerSession, WhatIsSavedIsWhatItsNameSays) {
  Session session(state_of({box_}), nullptr, ignore);
  EXPECT_FALSE(session.shown());
  settle(session);
  for (const char* name : {"a.png", "a.npy", "a.scene"}) {
    EXPECT_TRUE(is_shown_name(name));
    const auto saved = save_shown(*session.shown(), path(name));
    EXPECT_TRUE(saved) << name;
    EXPECT_GT(fs::file_size(path(name)), 100u);
  }
  EXPECT_FALSE(is_shown_name("a.gif"));
  EXPECT_FALSE(save_shown(*session.shown(), path("a.gif")));
  EXPECT_FALSE(save_shown(*session.shown(), path("no/folder.png")));
}

TEST(Saving, NumbersStandWhereNamesSay) {
  EXPECT_EQ(numbered_name("a-%d.png", 7), "a-7.png");
  EXPECT_EQ(numbered_name("%03d", 7), "007");
  EXPECT_EQ(numbered_name("a%02db", 123), "a123b");
  for (const char* name : {"a.png", "%d%d", "%3d", "%s", "a%", "%", "%0"})
    EXPECT_FALSE(numbered_name(name, 1)) << name;
}

}  // namespace
}  // namespace halfspace::viewer
