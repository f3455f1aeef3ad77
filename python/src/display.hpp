#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <stdexcept>
#include <utility>

#include "binding.hpp"
#include "halfspace/cut_display.hpp"
#include "halfspace/fast/build.hpp"

namespace halfspace::python {

/// A display, and the tree that maps are made of. Threads may use it at once.
/// Requires of all functions: the interpreter's lock is not held.
class Shown {
 public:
  explicit Shown(Display display) : display_(std::move(display)) {}

  /// What `question` says of the display, while nobody changes it.
  template <class Question>
  auto asked(const Question& question) const {
    const std::shared_lock lock(changes_);
    return question(display_);
  }
  /// The same for a display and its tree without leaves, which is made when it
  /// is first needed.
  template <class Question>
  auto asked_with_tree(const Question& question) {
    const std::shared_lock lock(changes_);
    return question(display_, tree());
  }
  /// Changes the display, while nobody asks.
  template <class Change>
  Result<Done> changed(const Change& change) {
    const std::unique_lock lock(changes_);
    const Result<Done> done = change(display_);
    if (done) {
      tree_.reset();
      ++version_;
    }
    return done;
  }

  /// What is made of a display and refers to it, and of which version.
  struct Cut {
    CutDisplay display;
    std::size_t version = 0;
  };
  Result<Cut> cut(const WorkOptions& options) const;
  /// What `question` says of it. Throws: std::invalid_argument, if the display
  /// has changed since.
  template <class Question>
  auto asked_of(const Cut& cut, const Question& question) const {
    const std::shared_lock lock(changes_);
    if (cut.version != version_) {
      throw std::invalid_argument(
          "the display has changed; make another CutDisplay of it");
    }
    return question(cut.display);
  }

 private:
  const fast::BspTree& tree();

  Display display_;
  std::size_t version_ = 0;
  mutable std::shared_mutex changes_;
  std::mutex mutex_;
  std::optional<fast::BspTree> tree_;
};

/// A camera of a display's scene.
struct ShownCamera {
  Camera camera;
};

}  // namespace halfspace::python
