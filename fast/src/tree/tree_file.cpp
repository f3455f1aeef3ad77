#include "halfspace/fast/tree_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "tree/leaf_packets.hpp"

namespace halfspace::fast {
namespace {

/// Words of 64 bits, hashed one after the other.
///
/// Each step is a bijection of the state for a given word, and of the word for
/// a given state: so two inputs that differ in one word never end alike.
class Checksum {
 public:
  void add(std::uint64_t word) {
    state_ = std::rotl((state_ ^ word) * 0x9e3779b97f4a7c15u, 29);
  }
  void add(std::span<const std::byte> bytes) {
    while (bytes.size() >= 8) {
      std::uint64_t word;
      std::memcpy(&word, bytes.data(), 8);
      add(word);
      bytes = bytes.subspan(8);
    }
    std::uint64_t rest = 0;
    if (!bytes.empty()) std::memcpy(&rest, bytes.data(), bytes.size());
    add(rest);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3u;
};

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

constexpr std::array<char, 8> kMagic = {'H', 'S', 'P', 'C', 'T', 'R', 'E', 'E'};
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kSections = 6;

// No gaps within the elements, but in a free plane.
static_assert(sizeof(Node) == 4 * 4 + 4 * 8);
static_assert(sizeof(TreeFragment) == 4 * 4);
static_assert(sizeof(Corner) == 2 * 4);
static_assert(sizeof(Vertex) == 4 * 8);
static_assert(sizeof(Box) == 6 * 4);

struct Section {
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
  std::uint64_t element_size = 0;
  friend bool operator==(const Section&, const Section&) = default;
};

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kTreeFileVersion;
  std::uint32_t byte_order = kByteOrder;
  std::uint64_t scene = 0;
  std::uint64_t file_size = 0;
  std::array<Section, kSections> sections{};
  std::array<std::uint64_t, 8> unused{};
  std::uint64_t body_checksum = 0;
  std::uint64_t header_checksum = 0;  // of the members before it
};
static_assert(sizeof(Header) == 256);

std::span<const std::byte> checked_part(const Header& header) {
  return std::as_bytes(std::span<const Header>(&header, 1))
      .first(offsetof(Header, header_checksum));
}

/// Calls take(array) for the arrays, in the order of the sections.
template <class Tree, class Take>
void for_arrays(Tree& tree, Take&& take) {
  take(tree.nodes);
  take(tree.fragments);
  take(tree.corners);
  take(tree.cut_vertices);
  take(tree.free_planes);
  take(tree.boxes);
}

std::uint64_t aligned(std::uint64_t offset) {
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

/// The sections of arrays of these lengths, and where they end.
template <class Tree>
std::uint64_t lay_out(const Tree& tree, std::array<Section, kSections>& all) {
  std::uint64_t end = sizeof(Header);
  std::size_t s = 0;
  for_arrays(tree, [&](const auto& array) {
    const std::uint64_t size = sizeof(array[0]);
    all[s++] = {aligned(end), array.size(), size};
    end = aligned(end) + array.size() * size;
  });
  return end;
}

template <class T>
void copy_out(const std::vector<T>& array, std::byte* to) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (!array.empty()) std::memcpy(to, array.data(), array.size() * sizeof(T));
}

/// A free plane has padding between its members, whose bytes are not defined.
void copy_out(const std::vector<FreePlane>& array, std::byte* to) {
  for (const FreePlane& plane : array) {
    std::memcpy(to + offsetof(FreePlane, axis), &plane.axis,
                sizeof(plane.axis));
    std::memcpy(to + offsetof(FreePlane, coordinate), &plane.coordinate,
                sizeof(plane.coordinate));
    to += sizeof(FreePlane);
  }
}

Error corrupt(std::int64_t first_byte) {
  return {ErrorCode::kSyntax,
          "the checksum of the bytes from " + std::to_string(first_byte) +
              " on is wrong",
          first_byte};
}

/// Whether there is a readable header, and all that it says is there.
std::optional<Error> header_error(std::span<const std::byte> bytes,
                                  Header& header) {
  if (bytes.size() < sizeof(Header)) {
    return Error{ErrorCode::kTruncated,
                 "a tree file has at least 256 bytes, not " +
                     std::to_string(bytes.size()),
                 static_cast<std::int64_t>(bytes.size())};
  }
  std::memcpy(&header, bytes.data(), sizeof(Header));
  if (header.magic != kMagic) {
    return Error{ErrorCode::kUnknownFormat, "not a tree file", 0};
  }
  if (header.version != kTreeFileVersion || header.byte_order != kByteOrder) {
    return Error{ErrorCode::kUnknownFormat,
                 "a tree file of version " + std::to_string(header.version) +
                     " or of another byte order, not of version " +
                     std::to_string(kTreeFileVersion),
                 8};
  }
  if (checksum_of(checked_part(header)) != header.header_checksum) {
    return corrupt(0);
  }
  if (bytes.size() < header.file_size) {
    return Error{ErrorCode::kTruncated,
                 "the file ends after " + std::to_string(bytes.size()) +
                     " of " + std::to_string(header.file_size) + " bytes",
                 static_cast<std::int64_t>(bytes.size())};
  }
  if (bytes.size() > header.file_size) {
    return Error{ErrorCode::kSyntax, "bytes follow the tree",
                 static_cast<std::int64_t>(header.file_size)};
  }
  if (checksum_of(bytes.subspan(sizeof(Header))) != header.body_checksum) {
    return corrupt(sizeof(Header));
  }
  return std::nullopt;
}

/// Checks that every index of a tree leads somewhere, and only once.
class IndexCheck {
 public:
  IndexCheck(const BspTree& tree, const Scene& scene)
      : tree_(tree),
        scene_(scene),
        has_parent_(tree.nodes.size()),
        is_listed_(tree.fragments.size()) {}

  std::optional<Error> run() {
    if (!tree_.boxes.empty() && tree_.boxes.size() != tree_.nodes.size()) {
      return error("box", tree_.boxes.size());
    }
    for (std::size_t f = 0; f < tree_.fragments.size(); ++f) {
      if (!is_good(tree_.fragments[f])) return error("fragment", f);
    }
    for (const FreePlane& plane : tree_.free_planes) {
      if (plane.axis < 0 || plane.axis > 2) return error("free plane", 0);
    }
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      if (!is_good(n)) return error("node", n);
    }
    return std::nullopt;
  }

 private:
  static Error error(const char* what, std::size_t index) {
    return {ErrorCode::kBadIndex,
            "an index in " + std::string(what) + " " + std::to_string(index) +
                " names nothing",
            static_cast<std::int64_t>(index)};
  }
  static bool names(std::int64_t index, std::size_t count) {
    return 0 <= index && static_cast<std::uint64_t>(index) < count;
  }

  bool is_good(const TreeFragment& fragment) const {
    if (!names(fragment.source, scene_.polygon_count())) return false;
    if (fragment.corner_count < 3 ||
        std::uint64_t{fragment.first_corner} + fragment.corner_count >
            tree_.corners.size()) {
      return false;
    }
    const std::size_t sides = scene_.corners(fragment.source).size();
    const std::size_t vertices =
        scene_.data().vertices.size() + tree_.cut_vertices.size();
    for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
      const Corner& corner = tree_.corners[fragment.first_corner + k];
      const std::int64_t edge = corner.edge;
      if (!(edge >= 0 ? names(edge, sides) : is_plane(-1 - edge))) return false;
      if (!names(corner.vertex, vertices)) return false;
    }
    return true;
  }

  bool is_plane(std::int64_t plane) const {
    return names(plane, scene_.polygon_count() + tree_.free_planes.size());
  }

  bool is_good(std::size_t id) {
    const Node& node = tree_.nodes[id];
    const bool is_leaf = node.splitter == kNoPlane;
    if (!is_leaf && !is_plane(node.splitter)) return false;
    for (const NodeId child : {node.positive, node.negative}) {
      if (child == kNoNode) continue;
      // Parents come before their children, so no way leads back.
      if (is_leaf || !names(child, tree_.nodes.size())) return false;
      const auto c = static_cast<std::size_t>(child);
      if (c <= id || has_parent_[c]) return false;
      has_parent_[c] = true;
    }
    for (std::int32_t f = node.first_fragment; f != kNoFragment;) {
      if (!names(f, tree_.fragments.size())) return false;
      const auto k = static_cast<std::size_t>(f);
      if (is_listed_[k]) return false;
      is_listed_[k] = true;
      f = tree_.fragments[k].next;
    }
    return true;
  }

  const BspTree& tree_;
  const Scene& scene_;
  std::vector<bool> has_parent_;
  std::vector<bool> is_listed_;
};

/// All of a file; nothing where it cannot be read.
std::optional<std::vector<std::byte>> bytes_of_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return std::nullopt;
  std::vector<std::byte> bytes;
  std::size_t got = 0;
  do {
    const std::size_t before = bytes.size();
    bytes.resize(std::max<std::size_t>(2 * before, std::size_t{1} << 16));
    got =
        std::fread(bytes.data() + before, 1, bytes.size() - before, file.get());
    bytes.resize(before + got);
  } while (got > 0);
  // A directory opens, but cannot be read.
  if (std::ferror(file.get()) != 0) return std::nullopt;
  return bytes;
}

Error at_path(const std::string& path, Error error) {
  error.message = path + ": " + error.message;
  return error;
}

}  // namespace

std::uint64_t fingerprint_of(const Scene& scene) {
  const SceneData& data = scene.data();
  Checksum sum;
  sum.add(static_cast<std::uint64_t>(data.grid_bits));
  sum.add(data.vertices.size());
  sum.add(data.corners.size());
  sum.add(data.first_corner.size());
  sum.add(std::as_bytes(std::span(data.vertices)));
  sum.add(std::as_bytes(std::span(data.corners)));
  sum.add(std::as_bytes(std::span(data.first_corner)));
  return sum.value();
}

std::vector<std::byte> encode_tree(const BspTree& tree, const Scene& scene) {
  Header header;
  header.scene = fingerprint_of(scene);
  header.file_size = lay_out(tree, header.sections);
  std::vector<std::byte> bytes(header.file_size);
  std::size_t s = 0;
  for_arrays(tree, [&](const auto& array) {
    copy_out(array, bytes.data() + header.sections[s++].offset);
  });
  header.body_checksum =
      checksum_of(std::span<const std::byte>(bytes).subspan(sizeof(Header)));
  header.header_checksum = checksum_of(checked_part(header));
  std::memcpy(bytes.data(), &header, sizeof(Header));
  return bytes;
}

Result<BspTree> decode_tree(std::span<const std::byte> bytes,
                            const Scene& scene) {
  Header header;
  if (auto error = header_error(bytes, header)) return *std::move(error);
  if (header.scene != fingerprint_of(scene)) {
    return Error{ErrorCode::kBadIndex, "the tree is that of another scene", -1};
  }
  BspTree tree;
  // Sections that do not fit would ask for memory that is not needed.
  std::uint64_t room = header.file_size;
  bool fits = true;
  std::size_t s = 0;
  for_arrays(tree, [&](auto& array) {
    const Section& section = header.sections[s++];
    const std::uint64_t most = room / sizeof(array[0]);
    fits = fits && section.count <= most;
    if (!fits) return;
    room -= section.count * sizeof(array[0]);
    array.resize(section.count);
  });
  std::array<Section, kSections> expected;
  if (!fits || lay_out(tree, expected) != header.file_size ||
      expected != header.sections) {
    return Error{ErrorCode::kUnknownFormat,
                 "the arrays do not lie as version 1 lays them", 32};
  }
  s = 0;
  for_arrays(tree, [&](auto& array) {
    const Section& section = header.sections[s++];
    if (array.empty()) return;
    std::memcpy(array.data(), bytes.data() + section.offset,
                array.size() * sizeof(array[0]));
  });
  if (auto error = IndexCheck(tree, scene).run()) return *std::move(error);
  if (has_leaves(tree)) add_blocks(tree, scene);
  return tree;
}

Result<Done> save_tree(const std::string& path, const BspTree& tree,
                       const Scene& scene) {
  const std::vector<std::byte> bytes = encode_tree(tree, scene);
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  bool good = file != nullptr;
  if (good) {
    good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    good = std::fclose(file) == 0 && good;
  }
  if (good) return Done{};
  return Error{ErrorCode::kUnwritable, path + ": cannot be written", -1};
}

Result<BspTree> load_tree(const std::string& path, const Scene& scene) {
  const auto bytes = bytes_of_file(path);
  if (!bytes) {
    return Error{ErrorCode::kUnreadable, path + ": cannot be read", -1};
  }
  Result<BspTree> tree = decode_tree(*bytes, scene);
  if (!tree) return at_path(path, tree.error());
  return tree;
}

}  // namespace halfspace::fast
