#include <algorithm>
#include <unordered_map>

#include "base/plain_file.hpp"
#include "base/text.hpp"
#include "halfspace/io/file.hpp"
#include "mesh/images.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

/// More of a file of materials is not read.
constexpr std::uint64_t kMostMaterialBytes = std::uint64_t{1} << 26;

using MaterialTokens = std::span<const std::string_view>;

/// A number from 0 to 1; nothing where it is none.
std::optional<double> share_of(std::string_view text) {
  const double value = value_or_none(text);
  if (!(value >= 0 && value <= 1)) return std::nullopt;
  return value;
}

/// The name of an image behind the options of a map.
std::string image_name(MaterialTokens values) {
  // Options begin with a hyphen, and have words or numbers after them: a name
  // with blanks is only read where there are none.
  if (values.empty()) return {};
  if (values.front().starts_with('-')) return std::string(values.back());
  return joined(values);
}

/// Takes the materials of one file into those of a mesh.
class MtlReader {
 public:
  MtlReader(std::string_view text, Mesh& mesh)
      : text_(text, {.comments = true, .continued = true}), mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.attributes.materials.size(); ++i)
      places_.emplace(mesh.attributes.materials[i].name, i);
  }

  /// What is wrong first, if something is.
  std::optional<std::string> read() {
    while (text_.next_line()) {
      const MaterialTokens tokens = text_.left();
      statement(tokens[0], tokens.subspan(1));
    }
    return trouble_;
  }

 private:
  void statement(std::string_view keyword, MaterialTokens values) {
    if (keyword == "newmtl") {
      const auto found = places_.find(joined(values));
      material_ = found == places_.end()
                      ? nullptr
                      : &mesh_.attributes.materials[found->second];
      return;
    }
    if (material_ == nullptr) return;  // of no face
    if (keyword == "Kd") {
      color(values);
    } else if (keyword == "d" || keyword == "Tr") {
      const auto share =
          values.empty() ? std::nullopt : share_of(values.back());
      if (!share) return complain(keyword);
      material_->opacity = keyword == "d" ? *share : 1 - *share;
    } else if (keyword == "map_Kd") {
      material_->texture = image_name(values);
    } else if (kHasImages && (keyword == "Pm" || keyword == "Pr")) {
      const auto share =
          values.empty() ? std::nullopt : share_of(values.back());
      if (!share) return complain(keyword);
      (keyword == "Pm" ? material_->metallic : material_->roughness) = share;
    }
  }

  void color(MaterialTokens values) {
    std::vector<double> shares;
    for (const std::string_view value : values) {
      const auto share = share_of(value);
      if (!share) return complain("Kd");
      shares.push_back(*share);
    }
    // One number is a grey.
    if (shares.size() == 1) shares.assign(3, shares[0]);
    if (shares.size() != 3) return complain("Kd");
    material_->color = rgb_of(shares);
  }

  void complain(std::string_view keyword) {
    if (trouble_) return;
    trouble_ = "line " + std::to_string(text_.line()) + ": " +
               std::string(keyword) + " has no numbers from 0 to 1";
  }

  TextReader text_;
  Mesh& mesh_;
  std::unordered_map<std::string, std::size_t> places_;
  Material* material_ = nullptr;
  std::optional<std::string> trouble_;
};

}  // namespace

void add_materials(const std::filesystem::path* folder, Mesh& mesh) {
  Attributes& attributes = mesh.attributes;
  const std::vector<std::filesystem::path> named = std::move(attributes.files);
  attributes.files.clear();
  // Whoever names one of them often reads it once.
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::path& name : named) {
    if (folder == nullptr || attributes.materials.empty()) continue;
    const auto path = path_beside(*folder, name.string());
    if (std::find(paths.begin(), paths.end(), path) == paths.end() &&
        paths.size() < 100)
      paths.push_back(path);
  }
  for (const std::filesystem::path& path : paths) {
    if (!is_plain_file(path)) {
      attributes.notes.push_back("there is no file of materials " +
                                 path.string());
      continue;
    }
    const Result<std::string> bytes = read_file(path, kMostMaterialBytes);
    if (!bytes) {
      attributes.notes.push_back(bytes.error().message);
      continue;
    }
    attributes.files.push_back(path);
    if (const auto trouble = MtlReader(*bytes, mesh).read())
      attributes.notes.push_back(path.string() + ": " + *trouble);
  }
  if constexpr (kHasImages) find_images(folder, mesh);
}

}  // namespace halfspace::io
