#include "image/engine.hpp"

namespace halfspace::tools {

std::unique_ptr<Engine> make_engine(Library library) {
  return library == Library::kFast ? make_fast_engine() : make_ref_engine();
}

}  // namespace halfspace::tools
