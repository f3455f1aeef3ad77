#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/viewer/model.hpp"
#include "halfspace/viewer/run.hpp"
#include "work/worker.hpp"

namespace halfspace::viewer {

/// What the loader does now.
struct Progress {
  std::string work;  ///< empty: nothing
  double share = 0;
};

/// The view of a scene that is seen first, for pictures of a size.
struct FirstLook {
  std::int32_t width_px = 0, height_px = 0;
  Result<io::ViewOptions> view;
};

/// A model, or why there is none.
struct Loaded {
  std::uint64_t number = 0;  ///< of the request
  State state;
  bool is_opened = false;  ///< the state is that of files that were opened
  Result<std::shared_ptr<const Model>> model;
  std::optional<FirstLook> first_look;  ///< of a model that there is
};

/// Frees models in a thread of its own: the last one to hold a model may be the
/// window's thread, and a million polygons take it 60 ms.
class ModelBin {
 public:
  /// The model, which the bin frees when nobody holds the result any more.
  static std::shared_ptr<const Model> kept(const std::shared_ptr<ModelBin>& bin,
                                           std::shared_ptr<const Model> model);

 private:
  Worker<std::shared_ptr<const Model>> worker_{
      [](const std::shared_ptr<const Model>&) {}};
};

/// Reads files and builds trees in a thread of its own. A new request ends the
/// one before, and so does cancel(), within milliseconds: reading, import and
/// building ask all the time.
class Loader {
 public:
  /// `first_view`, which is called in the loader's thread, looks at all points.
  Loader(FirstView first_view, std::function<void()> wake);

  /// Asks for the state's model, and its first view; what was asked for before
  /// is not wanted any more. Returns the request's number.
  std::uint64_t request(const State& state,
                        std::shared_ptr<const Model> before);
  /// Asks for the model of other files, which take the place of the state's
  /// parts; a `.view` file, which is read first, brings its state.
  std::uint64_t open(const State& state, std::vector<std::string> paths,
                     std::shared_ptr<const Model> before);
  /// That of pictures, for which first views are: also of the request that is
  /// carried out.
  void set_size(std::int32_t width_px, std::int32_t height_px);
  /// Ends what is being done; it gives an error, kStopped.
  void cancel();
  /// The same, and nothing comes of it.
  void forget();

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
    std::vector<std::string> opened;  ///< none: the state is asked for
  };
  std::uint64_t begin(State state, std::shared_ptr<const Model> before,
                      std::vector<std::string> opened);
  void carry_out(const Job& job);
  FirstLook first_look_of(const Scene& scene) const;

  FirstView first_view_;
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::optional<Loaded> result_;
  Progress progress_;
  std::int32_t width_px_ = 640, height_px_ = 480;
  bool is_busy_ = false;
  std::uint64_t last_number_ = 0;
  std::atomic<std::uint64_t> wanted_ = 0;
  MeshCache cache_;
  std::shared_ptr<ModelBin> bin_ = std::make_shared<ModelBin>();
  Worker<Job> worker_;
};

}  // namespace halfspace::viewer
