#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "halfspace/viewer/model.hpp"

namespace halfspace::viewer {

/// What the loader does now.
struct Progress {
  std::string work;  ///< empty: nothing
  double share = 0;
};

/// A model, or why there is none.
struct Loaded {
  std::uint64_t number = 0;  ///< of the request
  State state;
  Result<std::shared_ptr<const Model>> model;
};

/// Reads files and builds trees in a thread of its own. A new request ends the
/// one before as soon as that asks.
class Loader {
 public:
  explicit Loader(std::function<void()> wake);
  ~Loader();
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  /// Asks for the state's model; what was asked for before is not wanted any
  /// more. Returns the request's number.
  std::uint64_t request(const State& state,
                        std::shared_ptr<const Model> before);
  /// Ends what is being done; it gives an error, kStopped.
  void cancel();

  /// The model that was asked for last, once.
  std::optional<Loaded> take();
  Progress progress() const;
  /// Until the model is taken.
  bool is_busy() const;

 private:
  struct Job {
    std::uint64_t number = 0;
    State state;
    std::shared_ptr<const Model> before;
  };
  void work();
  void carry_out(const Job& job);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::optional<Loaded> result_;
  Progress progress_;
  bool is_busy_ = false;
  bool ends_ = false;
  std::uint64_t last_number_ = 0;
  std::atomic<std::uint64_t> wanted_ = 0;
  MeshCache cache_;
  std::thread thread_;
};

}  // namespace halfspace::viewer
