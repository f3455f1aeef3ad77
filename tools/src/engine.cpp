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

// The one place that knows which libraries the program was built with.
Result<std::unique_ptr<Engine>> make_engine(Library library) {
  if (library == Library::kFast) {
    return Error{ErrorCode::kUnknownFormat,
                 "--impl fast: the fast library is not built yet; use "
                 "--impl ref"};
  }
  return make_ref_engine();
}

}  // namespace halfspace::tools
