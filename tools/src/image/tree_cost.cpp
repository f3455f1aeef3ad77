#include "image/tree_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace halfspace::tools {
namespace {

/// Of so many polygons no tree takes long, however they lie.
constexpr std::size_t kMostSampled = 512;
/// Of a fragment and its share of nodes, as 1,000 triangles across a cube had.
constexpr double kBytesOfFragment = 200;

/// Every `step`-th polygon of the scene.
Scene sample_of(const Scene& scene, std::size_t step) {
  SceneData data;
  data.unit = scene.unit();
  data.grid_bits = scene.grid_bits();
  for (std::size_t p = 0; p < scene.polygon_count(); p += step) {
    const auto id = static_cast<PolygonId>(p);
    for (const VertexId v : scene.corners(id)) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(scene.point(v));
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(scene.color(id));
  }
  return *make_scene(std::move(data));
}

/// How many polygons are cut, in all, where a tree is made of these.
double splits_of(const Scene& sample, Library library,
                 const TreeRequest& request) {
  const std::unique_ptr<Engine> engine = make_engine(library);
  if (!engine->build(sample, request)) return 0;
  return static_cast<double>(engine->stats().fragments) -
         static_cast<double>(sample.polygon_count());
}

}  // namespace

std::string tree_cost_warning(const Scene& scene, Library library,
                              const TreeRequest& request) {
  const std::size_t count = scene.polygon_count();
  const bool cuts_all = request.rule || !request.leaves;
  if (!cuts_all || library != Library::kFast || count < kMostSampled) return {};
  const std::size_t step = std::max<std::size_t>(4, count / kMostSampled);
  const Scene large = sample_of(scene, step);
  const Scene small = sample_of(scene, 4 * step);
  TreeRequest quiet = request;
  quiet.progress = [](double) { return true; };
  const double few = splits_of(small, library, quiet);
  const double many = splits_of(large, library, quiet);
  if (few < 1 || many < 1) return {};
  const auto size = [](const Scene& some) {
    return static_cast<double>(some.polygon_count());
  };
  const double exponent = std::clamp(
      std::log(many / few) / std::log(size(large) / size(small)), 1.0, 3.0);
  const double fragments =
      size(scene) + many * std::pow(size(scene) / size(large), exponent);
  if (fragments < std::max(1e6, 4 * size(scene))) return {};
  std::string sentence = fmt::format(
      "this tree cuts polygons at each other's planes: of {} about {:.1f} "
      "million fragments are expected, {:.0f} MB",
      count, fragments / 1e6, fragments * kBytesOfFragment / 1e6);
  if (request.rule) sentence += "; without a rule they would not be cut";
  return sentence;
}

}  // namespace halfspace::tools
