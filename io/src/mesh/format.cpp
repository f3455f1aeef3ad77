#include "halfspace/io/format.hpp"

#include <algorithm>

#include "mesh/format_table.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

Result<std::string> encoded_obj(const MeshContent& content) {
  return obj_text(content.texts, content.faces);
}

Result<std::string> encoded_stl(const MeshContent& content) {
  return stl_binary(content.doubles, content.triangles);
}

Result<std::string> encoded_ply(const MeshContent& content) {
  return content.texts.empty() ? ply_binary(content.doubles, content.faces)
                               : ply_text(content.texts, content.faces);
}

Result<std::string> encoded_off(const MeshContent& content) {
  return off_text(content.texts, content.faces);
}

using enum Coordinates;
/// In the order of the enumerators.
constexpr FormatEntry kFormats[] = {
    {Format::kObj, "OBJ", ".obj", kText, false, read_obj, encoded_obj},
    {Format::kStl, "STL", ".stl", kFloats, true, read_stl, encoded_stl},
    {Format::kPly, "PLY", ".ply", kTextOrDoubles, false, read_ply, encoded_ply},
    {Format::kOff, "OFF", ".off", kText, false, read_off, encoded_off}};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

std::span<const FormatEntry> format_table() { return kFormats; }

const FormatEntry* entry_of(Format format) {
  const auto i = static_cast<std::size_t>(format);
  return i < std::size(kFormats) ? &kFormats[i] : nullptr;
}

std::optional<Format> format_of(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (lower_extension(name) == ".gz") name = name.stem();
  const std::string extension = lower_extension(name);
  const auto entry = std::find_if(
      std::begin(kFormats), std::end(kFormats),
      [&](const FormatEntry& e) { return e.extension == extension; });
  if (entry == std::end(kFormats)) return std::nullopt;
  return entry->format;
}

std::string format_extensions(std::string_view other) {
  std::vector<std::string_view> words;
  for (const FormatEntry& entry : kFormats) words.push_back(entry.extension);
  if (!other.empty()) words.push_back(other);
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 < words.size() ? ", " : " or ";
    list += words[i];
  }
  return list;
}

std::string format_names() {
  std::string list;
  for (const FormatEntry& entry : kFormats) {
    if (!list.empty()) list += ", ";
    list += entry.name;
  }
  return list;
}

}  // namespace halfspace::io
