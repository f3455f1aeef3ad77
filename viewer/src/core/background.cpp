#include "core/background.hpp"

#include <new>
#include <utility>

namespace halfspace::viewer {

Background::Background(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this] { work(); }) {}

Background::~Background() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    is_wanted_ = false;
  }
  changed_.notify_all();
  thread_.join();
}

void Background::start(Work work) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(work));
  }
  changed_.notify_all();
}

void Background::cancel() {
  const std::lock_guard lock(mutex_);
  if (is_working_) is_wanted_ = false;
}

bool Background::is_busy() const {
  const std::lock_guard lock(mutex_);
  return is_working_ || !waiting_.empty() || !results_.empty();
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
    {
      const std::lock_guard lock(mutex_);
      const bool is_same = progress_.work == what;
      if (is_same && share < progress_.share + 0.01) return is_wanted_.load();
      progress_ = {what, share};
    }
    wake_();
    return is_wanted_.load();
  };
  try {
    return work(report);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfRange, "there is not enough memory"};
  }
}

void Background::work() {
  for (;;) {
    Work next;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
      if (ends_) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
      is_working_ = true;
      is_wanted_ = true;
    }
    Result<std::string> result = carried_out(next);
    {
      const std::lock_guard lock(mutex_);
      progress_ = {};
      results_.push_back(std::move(result));
      is_working_ = false;
    }
    wake_();
  }
}

}  // namespace halfspace::viewer
