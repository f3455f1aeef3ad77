#include <cmath>
#include <optional>

#include "definition/definition.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using definition::Fraction;
using definition::Integer;

/// A decimal number, as text and as a value.
struct Decimal {
  std::string text;
  Fraction value;
};

Integer power(int base, int exponent) {
  return boost::multiprecision::pow(Integer(base),
                                    static_cast<unsigned>(exponent));
}

/// `digits` times ten to the `exponent`, spelt in one of several ways.
Decimal decimal(std::int64_t digits, int exponent, int spelling) {
  const Fraction value = exponent < 0
                             ? Fraction(Integer(digits), power(10, -exponent))
                             : Fraction(Integer(digits) * power(10, exponent));
  const std::string sign = digits < 0 ? "-" : spelling % 3 == 0 ? "+" : "";
  std::string text = std::to_string(digits < 0 ? -digits : digits);
  if (exponent < 0 && spelling % 2 == 0) {
    const auto places = static_cast<std::size_t>(-exponent);
    if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
    text.insert(text.size() - places, ".");
    return {sign + text + (spelling % 5 == 0 ? "00" : ""), value};
  }
  return {
      sign + text + (spelling % 7 == 0 ? "E" : "e") + std::to_string(exponent),
      value};
}

/// Triangles whose corners lie on the axes, three numbers each: they have an
/// area wherever none of the numbers is 0.
std::string obj_of(const std::vector<Decimal>& numbers) {
  std::string text;
  int vertices = 0;
  for (std::size_t k = 0; k + 3 <= numbers.size(); k += 3) {
    text += "v " + numbers[k].text + " 0 0\n";
    text += "v 0 " + numbers[k + 1].text + " 0\n";
    text += "v 0 0 " + numbers[k + 2].text + "\n";
    text += "f " + std::to_string(vertices + 1) + " " +
            std::to_string(vertices + 2) + " " + std::to_string(vertices + 3) +
            "\n";
    vertices += 3;
  }
  return text;
}

/// The length of a grid step.
Fraction step_of(Unit unit) {
  const Integer size = power(unit.base, std::abs(unit.exponent));
  return unit.exponent < 0 ? Fraction(Integer(1), size) : Fraction(size);
}

/// The numbers on the axes, in model units, as the scene has them.
std::vector<Fraction> numbers_of(const Scene& scene) {
  std::vector<Fraction> numbers;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    for (const VertexId vertex : scene.corners(static_cast<PolygonId>(p))) {
      const GridPoint& point = scene.point(vertex);
      numbers.push_back(Fraction(Integer(point.x + point.y + point.z)) *
                        step_of(scene.unit()));
    }
  }
  return numbers;
}

io::Imported imported(const std::string& text, std::optional<int> grid_bits) {
  const auto mesh = io::read_mesh(text, io::Format::kObj);
  HALFSPACE_LAW(mesh.has_value());
  auto result = io::import_scene(*mesh, {grid_bits, 0, false});
  HALFSPACE_LAW(result.has_value());
  return *std::move(result);
}

int any(int first, int last) {
  return *rc::gen::resize(100, rc::gen::inRange(first, last + 1));
}

/// A number of at most `bits` bits that is not 0.
std::int64_t any_number(int bits) {
  const auto value = *rc::gen::arbitrary<std::uint64_t>() >> (64 - bits);
  const auto size = static_cast<std::int64_t>(value == 0 ? 1 : value);
  return any(0, 1) == 0 ? size : -size;
}

TEST(S1Import, L9DecimalsThatFitAGridAreImportedExactly) {
  law::Cases grids({"26", "40", "54"});
  law::check(400, [&] {
    const int bits = any(2, 53);
    const int exponent = any(-9, 3);
    std::vector<Decimal> numbers;
    const int count = 3 * any(1, 5);
    for (int k = 0; k < count; ++k) {
      numbers.push_back(decimal(any_number(bits), exponent, any(0, 20)));
    }
    const auto result = imported(obj_of(numbers), std::nullopt);
    HALFSPACE_LAW(result.report.moved == 0);
    HALFSPACE_LAW(result.report.max_move == 0);
    HALFSPACE_LAW(result.report.dropped == 0);
    const std::vector<Fraction> read = numbers_of(result.scene);
    HALFSPACE_LAW(read.size() == numbers.size());
    for (std::size_t k = 0; k < read.size(); ++k)
      HALFSPACE_LAW(read[k] == numbers[k].value);
    grids.meet(std::to_string(result.scene.grid_bits()));
  });
  grids.expect_all();
}

TEST(S1Import, L10ARoundedCoordinateMovesByHalfAStepAtMost) {
  int moved_some = 0, moved_none = 0;
  law::check(400, [&] {
    const int grid_bits = kGridBits[any(0, 2)];
    const int exponent = any(-9, 3);
    std::vector<Decimal> numbers;
    const int count = 3 * any(1, 5);
    for (int k = 0; k < count; ++k) {
      // Never so small beside the others that rounding makes it 0.
      const int more = any(0, 5);
      const std::int64_t small = any_number(36);
      const std::int64_t large = std::int64_t{1} << 40;
      numbers.push_back(decimal(small < 0 ? small - large : small + large,
                                exponent - more, any(0, 20)));
    }
    const auto result = imported(obj_of(numbers), grid_bits);
    const std::vector<Fraction> read = numbers_of(result.scene);
    HALFSPACE_LAW(result.scene.grid_bits() == grid_bits);
    HALFSPACE_LAW(read.size() == numbers.size());
    std::size_t moved = 0;
    Fraction most = 0;
    for (std::size_t k = 0; k < read.size(); ++k) {
      const Fraction move = abs(read[k] - numbers[k].value);
      HALFSPACE_LAW(2 * move <= step_of(result.scene.unit()));
      if (move != 0) ++moved;
      most = std::max(most, move);
    }
    HALFSPACE_LAW(result.report.moved == moved);
    // The report is a double; it is the move but for that.
    const auto expected = most.convert_to<double>();
    HALFSPACE_LAW(std::abs(result.report.max_move - expected) <=
                  expected * 1e-12);
    ++(moved > 0 ? moved_some : moved_none);
  });
  EXPECT_GT(moved_some, 50);
  EXPECT_GT(moved_none, 20);
}

TEST(S1Import, L11MoreLostThanLeftIsRefused) {
  law::Cases cases({"fits", "refused", "left"});
  law::check(400, [&] {
    // Beside numbers 10^25 times as large a few digits round to 0.
    const bool is_astray = any(0, 2) > 0;
    const int gap = is_astray ? any(25, 280) : any(0, 6);
    const int small = any(1, 6), large = any(1, 6);
    std::vector<Decimal> numbers;
    std::size_t last_large = 0;
    double reach = 0;
    for (int k = 0, smalls = 0, larges = 0; k < small + large; ++k) {
      const bool is_small =
          larges == large || (smalls < small && any(0, 1) == 0);
      ++(is_small ? smalls : larges);
      double its_reach = 0;
      for (int axis = 0; axis < 3; ++axis) {
        numbers.push_back(
            decimal(any_number(20), is_small ? 0 : gap, any(0, 20)));
        its_reach = std::max(
            its_reach, std::abs(numbers.back().value.convert_to<double>()));
      }
      if (its_reach > reach) last_large = static_cast<std::size_t>(k);
      reach = std::max(reach, its_reach);
    }
    const auto mesh = io::read_mesh(obj_of(numbers), io::Format::kObj);
    HALFSPACE_LAW(mesh.has_value());
    const auto result = io::import_scene(*mesh, {});
    if (!is_astray || small <= large) {
      HALFSPACE_LAW(result.has_value());
      const int left = is_astray ? large : small + large;
      HALFSPACE_LAW(static_cast<int>(result->scene.polygon_count()) == left);
      cases.meet(is_astray ? "left" : "fits");
      return;
    }
    HALFSPACE_LAW(!result);
    HALFSPACE_LAW(result.error().code == ErrorCode::kOutOfRange);
    HALFSPACE_LAW(result.error().index ==
                  static_cast<std::int64_t>(last_large));
    cases.meet("refused");
  });
  cases.expect_all();
}

}  // namespace
}  // namespace halfspace
