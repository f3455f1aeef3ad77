#include "halfspace/csg/repair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "halfspace/boolean.hpp"
#include "halfspace/csg/closing.hpp"
#include "halfspace/csg/fault.hpp"
#include "halfspace/csg/trimmed.hpp"
#include "halfspace/io/load_scene.hpp"
#include "soup.hpp"

namespace halfspace::csg {
namespace {

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The word for a step, as a user leaves it out by.
std::string word_of(RepairStep step) {
  constexpr const char* kWords[] = {"duplicates", "weld",     "agree",
                                    "close",      "outwards", "resolve"};
  return kWords[static_cast<std::size_t>(step)];
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// A surface on its way to be a solid's.
class Mender {
 public:
  Mender(std::string path, const RepairOptions& options)
      : path_(std::move(path)), options_(options) {}

  Result<Repaired> run(const io::Mesh& mesh);

 private:
  Result<Done> import(Result<io::Imported> imported);
  Result<Done> import_soup();
  void split_lines();
  bool may(RepairStep step) const {
    return std::find(options_.without.begin(), options_.without.end(), step) ==
           options_.without.end();
  }
  Error naming_what_was_left_out(Error error) const;
  Result<Done> mend();
  bool is_open() {
    if (!is_open_) is_open_ = !bad().empty();
    return *is_open_;
  }
  const std::vector<BadEdge>& bad() {
    if (!bad_) bad_ = bad_edges(soup_);
    return *bad_;
  }
  void forget_edges() {
    is_open_.reset();
    bad_.reset();
    is_split_ = false;
  }
  bool stays_open();
  double step() const {
    const Unit unit = imported_.scene.unit();
    return std::pow(static_cast<double>(unit.base), unit.exponent);
  }
  double weld_distance() const;
  Result<Done> mend_polygons();
  Result<Done> weld_borders();
  Result<Done> make_agree();
  Result<Done> close();
  Result<Done> make_shell();
  Result<Done> turn_shells();
  Error open_still(const Filled& filled) const;
  Result<Source> source(bool repair) const {
    OperandOptions how;
    how.repair = repair;
    how.check = options_.check;
    return make_source(path_, imported_, how);
  }

  std::string path_;
  const RepairOptions& options_;
  io::Imported imported_;
  // Of the imported surface; nothing: not known yet.
  std::optional<bool> is_open_;
  std::optional<std::vector<BadEdge>> bad_;
  bool is_split_ = false;  // no vertex of it lies within a bad edge
  Soup soup_;
  std::size_t conflicts_ = 0;
  RepairReport report_;
};

Result<Done> Mender::import(Result<io::Imported> imported) {
  if (!imported) return io::error_about(path_, imported.error());
  imported_ = *std::move(imported);
  forget_edges();
  if (imported_.scene.polygon_count() == 0) {
    return io::error_about(
        path_, {ErrorCode::kEmpty,
                "it has no polygon with an area, so there is no surface", -1});
  }
  soup_ = soup_of(imported_);
  return Done{};
}

Result<Done> Mender::import_soup() { return import(imported_soup(soup_)); }

/// Vertices within edges become corners there.
void Mender::split_lines() {
  if (is_split_) return;
  std::optional<ClosedScene> split = split_on_lines(imported_.scene, bad());
  if (!split) {
    is_split_ = true;
    return;
  }
  report_.corners_added += split->added;
  imported_.scene = std::move(split->scene);
  soup_ = soup_of(imported_);
  forget_edges();
  is_open_ = split->is_open;
}

/// Whether the surface is open even with corners where vertices lie within
/// edges, so that no solid comes of it as it is.
bool Mender::stays_open() {
  if (!is_open()) return false;
  if (stays_open_on_lines(bad())) return true;
  const auto split = split_on_lines(imported_.scene, bad());
  is_split_ = !split;
  return !split || split->is_open;
}

double Mender::weld_distance() const {
  if (options_.weld) return *options_.weld;
  std::int64_t most = 0;
  for (const GridPoint& p : soup_.points)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  // Floats of 1 to 2 are 2^-23 apart.
  return static_cast<double>(most) * step() * 4 * 0x1p-23;
}

Result<Done> Mender::mend_polygons() {
  split_lines();
  // In a closed surface each counts as often as it is there (S6.7).
  if (!is_open()) return Done{};
  report_.duplicates = drop_duplicates(soup_);
  if (report_.duplicates > 0) {
    if (const auto done = import_soup(); !done) return done;
  }
  split_lines();
  return Done{};
}

Result<Done> Mender::weld_borders() {
  const double distance = std::floor(weld_distance() / step());
  const Welded welded =
      weld(soup_, static_cast<std::int64_t>(std::min(distance, 0x1p53)));
  if (welded.vertices == 0) return Done{};
  report_.welded = welded.vertices;
  report_.weld_move = static_cast<double>(welded.move) * step();
  const std::size_t before = soup_.polygons.size();
  report_.duplicates += drop_duplicates(soup_);
  if (const auto done = import_soup(); !done) return done;
  report_.dropped = before - std::min(before, soup_.polygons.size());
  split_lines();
  return Done{};
}

Result<Done> Mender::make_agree() {
  const Turned turned = turn_to_agree(soup_);
  conflicts_ = turned.conflicts;
  report_.turned = turned.polygons;
  return turned.polygons > 0 ? import_soup() : Result<Done>(Done{});
}

Error Mender::open_still(const Filled& filled) const {
  std::string sentence;
  if (filled.left_edges > 0) {
    const GridPoint& p = filled.left_at;
    const auto at = [&](std::int64_t steps) {
      return text_of(static_cast<double>(steps) * step());
    };
    sentence = "the surface is open: its border of " +
               counted(filled.left_edges, "edge") + " at " + at(p.x) + ", " +
               at(p.y) + ", " + at(p.z) +
               " is half as wide as its component or wider, so it may be no "
               "hole; --close-all fills it all the same, --thicken THICKNESS "
               "makes the surface a shell";
  } else if (conflicts_ > 0) {
    sentence = "the surface has one side only: along " +
               counted(conflicts_, "edge") +
               " no turning makes its polygons agree; --thicken THICKNESS "
               "makes it a shell, or cut it there";
  } else {
    sentence = open_error(imported_.scene, imported_.faces).message;
  }
  return io::error_about(path_, {ErrorCode::kOpen, sentence, -1});
}

Result<Done> Mender::close() {
  const Filled filled = fill_holes(soup_, options_.close_all);
  report_.planar_holes = filled.planar;
  report_.other_holes = filled.others;
  report_.filled = filled.polygons;
  if (filled.polygons > 0) {
    // What fills a hole may be there already, the other way round.
    drop_duplicates(soup_);
    if (soup_.polygons.empty()) {
      return io::error_about(
          path_, {ErrorCode::kEmpty,
                  "what fills its holes covers its polygons, so nothing is "
                  "within; --thicken THICKNESS makes the surface a shell",
                  -1});
    }
    if (const auto done = import_soup(); !done) return done;
    split_lines();
  }
  if (is_open()) return open_still(filled);
  return Done{};
}

Result<Done> Mender::make_shell() {
  const Shell made = shell_of(soup_, *options_.thicken);
  report_.thickness = *options_.thicken;
  report_.least_thickness = made.least;
  report_.most_thickness = made.most;
  Result<io::Imported> shell = io::import_scene(made.mesh, io::unlit());
  if (shell) {
    for (PolygonId& p : shell->faces)
      p = made.sources[static_cast<std::size_t>(p)];
  }
  if (const auto done = import(std::move(shell)); !done) return done;
  split_lines();
  if (is_open()) return open_still({});
  return Done{};
}

Result<Done> Mender::turn_shells() {
  const std::vector<std::size_t> turned = turn_outwards(soup_);
  report_.shells_turned = turned.size();
  return turned.empty() ? Result<Done>(Done{}) : import_soup();
}

/// The error, and which steps were left out, for one of them may have helped.
Error Mender::naming_what_was_left_out(Error error) const {
  if (options_.without.empty() || error.code == ErrorCode::kStopped)
    return error;
  std::string words;
  for (const RepairStep step : options_.without)
    words += (words.empty() ? "" : ", ") + word_of(step);
  error.message += "; left out was: " + words;
  return error;
}

/// Takes the steps that are wanted and that the surface needs.
Result<Done> Mender::mend() {
  using enum RepairStep;
  if (may(kDuplicates)) {
    if (const auto done = mend_polygons(); !done) return done;
  } else {
    split_lines();
  }
  if (is_open() && may(kWeld)) {
    if (const auto done = weld_borders(); !done) return done;
  }
  if (is_open() && may(kAgree)) {
    if (const auto done = make_agree(); !done) return done;
  }
  if (is_open() && !may(kClose))
    return io::error_about(path_, open_error(imported_.scene, imported_.faces));
  if (is_open()) {
    const auto done = options_.thicken ? make_shell() : close();
    if (!done) return done;
  }
  return may(kOutwards) ? turn_shells() : Result<Done>(Done{});
}

Result<Repaired> Mender::run(const io::Mesh& mesh) {
  if (const auto done = import(io::import_scene(mesh, io::unlit())); !done)
    return done.error();
  std::vector<bool> has_color = imported_.has_color;
  Result<Source> made = Error{ErrorCode::kOpen, "", -1};
  if (!stays_open()) made = source(false);
  const auto is_wrong = [&] {
    return !made && made.error().code != ErrorCode::kStopped;
  };
  if (is_wrong()) {
    if (const auto done = mend(); !done)
      return naming_what_was_left_out(done.error());
    made = source(false);
  }
  if (is_wrong() && may(RepairStep::kResolve)) {
    report_.crossing = made.error().message;
    if (report_.crossing.starts_with(path_ + ": "))
      report_.crossing.erase(0, path_.size() + 2);
    const std::size_t advice = report_.crossing.find(" (repair ");
    if (advice != std::string::npos) report_.crossing.erase(advice);
    made = source(true);
  }
  if (!made) return naming_what_was_left_out(made.error());
  auto faces =
      std::make_shared<const io::AttributedFaces>(io::attributed_faces(mesh));
  if (!faces->attributes.empty()) made->attributed = std::move(faces);
  made->has_color = std::move(has_color);
  // Corners that were welded are still those of the file.
  made->report.max_move = std::max(made->report.max_move, report_.weld_move);
  return Repaired{*std::move(made), std::move(report_)};
}

}  // namespace

bool RepairReport::is_empty() const { return sentences().empty(); }

std::vector<std::string> RepairReport::sentences() const {
  std::vector<std::string> all;
  if (duplicates > 0)
    all.push_back(counted(duplicates, "polygon") +
                  " dropped that others cover");
  if (welded > 0) {
    all.push_back(counted(welded, "point") +
                  " welded to others, moved by up to " + text_of(weld_move));
  }
  if (dropped > 0)
    all.push_back(counted(dropped, "polygon") +
                  " dropped that had no area left");
  if (corners_added > 0) {
    all.push_back(counted(corners_added, "corner") +
                  " added where vertices lay within edges");
  }
  if (turned > 0)
    all.push_back(counted(turned, "polygon") + " turned to agree with others");
  if (thickness > 0) {
    constexpr double kSame = 1e-4;
    const bool is_even = least_thickness >= (1 - kSame) * thickness &&
                         most_thickness <= (1 + kSame) * thickness;
    all.push_back("made a shell " + text_of(thickness) + " thick" +
                  (is_even ? ""
                           : ", at sharp or curved places " +
                                 text_of(least_thickness) + " to " +
                                 text_of(most_thickness)));
  }
  if (planar_holes + other_holes > 0) {
    all.push_back(counted(planar_holes + other_holes, "hole") + " filled, " +
                  std::to_string(planar_holes) + " in a plane, with " +
                  counted(filled, "polygon"));
  }
  if (shells_turned > 0)
    all.push_back(counted(shells_turned, "component") + " turned outwards");
  if (!crossing.empty())
    all.push_back("resolved by winding number: " + crossing);
  return all;
}

Result<Repaired> repaired(const std::string& path, const io::Mesh& mesh,
                          const RepairOptions& options) {
  return Mender(path, options).run(mesh);
}

}  // namespace halfspace::csg
