#include "core/loader.hpp"

#include <new>
#include <utility>

namespace halfspace::viewer {

Loader::Loader(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this] { work(); }) {}

Loader::~Loader() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    wanted_ = 0;
  }
  changed_.notify_all();
  thread_.join();
}

std::uint64_t Loader::request(const State& state,
                              std::shared_ptr<const Model> before) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++last_number_;
    wanted_ = number;
    next_ = Job{number, state, std::move(before)};
    result_.reset();
    is_busy_ = true;
  }
  changed_.notify_all();
  return number;
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

void Loader::work() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || next_.has_value(); });
      if (ends_) return;
      job = *std::move(next_);
      next_.reset();
    }
    carry_out(job);
  }
}

void Loader::carry_out(const Job& job) {
  const auto report = [&](const std::string& work, double share) {
    {
      const std::lock_guard lock(mutex_);
      // A bar of a hundred steps: no more is shown.
      if (progress_.work == work && share < progress_.share + 0.01)
        return wanted_ == job.number;
      progress_ = {work, share};
    }
    wake_();
    return wanted_ == job.number;
  };
  Result<std::shared_ptr<const Model>> model =
      Error{ErrorCode::kOutOfRange, "there is not enough memory"};
  try {
    model = make_model(job.state, cache_, job.before.get(), report);
  } catch (const std::bad_alloc&) {
    // The error is there already.
  }
  {
    const std::lock_guard lock(mutex_);
    progress_ = {};
    // A newer request has its own result.
    if (next_) return;
    is_busy_ = false;
    result_ = Loaded{job.number, job.state, std::move(model)};
  }
  wake_();
}

}  // namespace halfspace::viewer
