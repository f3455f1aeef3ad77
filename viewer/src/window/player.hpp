#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/script.hpp"
#include "halfspace/result.hpp"

namespace halfspace::viewer {

/// Events of a script, one after another.
class Player {
 public:
  explicit Player(std::vector<Event> events) : events_(std::move(events)) {}

  bool is_at_end() const { return next_ >= events_.size(); }
  const Event& next() const { return events_[next_]; }
  void advance() { ++next_; }
  std::size_t count() const { return next_; }

 private:
  std::vector<Event> events_;
  std::size_t next_ = 0;
};

}  // namespace halfspace::viewer
