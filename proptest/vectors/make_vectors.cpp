#include "make_vectors.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "generate/random_scenes.hpp"

namespace halfspace::vectors {
namespace {

namespace fs = std::filesystem;
using agree::Draws;

/// The saved scenes of a folder, by name.
std::vector<std::pair<std::string, SceneFile>> saved(const fs::path& folder) {
  std::vector<std::pair<std::string, SceneFile>> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".scene") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    files.emplace_back(entry.path().stem().string(), *read_scene(text));
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return files;
}

/// A few random scenes of every kind, on every grid in turn.
std::vector<std::pair<std::string, SceneFile>> drawn(int polygons,
                                                     int of_each) {
  std::vector<std::pair<std::string, SceneFile>> files;
  for (const agree::Kind kind : agree::kKinds) {
    for (int k = 0; k < of_each; ++k) {
      Draws draws(static_cast<std::uint64_t>(100 + k));
      SceneFile file;
      file.scene =
          agree::random_scene(kind, kGridBits[k % 3], polygons, draws, true);
      file.camera = agree::random_camera(kind, file.scene, 12, 9, draws);
      file.options.cull = k % 4 == 3;
      file.options.shading = k % 2 == 0 ? Shading::kGouraud : Shading::kFlat;
      files.emplace_back(
          std::string(agree::name_of(kind)) + "-" + std::to_string(k), file);
    }
  }
  return files;
}

/// The pixels of a set, as runs.
std::vector<Span> runs_of(std::uint32_t set) {
  std::vector<Span> spans;
  for (std::int32_t i = 0; i < 32; ++i) {
    if ((set >> i & 1u) == 0) continue;
    if (!spans.empty() && spans.back().last == i - 1) {
      spans.back().last = i;
    } else {
      spans.push_back({i, i});
    }
  }
  return spans;
}

/// The row of S4.7, column by column of its table.
int case_of(Span object, Span unlit) {
  const auto [i, j] = object;
  const auto [min, max] = unlit;
  if (j < min) return 1;
  if (i > max) return 8;
  if (j < max) return i <= min ? 2 : 3;
  if (j == max) return i <= min ? 4 : 5;
  return i <= min ? 6 : 7;
}

/// The cases of the steps, settling what ends first (S4.7, last column).
Json cases_of(std::vector<Span> objects, std::vector<Span> unlit) {
  Json cases = Json::array();
  auto object = objects.begin();
  auto line = unlit.begin();
  while (object != objects.end() && line != unlit.end()) {
    const int found = case_of(*object, *line);
    cases.push_back(found);
    if (found == 2 || found == 3) line->first = object->last + 1;
    if (found >= 4) ++line;
    if (found <= 5) ++object;
  }
  return cases;
}

/// The polygons of one operand: the first's are black, the second's are not.
std::vector<PolygonId> operand_ids(const Scene& scene, bool first) {
  std::vector<PolygonId> ids;
  for (const PolygonId id : ids_of(scene)) {
    if ((scene.color(id) == Rgb{0, 0, 0}) == first) ids.push_back(id);
  }
  return ids;
}

std::vector<definition::Facet> facets_of(const Scene& scene) {
  std::vector<definition::Facet> facets;
  for (const PolygonId id : ids_of(scene)) {
    facets.push_back(definition::facet_of(scene, definition::whole(scene, id)));
  }
  return facets;
}

/// Points about the scene, on no polygon's plane, as x, y, z over 7.
std::vector<GridPoint> points_about(const Scene& scene, Draws& draws) {
  GridPoint low{}, high{};
  for (const GridPoint& p : scene.data().vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y),
            std::max(high.z, p.z)};
  }
  const auto facets = facets_of(scene);
  std::vector<GridPoint> points;
  for (int tries = 0; tries < 400 && points.size() < 60; ++tries) {
    const GridPoint p{draws.from_to(7 * low.x - 3, 7 * high.x + 3),
                      draws.from_to(7 * low.y - 3, 7 * high.y + 3),
                      draws.from_to(7 * low.z - 3, 7 * high.z + 3)};
    const bool is_on = std::any_of(
        facets.begin(), facets.end(), [&](const definition::Facet& facet) {
          return definition::side_of(facet.support, {p.x, p.y, p.z, 7}) == 0;
        });
    if (!is_on) points.push_back(p);
  }
  return points;
}

}  // namespace

Json merge_vectors() {
  Json vectors = Json::array();
  const auto add = [&vectors](std::uint32_t objects, std::uint32_t unlit) {
    vectors.push_back({{"objects", to_json(runs_of(objects))},
                       {"unlit", to_json(runs_of(unlit))},
                       {"lit", to_json(runs_of(objects & unlit))},
                       {"left", to_json(runs_of(unlit & ~objects))},
                       {"cases", cases_of(runs_of(objects), runs_of(unlit))}});
  };
  for (std::uint32_t objects = 0; objects < 16; ++objects) {
    for (std::uint32_t unlit = 0; unlit < 16; ++unlit) add(objects, unlit);
  }
  Draws draws(4);
  for (int k = 0; k < 300; ++k) {
    // Runs of several lengths: sparse, even, and dense.
    const auto set = [&draws] {
      const auto a = static_cast<std::uint32_t>(draws.next());
      const auto b = static_cast<std::uint32_t>(draws.next());
      const std::int64_t how = draws.from_to(0, 3);
      const std::uint32_t wide = (a & b) | (a & b) << 1 | (a & b) << 2;
      return how == 0 ? a & b : how == 1 ? a : how == 2 ? a | b : wide;
    };
    const std::uint32_t objects = set();
    add(objects, set());
  }
  return vectors;
}

Json split_vectors() {
  Json vectors = Json::array();
  auto files = drawn(6, 3);
  for (const auto& [name, file] : files) {
    Json cuts = Json::array();
    for (const PolygonId p : ids_of(file.scene)) {
      FragmentName fragment = definition::whole(file.scene, p);
      Json way = Json::array();
      for (const PolygonId q : ids_of(file.scene)) {
        const Relation relation =
            definition::relation(definition::points_of(file.scene, fragment),
                                 definition::plane_of(file.scene, q));
        constexpr const char* kWords[] = {"positive", "negative", "coincident",
                                          "spanning"};
        Json cut = {{"polygon", p},
                    {"way", way},
                    {"splitter", q},
                    {"relation", kWords[static_cast<std::size_t>(relation)]}};
        if (relation == Relation::kSpanning) {
          const auto parts = definition::split(file.scene, fragment, q);
          cut["positive"] = to_json(parts.positive);
          cut["negative"] = to_json(parts.negative);
          const bool up = (p + q) % 2 == 0;
          fragment = up ? parts.positive : parts.negative;
          way.push_back({q, up ? "positive" : "negative"});
        }
        cuts.push_back(cut);
      }
    }
    vectors.push_back(
        {{"name", name}, {"scene", to_json(file.scene)}, {"cuts", cuts}});
  }
  return vectors;
}

Json traversal_vectors() {
  Json vectors = Json::array();
  auto files = drawn(7, 3);
  const auto more = saved(HALFSPACE_REGRESSIONS);
  files.insert(files.end(), more.begin(), more.end());
  int rule = 0;
  for (const auto& [name, file] : files) {
    BuildOptions options;
    options.rule = static_cast<RootRule>(rule++ % 9);
    options.candidates = 2 + static_cast<std::uint32_t>(rule % 3);
    options.seed = static_cast<std::uint64_t>(rule) * 0x9e3779b97f4a7c15u;
    const TreeName tree = definition::build(file.scene, options);
    const auto order = [](const std::vector<FragmentName>& fragments) {
      Json json = Json::array();
      for (const FragmentName& fragment : fragments)
        json.push_back(to_json(fragment));
      return json;
    };
    vectors.push_back(
        {{"name", name},
         {"scene", to_json(file.scene)},
         {"camera", to_json(*file.camera)},
         {"build", to_json(options)},
         {"tree", to_json(tree)},
         {"front_to_back",
          order(definition::front_to_back(file.scene, tree, *file.camera))},
         {"back_to_front",
          order(definition::back_to_front(file.scene, tree, *file.camera))}});
  }
  return vectors;
}

Json image_vectors() {
  Json vectors = Json::array();
  auto files = drawn(6, 6);
  const auto more = saved(HALFSPACE_REGRESSIONS);
  files.insert(files.end(), more.begin(), more.end());
  for (const auto& [name, file] : files) {
    vectors.push_back(
        {{"name", name},
         {"scene", to_json(file.scene)},
         {"camera", to_json(*file.camera)},
         {"options", to_json(file.options)},
         {"items", to_json(definition::item_image(file.scene, *file.camera,
                                                  file.options))},
         {"colors", to_json(definition::color_image(file.scene, *file.camera,
                                                    file.options))}});
  }
  return vectors;
}

Json boolean_vectors() {
  Json vectors = Json::array();
  Draws draws(6);
  for (const auto& [name, file] :
       saved(fs::path(HALFSPACE_REGRESSIONS) / "solids")) {
    const Scene a = chosen(file.scene, operand_ids(file.scene, true));
    const Scene b = chosen(file.scene, operand_ids(file.scene, false));
    const auto in_a = facets_of(a), in_b = facets_of(b);
    Json points = Json::array();
    for (const GridPoint& p : points_about(file.scene, draws)) {
      const definition::Point point{p.x, p.y, p.z, 7};
      const bool first = definition::winding(in_a, point) == 1;
      const bool second = definition::winding(in_b, point) == 1;
      points.push_back({{"point", {p.x, p.y, p.z}},
                        {"over", 7},
                        {"a", first},
                        {"b", second},
                        {"union", first || second},
                        {"intersection", first && second},
                        {"difference", first && !second}});
    }
    vectors.push_back({{"name", name},
                       {"a", to_json(a)},
                       {"b", to_json(b)},
                       {"points", points}});
  }
  return vectors;
}

}  // namespace halfspace::vectors
