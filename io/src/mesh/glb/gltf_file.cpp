#include "mesh/glb/gltf_file.hpp"

#include <optional>
#include <utility>

#include "base/binary.hpp"
#include "base/plain_file.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/message.hpp"
#include "mesh/glb/base64.hpp"
#include "mesh/glb/glb.hpp"

namespace halfspace::io {
namespace {

/// The two chunks of a GLB; errors name the byte.
struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> bytes;
};

std::optional<Error> header_error(std::string_view file) {
  const auto word = [&](std::size_t at) {
    return load<std::uint32_t>(file, at, ByteOrder::kLittle);
  };
  if (file.size() < kGlbHeader || word(0) != kGlbMagic) {
    return Error{ErrorCode::kUnknownFormat,
                 "a GLB begins with glTF, and a .gltf with {", 0};
  }
  if (word(4) != 2) {
    return Error{ErrorCode::kUnknownFormat,
                 "the GLB is of version " + std::to_string(word(4)) +
                     ", and only 2 is read",
                 4};
  }
  if (word(8) <= file.size()) return std::nullopt;
  return Error{ErrorCode::kTruncated,
               "the file ends at byte " + std::to_string(file.size()) + " of " +
                   std::to_string(word(8)),
               static_cast<std::int64_t>(file.size())};
}

Result<GlbChunks> chunks_of(std::string_view file) {
  if (auto error = header_error(file)) return *error;
  const auto word = [&](std::size_t at) {
    return load<std::uint32_t>(file, at, ByteOrder::kLittle);
  };
  file = file.substr(0, word(8));
  GlbChunks chunks;
  std::size_t at = kGlbHeader;
  for (int i = 0; at + kGlbChunkHeader <= file.size(); ++i) {
    const std::uint32_t size = word(at), type = word(at + 4);
    at += kGlbChunkHeader;
    if (size > file.size() - at) {
      return Error{ErrorCode::kTruncated,
                   "the chunk at byte " + std::to_string(at - kGlbChunkHeader) +
                       " claims " + std::to_string(size) + " bytes, but " +
                       std::to_string(file.size() - at) + " are left",
                   static_cast<std::int64_t>(at - kGlbChunkHeader)};
    }
    if (i == 0 && type == kGlbJson) chunks.json = file.substr(at, size);
    if (i == 1 && type == kGlbBytes) chunks.bytes = file.substr(at, size);
    at += size;
  }
  if (chunks.json.empty())
    return Error{ErrorCode::kSyntax, "the GLB has no chunk of JSON", 12};
  return chunks;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// What a file's JSON says of its buffers, brought together.
class BufferReader {
 public:
  BufferReader(GltfFile& file, std::optional<std::string_view> own,
               const std::filesystem::path* folder)
      : file_(file), own_(own), folder_(folder) {}

  std::optional<Error> read() {
    const auto list = list_in(file_.json, "buffers", "the file");
    if (!list) return list.error();
    // Buffers that share a file would be as many copies of it.
    constexpr std::size_t kMostBuffers = 1000;
    if ((*list)->size() > kMostBuffers) {
      return Error{ErrorCode::kOutOfRange, "the file has over " +
                                               std::to_string(kMostBuffers) +
                                               " buffers; export it with one"};
    }
    for (std::size_t i = 0; i < (*list)->size(); ++i) {
      if (auto error = read_buffer(i)) return error;
    }
    // What a chunk holds is there, even if no list says so.
    if (file_.buffers.empty() && own_) file_.buffers.push_back(*own_);
    return std::nullopt;
  }

 private:
  std::optional<Error> read_buffer(std::size_t i) {
    const std::string place = item("buffers", i);
    const auto buffer = entry_at(file_.json, "buffers",
                                 static_cast<std::int64_t>(i), "the file");
    if (!buffer) return buffer.error();
    const auto length = whole(**buffer, "byteLength", 0, place);
    if (!length) return length.error();
    const std::string uri = text_in(**buffer, "uri");
    if (uri.empty() && !(i == 0 && own_)) {
      return Error{ErrorCode::kSyntax, place + " has neither bytes nor a uri"};
    }
    const auto bytes =
        uri.empty() ? Result<std::string_view>(*own_) : bytes_at(uri, place);
    if (!bytes) return bytes.error();
    if (bytes->size() < static_cast<std::uint64_t>(*length)) {
      return Error{ErrorCode::kTruncated,
                   place + " has " + std::to_string(bytes->size()) + " of " +
                       std::to_string(*length) + " bytes"};
    }
    file_.buffers.push_back(*bytes);
    return std::nullopt;
  }

  Result<std::string_view> bytes_at(const std::string& uri,
                                    const std::string& place) {
    if (!uri.starts_with("data:")) return bytes_beside(uri, place);
    std::optional<std::string> bytes = bytes_of_data_uri(uri);
    if (!bytes) return Error{ErrorCode::kSyntax, place + ".uri is no base64"};
    return std::string_view(file_.owned.emplace_back(*std::move(bytes)));
  }

  Result<std::string_view> bytes_beside(const std::string& uri,
                                        const std::string& place) {
    const bool is_elsewhere = leads_elsewhere(uri);
    if (folder_ == nullptr || is_elsewhere) {
      return Error{
          ErrorCode::kUnreadable,
          place + " is in " + in_quotes(uri) + ", which is not read " +
              (is_elsewhere ? "from there: put it beside the file or below"
                            : "without the folder: name the file")};
    }
    const std::filesystem::path path = *folder_ / name_of_uri(uri);
    if (!is_plain_file(path)) {
      return Error{ErrorCode::kUnreadable,
                   place + ": there is no file " + path.string()};
    }
    Result<std::string> bytes = read_file(path);
    if (!bytes) return bytes.error();
    file_.files.push_back(path);
    return std::string_view(file_.owned.emplace_back(*std::move(bytes)));
  }

  GltfFile& file_;
  std::optional<std::string_view> own_;
  const std::filesystem::path* folder_;
};

}  // namespace

bool leads_elsewhere(std::string_view uri) {
  if (uri.find("://") != std::string_view::npos) return true;
  const std::filesystem::path name =
      std::filesystem::path(name_of_uri(uri)).lexically_normal();
  return name.has_root_path() || (!name.empty() && *name.begin() == "..");
}

std::string name_of_uri(std::string_view uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high < 0 ? -1 : hex_digit(uri[i + 2]);
    if (uri[i] != '%' || low < 0) {
      name += uri[i];
      continue;
    }
    name += static_cast<char>(16 * high + low);
    i += 2;
  }
  return name;
}

std::optional<std::string> bytes_of_data_uri(std::string_view uri) {
  constexpr std::string_view kEncoded = ";base64,";
  const std::size_t at = uri.find(kEncoded);
  if (!uri.starts_with("data:") || at == std::string_view::npos)
    return std::nullopt;
  return bytes_of_base64(uri.substr(at + kEncoded.size()));
}

Result<GltfFile> gltf_file(std::string_view bytes,
                           const std::filesystem::path* folder) {
  GlbChunks chunks;
  std::size_t begin = 0;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && bytes[first] == '{') {
    chunks.json = bytes;
  } else {
    const Result<GlbChunks> found = chunks_of(bytes);
    if (!found) return found.error();
    chunks = *found;
    begin = kGlbHeader + kGlbChunkHeader;
  }
  Result<Json> json = parsed_json(chunks.json, begin);
  if (!json) return json.error();
  GltfFile file{*std::move(json), {}, {}, {}, {}};
  if (folder != nullptr) file.folder = *folder;
  if (auto error = BufferReader(file, chunks.bytes, folder).read())
    return *error;
  return file;
}

}  // namespace halfspace::io
