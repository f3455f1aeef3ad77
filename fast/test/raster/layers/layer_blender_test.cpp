#include "raster/layers/layer_blender.hpp"

#include <gtest/gtest.h>

namespace halfspace::fast {
namespace {

TEST(LayerBlender, AChannelIsTheNearestOf255) {
  for (int alpha = 0; alpha <= 255; ++alpha) {
    for (int over = 0; over <= 255; ++over) {
      for (int under = 0; under <= 255; ++under) {
        const int parts = alpha * over + (255 - alpha) * under;
        ASSERT_EQ(blended(static_cast<std::uint8_t>(over),
                          static_cast<std::uint8_t>(under),
                          static_cast<std::uint8_t>(alpha)),
                  (2 * parts + 255) / 510)
            << alpha << " " << over << " " << under;
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::fast
