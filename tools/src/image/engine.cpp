#include "image/engine.hpp"

namespace halfspace::tools {

Picture rows_of(const Picture& whole, const Rows& rows) {
  const std::int32_t samples = whole.items.height_px / whole.colors.height_px;
  Picture part = whole;
  part.items = rows_of(whole.items, {rows.first * samples, rows.end * samples});
  part.colors = rows_of(whole.colors, rows);
  return part;
}

std::unique_ptr<Engine> make_engine(Library library) {
  return library == Library::kFast ? make_fast_engine() : make_ref_engine();
}

}  // namespace halfspace::tools
