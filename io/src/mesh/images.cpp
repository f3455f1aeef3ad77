#include "mesh/images.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/plain_file.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/message.hpp"

namespace halfspace::io {
namespace {

/// More of an image is not read, nor of all images of a file together.
constexpr std::uint64_t kMostImageBytes = std::uint64_t{1} << 28;

constexpr std::string_view kPngBegin = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpegBegin = "\xff\xd8\xff";

/// A file's name without folders and extension, of characters that any file and
/// any text may have.
std::string plain_stem(const std::string& path) {
  const std::size_t slash = path.find_last_of("/\\");
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  if (const std::size_t dot = name.rfind('.'); dot != std::string::npos)
    name.erase(dot);
  for (char& c : name) {
    const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                          (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
    if (!is_plain) c = '_';
  }
  constexpr std::size_t kLongest = 64;
  name.resize(std::min(name.size(), kLongest));
  return name.empty() ? "image" : name;
}

std::string plain_name(const std::string& texture, std::string_view type) {
  return plain_stem(texture) + (type == "image/png" ? ".png" : ".jpeg");
}

/// The name with a number before its last point.
std::string numbered(const std::string& name, std::size_t number) {
  const std::size_t dot = name.rfind('.');
  return name.substr(0, dot) + "_" + std::to_string(number) + name.substr(dot);
}

/// Reads each image once.
class ImageCollector {
 public:
  explicit ImageCollector(std::vector<std::string>& notes) : notes_(notes) {}

  std::int32_t place_of(const Material& material) {
    if (material.texture.empty()) return -1;
    if (!material.image) {
      note(material, "it was not found");
      return -1;
    }
    const Image& image = *material.image;
    if (!image.file.empty()) {
      const auto [at, is_new] = of_file_.try_emplace(image.file.string(), -1);
      if (is_new) at->second = add_file(material);
      return at->second;
    }
    return add(material, image.bytes);
  }
  std::vector<EmbeddedImage> taken() { return std::move(images_); }

 private:
  std::int32_t add_file(const Material& material) {
    const std::filesystem::path& file = material.image->file;
    if (!is_plain_file(file)) {
      note(material, "there is no file " + file.string());
      return -1;
    }
    Result<std::string> bytes = read_file(file, kMostImageBytes);
    if (!bytes) {
      note(material, bytes.error().message);
      return -1;
    }
    return add(material, *std::move(bytes));
  }

  std::int32_t add(const Material& material, std::string bytes) {
    const char* const type = image_type(bytes);
    if (type == nullptr) {
      note(material, "it is neither a PNG nor a JPEG");
      return -1;
    }
    const auto same = std::find_if(
        images_.begin(), images_.end(),
        [&](const EmbeddedImage& other) { return other.bytes == bytes; });
    if (same != images_.end())
      return static_cast<std::int32_t>(same - images_.begin());
    std::string name = plain_name(material.texture, type);
    for (std::size_t i = 2; !names_.insert(name).second; ++i)
      name = numbered(plain_name(material.texture, type), i);
    images_.push_back({std::move(name), type, std::move(bytes)});
    return static_cast<std::int32_t>(images_.size() - 1);
  }

  void note(const Material& material, const std::string& why) {
    notes_.push_back("the image " + in_quotes(material.texture) + " of " +
                     in_quotes(material.name) + " is not in it: " + why);
  }

  std::vector<std::string>& notes_;
  std::map<std::string, std::int32_t> of_file_;
  std::set<std::string> names_;
  std::vector<EmbeddedImage> images_;
};

/// The image's path as a file in `folder`, which may be empty, names it.
std::string path_from(const std::filesystem::path& folder,
                      const std::filesystem::path& file) {
  std::error_code error;
  const auto whole = [&error](const std::filesystem::path& path) {
    return std::filesystem::absolute(path, error).lexically_normal();
  };
  const std::filesystem::path from =
      whole(file).lexically_relative(whole(folder.empty() ? "." : folder));
  return error || from.empty() ? file.string() : from.generic_string();
}

/// Writes the image under the first name of its kind that is free or is that
/// very image already; returns the name.
Result<std::string> written_beside(const std::filesystem::path& path,
                                   const Material& material) {
  const std::string& bytes = material.image->bytes;
  const char* const type = image_type(bytes);
  // An output may be called `part.ply.gz`.
  const std::string stem = plain_stem(path.stem().string() + ".");
  const std::string name = stem + "_" + plain_name(material.texture, type);
  std::string tried = name;
  for (std::size_t i = 2;; ++i) {
    const std::filesystem::path file = path.parent_path() / tried;
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown)) {
      const Result<Done> done = write_file(file, bytes);
      if (!done) return done.error();
      return tried;
    }
    const auto there = is_plain_file(file) ? read_file(file, kMostImageBytes)
                                           : Result<std::string>(std::string());
    if (there && *there == bytes) return tried;
    tried = numbered(name, i);
  }
}

}  // namespace

const char* image_type(std::string_view bytes) {
  if (bytes.starts_with(kPngBegin)) return "image/png";
  return bytes.starts_with(kJpegBegin) ? "image/jpeg" : nullptr;
}

void find_images(const std::filesystem::path* folder, Mesh& mesh) {
  if (folder == nullptr) return;
  Attributes& attributes = mesh.attributes;
  std::map<std::string, std::shared_ptr<const Image>> found;
  for (Material& material : attributes.materials) {
    if (material.texture.empty() || material.image) continue;
    const auto [at, is_new] = found.try_emplace(material.texture, nullptr);
    const auto path = path_beside(*folder, material.texture);
    if (is_new && is_plain_file(path)) {
      at->second = std::make_shared<const Image>(Image{path, {}});
      attributes.files.push_back(path);
    }
    material.image = at->second;
  }
}

EmbeddedImages embedded_images(const Attributes& attributes,
                               std::vector<std::string>& notes) {
  EmbeddedImages embedded;
  if (attributes.face_materials.empty()) return embedded;
  ImageCollector collector(notes);
  for (const Material& material : attributes.materials)
    embedded.of_material.push_back(collector.place_of(material));
  embedded.images = collector.taken();
  return embedded;
}

Result<std::vector<std::string>> images_beside(
    const std::filesystem::path& path, const Attributes& attributes) {
  std::vector<std::string> names;
  if (attributes.face_materials.empty()) return names;
  std::map<const Image*, std::string> written;
  for (const Material& material : attributes.materials) {
    std::string& name = names.emplace_back(material.texture);
    if (!material.image) continue;
    if (!material.image->file.empty()) {
      name = path_from(path.parent_path(), material.image->file);
      continue;
    }
    const auto [at, is_new] = written.try_emplace(material.image.get());
    if (is_new) {
      Result<std::string> made = written_beside(path, material);
      if (!made) return made.error();
      at->second = *std::move(made);
    }
    name = at->second;
  }
  return names;
}

}  // namespace halfspace::io
