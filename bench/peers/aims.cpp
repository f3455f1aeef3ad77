#include "peers/aims.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace halfspace::bench {
namespace {

class Collector {
 public:
  explicit Collector(const std::vector<Row>& rows) : rows_(rows) {}

  std::vector<Aim> aims() {
    deep_overdraw();
    constant_time();
    papers_scenes();
    never_worse_than_painting();
    tiny_triangles();
    a_million_triangles();
    build();
    two_threads();
    return aims_;
  }

 private:
  const Row* find(std::string_view name) const {
    const auto found =
        std::find_if(rows_.begin(), rows_.end(),
                     [name](const Row& row) { return row.name == name; });
    return found == rows_.end() ? nullptr : &*found;
  }

  static bool is_mesh(const Row& row) { return row.name.rfind("W4", 0) == 0; }

  void at_least(int number, const std::string& what, double wanted,
                std::optional<double> theirs, double ours) {
    if (theirs) aims_.push_back({number, what, true, wanted, *theirs / ours});
  }

  void at_most(int number, const std::string& what, double wanted, double ours,
               std::optional<double> theirs) {
    if (theirs) aims_.push_back({number, what, false, wanted, ours / *theirs});
  }

  void deep_overdraw() {
    const Row* const row = find("W2 S500 N100000");
    if (row == nullptr) return;
    const double ours = row->ours.flat;
    at_least(1, row->name + ": llvmpipe z / ours", 3000,
             row->peers.llvmpipe_flat, ours);
    at_least(1, row->name + ": llvmpipe without depth / ours", 120,
             row->peers.llvmpipe_no_depth, ours);
    at_least(1, row->name + ": Embree / ours", 450, row->peers.embree, ours);
  }

  void constant_time() {
    const Row* const many = find("W2 S500 N100000");
    const Row* const few = find("W2 S500 N1000");
    if (many == nullptr || few == nullptr) return;
    at_most(2, "W2: 100,000 / 1,000, flat", 1.2, many->ours.flat,
            few->ours.flat);
    at_most(2, "W2: 100,000 / 1,000, smooth", 1.2, many->ours.smooth,
            few->ours.smooth);
  }

  void papers_scenes() {
    if (const Row* const row = find("W1 S500 N500")) {
      at_least(3, row->name + ": llvmpipe z / ours", 16,
               row->peers.llvmpipe_flat, row->ours.flat);
      at_least(3, row->name + ": span painter / ours, flat", 3,
               row->peers.painter_flat, row->ours.flat);
      at_least(3, row->name + ": span painter / ours, smooth", 25,
               row->peers.painter_smooth, row->ours.smooth);
      at_most(3, row->name + ": front to back / back to front, smooth", 0.10,
              row->ours.smooth, row->ours.painter_smooth);
    }
    if (const Row* const row = find("W2 S500 N10000")) {
      at_most(3, row->name + ": front to back / back to front, smooth", 0.01,
              row->ours.smooth, row->ours.painter_smooth);
    }
  }

  void never_worse_than_painting() {
    for (const Row& row : rows_) {
      at_most(4, row.name + ": ours / span painter, flat", 1, row.ours.flat,
              row.peers.painter_flat);
      at_most(4, row.name + ": ours, smooth / flat", 1.2, row.ours.smooth,
              row.ours.flat);
    }
  }

  void tiny_triangles() {
    for (const Row& row : rows_) {
      if (!is_mesh(row)) continue;
      const double ours = row.ours.flat;
      at_least(5, row.name + ": llvmpipe z / ours", 5, row.peers.llvmpipe_flat,
               ours);
      at_least(5, row.name + ": Embree / ours", 4, row.peers.embree, ours);
      at_least(5, row.name + ": z-buffer / ours", 2, row.peers.z_buffer, ours);
    }
  }

  void a_million_triangles() {
    const Row* const row = find("W3 S20 N1000000");
    if (row == nullptr) return;
    at_least(6, row->name + ": llvmpipe z / ours", 20, row->peers.llvmpipe_flat,
             row->ours.flat);
    at_least(6, row->name + ": Embree / ours", 12, row->peers.embree,
             row->ours.flat);
  }

  void build() {
    constexpr double kGibibyte = 1024.0 * 1024 * 1024;
    for (const Row& row : rows_) {
      const bool random = row.name == "W3 S20 N100000";
      if (is_mesh(row) || random) {
        at_most(7, row.name + ": build, ours / Embree", 1, row.ours.build,
                row.peers.embree_build);
        aims_.push_back({7, row.name + ": fragments / polygons", false,
                         random ? 2 : 1.3,
                         static_cast<double>(row.ours.stats.fragments) /
                             static_cast<double>(row.polygons)});
      }
      if (row.name == "W3 S50 N1000000") {
        aims_.push_back(
            {7, row.name + ": GiB while building", false, 16,
             static_cast<double>(row.ours.build_peak_bytes) / kGibibyte});
      }
    }
  }

  void two_threads() {
    for (const Row& row : rows_) {
      if (row.ours.elapsed_one < 2) continue;
      at_least(8, row.name + ": one thread / two", 1.85, row.ours.elapsed_one,
               row.ours.elapsed_two);
    }
  }

  const std::vector<Row>& rows_;
  std::vector<Aim> aims_;
};

std::string cell(std::optional<double> value) {
  return value ? digits(*value) : "-";
}

std::optional<double> over(std::optional<double> theirs, double ours) {
  return theirs ? std::optional(*theirs / ours) : std::nullopt;
}

/// The geometric mean of those ratios that were measured.
class GeometricMean {
 public:
  void add(std::optional<double> ratio) {
    if (!ratio) return;
    sum_ += std::log(*ratio);
    ++count_;
  }
  std::optional<double> value() const {
    return count_ > 0 ? std::optional(std::exp(sum_ / count_)) : std::nullopt;
  }

 private:
  double sum_ = 0;
  int count_ = 0;
};

std::string pair(std::optional<double> flat, std::optional<double> smooth) {
  return cell(flat) + " / " + cell(smooth);
}

}  // namespace

std::vector<Aim> aims_of(const std::vector<Row>& rows) {
  return Collector(rows).aims();
}

Table cost_table(const std::vector<Row>& rows) {
  Table table;
  table.head = {
      "workload",           "overdraw",           "visible",
      "ours flat / smooth", "ours, two threads",  "ours back to front",
      "llvmpipe z",         "llvmpipe, no depth", "Embree",
      "z-buffer",           "span painter"};
  for (const Row& row : rows) {
    const PeerCosts& peers = row.peers;
    table.rows.push_back(
        {row.name, digits(row.overdraw),
         digits(static_cast<double>(row.visible)),
         pair(row.ours.flat, row.ours.smooth), digits(row.ours.elapsed_two),
         pair(row.ours.painter_flat, row.ours.painter_smooth),
         pair(peers.llvmpipe_flat, peers.llvmpipe_smooth),
         cell(peers.llvmpipe_no_depth), cell(peers.embree),
         cell(peers.z_buffer), pair(peers.painter_flat, peers.painter_smooth)});
  }
  return table;
}

Table ratio_table(const std::vector<Row>& rows) {
  Table table;
  table.head = {"workload",
                "llvmpipe z",
                "llvmpipe z, smooth",
                "llvmpipe, no depth",
                "Embree",
                "z-buffer",
                "span painter",
                "span painter, smooth",
                "ours, smooth / flat"};
  std::vector<GeometricMean> means(table.head.size() - 1);
  for (const Row& row : rows) {
    const PeerCosts& peers = row.peers;
    const double flat = row.ours.flat;
    const double smooth = row.ours.smooth;
    const std::optional<double> ratios[] = {over(peers.llvmpipe_flat, flat),
                                            over(peers.llvmpipe_smooth, smooth),
                                            over(peers.llvmpipe_no_depth, flat),
                                            over(peers.embree, flat),
                                            over(peers.z_buffer, flat),
                                            over(peers.painter_flat, flat),
                                            over(peers.painter_smooth, smooth),
                                            over(smooth, flat)};
    std::vector<std::string> cells = {row.name};
    for (std::size_t k = 0; k < means.size(); ++k) {
      means[k].add(ratios[k]);
      cells.push_back(cell(ratios[k]));
    }
    table.rows.push_back(std::move(cells));
  }
  std::vector<std::string> last = {"geometric mean"};
  for (const GeometricMean& mean : means) last.push_back(cell(mean.value()));
  table.rows.push_back(std::move(last));
  return table;
}

Table work_table(const std::vector<Row>& rows) {
  Table table;
  table.head = {
      "workload",      "fragments displayed",         "for each polygon seen",
      "tiles touched", "exact decisions / pixels, %", "smooth, %"};
  for (const Row& row : rows) {
    const auto displayed = static_cast<double>(row.ours.fragments_displayed);
    table.rows.push_back(
        {row.name, digits(displayed),
         digits(displayed /
                static_cast<double>(std::max<std::size_t>(row.visible, 1))),
         digits(static_cast<double>(row.ours.tiles_touched)),
         digits(100 * row.ours.flat_share),
         digits(100 * row.ours.smooth_share)});
  }
  return table;
}

Table tree_table(const std::vector<Row>& rows) {
  Table table;
  table.head = {"workload",         "polygons",  "fragments",
                "growth",           "height",    "bytes / polygon",
                "bytes / fragment", "build, ms", "Embree build, ms",
                "peak, MiB"};
  for (const Row& row : rows) {
    const auto polygons = static_cast<double>(row.polygons);
    const auto fragments = static_cast<double>(row.ours.stats.fragments);
    const auto bytes = static_cast<double>(row.ours.tree_bytes);
    table.rows.push_back(
        {row.name, digits(polygons), digits(fragments),
         digits(fragments / polygons),
         digits(static_cast<double>(row.ours.stats.height)),
         digits(std::round(bytes / polygons)),
         digits(std::round(bytes / fragments)), digits(row.ours.build),
         cell(row.peers.embree_build),
         digits(std::round(static_cast<double>(row.ours.build_peak_bytes) /
                           (1024 * 1024)))});
  }
  return table;
}

Table aim_table(const std::vector<Aim>& aims) {
  Table table;
  table.head = {"aim", "what", "wanted", "measured", "reached"};
  for (const Aim& aim : aims) {
    table.rows.push_back(
        {std::to_string(aim.number), aim.what,
         (aim.at_least ? "at least " : "at most ") + digits(aim.wanted),
         digits(aim.got), aim.reached() ? "yes" : "no"});
  }
  return table;
}

}  // namespace halfspace::bench
