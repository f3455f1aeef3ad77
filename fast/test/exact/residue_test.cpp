#include "exact/residue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <span>

#include "exact/canonical_plane.hpp"

namespace halfspace::fast {
namespace {

TEST(Residue, OfLongNumbersIsThatOfTheirRest) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 2000; ++round) {
    const auto a = static_cast<std::int64_t>(random());
    const auto b = static_cast<std::int64_t>(random());
    const Int128 c = Int128{a} * b;
    constexpr auto kP = static_cast<Int128>(kPrime);
    const auto expected = static_cast<std::uint64_t>((c % kP + kP) % kP);
    EXPECT_EQ(residue(c), expected);
    EXPECT_EQ(residue(Wide<3>(c)), expected);
    EXPECT_EQ(residue(Wide<8>(c)), expected);
    // Beyond two words residues are multiplied.
    const auto rest = [&](std::int64_t x) { return residue(Int128{x}); };
    EXPECT_EQ(residue(multiply<4>(c, c)),
              multiply_residues(expected, expected));
    EXPECT_EQ(residue(multiply<3>(c, Int128{a})),
              multiply_residues(expected, rest(a)));
  }
  EXPECT_EQ(residue(kPrime), 0u);
  EXPECT_EQ(residue(~std::uint64_t{0}), 3u);
  EXPECT_EQ(residue(Int128{-1}), kPrime - 1);
}

TEST(Residue, InversesTimesTheirNumbersAreOne) {
  std::mt19937_64 random(4);
  std::array<std::uint64_t, 32> all;
  for (std::size_t count = 1; count <= all.size(); ++count) {
    for (std::uint64_t& a : all) a = 1 + random() % (kPrime - 1);
    auto inverses = all;
    invert_residues(std::span(inverses).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(multiply_residues(all[i], inverses[i]), 1u);
      EXPECT_EQ(inverse_residue(all[i]), inverses[i]);
    }
  }
}

/// Normals that the prime divides, some of them twice, and components that it
/// divides alone.
TEST(Residue, PlanesHaveOneHashWhateverTheirCommonFactor) {
  constexpr auto kP = static_cast<std::int64_t>(kPrime);
  std::mt19937_64 random(5);
  const auto small = [&] {
    return static_cast<std::int64_t>(random() % 9) - 4;
  };
  int divided = 0;
  for (int round = 0; round < 2000; ++round) {
    const bool is_small = round % 2 == 0;
    const auto maybe = [&] { return is_small || random() % 2 == 0 ? 1 : kP; };
    const GridPoint o{small() * maybe(), small() * maybe(), small() * maybe()};
    const GridPoint u{small() * maybe(), small() * maybe(), small() * maybe()};
    const GridPoint v{small() * maybe(), small() * maybe(), small() * maybe()};
    const auto at = [&](std::int64_t i, std::int64_t j) {
      return GridPoint{o.x + i * u.x + j * v.x, o.y + i * u.y + j * v.y,
                       o.z + i * u.z + j * v.z};
    };
    const auto plane = exact_plane<54>({o, at(1, 0), at(0, 1)});
    if (plane.normal == Vector3<Int128>{}) continue;
    const std::int64_t far = is_small ? kP : 7;
    const auto same =
        exact_plane<54>({at(2, 1), at(2 + far, 1), at(2, 1 + far)});
    const auto times = exact_plane<54>({at(1, 1), at(3, 1), at(1, 6)});
    const auto hash = canonical_plane(plane).hash;
    EXPECT_EQ(canonical_plane(same).hash, hash);
    EXPECT_EQ(canonical_plane(times).hash, hash);
    EXPECT_TRUE(is_same_plane(canonical_plane(same).exact,
                              canonical_plane(plane).exact));
    const GridPoint off{o.x + 1, o.y + 1, o.z + 1};
    const auto beside = exact_plane<54>({off, at(1, 0), at(0, 1)});
    // What differs by multiples of the prime alone has one hash.
    if (is_small && !(beside.normal == Vector3<Int128>{}) &&
        !is_same_plane(canonical_plane(beside).exact,
                       canonical_plane(plane).exact)) {
      EXPECT_NE(canonical_plane(beside).hash, hash);
    }
    divided += residue(plane.normal.x) == 0 && residue(plane.normal.y) == 0 &&
                       residue(plane.normal.z) == 0
                   ? 1
                   : 0;
  }
  EXPECT_GT(divided, 20);
}

}  // namespace
}  // namespace halfspace::fast
