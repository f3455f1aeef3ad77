#include "drawing/strokes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/hash_index.hpp"
#include "drawing/short_product.hpp"
#include "exact/cell_hash.hpp"
#include "exact/nearest_double.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::fast {
namespace {

using Coefficients = std::array<FormInt, 4>;

/// A plane through the eye, by which edges lie on one line of the image.
struct ImageLine {
  Coefficients form;
  std::size_t largest = 0;  ///< of the normal's components by size
  std::uint64_t hash = 0;   ///< equal for equal planes
};

ImageLine image_line(const Form& form) {
  ImageLine line;
  line.form = {form.a, form.b, form.c, form.d};
  for (std::size_t k = 1; k < 3; ++k) {
    if ((size_of(line.form[line.largest]) - size_of(line.form[k]))
            .is_negative())
      line.largest = k;
  }
  // The nearest doubles to quotients are the same for all multiples.
  const bool negative = line.form[line.largest].is_negative();
  const FormInt by = size_of(line.form[line.largest]);
  std::uint64_t hash = line.largest;
  for (const FormInt& value : line.form) {
    bool rounded = false;
    const double share = quotient(negative ? -value : value, by, rounded);
    hash = mixed(hash * 0x9e3779b97f4a7c15u +
                 std::bit_cast<std::uint64_t>(share + 0.0));
  }
  line.hash = hash;
  return line;
}

bool is_same(const ImageLine& f, const ImageLine& g) {
  if (f.hash != g.hash || f.largest != g.largest) return false;
  for (std::size_t k = 0; k < 4; ++k) {
    if (short_product<14>(f.form[k], g.form[g.largest]) !=
        short_product<14>(g.form[k], f.form[f.largest]))
      return false;
  }
  return true;
}

/// An end of an interval, along its line of the image.
struct StrokeEnd {
  double at = 0;  ///< the coordinate in which the line is longer
  std::int32_t interval = 0;
  bool begins = false;
};

/// The ways a stroke can be drawn: visible before hidden, by class.
constexpr std::size_t kClasses = kEdgeClassCount;
constexpr std::size_t kWays = 2 * kClasses;

/// Joins the intervals on one line of the image after the other.
class Joining {
 public:
  Joining(Drawing& drawing, const std::vector<Line>& lines,
          const std::vector<Piece>& pieces, const ImagePoints& points)
      : drawing_(drawing), lines_(lines), pieces_(pieces), points_(points) {}

  void join(const std::vector<std::int32_t>& intervals) {
    double across = 0;
    double down = 0;
    for (const std::int32_t i : intervals) {
      const EdgeInterval& interval = drawing_.intervals[at(i)];
      across = std::max(across, std::abs(interval.to.x - interval.from.x));
      down = std::max(down, std::abs(interval.to.y - interval.from.y));
    }
    by_x_ = across >= down;
    // All so short that doubles do not tell: a line that is upright has no
    // order by x.
    if (across == 0 && down == 0)
      by_x_ = compare_ends(intervals[0], true, intervals[0], false) != 0;
    ends_.clear();
    exact_.clear();
    exact_of_.clear();
    for (const std::int32_t i : intervals) {
      const EdgeInterval& interval = drawing_.intervals[at(i)];
      const double from = coordinate(interval.from);
      const double to = coordinate(interval.to);
      const bool forwards =
          from != to ? from < to : compare_ends(i, true, i, false) < 0;
      ends_.push_back({from, i, forwards});
      ends_.push_back({to, i, !forwards});
    }
    std::sort(ends_.begin(), ends_.end(),
              [this](const StrokeEnd& f, const StrokeEnd& g) {
                const int order = compare(f, g);
                if (order != 0) return order < 0;
                return std::tie(f.interval, f.begins) <
                       std::tie(g.interval, g.begins);
              });
    sweep();
  }

 private:
  static std::size_t at(std::int32_t index) {
    return static_cast<std::size_t>(index);
  }
  double coordinate(const DrawingPoint& p) const { return by_x_ ? p.x : p.y; }

  std::size_t way_of(std::int32_t i) const {
    const EdgeInterval& interval = drawing_.intervals[at(i)];
    const auto edge_class =
        static_cast<std::size_t>(drawing_.edges[at(interval.edge)].edge_class);
    return (interval.layers > 0 ? kClasses : 0) + edge_class;
  }

  /// The order of two ends whose nearest doubles are the same.
  int compare_ends(std::int32_t f, bool f_from, std::int32_t g,
                   bool g_from) const {
    const std::size_t first = exact_end(f, f_from);
    const std::size_t second = exact_end(g, g_from);
    const ExactImagePoint& p = exact_[first];
    const ExactImagePoint& q = exact_[second];
    const CutProduct& a = by_x_ ? p.x : p.y;
    const CutProduct& b = by_x_ ? q.x : q.y;
    return sign(short_product<44>(a, q.w) - short_product<44>(b, p.w));
  }

  /// The number of an end in `exact_`, worked out when it is first asked for.
  std::size_t exact_end(std::int32_t i, bool from) const {
    const auto [found, is_new] = exact_of_.try_emplace(
        2 * std::int64_t{i} + (from ? 1 : 0), exact_.size());
    if (is_new) {
      const Piece& piece = pieces_[at(i)];
      exact_.push_back(
          points_.exact(lines_[at(piece.line)], from ? piece.from : piece.to));
    }
    return found->second;
  }

  bool is_from(const StrokeEnd& end) const {
    const EdgeInterval& interval = drawing_.intervals[at(end.interval)];
    const double from = coordinate(interval.from);
    const double to = coordinate(interval.to);
    return from != to ? end.at == from
                      : end.begins == (compare_ends(end.interval, true,
                                                    end.interval, false) < 0);
  }

  VertexId vertex_of(const StrokeEnd& end, bool from) const {
    const Piece& piece = pieces_[at(end.interval)];
    const Cut& cut = from ? piece.from : piece.to;
    const Line& line = lines_[at(piece.line)];
    return cut.kind == CutKind::kFrom ? line.from.vertex
           : cut.kind == CutKind::kTo ? line.to.vertex
                                      : -1;
  }

  int compare(const StrokeEnd& f, const StrokeEnd& g) const {
    if (f.at != g.at) return f.at < g.at ? -1 : 1;
    const bool f_from = is_from(f);
    const bool g_from = is_from(g);
    const VertexId vertex = vertex_of(f, f_from);
    if (vertex >= 0 && vertex == vertex_of(g, g_from)) return 0;
    return compare_ends(f.interval, f_from, g.interval, g_from);
  }

  DrawingPoint point_of(const StrokeEnd& end) const {
    const EdgeInterval& interval = drawing_.intervals[at(end.interval)];
    return is_from(end) ? interval.from : interval.to;
  }

  void sweep() {
    for (auto& active : active_) active.clear();
    std::size_t way = kWays;
    Stroke stroke;
    for (std::size_t k = 0; k < ends_.size();) {
      const DrawingPoint here = point_of(ends_[k]);
      const std::size_t first = k;
      do {
        const StrokeEnd& end = ends_[k];
        auto& active = active_[way_of(end.interval)];
        if (end.begins) {
          active.push_back(end.interval);
        } else {
          const auto open =
              std::find(active.begin(), active.end(), end.interval);
          HALFSPACE_ASSERT(open != active.end());
          active.erase(open);
        }
        ++k;
      } while (k < ends_.size() && compare(ends_[k], ends_[first]) == 0);
      std::size_t next = 0;
      while (next < kWays && active_[next].empty()) ++next;
      if (next == way) {
        for (std::size_t e = first; e < k && way < kWays; ++e) {
          if (ends_[e].begins && way_of(ends_[e].interval) == way)
            add_piece(stroke, ends_[e].interval);
        }
        continue;
      }
      if (way < kWays) {
        stroke.to = here;
        finish(stroke);
      }
      way = next;
      if (way == kWays) continue;
      stroke = Stroke{};
      stroke.from = here;
      stroke.edge_class = static_cast<EdgeClass>(way % kClasses);
      stroke.first_piece = static_cast<std::uint32_t>(drawing_.pieces.size());
      stroke.layers = way < kClasses ? 0 : INT32_MAX;
      for (const std::int32_t i : active_[way]) add_piece(stroke, i);
    }
  }

  void add_piece(Stroke& stroke, std::int32_t interval) {
    drawing_.pieces.push_back(interval);
    stroke.layers =
        std::min(stroke.layers, drawing_.intervals[at(interval)].layers);
  }

  void finish(Stroke& stroke) {
    stroke.piece_count =
        static_cast<std::uint32_t>(drawing_.pieces.size()) - stroke.first_piece;
    if (std::tie(stroke.to.x, stroke.to.y) <
        std::tie(stroke.from.x, stroke.from.y))
      std::swap(stroke.from, stroke.to);
    drawing_.strokes.push_back(stroke);
  }

  Drawing& drawing_;
  const std::vector<Line>& lines_;
  const std::vector<Piece>& pieces_;
  const ImagePoints& points_;
  bool by_x_ = true;
  std::vector<StrokeEnd> ends_;
  /// Ends on the present line whose doubles did not tell, by exact_end().
  mutable std::vector<ExactImagePoint> exact_;
  mutable std::unordered_map<std::int64_t, std::size_t> exact_of_;
  std::array<std::vector<std::int32_t>, kWays> active_;
};

}  // namespace

void add_strokes(Drawing& drawing, const std::vector<Line>& lines,
                 const std::vector<Piece>& pieces, const Hiding& hiding,
                 const ImagePoints& points) {
  // Step 1: number the lines of the image.
  HashIndex index;
  std::vector<ImageLine> image_lines;
  std::vector<std::vector<std::int32_t>> intervals;
  std::int32_t last = -1;
  std::int32_t number = -1;
  for (std::int32_t i = 0; i < std::ssize(pieces); ++i) {
    const std::int32_t line = pieces[static_cast<std::size_t>(i)].line;
    if (line != last) {
      last = line;
      const ImageLine made =
          image_line(hiding.plane_of(lines[static_cast<std::size_t>(line)]));
      number = index.find(made.hash, [&](std::int32_t k) {
        return is_same(image_lines[static_cast<std::size_t>(k)], made);
      });
      if (number < 0) {
        number = static_cast<std::int32_t>(image_lines.size());
        index.reserve(image_lines.size() + 1, image_lines.size());
        index.enter(made.hash, number);
        image_lines.push_back(made);
        intervals.emplace_back();
      }
    }
    intervals[static_cast<std::size_t>(number)].push_back(i);
  }
  // Step 2: join along each of them.
  Joining joining(drawing, lines, pieces, points);
  for (const auto& along : intervals) joining.join(along);
  const auto key = [](const Stroke& s) {
    return std::tie(s.from.x, s.from.y, s.to.x, s.to.y, s.edge_class, s.layers,
                    s.first_piece);
  };
  std::sort(drawing.strokes.begin(), drawing.strokes.end(),
            [&](const Stroke& f, const Stroke& g) { return key(f) < key(g); });
}

}  // namespace halfspace::fast
