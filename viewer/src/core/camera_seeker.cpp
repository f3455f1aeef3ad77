#include "core/camera_seeker.hpp"

#include <utility>

namespace halfspace::viewer {

CameraSeeker::CameraSeeker(std::function<void()> wake)
    : wake_(std::move(wake)),
      worker_([this](const Job& job) { carry_out(job); }) {}

void CameraSeeker::seek(std::shared_ptr<const Model> model, Seek how) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++last_number_;
    is_busy_ = true;
    found_.reset();
  }
  worker_.replace({number, std::move(model), std::move(how)});
}

void CameraSeeker::stop() {
  const std::lock_guard lock(mutex_);
  ++last_number_;
  is_busy_ = false;
  found_.reset();
}

bool CameraSeeker::is_busy() const {
  const std::lock_guard lock(mutex_);
  return is_busy_;
}

std::optional<Result<io::ViewOptions>> CameraSeeker::take() {
  const std::lock_guard lock(mutex_);
  if (found_) is_busy_ = false;
  return std::exchange(found_, std::nullopt);
}

void CameraSeeker::carry_out(const Job& job) {
  Result<io::ViewOptions> found = job.how(job.model->loaded.file.scene);
  {
    const std::lock_guard lock(mutex_);
    if (job.number != last_number_) return;
    found_ = std::move(found);
  }
  wake_();
}

}  // namespace halfspace::viewer
