#include "halfspace/io/attributes.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/io/mesh.hpp"

namespace halfspace::io {

const Channel* channel_named(const std::vector<Channel>& channels,
                             const std::string& name) {
  const auto found =
      std::find_if(channels.begin(), channels.end(),
                   [&](const Channel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

std::optional<Rgb> rgb_of(std::span<const double> values) {
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::isnan(values[i])) return std::nullopt;
    bytes[i] = static_cast<std::uint8_t>(
        std::floor(std::clamp(values[i], 0.0, 1.0) * 255 + 0.5));
  }
  return Rgb{bytes[0], bytes[1], bytes[2]};
}

Channel color_channel(const std::vector<std::optional<Rgb>>& colors) {
  Channel channel{"color", ChannelKind::kColor, 3, {}, false};
  channel.values.reserve(3 * colors.size());
  for (const std::optional<Rgb>& color : colors) {
    if (!color) {
      channel.values.insert(channel.values.end(), 3, kNoValue);
      continue;
    }
    for (const std::uint8_t value : {color->r, color->g, color->b})
      channel.values.push_back(value / 255.0);
  }
  return channel;
}

namespace {

bool has_any_color(const std::vector<std::optional<Rgb>>& colors) {
  return std::any_of(colors.begin(), colors.end(),
                     [](const auto& color) { return color.has_value(); });
}

}  // namespace

AttributedFaces attributed_faces(const Mesh& mesh) {
  AttributedFaces faces;
  faces.attributes = mesh.attributes;
  if (has_any_color(mesh.face_colors))
    faces.attributes.faces.push_back(color_channel(mesh.face_colors));
  if (has_any_color(mesh.vertex_colors)) {
    std::vector<std::optional<Rgb>> colors;
    colors.reserve(mesh.corners.size());
    for (const VertexId corner : mesh.corners)
      colors.push_back(mesh.vertex_colors[static_cast<std::size_t>(corner)]);
    faces.attributes.corners.push_back(color_channel(colors));
  }
  if (faces.attributes.empty()) return faces;
  faces.vertices.reserve(mesh.vertices.size());
  for (const auto& [x, y, z] : mesh.vertices)
    faces.vertices.push_back({to_double(x), to_double(y), to_double(z)});
  faces.first_corner = mesh.first_corner;
  faces.corners = mesh.corners;
  return faces;
}

}  // namespace halfspace::io
