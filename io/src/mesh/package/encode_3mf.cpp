#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "mesh/package/model_3mf.hpp"
#include "mesh/package/package.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

/// What has no colour of its own is shown like this: a material must have one.
constexpr Rgb kGrey{170, 170, 170};

/// The text within an attribute's quotes.
std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        // XML has no other control characters.
        escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return escaped;
}

std::string color_digits(const Rgb& color, double opacity) {
  char text[16];
  std::snprintf(
      text, sizeof text, "#%02X%02X%02X%02X", color.r, color.g, color.b,
      static_cast<unsigned>(std::clamp(opacity, 0.0, 1.0) * 255 + 0.5));
  return text;
}

/// Ids of resources: the images' are behind those, then the materials' of them.
constexpr int kMaterialsId = 1, kColorsId = 2, kObjectId = 3, kSurfacesId = 4,
              kFirstImageId = 5;

constexpr const char* kImageFolder = "/3D/Textures/";

std::string digits_of(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// ` name="VALUE"`.
std::string attribute(const char* name, std::int64_t value) {
  return std::string(" ") + name + "=\"" + std::to_string(value) + "\"";
}

/// The properties of a triangle: the id of a group, and places in it.
struct Triangle3mf {
  int group = 0;  ///< 0: none
  std::array<std::size_t, 3> at{};
};

class Writer3mf {
 public:
  explicit Writer3mf(const MeshContent& content)
      : content_(content),
        attributes_(content.attributes ? *content.attributes : none_) {}
  std::string model();

 private:
  void choose_properties();
  bool choose_texture(std::size_t i, Triangle3mf& made);
  void complete_properties();
  /// How many materials are written.
  std::size_t base_count() const {
    return attributes_.face_materials.empty() ? 0
                                              : attributes_.materials.size();
  }
  std::size_t place_of(const std::string& color);
  /// The id of a material's texture points.
  int texture_id(std::size_t material) const {
    return kFirstImageId + static_cast<int>(content_.images.images.size()) +
           static_cast<int>(material);
  }
  bool has_surfaces() const;
  void add_materials(std::string& text) const;
  void add_textures(std::string& text) const;
  void add_resources(std::string& text) const;
  void add_mesh(std::string& text) const;
  void add_triangle(std::size_t i, std::string& text) const;
  void add_sets(const char* kind, const Labels& labels,
                std::string& text) const;
  std::string object_name() const;

  const Attributes none_;
  const MeshContent& content_;
  const Attributes& attributes_;
  const Channel* solid_ = nullptr;
  const Channel* polygon_ = nullptr;
  std::vector<std::string> colors_;
  std::map<std::string, std::size_t> color_places_;
  /// By material its texture points, and the place of each.
  std::vector<std::vector<std::array<double, 2>>> texture_points_;
  std::vector<std::map<std::array<double, 2>, std::size_t>> texture_places_;
  const Channel* texture_ = nullptr;
  std::vector<Triangle3mf> triangles_;
  bool needs_none_ = false;
};

std::size_t Writer3mf::place_of(const std::string& color) {
  const auto [at, is_new] = color_places_.try_emplace(color, colors_.size());
  if (is_new) colors_.push_back(color);
  return at->second;
}

/// Gives a triangle the texture points of its corners, where its material has
/// an image in the file and they all have some.
bool Writer3mf::choose_texture(std::size_t i, Triangle3mf& made) {
  if (texture_ == nullptr) return false;
  const auto material = static_cast<std::size_t>(
      attributes_.face_materials[content_.triangle_faces[i]]);
  if (content_.images.at(material) < 0) return false;
  std::array<std::array<double, 2>, 3> points;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = texture_->at(content_.triangle_corners[i][k]);
    if (!std::isfinite(at[0]) || !std::isfinite(at[1])) return false;
    points[k] = {at[0] + 0.0, at[1] + 0.0};
  }
  made.group = texture_id(material);
  for (std::size_t k = 0; k < 3; ++k) {
    auto& all = texture_points_[material];
    const auto [place, is_new] =
        texture_places_[material].try_emplace(points[k], all.size());
    if (is_new) all.push_back(points[k]);
    made.at[k] = place->second;
  }
  return true;
}

/// A triangle has its face's image, or else its material, or else the colours
/// of its corners, or that of its face.
void Writer3mf::choose_properties() {
  const Channel* of_corners = nullptr;
  const Channel* of_faces = nullptr;
  for (const Channel& channel : attributes_.corners) {
    if (channel.kind == ChannelKind::kColor) of_corners = &channel;
    if (channel.kind == ChannelKind::kTexture && channel.width == 2)
      texture_ = &channel;
  }
  texture_points_.resize(attributes_.materials.size());
  texture_places_.resize(attributes_.materials.size());
  for (const Channel& channel : attributes_.faces) {
    if (channel.kind == ChannelKind::kColor) of_faces = &channel;
  }
  solid_ = channel_named(attributes_.faces, "origin_solid");
  polygon_ = channel_named(attributes_.faces, "origin_polygon");
  const auto color_in =
      [](std::span<const double> values) -> std::optional<std::string> {
    const auto color = rgb_of(values);
    if (!color) return std::nullopt;
    return color_digits(*color, values.size() > 3 ? values[3] : 1);
  };
  for (std::size_t i = 0; i < content_.triangles.size(); ++i) {
    const std::size_t face = content_.triangle_faces[i];
    Triangle3mf& made = triangles_.emplace_back();
    if (!attributes_.face_materials.empty() &&
        attributes_.face_materials[face] >= 0) {
      if (choose_texture(i, made)) continue;
      made.group = kMaterialsId;
      made.at.fill(static_cast<std::size_t>(attributes_.face_materials[face]));
      continue;
    }
    std::array<std::optional<std::string>, 3> colors;
    for (std::size_t k = 0; k < 3; ++k) {
      if (of_corners != nullptr)
        colors[k] = color_in(of_corners->at(content_.triangle_corners[i][k]));
      if (!colors[k] && of_faces != nullptr)
        colors[k] = color_in(of_faces->at(face));
    }
    if (!colors[0] || !colors[1] || !colors[2]) continue;
    made.group = kColorsId;
    for (std::size_t k = 0; k < 3; ++k) made.at[k] = place_of(*colors[k]);
  }
}

/// A mesh with properties has one for all triangles that say none, so these say
/// that theirs is none.
void Writer3mf::complete_properties() {
  const auto has_group = [](const Triangle3mf& made) {
    return made.group != 0;
  };
  const bool any = std::any_of(triangles_.begin(), triangles_.end(), has_group);
  needs_none_ =
      any && !std::all_of(triangles_.begin(), triangles_.end(), has_group);
  if (!needs_none_) return;
  for (Triangle3mf& made : triangles_) {
    if (made.group != 0) continue;
    made.group = kMaterialsId;
    made.at.fill(base_count());
  }
}

bool Writer3mf::has_surfaces() const {
  return base_count() > 0 &&
         std::any_of(attributes_.materials.begin(), attributes_.materials.end(),
                     [](const Material& material) {
                       return material.metallic || material.roughness;
                     });
}

/// The images, and the texture points of each material that has one.
void Writer3mf::add_textures(std::string& text) const {
  const auto& images = content_.images.images;
  for (std::size_t i = 0; i < images.size(); ++i) {
    text += "  <m:texture2d" +
            attribute("id", kFirstImageId + static_cast<int>(i)) + " path=\"" +
            kImageFolder + images[i].name + "\" contenttype=\"" +
            images[i].type + "\"/>\n";
  }
  for (std::size_t i = 0; i < texture_points_.size(); ++i) {
    if (texture_points_[i].empty()) continue;
    text += "  <m:texture2dgroup" + attribute("id", texture_id(i)) +
            attribute("texid", kFirstImageId + content_.images.at(i)) +
            attribute("h:pid", kMaterialsId) +
            attribute("h:pindex", static_cast<std::int64_t>(i)) + ">\n";
    for (const auto& [u, v] : texture_points_[i]) {
      text += "<m:tex2coord u=\"" + digits_of(u) + "\" v=\"" + digits_of(v) +
              "\"/>\n";
    }
    text += "  </m:texture2dgroup>\n";
  }
}

void Writer3mf::add_materials(std::string& text) const {
  if (base_count() > 0 || needs_none_) {
    const bool surfaces = has_surfaces();
    if (surfaces) {
      text += "  <m:pbmetallicdisplayproperties" +
              attribute("id", kSurfacesId) + ">\n";
      for (std::size_t i = 0; i < base_count() + (needs_none_ ? 1 : 0); ++i) {
        const Material none{"none"};
        const Material& material =
            i < base_count() ? attributes_.materials[i] : none;
        text += "   <m:pbmetallic name=\"" + xml_text(material.name) +
                "\" metallicness=\"" +
                digits_of(material.metallic.value_or(0)) + "\" roughness=\"" +
                digits_of(material.roughness.value_or(1)) + "\"/>\n";
      }
      text += "  </m:pbmetallicdisplayproperties>\n";
    }
    text += "  <basematerials" + attribute("id", kMaterialsId) +
            (surfaces ? attribute("displaypropertiesid", kSurfacesId) : "") +
            ">\n";
    for (std::size_t i = 0; i < base_count(); ++i) {
      const Material& material = attributes_.materials[i];
      text += "   <base name=\"" + xml_text(material.name) +
              "\" displaycolor=\"" +
              color_digits(material.color.value_or(kGrey), material.opacity) +
              "\"/>\n";
    }
    if (needs_none_) {
      text += "   <base name=\"none\" displaycolor=\"" +
              color_digits(kGrey, 1) + "\"/>\n";
    }
    text += "  </basematerials>\n";
  }
}

void Writer3mf::add_resources(std::string& text) const {
  add_materials(text);
  add_textures(text);
  if (colors_.empty()) return;
  text += "  <m:colorgroup id=\"2\">\n";
  for (const std::string& color : colors_)
    text += "   <m:color color=\"" + color + "\"/>\n";
  text += "  </m:colorgroup>\n";
}

void Writer3mf::add_triangle(std::size_t i, std::string& text) const {
  const auto& [a, b, c] = content_.triangles[i];
  text += "<triangle v1=\"" + std::to_string(a) + "\" v2=\"" +
          std::to_string(b) + "\" v3=\"" + std::to_string(c) + "\"";
  const Triangle3mf& made = triangles_[i];
  if (made.group != 0) {
    text += " pid=\"" + std::to_string(made.group) + "\" p1=\"" +
            std::to_string(made.at[0]) + "\"";
    if (made.at[1] != made.at[0] || made.at[2] != made.at[0]) {
      text += " p2=\"" + std::to_string(made.at[1]) + "\" p3=\"" +
              std::to_string(made.at[2]) + "\"";
    }
  }
  const std::size_t face = content_.triangle_faces[i];
  for (const auto& [channel, name] :
       {std::pair(solid_, "solid"), std::pair(polygon_, "polygon")}) {
    if (channel == nullptr || !(channel->at(face)[0] >= 0)) continue;
    text += std::string(" h:") + name + "=\"" +
            std::to_string(static_cast<std::int64_t>(channel->at(face)[0])) +
            "\"";
  }
  text += "/>\n";
}

void Writer3mf::add_sets(const char* kind, const Labels& labels,
                         std::string& text) const {
  if (labels.of_face.empty()) return;
  std::vector<std::string> ranges(labels.names.size());
  std::size_t i = 0;
  const auto label = [&](std::size_t triangle) {
    return labels.of_face[content_.triangle_faces[triangle]];
  };
  while (i < content_.triangles.size()) {
    std::size_t end = i + 1;
    while (end < content_.triangles.size() && label(end) == label(i)) ++end;
    if (label(i) >= 0) {
      std::string& range = ranges[static_cast<std::size_t>(label(i))];
      range += end == i + 1
                   ? "<t:ref index=\"" + std::to_string(i) + "\"/>"
                   : "<t:refrange startindex=\"" + std::to_string(i) +
                         "\" endindex=\"" + std::to_string(end - 1) + "\"/>";
    }
    i = end;
  }
  for (std::size_t name = 0; name < ranges.size(); ++name) {
    if (ranges[name].empty()) continue;
    text += "     <t:triangleset name=\"" + xml_text(labels.names[name]) +
            "\" identifier=\"" + kind + std::to_string(name) + "\">" +
            ranges[name] + "</t:triangleset>\n";
  }
}

void Writer3mf::add_mesh(std::string& text) const {
  text += "   <mesh>\n    <vertices>\n";
  for (const DoublePoint& point : content_.doubles) {
    text += "<vertex";
    constexpr const char* kAxes[] = {" x=\"", " y=\"", " z=\""};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // The float's very value, so that whoever reads floats or doubles or
      // decimals has the same point.
      text += kAxes[axis] +
              all_digits(double{static_cast<float>(point[axis])}) + "\"";
    }
    text += "/>\n";
  }
  text += "    </vertices>\n    <triangles>\n";
  for (std::size_t i = 0; i < triangles_.size(); ++i) add_triangle(i, text);
  text += "    </triangles>\n";
  std::string sets;
  add_sets("object", attributes_.objects, sets);
  add_sets("group", attributes_.groups, sets);
  if (!sets.empty())
    text += "    <t:trianglesets>\n" + sets + "    </t:trianglesets>\n";
  text += "   </mesh>\n";
}

std::string Writer3mf::object_name() const {
  return attributes_.objects.names.size() == 1 ? attributes_.objects.names[0]
                                               : "solid";
}

std::string Writer3mf::model() {
  choose_properties();
  complete_properties();
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
      "xml:lang=\"en-US\" xmlns=\"";
  text += std::string(kModelSpace) + "\" xmlns:m=\"" + kMaterialSpace +
          "\" xmlns:t=\"" + kSetSpace + "\" xmlns:h=\"" + kOriginSpace +
          "\">\n <metadata name=\"Application\">halfspace</metadata>\n";
  for (std::size_t i = 0; i < attributes_.origins.size(); ++i) {
    text += " <metadata name=\"h:origin" + std::to_string(i) + "\">" +
            xml_text(attributes_.origins[i]) + "</metadata>\n";
  }
  text += " <resources>\n";
  add_resources(text);
  text += "  <object id=\"3\" type=\"model\" name=\"" +
          xml_text(object_name()) + "\"";
  if (!triangles_.empty() && triangles_[0].group != 0) {
    text += " pid=\"" + std::to_string(triangles_[0].group) + "\" pindex=\"" +
            std::to_string(triangles_[0].at[0]) + "\"";
  }
  text += ">\n";
  add_mesh(text);
  text +=
      "  </object>\n </resources>\n <build>\n  <item objectid=\"3\"/>\n "
      "</build>\n</model>\n";
  return text;
}

}  // namespace

Result<std::string> three_mf_bytes(const MeshContent& content) {
  if (auto error = beyond_floats(content.doubles)) return *error;
  std::string types =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types xmlns=\"http://"
      "schemas.openxmlformats.org/package/2006/content-types\"><Default "
      "Extension=\"rels\" ContentType=\"application/"
      "vnd.openxmlformats-package.relationships+xml\"/><Default "
      "Extension=\"model\" ContentType=\"application/"
      "vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>";
  const auto& images = content.images.images;
  for (const char* type : {"png", "jpeg"}) {
    if (std::any_of(images.begin(), images.end(), [&](const auto& image) {
          return image.name.ends_with(std::string(".") + type);
        })) {
      types += std::string("<Default Extension=\"") + type +
               "\" ContentType=\"image/" + type + "\"/>";
    }
  }
  types += "</Types>\n";
  const std::string relations =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"http:"
      "//schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
      "Target=\"/3D/3dmodel.model\" Id=\"rel0\" Type=\"http://"
      "schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
      "</Relationships>\n";
  std::vector<std::pair<std::string, std::string>> entries = {
      {"[Content_Types].xml", types},
      {"_rels/.rels", relations},
      {"3D/3dmodel.model", Writer3mf(content).model()}};
  if (images.empty()) return package_of(entries);
  std::string own =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"http:"
      "//schemas.openxmlformats.org/package/2006/relationships\">";
  for (std::size_t i = 0; i < images.size(); ++i) {
    own += "<Relationship Target=\"" + (kImageFolder + images[i].name) +
           "\" Id=\"image" + std::to_string(i) +
           "\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/"
           "3dtexture\"/>";
    entries.emplace_back((kImageFolder + images[i].name).substr(1),
                         images[i].bytes);
  }
  entries.emplace_back("3D/_rels/3dmodel.model.rels",
                       own + "</Relationships>\n");
  return package_of(entries);
}

}  // namespace halfspace::io
