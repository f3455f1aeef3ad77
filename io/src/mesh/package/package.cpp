#include "mesh/package/package.hpp"

#include <zip.h>

#include <array>

#include "halfspace/message.hpp"

namespace halfspace::io {
namespace {

/// What libzip says is wrong.
std::string zip_message(zip_error_t& error) {
  std::string message = zip_error_strerror(&error);
  zip_error_fini(&error);
  return message;
}

}  // namespace

void PackageReader::Closer::operator()(zip* archive) const {
  zip_discard(archive);
}

Result<PackageReader> PackageReader::open(std::string_view bytes) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source =
      zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive =
      source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
  if (archive == nullptr) {
    if (source != nullptr) zip_source_free(source);
    return Error{
        ErrorCode::kSyntax,
        "the file is no whole ZIP package (" + zip_message(error) + ")", -1};
  }
  zip_error_fini(&error);
  PackageReader reader;
  reader.archive_.reset(archive);
  return reader;
}

std::vector<std::string> PackageReader::names() const {
  std::vector<std::string> names;
  const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name =
        zip_get_name(archive_.get(), static_cast<zip_uint64_t>(i), 0);
    if (name != nullptr) names.emplace_back(name);
  }
  return names;
}

bool PackageReader::has(const std::string& name) const {
  return zip_name_locate(archive_.get(), name.c_str(), 0) >= 0;
}

Result<Done> PackageReader::read(
    const std::string& name, std::uint64_t most,
    const std::function<bool(std::string_view, bool)>& take) const {
  const std::string place = "entry " + in_quotes(name);
  const zip_int64_t at = zip_name_locate(archive_.get(), name.c_str(), 0);
  if (at < 0)
    return Error{ErrorCode::kBadIndex, "the package has no " + place, -1};
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
      zip_fopen_index(archive_.get(), static_cast<zip_uint64_t>(at), 0),
      zip_fclose);
  if (!file) {
    return Error{
        ErrorCode::kSyntax,
        place + " cannot be unpacked (" + zip_strerror(archive_.get()) + ")",
        -1};
  }
  std::array<char, 1 << 16> buffer;
  std::uint64_t all = 0;
  while (true) {
    const zip_int64_t got = zip_fread(file.get(), buffer.data(), buffer.size());
    if (got < 0) {
      return Error{ErrorCode::kSyntax,
                   place + " is damaged (" + zip_file_strerror(file.get()) +
                       ", after " + std::to_string(all) + " bytes)",
                   -1};
    }
    all += static_cast<std::uint64_t>(got);
    if (all > most) {
      return Error{
          ErrorCode::kOutOfRange,
          place + " unpacks to more than " + std::to_string(most) + " bytes",
          -1};
    }
    if (!take({buffer.data(), static_cast<std::size_t>(got)}, got == 0))
      return Done{};
    if (got == 0) return Done{};
  }
}

Result<std::string> package_of(
    const std::vector<std::pair<std::string, std::string>>& entries) {
  const Error no_room{ErrorCode::kOutOfRange,
                      "the package could not be made in memory", -1};
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* whole = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (whole == nullptr) return no_room;
  // The archive owns one share of the bytes, this function the other.
  zip_source_keep(whole);
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> bytes(
      whole, zip_source_free);
  zip_t* archive = zip_open_from_source(whole, ZIP_TRUNCATE, &error);
  if (archive == nullptr) {
    zip_source_free(whole);
    return no_room;
  }
  constexpr zip_uint16_t kNoon = 12 << 11, kFirstDay = (1 << 5) | 1;
  for (const auto& [name, content] : entries) {
    zip_source_t* source =
        zip_source_buffer(archive, content.data(), content.size(), 0);
    const zip_int64_t at =
        source ? zip_file_add(archive, name.c_str(), source, 0) : -1;
    if (at < 0) {
      if (source != nullptr) zip_source_free(source);
      zip_discard(archive);
      return no_room;
    }
    zip_file_set_dostime(archive, static_cast<zip_uint64_t>(at), kNoon,
                         kFirstDay, 0);
  }
  if (zip_close(archive) != 0) {
    zip_discard(archive);
    return no_room;
  }
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(whole, &stat) != 0 || zip_source_open(whole) != 0)
    return no_room;
  std::string packed(static_cast<std::size_t>(stat.size), '\0');
  const zip_int64_t got = zip_source_read(whole, packed.data(), packed.size());
  zip_source_close(whole);
  if (got != static_cast<zip_int64_t>(packed.size())) return no_room;
  return packed;
}

}  // namespace halfspace::io
