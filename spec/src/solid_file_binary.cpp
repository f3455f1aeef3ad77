#include <utility>

#include "crc32c.hpp"
#include "solid_file.hpp"

namespace halfspace {
namespace {

constexpr std::size_t kCrcBytes = 4;
enum Flag : std::uint32_t { kChecked = 1, kConforming = 2 };

/// Puts integers into bytes, the least significant first.
class ByteWriter {
 public:
  template <class Int>
  void put(Int value, std::size_t size = sizeof(Int)) {
    for (std::size_t i = 0; i < size; ++i)
      bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
  void put(const GridPoint& p) {
    put(p.x);
    put(p.y);
    put(p.z);
  }
  std::string bytes;
};

/// Takes integers out of bytes; notes where these end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Int>
  Int get() {
    if (bytes_.size() - at_ < sizeof(Int)) {
      is_cut_ = true;
      at_ = bytes_.size();
      return {};
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Int); ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[at_ + i]);
      value |= std::uint64_t{byte} << (8 * i);
    }
    at_ += sizeof(Int);
    return static_cast<Int>(value);
  }
  std::string_view get_bytes(std::size_t count) {
    if (bytes_.size() - at_ < count) {
      is_cut_ = true;
      count = bytes_.size() - at_;
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t at() const { return at_; }
  bool is_cut() const { return is_cut_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_cut_ = false;
};

Error error_at_byte(ErrorCode code, const std::string& what, std::size_t at) {
  return {code, "byte " + std::to_string(at) + ": " + what,
          static_cast<std::int64_t>(at)};
}

std::int64_t get_int64(ByteReader& in) {
  return static_cast<std::int64_t>(in.get<std::uint64_t>());
}

Int128 get_int128(ByteReader& in) {
  const auto low = in.get<std::uint64_t>();
  const auto high = in.get<std::uint64_t>();
  __extension__ using Uint128 = unsigned __int128;
  return static_cast<Int128>((Uint128{high} << 64) | low);
}

GridPoint get_point(ByteReader& in) {
  const std::int64_t x = get_int64(in), y = get_int64(in), z = get_int64(in);
  return {x, y, z};
}

/// Reads a file's body, list by list.
class BodyReader {
 public:
  explicit BodyReader(std::string_view bytes) : in_(bytes) {}
  Result<SolidData> read();

 private:
  bool header();
  /// Reads a list's length and its items, of at least `size` bytes each, which
  /// are there if there are to be so many.
  template <class Item, class Read>
  bool list(std::vector<Item>& items, std::size_t size, Read&& read) {
    const std::size_t at = in_.at();
    const auto count = in_.get<std::uint32_t>();
    if (in_.is_cut() || count > in_.left() / size || count > kMostSolidItems) {
      error_ = error_at_byte(
          ErrorCode::kTruncated,
          "a list of " + std::to_string(count) + " is longer than the file",
          at);
      return false;
    }
    items.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) items.push_back(read());
    if (!in_.is_cut()) return true;
    error_ = error_at_byte(ErrorCode::kTruncated, "the file ends in a list",
                           in_.at());
    return false;
  }
  bool lists();
  SolidData::Face face();

  ByteReader in_;
  SolidData data_;
  std::uint32_t version_ = 0;
  Error error_{};
};

bool BodyReader::header() {
  in_.get_bytes(kSolidBinaryMagic.size());
  const auto version = in_.get<std::uint32_t>();
  const auto flags = in_.get<std::uint32_t>();
  data_.unit.base = static_cast<std::int32_t>(in_.get<std::uint32_t>());
  data_.unit.exponent = static_cast<std::int32_t>(in_.get<std::uint32_t>());
  data_.grid_bits = static_cast<int>(in_.get<std::uint32_t>());
  if (in_.is_cut()) {
    error_ = error_at_byte(ErrorCode::kTruncated, "the file ends in its header",
                           in_.at());
    return false;
  }
  version_ = version;
  if (version < kFirstSolidVersion || version > kSolidVersion ||
      (flags & ~(kChecked | kConforming)) != 0) {
    error_ = error_at_byte(ErrorCode::kUnknownFormat,
                           "version " + std::to_string(version) + ", flags " +
                               std::to_string(flags) + " are not known",
                           kSolidBinaryMagic.size());
    return false;
  }
  data_.is_checked = (flags & kChecked) != 0;
  data_.is_conforming = (flags & kConforming) != 0;
  return true;
}

SolidData::Face BodyReader::face() {
  SolidData::Face made;
  made.plane = in_.get<std::uint32_t>();
  made.origin = in_.get<std::uint32_t>();
  made.loop_count = in_.get<std::uint32_t>();
  made.color.r = in_.get<std::uint8_t>();
  made.color.g = in_.get<std::uint8_t>();
  made.color.b = in_.get<std::uint8_t>();
  const auto side = in_.get<std::uint8_t>();
  made.flipped = (side & 1) != 0;
  made.has_color = (side & 2) == 0;
  // Else there would be two files of one solid.
  if (side > (version_ == kFirstSolidVersion ? 1 : 3) ||
      (!made.has_color && made.color != Rgb()))
    made.loop_count = 0;
  return made;
}

bool BodyReader::lists() {
  const auto index = [&] { return in_.get<std::uint32_t>(); };
  return list(data_.points, 24, [&] { return get_point(in_); }) &&
         list(data_.planes, 72,
              [&] {
                SolidData::Plane plane;
                for (Int128& n : plane.normal) n = get_int128(in_);
                plane.origin = get_point(in_);
                return plane;
              }) &&
         list(data_.meets, 12,
              [&] {
                std::array<std::uint32_t, 3> meet{};
                for (std::uint32_t& plane : meet) plane = index();
                return meet;
              }) &&
         list(data_.parts, 4,
              [&] { return std::string(in_.get_bytes(index())); }) &&
         list(data_.origins, 8,
              [&] {
                SolidData::Origin origin;
                origin.part = index();
                origin.polygon = index();
                return origin;
              }) &&
         list(data_.faces, 16, [&] { return face(); }) &&
         list(data_.loops, 4, index) && list(data_.corners, 8, [&] {
           SolidData::Corner corner;
           corner.vertex = index();
           corner.plane = index();
           return corner;
         });
}

Result<SolidData> BodyReader::read() {
  if (!header() || !lists()) return error_;
  if (in_.left() > 0) {
    return error_at_byte(ErrorCode::kSyntax, "there are bytes after the solid",
                         in_.at());
  }
  return std::move(data_);
}

template <class Items, class Put>
void put_list(ByteWriter& out, const Items& items, Put&& put) {
  out.put(static_cast<std::uint32_t>(items.size()));
  for (const auto& item : items) put(item);
}

void put_faces(ByteWriter& out, const SolidData& data) {
  put_list(out, data.faces, [&](const SolidData::Face& face) {
    out.put(face.plane);
    out.put(face.origin);
    out.put(face.loop_count);
    const Rgb color = face.has_color ? face.color : Rgb();
    out.put(color.r);
    out.put(color.g);
    out.put(color.b);
    out.put(static_cast<std::uint8_t>((face.flipped ? 1 : 0) +
                                      (face.has_color ? 0 : 2)));
  });
  put_list(out, data.loops, [&](std::uint32_t count) { out.put(count); });
  put_list(out, data.corners, [&](const SolidData::Corner& corner) {
    out.put(corner.vertex);
    out.put(corner.plane);
  });
}

}  // namespace

Result<SolidData> read_solid_binary(std::string_view bytes) {
  if (!bytes.starts_with(kSolidBinaryMagic)) {
    const bool is_cut = kSolidBinaryMagic.starts_with(bytes);
    return error_at_byte(
        is_cut ? ErrorCode::kTruncated : ErrorCode::kUnknownFormat,
        "this is no exact solid, or its line ends were changed on the way", 0);
  }
  if (bytes.size() < kSolidBinaryMagic.size() + kCrcBytes) {
    return error_at_byte(ErrorCode::kTruncated, "the file ends in its header",
                         bytes.size());
  }
  const std::string_view body = bytes.substr(0, bytes.size() - kCrcBytes);
  Result<SolidData> data = BodyReader(body).read();
  // A file that is cut off says so, and not that its checksum is wrong.
  if (!data && data.error().code == ErrorCode::kUnknownFormat) return data;
  ByteReader end(bytes.substr(body.size()));
  const bool agrees = crc32c(body) == end.get<std::uint32_t>();
  if (!data && (agrees || data.error().code == ErrorCode::kTruncated))
    return data;
  if (!agrees) {
    return error_at_byte(ErrorCode::kSyntax,
                         "the checksum is wrong: the file is damaged; write it "
                         "anew",
                         body.size());
  }
  return data;
}

std::string solid_binary(const SolidData& data) {
  ByteWriter out;
  out.bytes = kSolidBinaryMagic;
  out.put(solid_version(data));
  out.put((data.is_checked ? kChecked : 0u) |
          (data.is_conforming ? kConforming : 0u));
  out.put(static_cast<std::uint32_t>(data.unit.base));
  out.put(static_cast<std::uint32_t>(data.unit.exponent));
  out.put(static_cast<std::uint32_t>(data.grid_bits));
  put_list(out, data.points, [&](const GridPoint& point) { out.put(point); });
  put_list(out, data.planes, [&](const SolidData::Plane& plane) {
    for (const Int128 n : plane.normal) out.put(n);
    out.put(plane.origin);
  });
  put_list(out, data.meets, [&](const std::array<std::uint32_t, 3>& meet) {
    for (const std::uint32_t plane : meet) out.put(plane);
  });
  put_list(out, data.parts, [&](const std::string& name) {
    out.put(static_cast<std::uint32_t>(name.size()));
    out.bytes += name;
  });
  put_list(out, data.origins, [&](const SolidData::Origin& origin) {
    out.put(origin.part);
    out.put(origin.polygon);
  });
  put_faces(out, data);
  out.put(crc32c(out.bytes));
  return std::move(out.bytes);
}

}  // namespace halfspace
