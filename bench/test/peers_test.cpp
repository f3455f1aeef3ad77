#include <gtest/gtest.h>

#include "halfspace/ref/oracle/zbuffer.hpp"
#include "peers/measure.hpp"
#include "peers/peer.hpp"
#include "scenes.hpp"
#include "views.hpp"

namespace halfspace::bench {
namespace {

TEST(BenchPeers, EveryPeerDrawsTheExactImage) {
  const Scene scene = random_triangles({500, 60, true, 5});
  const Camera camera = universe_camera(View::kFront, 120);
  const Soup soup = make_soup(scene, camera);
  const Checks checks = {ref::zbuffer(scene, camera, {}).items.pixels, true};
  std::vector<WrongPicture> wrong_pictures;
  const PeerCosts costs =
      measure_peers(soup, checks, {.most = 1, .budget_ms = 1}, wrong_pictures);
  for (const WrongPicture& wrong : wrong_pictures) {
    ADD_FAILURE() << wrong.peer << ": " << wrong.share_equal;
  }
  for (const auto& cost :
       {costs.llvmpipe_flat, costs.llvmpipe_smooth, costs.llvmpipe_no_depth,
        costs.embree, costs.z_buffer, costs.painter_flat,
        costs.painter_smooth}) {
    ASSERT_TRUE(cost.has_value());
    EXPECT_GT(*cost, 0);
  }
}

TEST(BenchPeers, AnEmptyPictureIsAComplaint) {
  const Scene scene = random_triangles({500, 60, true, 5});
  const Camera camera = universe_camera(View::kFront, 120);
  const Soup soup = make_soup(scene, camera);
  const Checks checks = {
      std::vector<PolygonId>(std::size_t{120} * 120, kBackground), true};
  std::vector<WrongPicture> wrong_pictures;
  measure_peers(soup, checks, {.most = 1, .budget_ms = 1}, wrong_pictures);
  EXPECT_EQ(wrong_pictures.size(), 9u);
}

}  // namespace
}  // namespace halfspace::bench
