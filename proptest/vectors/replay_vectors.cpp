#include "replay_vectors.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "adapters/both.hpp"
#include "adapters/both_solid.hpp"
#include "adapters/screen_line.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/traverse.hpp"

namespace halfspace::vectors {
namespace {

/// The cases of a merge, step by step, by an implementation's merge_case().
template <class CaseOf>
Json cases_of(const std::vector<Span>& objects, std::vector<Span> unlit,
              const CaseOf& case_of) {
  using enum MergeCase;
  Json cases = Json::array();
  auto object = objects.begin();
  auto line = unlit.begin();
  while (object != objects.end() && line != unlit.end()) {
    const MergeCase found = case_of(*object, *line);
    cases.push_back(static_cast<int>(found));
    if (found == k2 || found == k3) line->first = object->last + 1;
    if (found >= k4) ++line;
    if (found <= k5) ++object;
  }
  return cases;
}

/// The cases as F2B's Merge-segment itself goes through them.
Json cases_of_ref(const std::vector<Span>& objects,
                  const std::vector<Span>& unlit) {
  Json cases = Json::array();
  ref::UnlitList list(unlit.begin(), unlit.end());
  auto object = objects.begin();
  auto line = list.begin();
  while (object != objects.end() && line != list.end()) {
    cases.push_back(static_cast<int>(ref::merge_case(*object, *line)));
    ref::merge_segment(object, list, line, [](Span) {});
  }
  return cases;
}

template <class Split>
Json parts_json(const Split& split) {
  return Json::array(
      {to_json(name_of(split.positive)), to_json(name_of(split.negative))});
}

constexpr const char* kRelations[] = {"positive", "negative", "coincident",
                                      "spanning"};

std::string word(Relation relation) {
  return kRelations[static_cast<std::size_t>(relation)];
}

/// The fragment of polygon `polygon` that is left after the cuts of `way`.
std::pair<ref::Fragment, fast::Fragment> fragments_of(const Scene& scene,
                                                      PolygonId polygon,
                                                      const Json& way) {
  ref::Fragment f = ref::whole(scene, polygon);
  fast::Fragment g = fast::whole(scene, polygon);
  fast::FilterStats stats;
  for (const Json& step : way) {
    const auto q = step.at(0).get<PolygonId>();
    const auto parts =
        ref::split(f, ref::plane_of(ref::whole(scene, q).vertices), q);
    const auto found = fast::split(scene, g, q, stats);
    const bool up = step.at(1) == "positive";
    f = up ? parts.positive : parts.negative;
    g = up ? found.positive : found.negative;
  }
  return {f, g};
}

/// One pair of solids: what every point is in, by one of the libraries.
template <class Solids>
std::size_t replay_boolean(const Json& vector) {
  std::size_t compared = 0;
  const auto a = Solids::to_solid(*make_solid(scene_of(vector.at("a"))));
  const auto b = Solids::to_solid(*make_solid(scene_of(vector.at("b"))));
  constexpr std::pair<BooleanOp, const char*> kOperations[] = {
      {BooleanOp::kUnion, "union"},
      {BooleanOp::kIntersection, "intersection"},
      {BooleanOp::kDifference, "difference"}};
  for (const auto& [operation, name] : kOperations) {
    const auto result = Solids::boolean(operation, a, b);
    EXPECT_TRUE(Solids::is_closed(result)) << name;
    std::vector<definition::Facet> facets;
    for (const auto& polygon : Solids::polygons_of(result))
      facets.push_back(definition::facet_of(polygon));
    for (const Json& point : vector.at("points")) {
      const Json& p = point.at("point");
      const definition::Point at{
          p.at(0).get<std::int64_t>(), p.at(1).get<std::int64_t>(),
          p.at(2).get<std::int64_t>(), point.at("over").get<std::int64_t>()};
      EXPECT_EQ(definition::winding(facets, at) == 1,
                point.at(name).template get<bool>())
          << name << " at " << point.dump();
      ++compared;
    }
  }
  return compared;
}

}  // namespace

std::size_t replay_merges(const Json& vectors) {
  std::size_t compared = 0;
  for (const Json& vector : vectors) {
    SCOPED_TRACE(vector.dump());
    const auto objects = spans_of(vector.at("objects"));
    const auto unlit = spans_of(vector.at("unlit"));
    const auto one = ref::merge(objects, unlit);
    EXPECT_EQ(to_json(one.lit), vector.at("lit"));
    EXPECT_EQ(to_json(one.unlit), vector.at("left"));
    for (const fast::SimdLevel level : kSimdLevels) {
      if (!fast::is_supported(level)) continue;
      ScreenLine line(32, level);
      const ScreenLine::Merged& other = line.merge(objects, unlit);
      EXPECT_EQ(to_json(other.lit), vector.at("lit")) << level_name(level);
      EXPECT_EQ(to_json(other.unlit), vector.at("left")) << level_name(level);
    }
    EXPECT_EQ(cases_of_ref(objects, unlit), vector.at("cases"));
    EXPECT_EQ(cases_of(objects, unlit, fast::merge_case), vector.at("cases"));
    compared += 6;
  }
  return compared;
}

std::size_t replay_splits(const Json& vectors) {
  std::size_t compared = 0;
  fast::FilterStats stats;
  for (const Json& vector : vectors) {
    SCOPED_TRACE(vector.at("name").get<std::string>());
    const Scene scene = scene_of(vector.at("scene"));
    for (const Json& cut : vector.at("cuts")) {
      const auto [f, g] = fragments_of(
          scene, cut.at("polygon").get<PolygonId>(), cut.at("way"));
      const auto q = cut.at("splitter").get<PolygonId>();
      const auto plane = ref::plane_of(ref::whole(scene, q).vertices);
      EXPECT_EQ(Json(word(ref::relation(f, plane))), cut.at("relation"));
      EXPECT_EQ(Json(word(fast::relation(scene, g, q, stats))),
                cut.at("relation"));
      compared += 2;
      if (!cut.contains("positive")) continue;
      const Json parts = {cut.at("positive"), cut.at("negative")};
      EXPECT_EQ(parts_json(ref::split(f, plane, q)), parts);
      EXPECT_EQ(parts_json(fast::split(scene, g, q, stats)), parts);
      compared += 2;
    }
  }
  return compared;
}

std::size_t replay_traversals(const Json& vectors) {
  std::size_t compared = 0;
  for (const Json& vector : vectors) {
    SCOPED_TRACE(vector.at("name").get<std::string>());
    const Scene scene = scene_of(vector.at("scene"));
    const Camera camera = camera_of(vector.at("camera"), scene.grid_bits());
    const BuildOptions options = build_options_of(vector.at("build"));
    const ref::BspTree tree = ref::build(scene, options);
    const fast::BspTree other = fast::build(scene, options);
    EXPECT_EQ(to_json(ref::name_of(tree)), vector.at("tree"));
    EXPECT_EQ(to_json(fast::name_of(other)), vector.at("tree"));
    Json near_first = Json::array(), far_first = Json::array();
    const auto into = [](Json& list) {
      return [&list](const ref::Node&, const ref::Fragment& fragment) {
        list.push_back(to_json(ref::name_of(fragment)));
        return true;
      };
    };
    ref::front_to_back(tree, camera, into(near_first));
    ref::back_to_front(tree, camera, into(far_first));
    EXPECT_EQ(near_first, vector.at("front_to_back"));
    EXPECT_EQ(far_first, vector.at("back_to_front"));
    // The fast library shows its tree's fragments by source and splitter.
    const auto shown = [](Json& list) {
      return [&list](const fast::Node&, const fast::TreeFragment& fragment) {
        list.push_back(fragment.source);
        return true;
      };
    };
    const auto sources = [](const Json& order) {
      Json list = Json::array();
      for (const Json& fragment : order) list.push_back(fragment.at("source"));
      return list;
    };
    Json near_sources = Json::array(), far_sources = Json::array();
    fast::front_to_back(other, scene, camera, shown(near_sources));
    fast::back_to_front(other, scene, camera, shown(far_sources));
    EXPECT_EQ(near_sources, sources(vector.at("front_to_back")));
    EXPECT_EQ(far_sources, sources(vector.at("back_to_front")));
    compared += 6;
  }
  return compared;
}

std::size_t replay_images(const Json& vectors) {
  std::size_t compared = 0;
  for (const Json& vector : vectors) {
    SCOPED_TRACE(vector.at("name").get<std::string>());
    const Scene scene = scene_of(vector.at("scene"));
    const Camera camera = camera_of(vector.at("camera"), scene.grid_bits());
    const ImageOptions options = image_options_of(vector.at("options"));
    const auto expect = [&](const auto& picture) {
      EXPECT_EQ(to_json(picture.items), vector.at("items"));
      EXPECT_EQ(to_json(picture.colors), vector.at("colors"));
      compared += 2;
    };
    const ref::BspTree tree = ref::build(scene, {});
    expect(ref::render(scene, tree, camera, options));
    expect(ref::paint(scene, tree, camera, options));
    expect(ref::zbuffer(scene, camera, options));
    expect(ref::raycast(scene, camera, options));
    const fast::BspTree other = fast::build(scene, {});
    expect(fast::render(scene, other, camera, options));
    expect(fast::paint(scene, other, camera, options));
    expect(
        fast::render(scene, fast::build_display_tree(scene), camera, options));
  }
  return compared;
}

std::size_t replay_booleans(const Json& vectors) {
  std::size_t compared = 0;
  for (const Json& vector : vectors) {
    SCOPED_TRACE(vector.at("name").get<std::string>());
    compared += replay_boolean<Ref>(vector);
    compared += replay_boolean<FastSolids>(vector);
  }
  return compared;
}

}  // namespace halfspace::vectors
