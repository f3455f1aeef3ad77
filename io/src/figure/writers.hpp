#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "figure/fine_points.hpp"
#include "halfspace/io/figure.hpp"

/// What the writers of figures share.
namespace halfspace::io {

/// The shortest text of a number with at most this number of decimals.
std::string decimal(double value, int decimals);

/// A point with its digits after rounding: what is the same text is one point.
struct Pen {
  int decimals = 3;
  double height = -1;  ///< y is measured from there up; negative: downwards
  double scale = 1;    ///< the length of a unit of the figure
  std::shared_ptr<const FinePoints> fine;  ///< null: there are none

  std::string length(double value) const {
    return decimal(scale * value, decimals);
  }
  std::string at(const FigurePoint& p) const;
  /// The point as the format has it, not rounded.
  FigurePoint placed(const FigurePoint& p) const {
    const double y = scale * p[1];
    return {scale * p[0], height < 0 ? y : height - y};
  }
};

/// The pen with finer points where a loop of the figure would turn over.
Pen fitted(Pen pen, const Figure& figure);

/// The certificate of what a fitted pen writes.
FigureCertificate certificate_of(const Figure& figure, const Pen& pen);

/// The pen of a format with `per_mm` units on a millimetre of paper.
inline Pen upright_pen(const Figure& figure, const FigureOptions& options,
                       double per_mm) {
  const double scale = figure.unit_mm > 0 ? figure.unit_mm * per_mm : 1;
  return {options.decimals, scale * figure.height, scale, nullptr};
}

/// The loops of a region as texts of points. Points that fall together by
/// rounding are one, and what has fewer than three left is no loop any more.
std::vector<std::vector<std::string>> loops_of(const FigureRegion& region,
                                               const Pen& pen);

/// A stroke whose points follow each other: strokes without titles in their
/// order, each run of which goes on where the one before it ended.
std::vector<std::vector<std::string>> chains_of(const FigureStrokes& strokes,
                                                const Pen& pen);

/// The order in which regions are drawn with strokes, and then without: the
/// background first, and then last.
std::vector<const FigureRegion*> drawn_regions(const Figure& figure,
                                               bool with_strokes);

/// The figure with its shaded regions in parts of one colour each.
Figure in_flat_parts(const Figure& figure, double levels);

/// The certificate in words, without what comments end with.
std::string certificate_text(const Figure& figure, const Pen& pen);

/// The width of letters in Helvetica. Units: their size.
double width_of(std::string_view letters);

/// Where a text begins, upright, as the pen writes points.
FigurePoint start_of(const FigureText& text);

std::string svg_of(const Figure& figure, const FigureOptions& options);
std::string pdf_of(const Figure& figure, const FigureOptions& options);
std::string eps_of(const Figure& figure, const FigureOptions& options);
std::string tex_of(const Figure& figure, const FigureOptions& options);
std::string dxf_of(const Figure& figure, const FigureOptions& options);
std::string hpgl_of(const Figure& figure, const FigureOptions& options);

}  // namespace halfspace::io
