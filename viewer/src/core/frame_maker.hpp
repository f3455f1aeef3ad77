#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/picture.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/image.hpp"
#include "halfspace/viewer/model.hpp"
#include "work/worker.hpp"

namespace halfspace::viewer {

/// A picture that is wanted.
struct FrameRequest {
  std::uint64_t number = 0;  ///< above that of requests before
  PictureRequest picture;
};

/// Pixels for a screen: 0xffRRGGBB, row by row. Rows of two pictures may stand
/// beside each other while one grows.
struct Canvas {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::uint32_t> pixels;
};

/// Makes pictures in a thread of its own, the newest request first.
///
/// A picture that takes longer than 30 ms comes in strips of rows; a newer
/// request ends it between two strips, and goes on at the row where it was, so
/// that all rows stay alive however fast requests come.
class FrameMaker {
 public:
  /// `wake` is called, in that thread, when rows have changed.
  explicit FrameMaker(std::function<void()> wake);

  void request(FrameRequest request);

  /// The colours of the picture. Requires: is_done(), and one was asked for.
  ColorImage picture() const;

  /// Calls `read` with the canvas and the rows that have changed since the last
  /// call; not at all if none have.
  void read_changes(
      const std::function<void(const Canvas&, std::int32_t first_row,
                               std::int32_t end_row)>& read);

  /// Whether read_changes() has something to read.
  bool has_changes() const;

  /// Calls `read` with the canvas as it is.
  void look(const std::function<void(const Canvas&)>& read) const;

  /// Whether the picture that was asked for last is whole.
  bool is_done() const;
  std::uint64_t done_number() const;
  /// How many pictures were whole, and how long the last of them took.
  std::size_t count() const;
  double last_ms() const;
  std::vector<double> times_ms() const;

 private:
  void make(const FrameRequest& request);
  void publish(const FrameRequest& request, const ColorImage& rows,
               std::int32_t first_row);
  bool is_newer_wanted(const FrameRequest& request) const;

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  Canvas canvas_;
  std::int32_t dirty_first_ = 0, dirty_end_ = 0;
  std::uint64_t wanted_ = 0, done_ = 0;
  std::vector<double> times_ms_;
  // Of the thread alone.
  double expected_ms_ = 0;
  std::int32_t next_row_ = 0;
  PictureMaker maker_;
  fast::Rendering rendering_;  ///< kept: its memory is touched already
  Worker<FrameRequest> worker_;
};

/// The drawing whose lines are laid over a picture: silhouettes, borders,
/// creases and intersections (S9), found in a thread of its own.
class EdgeLines {
 public:
  explicit EdgeLines(std::function<void()> wake);

  /// Asks for the drawing of picture `number`, unless it was asked for.
  void request(std::uint64_t number, const PictureRequest& picture,
               Lines lines);

  /// The drawing of the picture, if it is there. Where there are too many lines
  /// it has none.
  std::shared_ptr<const fast::Drawing> drawing_of(std::uint64_t number) const;

 private:
  struct Job {
    std::uint64_t number = 0;
    PictureRequest picture;
    Lines lines = Lines::kNone;
  };
  void draw(const Job& job);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::uint64_t asked_ = 0, done_ = 0;
  std::shared_ptr<const fast::Drawing> drawing_;
  Worker<Job> worker_;
};

}  // namespace halfspace::viewer
