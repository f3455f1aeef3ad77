#include "papers/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace halfspace::bench {

namespace {

/// The cell, in quotes if it holds a comma.
std::string csv_cell(const std::string& cell) {
  if (cell.find(',') == std::string::npos) return cell;
  return '"' + cell + '"';
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string text;
  const auto add = [&text](const std::vector<std::string>& row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      text += (k == 0 ? "" : ",") + csv_cell(row[k]);
    }
    text += '\n';
  };
  add(table.head);
  for (const auto& row : table.rows) add(row);
  return text;
}

std::string to_markdown(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& cell : table.head) widths.push_back(cell.size());
  for (const auto& row : table.rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      widths[k] = std::max(widths[k], row[k].size());
    }
  }
  std::string text;
  const auto add = [&](const std::vector<std::string>& row) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      text += (k == 0 ? "| " : " | ") + row[k] +
              std::string(widths[k] - row[k].size(), ' ');
    }
    text += " |\n";
  };
  add(table.head);
  std::vector<std::string> rule;
  for (const std::size_t width : widths) rule.emplace_back(width, '-');
  add(rule);
  for (const auto& row : table.rows) add(row);
  return text;
}

std::string digits(double value, int count) {
  const double size = std::abs(value);
  int places = 0;
  if (size > 0 && value != std::floor(value)) {
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    places = std::max(0, count - before);
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", places, value);
  return text;
}

bool write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  return file.good();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace halfspace::bench
