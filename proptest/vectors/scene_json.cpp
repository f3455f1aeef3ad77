#include "scene_json.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

namespace halfspace::vectors {
namespace {

Json color_json(Rgb color) { return {color.r, color.g, color.b}; }

Rgb color_of(const Json& json) {
  return {json.at(0).get<std::uint8_t>(), json.at(1).get<std::uint8_t>(),
          json.at(2).get<std::uint8_t>()};
}

/// Lattice numbers are text: they may be beyond 64 bits.
Json lattice_json(const LatticeVector& v) {
  return {to_string(v.x), to_string(v.y), to_string(v.z)};
}

LatticeVector lattice_of(const Json& json) {
  LatticeVector v;
  const auto read = [&json](std::size_t k, Int128& value) {
    if (!parse_int128(json.at(k).get<std::string>(), value))
      throw std::runtime_error("not a number: " + json.dump());
  };
  read(0, v.x);
  read(1, v.y);
  read(2, v.z);
  return v;
}

constexpr const char* kRules[] = {"first", "random", "fewest-cuts", "h1", "h2",
                                  "h3",    "h4",     "h5",          "h6"};

template <class T>
T valid(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return *std::move(result);
}

}  // namespace

Json to_json(const Scene& scene) {
  Json json = {{"grid_bits", scene.grid_bits()},
               {"vertices", Json::array()},
               {"polygons", Json::array()}};
  for (const GridPoint& p : scene.data().vertices)
    json["vertices"].push_back({p.x, p.y, p.z});
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    Json polygon = {
        {"corners", std::vector<VertexId>(corners.begin(), corners.end())},
        {"color", color_json(scene.color(id))}};
    for (const Rgb& color : scene.corner_colors(id))
      polygon["corner_colors"].push_back(color_json(color));
    json["polygons"].push_back(polygon);
  }
  return json;
}

Scene scene_of(const Json& json) {
  SceneData data;
  data.grid_bits = json.at("grid_bits").get<int>();
  for (const Json& p : json.at("vertices")) {
    data.vertices.push_back({p.at(0).get<std::int64_t>(),
                             p.at(1).get<std::int64_t>(),
                             p.at(2).get<std::int64_t>()});
  }
  for (const Json& polygon : json.at("polygons")) {
    for (const Json& corner : polygon.at("corners"))
      data.corners.push_back(corner.get<VertexId>());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(color_of(polygon.at("color")));
    if (!polygon.contains("corner_colors")) continue;
    for (const Json& color : polygon.at("corner_colors"))
      data.corner_colors.push_back(color_of(color));
  }
  return valid(make_scene(std::move(data)));
}

Json to_json(const Camera& camera) {
  const CameraData& data = camera.data();
  Json json = {
      {"eye", lattice_json(data.eye)}, {"perspective", data.perspective},
      {"s0", lattice_json(data.s0)},   {"sx", lattice_json(data.sx)},
      {"sy", lattice_json(data.sy)},   {"width_px", data.width_px},
      {"height_px", data.height_px}};
  if (data.near) json["near"] = *data.near;
  return json;
}

Camera camera_of(const Json& json, int grid_bits) {
  CameraData data;
  data.eye = lattice_of(json.at("eye"));
  data.perspective = json.at("perspective").get<bool>();
  data.s0 = lattice_of(json.at("s0"));
  data.sx = lattice_of(json.at("sx"));
  data.sy = lattice_of(json.at("sy"));
  data.width_px = json.at("width_px").get<std::int32_t>();
  data.height_px = json.at("height_px").get<std::int32_t>();
  if (json.contains("near")) data.near = json.at("near").get<std::int64_t>();
  return valid(make_camera(data, grid_bits));
}

Json to_json(const ImageOptions& options) {
  return {
      {"cull", options.cull},
      {"shading", options.shading == Shading::kGouraud ? "gouraud" : "flat"},
      {"background", color_json(options.background)}};
}

ImageOptions image_options_of(const Json& json) {
  ImageOptions options;
  options.cull = json.at("cull").get<bool>();
  options.shading = json.at("shading").get<std::string>() == "gouraud"
                        ? Shading::kGouraud
                        : Shading::kFlat;
  options.background = color_of(json.at("background"));
  return options;
}

Json to_json(const BuildOptions& options) {
  return {{"rule", kRules[static_cast<std::size_t>(options.rule)]},
          {"candidates", options.candidates},
          {"seed", std::to_string(options.seed)},
          {"cut_weight", options.cut_weight}};
}

BuildOptions build_options_of(const Json& json) {
  BuildOptions options;
  const auto rule = json.at("rule").get<std::string>();
  std::size_t k = 0;
  while (rule != kRules[k]) {
    if (++k == std::size(kRules)) throw std::runtime_error("no rule " + rule);
  }
  options.rule = static_cast<RootRule>(k);
  options.candidates = json.at("candidates").get<std::uint32_t>();
  options.seed = std::stoull(json.at("seed").get<std::string>());
  options.cut_weight = json.at("cut_weight").get<std::uint32_t>();
  return options;
}

Json to_json(const FragmentName& fragment) {
  Json edges = Json::array();
  for (const EdgeName& edge : fragment.edges) {
    edges.push_back(
        {edge.kind == EdgeName::Kind::kSource ? "source" : "splitter",
         edge.index});
  }
  return {{"source", fragment.source}, {"edges", edges}};
}

Json to_json(const TreeName& tree) {
  Json nodes = Json::array();
  for (const NodeName& node : tree) {
    Json fragments = Json::array();
    for (const FragmentName& fragment : node.coincident)
      fragments.push_back(to_json(fragment));
    nodes.push_back({{"splitter", node.splitter},
                     {"fragments", fragments},
                     {"positive", node.positive},
                     {"negative", node.negative}});
  }
  return nodes;
}

Json to_json(const std::vector<Span>& spans) {
  Json json = Json::array();
  for (const Span& span : spans) json.push_back({span.first, span.last});
  return json;
}

std::vector<Span> spans_of(const Json& json) {
  std::vector<Span> spans;
  for (const Json& span : json) {
    spans.push_back(
        {span.at(0).get<std::int32_t>(), span.at(1).get<std::int32_t>()});
  }
  return spans;
}

Json to_json(const ItemImage& image) {
  Json rows = Json::array();
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    Json row = Json::array();
    for (std::int32_t i = 0; i < image.width_px; ++i)
      row.push_back(image.at(i, j));
    rows.push_back(row);
  }
  return rows;
}

Json to_json(const ColorImage& image) {
  Json rows = Json::array();
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    std::string row;
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      const Rgb color = image.at(i, j);
      char text[7];
      std::snprintf(text, sizeof text, "%02x%02x%02x", color.r, color.g,
                    color.b);
      row += text;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace halfspace::vectors
