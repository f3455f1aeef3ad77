#include "halfspace/io/figure.hpp"

#include <algorithm>
#include <iterator>

#include "figure/writers.hpp"
#include "halfspace/io/file.hpp"

namespace halfspace::io {
namespace {

struct FigureFormat {
  std::string_view ending;
  std::string (*write)(const Figure&, const FigureOptions&);
};
constexpr FigureFormat kFormats[] = {{".svg", svg_of}, {".pdf", pdf_of},
                                     {".eps", eps_of}, {".tex", tex_of},
                                     {".dxf", dxf_of}, {".hpgl", hpgl_of}};

}  // namespace

std::string figure_format_names() {
  std::string names;
  for (const FigureFormat& format : kFormats)
    names += (names.empty() ? "" : " ") + std::string(format.ending);
  return names;
}

bool is_plotter_format(std::string_view ending) {
  return ending == ".dxf" || ending == ".hpgl";
}

bool is_figure_name(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return std::any_of(
      std::begin(kFormats), std::end(kFormats),
      [&](const FigureFormat& format) { return format.ending == ending; });
}

Result<std::string> figure_bytes(std::string_view ending, const Figure& figure,
                                 const FigureOptions& options) {
  for (const FigureFormat& format : kFormats) {
    if (format.ending == ending) return format.write(figure, options);
  }
  return Error{ErrorCode::kUnknownFormat,
               "a figure's name ends in one of " + figure_format_names()};
}

Result<Done> write_figure(const std::filesystem::path& path,
                          const Figure& figure, const FigureOptions& options) {
  const Result<std::string> bytes =
      figure_bytes(path.extension().string(), figure, options);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

}  // namespace halfspace::io
