#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/loader.hpp"
#include "halfspace/result.hpp"

namespace halfspace::viewer {

/// One piece of work beside the pictures, such as a measure or an export, whose
/// result is a text. A new one ends that before.
class Background {
 public:
  using Work = std::function<Result<std::string>(const Report& report)>;

  explicit Background(std::function<void()> wake) : wake_(std::move(wake)) {}
  ~Background() { end(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Waits for the end of the work before, which it stops.
  void start(Work work);
  void cancel() { is_wanted_ = false; }
  /// Until the result is taken.
  bool is_busy() const;
  Progress progress() const;
  /// The result, once.
  std::optional<Result<std::string>> take();

 private:
  void end();

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  Progress progress_;
  std::optional<Result<std::string>> result_;
  bool is_working_ = false;
  std::atomic<bool> is_wanted_ = false;
  std::thread thread_;
};

}  // namespace halfspace::viewer
