#include "core/background.hpp"

#include <new>
#include <utility>

namespace halfspace::viewer {

Background::Background(std::function<void()> wake)
    : wake_(std::move(wake)),
      worker_([this](const Work& work) { carry_out(work); }) {}

void Background::start(Work work) {
  {
    const std::lock_guard lock(mutex_);
    ++started_;
  }
  worker_.add(std::move(work));
}

void Background::cancel() { is_wanted_ = false; }

bool Background::is_busy() const {
  const std::lock_guard lock(mutex_);
  return started_ > 0 || !results_.empty();
}

Progress Background::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::optional<Result<std::string>> Background::take() {
  const std::lock_guard lock(mutex_);
  if (results_.empty()) return std::nullopt;
  std::optional<Result<std::string>> result = std::move(results_.front());
  results_.pop_front();
  return result;
}

Result<std::string> Background::carried_out(const Work& work) {
  const auto report = [this](const std::string& what, double share) {
    const bool goes_on = is_wanted_ && !worker_.is_ending();
    {
      const std::lock_guard lock(mutex_);
      const bool is_same = progress_.work == what;
      if (is_same && share < progress_.share + 0.01) return goes_on;
      progress_ = {what, share};
    }
    wake_();
    return goes_on;
  };
  try {
    return work(report);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfRange, "there is not enough memory"};
  }
}

void Background::carry_out(const Work& work) {
  is_wanted_ = true;
  Result<std::string> result = carried_out(work);
  {
    const std::lock_guard lock(mutex_);
    progress_ = {};
    results_.push_back(std::move(result));
    --started_;
  }
  wake_();
}

}  // namespace halfspace::viewer
