#include "tree/eye_classifier.hpp"

#include "camera/edge_function.hpp"

namespace halfspace::fast {

int EyeClassifier::exact(PlaneId id) const {
  if (moved_ != nullptr) {
    return sign(projected(reader_.planes().exact<kMovedGrid>(id), *moved_).eye);
  }
  return with_grid(reader_.scene().grid_bits(), [&](auto bits) {
    return sign(
        projected(reader_.planes().template exact<bits()>(id), camera_).eye);
  });
}

}  // namespace halfspace::fast
