#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "halfspace/io/view.hpp"
#include "halfspace/result.hpp"
#include "halfspace/viewer/model.hpp"
#include "work/worker.hpp"

namespace halfspace::viewer {

/// Looks for cameras that see all of a model, in a thread of its own: all
/// points are looked at, which takes some 40 ms of a million triangles.
class CameraSeeker {
 public:
  using Seek = std::function<Result<io::ViewOptions>(const Scene& scene)>;

  /// `wake` is called, in that thread, when a camera was found, or none.
  explicit CameraSeeker(std::function<void()> wake);

  /// Begins to look, in place of what was looked for before.
  void seek(std::shared_ptr<const Model> model, Seek how);
  /// What is looked for is not wanted any more.
  void stop();
  /// Until what was found is taken.
  bool is_busy() const;
  /// What was found, once.
  std::optional<Result<io::ViewOptions>> take();

 private:
  struct Job {
    std::uint64_t number = 0;
    std::shared_ptr<const Model> model;
    Seek how;
  };
  void carry_out(const Job& job);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::uint64_t last_number_ = 0;
  bool is_busy_ = false;
  std::optional<Result<io::ViewOptions>> found_;
  Worker<Job> worker_;
};

}  // namespace halfspace::viewer
