#include <charconv>
#include <cmath>

#include "base/binary.hpp"
#include "base/text.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/scalars.hpp"

namespace halfspace::io {
namespace {

/// A name without its `:COLUMN`, and that.
struct ColumnName {
  std::string path;
  std::string column;
};

bool ends_as_scalars(const std::string& path) {
  return has_extension(path, ".npy") || has_extension(path, ".csv") ||
         has_extension(path, ".txt");
}

ColumnName parted(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  if (colon != std::string::npos && ends_as_scalars(name.substr(0, colon)))
    return {name.substr(0, colon), name.substr(colon + 1)};
  return {name, {}};
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// The number that a cell spells; nothing if it spells none.
std::optional<double> number_in(std::string_view cell) {
  if (cell.empty() || is_word(cell, "nan") || is_word(cell, "na"))
    return kNoData;
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const std::errc code = read_double(cell, value);
  if (code == std::errc::invalid_argument) return std::nullopt;
  // Too small a number is 0, too great a one infinite, as NumPy reads them.
  if (code == std::errc::result_out_of_range) {
    const bool is_small = cell.find("e-") != std::string_view::npos ||
                          cell.find("E-") != std::string_view::npos;
    value = is_small ? 0.0 : HUGE_VAL;
  }
  return value;
}

/// Which column is meant, and whether the first line has names.
struct ColumnChoice {
  std::size_t column = 0;
  bool has_names = false;
};

Result<ColumnChoice> choose_column(const std::vector<std::string_view>& first,
                                   const std::string& wanted) {
  ColumnChoice choice;
  for (const std::string_view cell : first)
    choice.has_names = choice.has_names || !number_in(cell);
  if (wanted.empty()) {
    if (first.size() == 1) return choice;
    return Error{ErrorCode::kBadIndex, "there are " +
                                           std::to_string(first.size()) +
                                           " columns; name one after a colon"};
  }
  for (std::size_t k = 0; k < first.size(); ++k) {
    const bool is_wanted =
        choice.has_names ? first[k] == wanted : std::to_string(k) == wanted;
    if (!is_wanted) continue;
    choice.column = k;
    return choice;
  }
  return Error{ErrorCode::kBadIndex, "there is no column " + in_quotes(wanted)};
}

Result<ScalarColumn> parse_csv(std::string_view bytes,
                               const std::string& wanted) {
  if (const auto error = not_plain_text(bytes)) return *error;
  ScalarColumn column;
  std::optional<ColumnChoice> choice;
  for (std::int64_t line = 1; !bytes.empty(); ++line) {
    const std::size_t feed = bytes.find('\n');
    const std::string_view text = bytes.substr(0, feed);
    const bool is_last = feed == std::string_view::npos;
    bytes.remove_prefix(is_last ? bytes.size() : feed + 1);
    const auto cells = cells_of(text);
    const auto fault = [&](const std::string& what) {
      return Error{ErrorCode::kSyntax,
                   "line " + std::to_string(line) + ": " + what, line};
    };
    if (!choice) {
      const auto chosen = choose_column(cells, wanted);
      if (!chosen) return chosen.error();
      choice = *chosen;
      if (choice->has_names) continue;
    }
    if (choice->column >= cells.size()) {
      return fault("there are only " + std::to_string(cells.size()) +
                   " columns");
    }
    const auto value = number_in(cells[choice->column]);
    if (!value)
      return fault(in_quotes(cells[choice->column]) + " is no number");
    column.values.push_back(*value);
  }
  return column;
}

/// The type of an array's values, such as `<f8`, and how many there are.
struct NpyColumn {
  std::string type;
  std::size_t count = 0;
  std::size_t start = 0;
};

Result<NpyColumn> npy_column(std::string_view bytes) {
  const Error cut{ErrorCode::kTruncated, "the file ends in its header"};
  if (!bytes.starts_with("\x93NUMPY"))
    return Error{ErrorCode::kUnknownFormat, "this is no NumPy array"};
  if (bytes.size() < 12) return cut;
  const bool is_version_1 = bytes[6] == 1;
  const std::size_t begin = is_version_1 ? 10 : 12;
  const std::size_t size =
      is_version_1
          ? std::size_t{load<std::uint16_t>(bytes, 8, ByteOrder::kLittle)}
          : std::size_t{load<std::uint32_t>(bytes, 8, ByteOrder::kLittle)};
  if (bytes.size() - begin < size) return cut;
  const std::string_view header = bytes.substr(begin, size);
  const auto after = [&](std::string_view key) {
    const std::size_t at = header.find(key);
    return at == std::string_view::npos ? std::string_view()
                                        : header.substr(at + key.size());
  };
  NpyColumn column;
  column.start = begin + size;
  const std::string_view type = after("'descr':");
  const std::size_t quote = type.find('\'');
  if (quote != std::string_view::npos)
    column.type =
        type.substr(quote + 1, type.find('\'', quote + 1) - quote - 1);
  std::string_view shape = after("'shape':");
  const std::size_t open = shape.find('(');
  if (open == std::string_view::npos)
    return Error{ErrorCode::kSyntax, "the array's header has no shape"};
  shape.remove_prefix(open + 1);
  const auto [end, code] =
      std::from_chars(shape.data(), shape.data() + shape.size(), column.count);
  shape.remove_prefix(static_cast<std::size_t>(end - shape.data()));
  const auto rest = shape.substr(0, shape.find(')'));
  const bool is_column =
      rest.empty() || rest == "," || rest == ", 1" || rest == ",1";
  if (code != std::errc() || !is_column) {
    return Error{ErrorCode::kUnknownFormat,
                 "scalars are an array of one dimension"};
  }
  return column;
}

/// A kind of numbers: their size in bytes, and the number at a place.
struct NpyKind {
  std::string_view name;
  std::size_t size;
  double (*load)(std::string_view bytes, std::size_t at, ByteOrder order);
};

template <class T>
NpyKind npy_kind(std::string_view name) {
  return {name, sizeof(T),
          [](std::string_view bytes, std::size_t at, ByteOrder order) {
            return static_cast<double>(load<T>(bytes, at, order));
          }};
}

Result<ScalarColumn> values_of(std::string_view bytes, const NpyColumn& npy,
                               const NpyKind& kind) {
  const std::string_view values = bytes.substr(npy.start);
  if (values.size() / kind.size < npy.count) {
    return Error{ErrorCode::kTruncated,
                 "the file holds " + std::to_string(values.size() / kind.size) +
                     " of " + std::to_string(npy.count) + " numbers"};
  }
  if (values.size() != npy.count * kind.size)
    return Error{ErrorCode::kSyntax, "the file goes on after its numbers"};
  const ByteOrder order =
      npy.type[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
  ScalarColumn column;
  column.values.reserve(npy.count);
  for (std::size_t k = 0; k < npy.count; ++k)
    column.values.push_back(kind.load(values, k * kind.size, order));
  return column;
}

Result<ScalarColumn> parse_npy_column(std::string_view bytes) {
  static const NpyKind kKinds[] = {
      npy_kind<double>("f8"),        npy_kind<float>("f4"),
      npy_kind<std::int8_t>("i1"),   npy_kind<std::int16_t>("i2"),
      npy_kind<std::int32_t>("i4"),  npy_kind<std::int64_t>("i8"),
      npy_kind<std::uint8_t>("u1"),  npy_kind<std::uint8_t>("b1"),
      npy_kind<std::uint16_t>("u2"), npy_kind<std::uint32_t>("u4"),
      npy_kind<std::uint64_t>("u8")};
  const Result<NpyColumn> npy = npy_column(bytes);
  if (!npy) return npy.error();
  for (const NpyKind& kind : kKinds) {
    if (!npy->type.empty() && npy->type.substr(1) == kind.name)
      return values_of(bytes, *npy, kind);
  }
  return Error{ErrorCode::kUnknownFormat,
               "scalars are floats or integers, not " + in_quotes(npy->type)};
}

}  // namespace

bool is_scalar_file_name(const std::string& name) {
  return ends_as_scalars(parted(name).path);
}

Result<ScalarColumn> read_scalars(const std::string& name) {
  const auto [path, wanted] = parted(name);
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<ScalarColumn> column = has_extension(path, ".npy")
                                    ? parse_npy_column(*bytes)
                                    : parse_csv(*bytes, wanted);
  if (!column) return error_about(path, column.error());
  return column;
}

}  // namespace halfspace::io
