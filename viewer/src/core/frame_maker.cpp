#include "core/frame_maker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace halfspace::viewer {
namespace {

using Clock = std::chrono::steady_clock;

/// Longer ones come in strips.
constexpr double kLongFrameMs = 30;
/// What one strip should take, and what those beyond the fourth do: each walks
/// the tree again. On a busy machine, at 190 ms a picture, a million triangles
/// took 79 ms of processor in eight strips, and take 40 in one.
constexpr double kStripMs = 24;
constexpr double kFewStrips = 4;
constexpr double kLongStripMs = 120;

/// In how many strips a picture comes that takes so long.
double strip_count(double expected_ms) {
  if (expected_ms <= kLongFrameMs) return 1;
  const double beyond = expected_ms - kFewStrips * kStripMs;
  return beyond <= 0 ? std::ceil(expected_ms / kStripMs)
                     : kFewStrips + std::floor(beyond / kLongStripMs);
}

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start)
      .count();
}

}  // namespace

FrameMaker::FrameMaker(std::function<void()> wake)
    : wake_(std::move(wake)),
      worker_([this](const FrameRequest& request) { make(request); }) {}

void FrameMaker::request(FrameRequest request) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = request.number;
  }
  worker_.replace(std::move(request));
}

ColorImage FrameMaker::picture() const {
  const std::lock_guard lock(mutex_);
  ColorImage image(canvas_.width_px, canvas_.height_px, {});
  std::transform(canvas_.pixels.begin(), canvas_.pixels.end(),
                 image.pixels.begin(), [](std::uint32_t pixel) {
                   return Rgb{static_cast<std::uint8_t>(pixel >> 16),
                              static_cast<std::uint8_t>(pixel >> 8),
                              static_cast<std::uint8_t>(pixel)};
                 });
  return image;
}

void FrameMaker::read_changes(
    const std::function<void(const Canvas&, std::int32_t, std::int32_t)>&
        read) {
  const std::lock_guard lock(mutex_);
  if (dirty_first_ >= dirty_end_) return;
  read(canvas_, dirty_first_, dirty_end_);
  dirty_first_ = dirty_end_ = 0;
}

bool FrameMaker::has_changes() const {
  const std::lock_guard lock(mutex_);
  return dirty_first_ < dirty_end_;
}

void FrameMaker::look(const std::function<void(const Canvas&)>& read) const {
  const std::lock_guard lock(mutex_);
  read(canvas_);
}

bool FrameMaker::is_done() const {
  const std::lock_guard lock(mutex_);
  return done_ == wanted_;
}

std::uint64_t FrameMaker::done_number() const {
  const std::lock_guard lock(mutex_);
  return done_;
}

std::size_t FrameMaker::count() const {
  const std::lock_guard lock(mutex_);
  return times_ms_.size();
}

double FrameMaker::last_ms() const {
  const std::lock_guard lock(mutex_);
  return times_ms_.empty() ? 0 : times_ms_.back();
}

std::vector<double> FrameMaker::times_ms() const {
  const std::lock_guard lock(mutex_);
  return times_ms_;
}

bool FrameMaker::is_newer_wanted(const FrameRequest& request) const {
  if (worker_.is_ending()) return true;
  const std::lock_guard lock(mutex_);
  return wanted_ != request.number;
}

void FrameMaker::make(const FrameRequest& request) {
  const auto start = Clock::now();
  const PictureRequest& picture = request.picture;
  const std::int32_t height = picture.camera->height_px;
  // A legend and lines stand over the whole picture; and each strip would look
  // for the caps of all of it.
  const bool is_whole = (picture.numbers && picture.numbers->has_legend) ||
                        picture.lines || picture.options.caps;
  const double strips = is_whole ? 1 : strip_count(expected_ms_);
  const auto strip_height = static_cast<std::int32_t>(
      std::clamp(std::ceil(height / strips), 1.0, double(height)));
  std::int32_t row = next_row_ < height && strips > 1 ? next_row_ : 0;
  for (std::int32_t made = 0; made < height;) {
    const std::int32_t end =
        std::min({row + strip_height, height, row + height - made});
    maker_.draw(picture, row, end, rendering_);
    publish(request, rendering_.colors, row);
    made += end - row;
    row = end < height ? end : 0;
    if (made < height && is_newer_wanted(request)) {
      // What the whole would have taken.
      expected_ms_ = ms_since(start) * height / made;
      next_row_ = row;
      return;
    }
  }
  next_row_ = 0;
  expected_ms_ = ms_since(start);
  {
    const std::lock_guard lock(mutex_);
    done_ = request.number;
    times_ms_.push_back(expected_ms_);
  }
  wake_();
}

void FrameMaker::publish(const FrameRequest& request, const ColorImage& rows,
                         std::int32_t first_row) {
  {
    const std::lock_guard lock(mutex_);
    const std::int32_t width = request.picture.camera->width_px;
    const std::int32_t height = request.picture.camera->height_px;
    if (canvas_.width_px != width || canvas_.height_px != height) {
      const Rgb color = request.picture.options.background;
      const std::uint32_t background =
          0xff000000u | static_cast<std::uint32_t>(color.r) << 16 |
          static_cast<std::uint32_t>(color.g) << 8 | color.b;
      canvas_.width_px = width;
      canvas_.height_px = height;
      canvas_.pixels.assign(
          static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          background);
      dirty_first_ = 0;
      dirty_end_ = height;
    }
    std::uint32_t* to =
        canvas_.pixels.data() +
        static_cast<std::size_t>(first_row) * static_cast<std::size_t>(width);
    for (const Rgb& pixel : rows.pixels) {
      *to++ = 0xff000000u | static_cast<std::uint32_t>(pixel.r) << 16 |
              static_cast<std::uint32_t>(pixel.g) << 8 | pixel.b;
    }
    const std::int32_t end_row = first_row + rows.height_px;
    if (dirty_first_ >= dirty_end_) {
      dirty_first_ = first_row;
      dirty_end_ = end_row;
    } else {
      dirty_first_ = std::min(dirty_first_, first_row);
      dirty_end_ = std::max(dirty_end_, end_row);
    }
  }
  wake_();
}

EdgeLines::EdgeLines(std::function<void()> wake)
    : wake_(std::move(wake)), worker_([this](const Job& job) { draw(job); }) {}

void EdgeLines::request(std::uint64_t number, const PictureRequest& picture,
                        Lines lines) {
  {
    const std::lock_guard lock(mutex_);
    if (number == asked_) return;
    asked_ = number;
  }
  worker_.replace({number, picture, lines});
}

std::shared_ptr<const fast::Drawing> EdgeLines::drawing_of(
    std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  return done_ == number ? drawing_ : nullptr;
}

void EdgeLines::draw(const Job& job) {
  auto drawing = lines_for(job.picture, job.lines);
  {
    const std::lock_guard lock(mutex_);
    drawing_ =
        drawing ? *std::move(drawing) : std::make_shared<const fast::Drawing>();
    done_ = job.number;
  }
  wake_();
}

}  // namespace halfspace::viewer
