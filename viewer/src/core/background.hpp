#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "core/loader.hpp"
#include "halfspace/result.hpp"
#include "work/worker.hpp"

namespace halfspace::viewer {

/// Work beside the pictures, such as measures and files to be saved, one after
/// another in a thread of its own; the result of each is a text.
class Background {
 public:
  using Work = std::function<Result<std::string>(const Report& report)>;

  /// Its end stops the work that is done, and begins no other.
  explicit Background(std::function<void()> wake);

  /// Carries out the work after that before. Does not wait.
  void start(Work work);
  /// Stops the work that is done now as soon as that asks.
  void cancel();
  /// Until all results are taken.
  bool is_busy() const;
  Progress progress() const;
  /// The next result, once.
  std::optional<Result<std::string>> take();

 private:
  void carry_out(const Work& work);
  Result<std::string> carried_out(const Work& work);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::deque<Result<std::string>> results_;
  Progress progress_;
  std::size_t started_ = 0;  ///< and not done
  std::atomic<bool> is_wanted_ = true;
  Worker<Work> worker_;
};

}  // namespace halfspace::viewer
