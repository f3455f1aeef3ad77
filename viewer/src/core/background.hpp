#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/loader.hpp"
#include "halfspace/result.hpp"

namespace halfspace::viewer {

/// Work beside the pictures, such as measures and files to be saved, one after
/// another in a thread of its own; the result of each is a text.
class Background {
 public:
  using Work = std::function<Result<std::string>(const Report& report)>;

  explicit Background(std::function<void()> wake);
  /// Stops the work that is done and begins no other.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

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
  void work();
  Result<std::string> carried_out(const Work& work);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Work> waiting_;
  std::deque<Result<std::string>> results_;
  Progress progress_;
  bool is_working_ = false;
  bool ends_ = false;
  std::atomic<bool> is_wanted_ = true;
  std::thread thread_;
};

}  // namespace halfspace::viewer
