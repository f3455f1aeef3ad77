#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::viewer {

/// The visible lines of a picture: silhouettes, borders, creases and
/// intersections (S9), found in a thread of its own.
class EdgeLines {
 public:
  explicit EdgeLines(std::function<void()> wake);
  ~EdgeLines();
  EdgeLines(const EdgeLines&) = delete;
  EdgeLines& operator=(const EdgeLines&) = delete;

  /// Asks for the lines of picture `number`, unless they were asked for.
  void request(std::uint64_t number, std::shared_ptr<const Model> model,
               const Camera& camera, bool cull);

  /// The lines of the picture, if they are there; valid until the next call.
  const std::vector<fast::Stroke>* lines_of(std::uint64_t number);
  bool is_busy() const;

 private:
  struct Job {
    std::uint64_t number = 0;
    std::shared_ptr<const Model> model;
    Camera camera;
    bool cull = false;
  };
  void work();

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::uint64_t asked_ = 0, done_ = 0, shown_ = 0;
  std::vector<fast::Stroke> done_strokes_, shown_strokes_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace halfspace::viewer
