#include "engine.hpp"

namespace halfspace::tools {

const std::vector<std::string>& library_words() {
  static const std::vector<std::string> kWords = {"ref", "fast"};
  return kWords;
}

const std::vector<std::string>& method_words() {
  static const std::vector<std::string> kWords = {"span", "painter", "zbuffer",
                                                  "raycast"};
  return kWords;
}

std::unique_ptr<Engine> make_engine(Library library) {
  return library == Library::kFast ? make_fast_engine() : make_ref_engine();
}

}  // namespace halfspace::tools
