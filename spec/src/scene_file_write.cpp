#include "halfspace/scene_file.hpp"

namespace halfspace {
namespace {

void write_values(std::string& text, std::initializer_list<Int128> values) {
  for (const Int128 value : values) text += ' ' + to_string(value);
}

void write_color(std::string& text, Rgb color) {
  write_values(text, {color.r, color.g, color.b});
}

void write_polygon(std::string& text, const Scene& scene, PolygonId polygon) {
  text += 'p';
  for (const VertexId vertex : scene.corners(polygon)) {
    write_values(text, {vertex});
  }
  text += " color";
  write_color(text, scene.color(polygon));
  // On every polygon or on none: then reading cannot lose them.
  const std::span<const Rgb> colors = scene.corner_colors(polygon);
  if (!colors.empty()) text += " colors";
  for (const Rgb& color : colors) write_color(text, color);
  text += '\n';
}

void write_camera(std::string& text, const CameraData& camera) {
  const auto vector = [&text](const char* keyword, const LatticeVector& v) {
    text += keyword;
    write_values(text, {v.x, v.y, v.z});
  };
  vector("eye", camera.eye);
  text += camera.perspective ? " 1" : " 0";
  vector("\ns0", camera.s0);
  vector("\nsx", camera.sx);
  vector("\nsy", camera.sy);
  if (camera.near) {
    text += "\nnear";
    write_values(text, {*camera.near});
  }
  text += "\nsize";
  write_values(text, {camera.width_px, camera.height_px});
  text += '\n';
}

void write_style(std::string& text, const char* keyword,
                 const CapStyle& style) {
  text += keyword;
  write_color(text, style.color);
  if (style.hatch) {
    text += " hatch";
    write_color(text, *style.hatch);
  }
  text += '\n';
}

void write_parts(std::string& text, const CapParts& parts) {
  for (const CapStyle& style : parts.styles) write_style(text, "cap", style);
  const std::vector<std::uint32_t>& part_of = parts.part_of;
  for (std::size_t from = 0, to = 0; from < part_of.size(); from = to) {
    while (to < part_of.size() && part_of[to] == part_of[from]) ++to;
    text += "part";
    write_values(text, {part_of[from], static_cast<Int128>(from),
                        static_cast<Int128>(to - from)});
    text += '\n';
  }
}

}  // namespace

std::string write_scene(const SceneFile& file) {
  const Scene& scene = file.scene;
  std::string text = "halfspace-scene 1\nunit";
  write_values(text, {scene.unit().base, scene.unit().exponent});
  text += "\ngrid";
  write_values(text, {scene.grid_bits()});
  text += '\n';
  for (const GridPoint& point : scene.data().vertices) {
    text += 'v';
    write_values(text, {point.x, point.y, point.z});
    text += '\n';
  }
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    write_polygon(text, scene, static_cast<PolygonId>(p));
  }
  if (file.camera) write_camera(text, file.camera->data());
  if (file.options.cull) text += "cull\n";
  if (file.options.shading == Shading::kGouraud) text += "shade gouraud\n";
  if (file.options.background != ImageOptions{}.background) {
    text += "background";
    write_color(text, file.options.background);
    text += '\n';
  }
  for (const ClipPlane& plane : file.options.clips) {
    text += "clip";
    write_values(text, {plane.a, plane.b, plane.c, plane.d});
    text += '\n';
  }
  if (const auto& caps = file.options.caps) {
    write_style(text, "caps", *caps);
    if (const auto& parts = file.options.parts) write_parts(text, *parts);
  }
  return text + "end\n";
}

}  // namespace halfspace
