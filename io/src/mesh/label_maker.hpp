#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "halfspace/io/attributes.hpp"

namespace halfspace::io {

/// Notes the names that faces have, while they are read one after another.
class LabelMaker {
 public:
  /// The faces from here on have this name; an empty one is none.
  void name_from_here(const std::string& name) {
    current_ = name.empty() ? -1 : place_of(name);
  }
  /// The place of a name, which may be new.
  std::int32_t place_of(const std::string& name) {
    const auto next = static_cast<std::int32_t>(names_.size());
    const auto [at, is_new] = places_.try_emplace(name, next);
    if (is_new) names_.push_back(name);
    return at->second;
  }
  /// Face number `face` is there now.
  void add_face(std::size_t face) {
    if (current_ < 0 && of_face_.empty()) return;
    of_face_.resize(face, -1);
    of_face_.push_back(current_);
  }
  /// The names, and by face its own.
  Labels taken(std::size_t face_count) {
    if (!of_face_.empty()) of_face_.resize(face_count, -1);
    return {std::move(names_), std::move(of_face_)};
  }

 private:
  std::int32_t current_ = -1;
  std::vector<std::string> names_;
  std::vector<std::int32_t> of_face_;
  std::unordered_map<std::string, std::int32_t> places_;
};

}  // namespace halfspace::io
