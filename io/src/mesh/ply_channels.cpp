#include "mesh/ply_channels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "base/text.hpp"
#include "mesh/images.hpp"

namespace halfspace::io {
namespace {

/// More numbers than these are not spread over corners: a file of few bytes
/// could ask for any amount.
constexpr std::size_t kMostNumbers = std::size_t{1} << 26;

/// What lists of corners are called, but for texture points.
constexpr std::string_view kCornerPrefix = "corner_";

bool is_integer_type(PlyType type) {
  return type != PlyType::kFloat && type != PlyType::kDouble &&
         type != PlyType::kUint32;
}

ChannelKind kind_named(const std::string& name, std::size_t width) {
  if (name == "uv" && width == 2) return ChannelKind::kTexture;
  if (name == "normal" && width == 3) return ChannelKind::kNormal;
  if (name == "color" && (width == 3 || width == 4)) return ChannelKind::kColor;
  return ChannelKind::kNumber;
}

/// The words of a comment of ours about `what`, from its index on; empty of
/// others.
std::vector<std::string> words_about(const std::string& comment,
                                     std::string_view what) {
  constexpr std::string_view kBlank = " \t\n\v\f\r";
  std::vector<std::string> words;
  std::size_t at = comment.find_first_not_of(kBlank);
  while (at != std::string::npos) {
    const std::size_t end =
        std::min(comment.find_first_of(kBlank, at), comment.size());
    words.push_back(comment.substr(at, end - at));
    at = comment.find_first_not_of(kBlank, end);
  }
  if (words.size() < 4 || words[0] != "halfspace" || words[1] != what)
    return {};
  words.erase(words.begin(), words.begin() + 2);
  return words;
}

/// The words from number `first` on.
std::string rest_of(const std::vector<std::string>& words, std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < words.size(); ++i)
    text += (text.empty() ? "" : " ") + words[i];
  return text;
}

/// Comments hold the names in order; anything else is somebody else's.
Labels labels_in(const std::vector<std::string>& comments,
                 std::string_view what) {
  Labels labels;
  for (const std::string& comment : comments) {
    const auto words = words_about(comment, what);
    if (words.empty() || words[0] != std::to_string(labels.names.size()))
      continue;
    labels.names.push_back(rest_of(words, 1));
  }
  return labels;
}

/// `INDEX COLOUR OPACITY NAME`, where the colour is `none` or three numbers.
std::optional<Material> material_in(const std::vector<std::string>& words) {
  Material material;
  std::size_t at = 1;
  if (words[at] == "none") {
    ++at;
  } else {
    std::array<double, 3> shares{};
    for (double& share : shares) {
      if (at >= words.size()) return std::nullopt;
      share = value_or_none(words[at++]) / 255;
    }
    material.color = rgb_of(shares);
  }
  if (at + 1 >= words.size()) return std::nullopt;
  material.opacity = value_or_none(words[at]);
  if (!(material.opacity >= 0 && material.opacity <= 1)) return std::nullopt;
  material.name = rest_of(words, at + 1);
  return material;
}

/// A number from 0 to 1; nothing where it is none.
std::optional<double> share_in(const std::string& word) {
  const double value = value_or_none(word);
  if (!(value >= 0 && value <= 1)) return std::nullopt;
  return value;
}

std::vector<Material> materials_in(const std::vector<std::string>& comments) {
  std::vector<Material> materials;
  for (const std::string& comment : comments) {
    if (const auto image = words_about(comment, "texture");
        !image.empty() && !materials.empty() &&
        image[0] == std::to_string(materials.size() - 1)) {
      materials.back().texture = rest_of(image, 1);
    }
    if (const auto surface = kHasImages ? words_about(comment, "surface")
                                        : std::vector<std::string>();
        surface.size() > 2 && !materials.empty() &&
        surface[0] == std::to_string(materials.size() - 1)) {
      materials.back().metallic = share_in(surface[1]);
      materials.back().roughness = share_in(surface[2]);
    }
    const auto words = words_about(comment, "material");
    if (words.empty() || words[0] != std::to_string(materials.size())) continue;
    if (auto material = material_in(words))
      materials.push_back(*std::move(material));
  }
  return materials;
}

/// The numbers as places among `count` names, if all are such, or -1.
std::optional<std::vector<std::int32_t>> places_of(
    const std::vector<double>& values, std::size_t count) {
  std::vector<std::int32_t> places;
  for (const double value : values) {
    if (!(value >= -1 && value < static_cast<double>(count)) ||
        value != std::floor(value))
      return std::nullopt;
    places.push_back(static_cast<std::int32_t>(value));
  }
  return places;
}

}  // namespace

void PlyChannels::begin(const PlyElement& element,
                        const std::vector<bool>& is_read) {
  columns_.clear();
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    Column& column = columns_.emplace_back();
    column.name = property.name;
    column.is_list = property.is_list;
    column.is_integer = is_integer_type(property.type);
    column.is_wanted = !is_read[i];
    if (!property.is_list) continue;
    const bool is_texture = property.name == "texcoord";
    column.is_wanted = element.name == "face" && !is_read[i] &&
                       (is_texture || property.name.starts_with(kCornerPrefix));
    if (is_texture) {
      column.name = "uv";
      column.width = 2;
    } else if (column.is_wanted) {
      column.name.erase(0, kCornerPrefix.size());
    }
  }
}

void PlyChannels::end_face(const Mesh& mesh) {
  const std::size_t face = mesh.face_count() - 1;
  const std::size_t corners =
      mesh.first_corner[face + 1] - mesh.first_corner[face];
  for (Column& column : columns_) {
    if (!column.is_wanted || !column.is_list) continue;
    const std::size_t there = column.values.size() - column.done;
    if (column.width == 0 && corners > 0 && there % corners == 0)
      column.width = there / corners;
    // Lists of another length say nothing of the corners.
    if (there != column.width * corners) {
      column.values.resize(column.done);
      column.values.resize(column.done + column.width * corners, kNoValue);
    }
    column.done = column.values.size();
    if (column.width == 0) continue;
    // Faces before the first that had some.
    const std::size_t all = column.width * mesh.first_corner[face + 1];
    if (column.done < all)
      column.values.insert(column.values.begin(), all - column.done, kNoValue);
    column.done = all;
  }
}

std::vector<PlyChannels::Column*> PlyChannels::all_of(
    const std::vector<std::string>& names) {
  std::vector<Column*> found;
  for (const std::string& name : names) {
    for (Column& column : columns_) {
      if (column.is_wanted && !column.is_list && column.name == name)
        found.push_back(&column);
    }
  }
  return found.size() == names.size() ? found : std::vector<Column*>();
}

std::vector<Channel> PlyChannels::channels() {
  struct Known {
    const char* name;
    ChannelKind kind;
    std::vector<std::string> columns;
  };
  const Known known[] = {
      {"normal", ChannelKind::kNormal, {"nx", "ny", "nz"}},
      {"uv", ChannelKind::kTexture, {"s", "t"}},
      {"uv", ChannelKind::kTexture, {"u", "v"}},
      {"uv", ChannelKind::kTexture, {"texture_u", "texture_v"}}};
  std::vector<Channel> made;
  for (const Known& entry : known) {
    const std::vector<Column*> columns = all_of(entry.columns);
    if (columns.empty() || channel_named(made, entry.name)) continue;
    Channel channel{entry.name, entry.kind, columns.size(), {}, false};
    const std::size_t count = columns.front()->values.size();
    channel.values.reserve(count * channel.width);
    for (std::size_t i = 0; i < count; ++i) {
      for (const Column* column : columns)
        channel.values.push_back(column->values[i]);
    }
    for (Column* column : columns) *column = {};
    made.push_back(std::move(channel));
  }
  for (Column& column : columns_) {
    if (!column.is_wanted || column.is_list) continue;
    made.push_back({std::move(column.name), ChannelKind::kNumber, 1,
                    std::move(column.values), column.is_integer});
  }
  return made;
}

void PlyChannels::add_to_corners(Mesh& mesh) {
  std::size_t numbers = 0;
  for (Channel& channel : channels()) {
    numbers += mesh.corners.size() * channel.width;
    if (numbers > kMostNumbers) {
      mesh.attributes.notes.push_back(
          "numbers of vertices from " + in_quotes(channel.name) +
          " on are passed over, for there are too many");
      return;
    }
    Channel spread{
        channel.name, channel.kind, channel.width, {}, channel.is_integer};
    spread.values.reserve(mesh.corners.size() * channel.width);
    for (const VertexId corner : mesh.corners) {
      const auto at = channel.at(static_cast<std::size_t>(corner));
      spread.values.insert(spread.values.end(), at.begin(), at.end());
    }
    mesh.attributes.corners.push_back(std::move(spread));
  }
}

void PlyChannels::add_to_faces(const std::vector<std::string>& comments,
                               Mesh& mesh) {
  Attributes& attributes = mesh.attributes;
  for (Column& column : columns_) {
    if (!column.is_wanted || !column.is_list || column.width == 0) continue;
    if (channel_named(attributes.corners, column.name)) continue;
    attributes.corners.push_back(
        {column.name, kind_named(column.name, column.width), column.width,
         std::move(column.values), column.is_integer});
  }
  std::vector<Material> materials = materials_in(comments);
  Labels objects = labels_in(comments, "object");
  Labels groups = labels_in(comments, "group");
  for (Channel& channel : channels()) {
    const auto taken = [&](const char* name, std::size_t count) {
      return channel.name == name && count > 0
                 ? places_of(channel.values, count)
                 : std::nullopt;
    };
    if (auto places = taken("material", materials.size())) {
      attributes.materials = std::move(materials);
      attributes.face_materials = *std::move(places);
    } else if (auto object = taken("object", objects.names.size())) {
      objects.of_face = *std::move(object);
      attributes.objects = std::move(objects);
    } else if (auto group = taken("group", groups.names.size())) {
      groups.of_face = *std::move(group);
      attributes.groups = std::move(groups);
    } else {
      attributes.faces.push_back(std::move(channel));
    }
  }
}

std::string ply_material_comment(std::size_t index, const Material& material) {
  std::string text = "halfspace material " + std::to_string(index) + ' ';
  if (material.color) {
    text += std::to_string(material.color->r) + ' ' +
            std::to_string(material.color->g) + ' ' +
            std::to_string(material.color->b);
  } else {
    text += "none";
  }
  char opacity[32];
  std::snprintf(opacity, sizeof opacity, " %.6g ", material.opacity);
  return text + opacity + material.name;
}

std::string ply_surface_comment(std::size_t index, const Material& material) {
  std::string text = "halfspace surface " + std::to_string(index);
  for (const auto& share : {material.metallic, material.roughness}) {
    char digits[32];
    std::snprintf(digits, sizeof digits, " %.6g", share.value_or(0));
    text += share ? digits : " none";
  }
  return text;
}

}  // namespace halfspace::io
