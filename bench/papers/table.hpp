#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halfspace::bench {

/// Numbers as text, in rows under a head.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// The table as comma-separated values; cells with commas stand in quotes.
/// Requires: no cell holds a quote or a line's end.
std::string to_csv(const Table& table);

/// The table as Markdown, columns as wide as their widest cell.
std::string to_markdown(const Table& table);

/// `value` with at most `count` significant digits; integers in full.
std::string digits(double value, int count = 3);

/// Writes `text`; false where the file cannot be written.
bool write_file(const std::filesystem::path& path, const std::string& text);

/// The middle of the values; of an even number the greater one.
/// Requires: not empty.
double median(std::vector<double> values);

}  // namespace halfspace::bench
