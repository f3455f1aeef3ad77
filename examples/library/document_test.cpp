// Calls the functions that docs/library.md shows.
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>

#include "halfspace/halfspace.hpp"

halfspace::Solid drilled_part();
halfspace::Result<halfspace::Done> without_corner(const char* in,
                                                  const char* out);
double how_far_a_turn_moved();
std::string volume_of_a_corner();
bool fits_in(const halfspace::Solid& part, const halfspace::Solid& box);
std::size_t holes_half_way_up(const halfspace::Solid& solid);
std::size_t polygons_of(const halfspace::Solid& part, const char* operand);
halfspace::Result<std::optional<halfspace::Pick>> picture_and_pick(
    const halfspace::Solid& solid, const char* png);
std::size_t walls_on_the_way(const halfspace::Display& display);
double share_that_is_seen(const halfspace::Display& display);
std::string what_is_wrong(const halfspace::Solid& solid);

namespace halfspace {
namespace {

TEST(LibraryDocument, ItsTenJobsAreDone) {
  const Solid part = drilled_part();
  EXPECT_NEAR(*part.volume(), 40 * 30 * 5 - 2 * 5 * 50.184776, 1e-3);
  const Solid box = Solid::box({0, 0, 0}, {40, 30, 5});
  ASSERT_TRUE(box.save("document_box.off"));
  ASSERT_TRUE(without_corner("document_box.off", "document_corner.off"));
  EXPECT_EQ(*Solid::from_file("document_corner.off").volume(), 6000 * 7 / 8);
  EXPECT_LT(how_far_a_turn_moved(), 1e-11);
  EXPECT_GT(how_far_a_turn_moved(), 0);
  EXPECT_EQ(volume_of_a_corner(), "1/36");
  EXPECT_TRUE(fits_in(part, box));
  EXPECT_EQ(holes_half_way_up(part), 2u);
  EXPECT_EQ(polygons_of(part, "cylinder"), 2u * 64 * 2);
  const auto pick = picture_and_pick(box, "document.png");
  ASSERT_TRUE(pick);
  ASSERT_TRUE(pick->has_value());
  EXPECT_EQ((*pick)->solid, 0);
  const Display display = *Display::of(box);
  EXPECT_EQ(walls_on_the_way(display), 1u);
  EXPECT_GT(share_that_is_seen(display), 0.1);
  EXPECT_LT(share_that_is_seen(display), 0.9);
  EXPECT_EQ(what_is_wrong(part), "nothing");
  EXPECT_EQ(what_is_wrong(Solid::from_file("no.off")).substr(0, 15),
            "unreadable file");
}

}  // namespace
}  // namespace halfspace
