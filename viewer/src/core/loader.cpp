#include "core/loader.hpp"

#include <new>
#include <utility>

namespace halfspace::viewer {

Loader::Loader(FirstView first_view, std::function<void()> wake)
    : first_view_(std::move(first_view)),
      wake_(std::move(wake)),
      worker_([this](const Job& job) { carry_out(job); }) {}

std::uint64_t Loader::request(const State& state,
                              std::shared_ptr<const Model> before) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++last_number_;
    wanted_ = number;
    result_.reset();
    is_busy_ = true;
  }
  worker_.replace({number, state, std::move(before)});
  return number;
}

void Loader::set_size(std::int32_t width_px, std::int32_t height_px) {
  const std::lock_guard lock(mutex_);
  width_px_ = width_px;
  height_px_ = height_px;
}

FirstLook Loader::first_look_of(const Scene& scene) const {
  std::int32_t width = 0, height = 0;
  {
    const std::lock_guard lock(mutex_);
    width = width_px_;
    height = height_px_;
  }
  return {width, height, first_view_(scene, width, height)};
}

void Loader::cancel() { wanted_ = 0; }

std::optional<Loaded> Loader::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

Progress Loader::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool Loader::is_busy() const {
  const std::lock_guard lock(mutex_);
  return is_busy_ || result_.has_value();
}

void Loader::carry_out(const Job& job) {
  const auto report = [&](const std::string& work, double share) {
    const bool goes_on = wanted_ == job.number && !worker_.is_ending();
    {
      const std::lock_guard lock(mutex_);
      // A bar of a hundred steps: no more is shown.
      if (progress_.work == work && share < progress_.share + 0.01)
        return goes_on;
      progress_ = {work, share};
    }
    wake_();
    return goes_on;
  };
  Result<std::shared_ptr<const Model>> model =
      Error{ErrorCode::kOutOfRange, "there is not enough memory"};
  std::optional<FirstLook> look;
  try {
    model = make_model(job.state, cache_, job.before.get(), report);
    if (model) look = first_look_of((*model)->loaded.file.scene);
  } catch (const std::bad_alloc&) {
    // The error is there already.
  }
  {
    const std::lock_guard lock(mutex_);
    progress_ = {};
    // A newer request has its own result.
    if (job.number != last_number_) return;
    is_busy_ = false;
    result_ = Loaded{job.number, job.state, std::move(model), std::move(look)};
  }
  wake_();
}

}  // namespace halfspace::viewer
