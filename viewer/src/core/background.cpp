#include "core/background.hpp"

#include <new>
#include <utility>

namespace halfspace::viewer {

void Background::end() {
  is_wanted_ = false;
  if (thread_.joinable()) thread_.join();
}

void Background::start(Work work) {
  end();
  result_.reset();
  is_wanted_ = true;
  is_working_ = true;
  thread_ = std::thread([this, work = std::move(work)] {
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
    Result<std::string> result =
        Error{ErrorCode::kOutOfRange, "there is not enough memory"};
    try {
      result = work(report);
    } catch (const std::bad_alloc&) {
      // The error is there already.
    }
    {
      const std::lock_guard lock(mutex_);
      progress_ = {};
      result_ = std::move(result);
      is_working_ = false;
    }
    wake_();
  });
}

bool Background::is_busy() const {
  const std::lock_guard lock(mutex_);
  return is_working_ || result_.has_value();
}

Progress Background::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::optional<Result<std::string>> Background::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

}  // namespace halfspace::viewer
