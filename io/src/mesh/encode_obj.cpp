#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "base/point_table.hpp"
#include "mesh/encode.hpp"
#include "mesh/images.hpp"

namespace halfspace::io {
namespace {

/// More materials are not made of faces' colours.
constexpr std::size_t kMostColorMaterials = 4096;

/// A name that is read back: without line ends, and without blanks at its ends.
std::string obj_name(const std::string& name, const char* other) {
  std::string word;
  for (const char c : name) {
    const bool is_blank = c == ' ' || (c >= '\t' && c <= '\r') || c == '#';
    if (is_blank && (word.empty() || word.back() == ' ')) continue;
    word += is_blank ? ' ' : c;
  }
  while (!word.empty() && (word.back() == ' ' || word.back() == '\\'))
    word.pop_back();
  return word.empty() ? other : word;
}

std::string color_name(const Rgb& color) {
  char name[16];
  std::snprintf(name, sizeof name, "color_%02x%02x%02x", color.r, color.g,
                color.b);
  return name;
}

/// The channel of faces' colours; null where there is none.
const Channel* face_colors_of(const Attributes& attributes) {
  for (const Channel& channel : attributes.faces) {
    if (channel.kind == ChannelKind::kColor) return &channel;
  }
  return nullptr;
}

/// The materials that faces have, and those made of their colours.
class ObjMaterials {
 public:
  explicit ObjMaterials(const Attributes& attributes)
      : attributes_(attributes), colors_(face_colors_of(attributes)) {
    std::set<std::string> taken;
    for (const Material& material : attributes.materials) {
      std::string name = obj_name(material.name, "material");
      // Two that are not the same are two.
      for (int i = 2; !taken.insert(name).second; ++i)
        name = obj_name(material.name, "material") + "." + std::to_string(i);
      names_.push_back(std::move(name));
    }
    if (colors_ == nullptr) return;
    const std::size_t faces = colors_->values.size() / colors_->width;
    for (std::size_t face = 0; face < faces; ++face) {
      if (material_of(face) >= 0) continue;
      if (const auto color = rgb_of(colors_->at(face))) made_.insert(*color);
      if (made_.size() <= kMostColorMaterials) continue;
      made_.clear();
      colors_ = nullptr;
      return;
    }
  }

  /// The name of a face's material; empty where it has none.
  std::string name_of(std::size_t face) const {
    const std::int32_t material = material_of(face);
    if (material >= 0) return names_[static_cast<std::size_t>(material)];
    if (colors_ == nullptr) return {};
    const auto color = rgb_of(colors_->at(face));
    return color ? color_name(*color) : std::string();
  }
  bool empty() const {
    return made_.empty() && attributes_.face_materials.empty();
  }
  std::string text(std::span<const std::string> textures) const {
    std::string text = "# written by halfspace\n";
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const Material& material = attributes_.materials[i];
      text += "\nnewmtl " + names_[i] + "\n";
      if (material.color) append_color(*material.color, text);
      if (material.opacity != 1) append("d", {material.opacity}, text);
      if constexpr (kHasImages) {
        if (material.metallic) append("Pm", {*material.metallic}, text);
        if (material.roughness) append("Pr", {*material.roughness}, text);
      }
      const std::string& texture = texture_of(attributes_, textures, i);
      if (!texture.empty())
        text += "map_Kd " + obj_name(texture, "image") + "\n";
    }
    for (const Rgb& color : made_) {
      text += "\nnewmtl " + color_name(color) + "\n";
      append_color(color, text);
    }
    return text;
  }

 private:
  std::int32_t material_of(std::size_t face) const {
    return attributes_.face_materials.empty()
               ? -1
               : attributes_.face_materials[face];
  }
  static void append(const char* keyword, std::initializer_list<double> values,
                     std::string& text) {
    text += keyword;
    for (const double value : values) {
      char digits[32];
      std::snprintf(digits, sizeof digits, " %.4g", value);
      text += digits;
    }
    text += '\n';
  }
  /// Four digits tell 256 values apart.
  static void append_color(const Rgb& color, std::string& text) {
    append("Kd", {color.r / 255.0, color.g / 255.0, color.b / 255.0}, text);
  }

  const Attributes& attributes_;
  const Channel* colors_;
  std::vector<std::string> names_;  // by material
  std::set<Rgb> made_;
};

struct DoublesHash {
  template <std::size_t n>
  std::size_t operator()(const std::array<double, n>& values) const {
    std::uint64_t hash = 0;
    for (const double value : values)
      hash = mixed(hash + std::bit_cast<std::uint64_t>(value + 0.0));
    return hash;
  }
};

void append_numbers(std::span<const double> values, std::string& text) {
  for (const double value : values) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text += ' ';
    text.append(digits, end);
  }
}

/// The lines `vt` or `vn` of a channel, and by corner the number of its line;
/// 0 where it has none.
template <std::size_t n>
std::vector<std::int32_t> append_references(const Channel* channel,
                                            const char* keyword,
                                            std::string& text) {
  std::vector<std::int32_t> places;
  if (channel == nullptr) return places;
  std::vector<std::array<double, n>> rows;
  PointTable<std::array<double, n>, DoublesHash> table;
  const std::size_t corners = channel->values.size() / n;
  for (std::size_t c = 0; c < corners; ++c) {
    std::array<double, n> row{};
    bool is_there = true;
    for (std::size_t i = 0; i < n; ++i) {
      row[i] = channel->values[c * n + i];
      is_there = is_there && std::isfinite(row[i]);
    }
    places.push_back(is_there ? table.index_of(row, rows) + 1 : 0);
  }
  for (const auto& row : rows) {
    text += keyword;
    append_numbers(row, text);
    text += '\n';
  }
  return places;
}

/// The channel of a kind and a width; null where there is none.
const Channel* channel_of(const Attributes& attributes, ChannelKind kind,
                          std::size_t width) {
  for (const Channel& channel : attributes.corners) {
    if (channel.kind == kind && channel.width == width) return &channel;
  }
  return nullptr;
}

/// Writes a line where what faces have changes.
class Changes {
 public:
  Changes(const char* keyword, const char* none)
      : keyword_(keyword), none_(none) {}
  void now(const std::string& name, std::string& text) {
    if (name == last_) return;
    last_ = name;
    text += keyword_;
    text += ' ';
    text += name.empty() ? none_ : name;
    text += '\n';
  }

 private:
  const char* keyword_;
  const char* none_;
  std::string last_;
};

std::string label_at(const Labels& labels, std::size_t face) {
  const std::int32_t at = labels.of_face.empty() ? -1 : labels.of_face[face];
  return at < 0 ? std::string()
                : obj_name(labels.names[static_cast<std::size_t>(at)], "name");
}

void append_obj_points(std::span<const std::string> points,
                       const std::optional<std::vector<double>>& colors,
                       std::size_t width, std::string& text) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    text += "v " + points[v];
    if (colors) {
      const std::span<const double> color(colors->data() + v * width, 3);
      for (const double share : color) {
        if (!rgb_of(color)) break;
        char digits[32];
        std::snprintf(digits, sizeof digits, " %.4g", share);
        text += digits;
      }
    }
    text += '\n';
  }
}

}  // namespace

std::string obj_text(std::span<const std::string> points, const Faces& faces,
                     const Attributes* attributes, std::string_view library) {
  const Attributes none;
  if (attributes == nullptr) attributes = &none;
  std::string text = "# written by halfspace\n";
  const ObjMaterials materials(*attributes);
  const bool has_materials = !library.empty() && !materials.empty();
  if (has_materials) text += "mtllib " + std::string(library) + "\n";
  const Channel* colors = channel_of(*attributes, ChannelKind::kColor, 3);
  if (colors == nullptr)
    colors = channel_of(*attributes, ChannelKind::kColor, 4);
  append_obj_points(
      points,
      colors ? by_vertex(*colors, faces.corners, points.size()) : std::nullopt,
      colors ? colors->width : 0, text);
  const auto texture = append_references<2>(
      channel_of(*attributes, ChannelKind::kTexture, 2), "vt", text);
  const auto normals = append_references<3>(
      channel_of(*attributes, ChannelKind::kNormal, 3), "vn", text);
  // A file cannot take a material or an object back: what has none after one
  // that has gets a name that stands for none.
  Changes objects("o", "none"), groups("g", "default");
  Changes uses("usemtl", "none");
  std::size_t corner = 0;
  for (std::size_t face = 0; face < faces.count(); ++face) {
    objects.now(label_at(attributes->objects, face), text);
    groups.now(label_at(attributes->groups, face), text);
    if (has_materials) uses.now(materials.name_of(face), text);
    text += 'f';
    for (const VertexId vertex : faces.corners_of(face)) {
      text += ' ' + std::to_string(vertex + 1);
      const std::int32_t vt = texture.empty() ? 0 : texture[corner];
      const std::int32_t vn = normals.empty() ? 0 : normals[corner];
      if (vt > 0 || vn > 0) text += '/';
      if (vt > 0) text += std::to_string(vt);
      if (vn > 0) text += '/' + std::to_string(vn);
      ++corner;
    }
    text += '\n';
  }
  return text;
}

std::string mtl_text(const Attributes& attributes,
                     std::span<const std::string> textures) {
  const ObjMaterials materials(attributes);
  return materials.empty() ? std::string() : materials.text(textures);
}

}  // namespace halfspace::io
