#include <charconv>
#include <cstdio>

#include "crc32c.hpp"
#include "solid_file.hpp"
#include "token_lines.hpp"

namespace halfspace {
namespace {

constexpr std::string_view kChecksum = "checksum";

bool is_plain(unsigned char c) {
  return c > ' ' && c < 0x7f && c != '%' && c != '#';
}

/// The name as one token: other bytes than plain ones as `%` and two digits.
std::string token_of(const std::string& name) {
  std::string token;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_plain(byte)) {
      token += c;
      continue;
    }
    char code[4];
    std::snprintf(code, sizeof code, "%%%02x", byte);
    token += code;
  }
  return token;
}

std::string hex_of(std::uint32_t value) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", value);
  return text;
}

/// The text up to the line of the checksum, and what that says.
struct Checked {
  std::string_view body;
  std::string_view sum;  ///< empty: there is no such line
};

Checked checked_part(std::string_view text) {
  std::size_t at = text.rfind("\nchecksum ");
  if (at == std::string_view::npos) return {text, {}};
  const std::string_view body = text.substr(0, ++at);
  std::string_view sum = text.substr(at + kChecksum.size() + 1);
  sum = sum.substr(0, sum.find_first_of("\r\n"));
  return {body, sum};
}

/// Reads one file, a line at a time.
class TextReader : private TokenLines {
 public:
  explicit TextReader(std::string_view text)
      : TokenLines(text), checked_(checked_part(text)) {}
  Result<SolidData> read();

 private:
  bool header_line(std::string_view keyword, std::size_t values);
  bool header();
  bool lines();
  bool body_line();
  bool flag(bool& value);
  bool point(std::size_t token, GridPoint& value);
  bool index(std::size_t token, std::uint32_t& value) {
    return integer(token, 0, Int128{kMostSolidItems}, value);
  }
  bool plane_line();
  bool meet_line();
  bool part_line();
  bool origin_line();
  bool face_line();
  bool loop_line();
  bool checksum_line();

  Checked checked_;
  SolidData data_;
  std::uint32_t version_ = 0;
  bool ended_ = false;
};

bool TextReader::header_line(std::string_view keyword, std::size_t values) {
  if (!next_line()) {
    ++line_;
    return fail(ErrorCode::kTruncated, "the file ends where its '" +
                                           std::string(keyword) +
                                           "' line should be");
  }
  if (tokens_[0] != keyword)
    return fail(ErrorCode::kSyntax, "there should be '" + std::string(keyword) +
                                        "', not " + in_quotes(tokens_[0]));
  return count_is(values);
}

bool TextReader::header() {
  if (!header_line(kSolidTextMagic, 1)) return false;
  for (std::uint32_t known = kFirstSolidVersion; known <= kSolidVersion;
       ++known) {
    if (tokens_[1] == std::to_string(known)) version_ = known;
  }
  if (version_ == 0)
    return fail(ErrorCode::kUnknownFormat,
                "version " + in_quotes(tokens_[1]) + " is not known");
  return header_line("unit", 2) && integer(1, 2, 10, data_.unit.base) &&
         integer(2, -4096, 4096, data_.unit.exponent) &&
         header_line("grid", 1) && integer(1, 26, 54, data_.grid_bits);
}

bool TextReader::flag(bool& value) {
  value = true;
  return count_is(0);
}

bool TextReader::point(std::size_t token, GridPoint& value) {
  const Int128 limit = Int128{1} << 53;
  return integer(token, -limit, limit - 1, value.x) &&
         integer(token + 1, -limit, limit - 1, value.y) &&
         integer(token + 2, -limit, limit - 1, value.z);
}

bool TextReader::plane_line() {
  SolidData::Plane plane;
  const Int128 limit = Int128{1} << 110;
  if (!count_is(6)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!integer(1 + k, -limit, limit, plane.normal[k])) return false;
  }
  if (!point(4, plane.origin)) return false;
  data_.planes.push_back(plane);
  return true;
}

bool TextReader::meet_line() {
  auto& meet = data_.meets.emplace_back();
  return count_is(3) && index(1, meet[0]) && index(2, meet[1]) &&
         index(3, meet[2]);
}

bool TextReader::part_line() {
  std::string& name = data_.parts.emplace_back();
  if (tokens_.size() == 1) return true;
  if (!count_is(1)) return false;
  const std::string_view token = tokens_[1];
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] != '%') {
      name += token[i];
      continue;
    }
    unsigned code = 0;
    const std::string_view digits = token.substr(i + 1, 2);
    const auto [end, trouble] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (trouble != std::errc() || digits.size() != 2 ||
        end != digits.data() + 2) {
      return fail(ErrorCode::kSyntax,
                  "after a % in a name there are two hexadecimal digits");
    }
    name += static_cast<char>(code);
    i += 2;
  }
  return true;
}

bool TextReader::origin_line() {
  SolidData::Origin& origin = data_.origins.emplace_back();
  return count_is(2) && index(1, origin.part) && index(2, origin.polygon);
}

bool TextReader::face_line() {
  SolidData::Face& face = data_.faces.emplace_back();
  face.has_color = version_ == kFirstSolidVersion || tokens_.size() != 5 ||
                   tokens_[3] != "-";
  if (!count_is(face.has_color ? 6 : 4) || !index(1, face.plane)) return false;
  if (tokens_[2] != "+" && tokens_[2] != "-")
    return fail(ErrorCode::kSyntax,
                "a face is on the '+' or on the '-' side of its plane, not " +
                    in_quotes(tokens_[2]));
  face.flipped = tokens_[2] == "-";
  if (!face.has_color) return index(4, face.origin);
  return integer(3, 0, 255, face.color.r) && integer(4, 0, 255, face.color.g) &&
         integer(5, 0, 255, face.color.b) && index(6, face.origin);
}

bool TextReader::loop_line() {
  if (data_.faces.empty())
    return fail(ErrorCode::kSyntax, "a loop stands before the first face");
  if (tokens_.size() % 2 == 0)
    return fail(ErrorCode::kSyntax,
                "a loop has a vertex and a plane, or '-', "
                "for each of its corners");
  for (std::size_t token = 1; token < tokens_.size(); token += 2) {
    SolidData::Corner& corner = data_.corners.emplace_back();
    if (!index(token, corner.vertex)) return false;
    if (tokens_[token + 1] != "-" && !index(token + 1, corner.plane))
      return false;
  }
  ++data_.faces.back().loop_count;
  data_.loops.push_back(static_cast<std::uint32_t>(tokens_.size() / 2));
  return true;
}

/// The line that ends the file. `-` says that there is no checksum, as in files
/// that people edit; then nobody vouches for the surface.
bool TextReader::checksum_line() {
  ended_ = true;
  if (!count_is(1)) return false;
  if (tokens_[1] == "-") {
    data_.is_checked = false;
    return true;
  }
  if (tokens_[1] == checked_.sum && hex_of(crc32c(checked_.body)) == tokens_[1])
    return true;
  return fail(ErrorCode::kSyntax,
              "the checksum is wrong: the file is damaged, or was edited; "
              "'checksum -' says that there is none");
}

bool TextReader::body_line() {
  const std::string_view keyword = tokens_[0];
  if (keyword == "checked") return flag(data_.is_checked);
  if (keyword == "conforming") return flag(data_.is_conforming);
  if (keyword == "point")
    return count_is(3) && point(1, data_.points.emplace_back());
  if (keyword == "plane") return plane_line();
  if (keyword == "meet") return meet_line();
  if (keyword == "part") return part_line();
  if (keyword == "origin") return origin_line();
  if (keyword == "face") return face_line();
  if (keyword == "loop") return loop_line();
  if (keyword == kChecksum) return checksum_line();
  return fail(ErrorCode::kSyntax, in_quotes(keyword) + " is no keyword");
}

bool TextReader::lines() {
  while (next_line()) {
    if (ended_)
      return fail(ErrorCode::kSyntax, "there is something after the checksum");
    if (!body_line()) return false;
  }
  if (ended_) return true;
  ++line_;
  return fail(ErrorCode::kTruncated, "the file ends before its checksum");
}

Result<SolidData> TextReader::read() {
  if (!header() || !lines()) return *error_;
  return std::move(data_);
}

void put_values(std::string& text, std::string_view keyword,
                std::initializer_list<Int128> values) {
  text += keyword;
  for (const Int128 value : values) text += ' ' + to_string(value);
  text += '\n';
}

void put_faces(std::string& text, const SolidData& data) {
  std::size_t loop = 0, corner = 0;
  for (const SolidData::Face& face : data.faces) {
    text += "face " + std::to_string(face.plane) + (face.flipped ? " -" : " +");
    if (face.has_color) {
      put_values(text, "",
                 {face.color.r, face.color.g, face.color.b, face.origin});
    } else {
      put_values(text, " -", {face.origin});
    }
    for (std::uint32_t l = 0; l < face.loop_count; ++l) {
      text += "loop";
      for (std::uint32_t i = 0; i < data.loops[loop]; ++i, ++corner) {
        const auto& [vertex, plane] = data.corners[corner];
        text += ' ' + std::to_string(vertex) + ' ' +
                (plane == SolidData::kNoPlane ? "-" : std::to_string(plane));
      }
      ++loop;
      text += '\n';
    }
  }
}

}  // namespace

Result<SolidData> read_solid_text(std::string_view text) {
  return TextReader(text).read();
}

std::string solid_text(const SolidData& data) {
  std::string text(kSolidTextMagic);
  put_values(text, "", {solid_version(data)});
  put_values(text, "unit", {data.unit.base, data.unit.exponent});
  put_values(text, "grid", {data.grid_bits});
  if (data.is_checked) text += "checked\n";
  if (data.is_conforming) text += "conforming\n";
  for (const GridPoint& p : data.points)
    put_values(text, "point", {p.x, p.y, p.z});
  for (const auto& [n, at] : data.planes)
    put_values(text, "plane", {n[0], n[1], n[2], at.x, at.y, at.z});
  for (const auto& meet : data.meets)
    put_values(text, "meet", {meet[0], meet[1], meet[2]});
  for (const std::string& name : data.parts)
    text += (name.empty() ? "part" : "part " + token_of(name)) + '\n';
  for (const SolidData::Origin& origin : data.origins)
    put_values(text, "origin", {origin.part, origin.polygon});
  put_faces(text, data);
  const std::string sum = hex_of(crc32c(text));
  return text + "checksum " + sum + '\n';
}

}  // namespace halfspace
