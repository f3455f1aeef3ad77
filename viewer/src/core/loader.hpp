#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "halfspace/viewer/model.hpp"
#include "work/worker.hpp"

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
/// one before, and so does cancel(), within milliseconds: reading, import and
/// building ask all the time.
class Loader {
 public:
  explicit Loader(std::function<void()> wake);

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
  void carry_out(const Job& job);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::optional<Loaded> result_;
  Progress progress_;
  bool is_busy_ = false;
  std::uint64_t last_number_ = 0;
  std::atomic<std::uint64_t> wanted_ = 0;
  MeshCache cache_;
  Worker<Job> worker_;
};

}  // namespace halfspace::viewer
