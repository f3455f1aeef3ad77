#include "core/edge_lines.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace halfspace::viewer {
namespace {

/// Two faces that meet at more than this make a line.
constexpr double kCreaseDeg = 20;

DrawingOptions options_of(bool cull) {
  DrawingOptions options;
  options.cull = cull;
  options.crease_cosine = static_cast<std::int32_t>(std::lround(
      std::ldexp(std::cos(kCreaseDeg * std::numbers::pi / 180), kCosineBits)));
  return options;
}

}  // namespace

EdgeLines::EdgeLines(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this] { work(); }) {}

EdgeLines::~EdgeLines() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void EdgeLines::request(std::uint64_t number,
                        std::shared_ptr<const Model> model,
                        const Camera& camera, bool cull) {
  {
    const std::lock_guard lock(mutex_);
    if (number == asked_) return;
    asked_ = number;
    next_ = Job{number, std::move(model), camera, cull};
  }
  changed_.notify_all();
}

const std::vector<fast::Stroke>* EdgeLines::lines_of(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  if (done_ != shown_) {
    shown_strokes_ = std::move(done_strokes_);
    shown_ = done_;
  }
  return shown_ == number ? &shown_strokes_ : nullptr;
}

bool EdgeLines::is_busy() const {
  const std::lock_guard lock(mutex_);
  return asked_ != done_;
}

void EdgeLines::work() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || next_.has_value(); });
      if (ends_) return;
      job = *std::move(next_);
      next_.reset();
    }
    const Scene& scene = job.model->loaded.file.scene;
    auto drawing = fast::draw(scene, job.camera, options_of(job.cull));
    {
      const std::lock_guard lock(mutex_);
      done_strokes_.clear();
      if (drawing) {
        for (const fast::Stroke& stroke : drawing->strokes) {
          if (stroke.layers == 0) done_strokes_.push_back(stroke);
        }
      }
      done_ = job.number;
    }
    wake_();
  }
}

}  // namespace halfspace::viewer
