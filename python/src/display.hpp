#pragma once

#include <mutex>
#include <optional>
#include <shared_mutex>

#include "binding.hpp"
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
  Result<Done> insert(const Mesh& mesh);

 private:
  const fast::BspTree& tree();

  Display display_;
  mutable std::shared_mutex changes_;
  std::mutex mutex_;
  std::optional<fast::BspTree> tree_;
};

/// A camera of a display's scene.
struct ShownCamera {
  Camera camera;
};

}  // namespace halfspace::python
