#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/looks.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/ref/scalars.hpp"
#include "halfspace/visible_map.hpp"
#include "laws/changed_views.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using definition::Fraction;

/// The implementations, as these laws see them.
struct RefScalars : Ref {
  static ColorImage colors(const SceneFile& view, const ItemImage& items,
                           const ScalarField& field, const ColorScale& scale,
                           std::int32_t samples = 1) {
    return ref::color_scalars(view.scene, *view.camera, view.options, items,
                              field, scale, samples);
  }
};
struct FastScalars : Fast {
  static ColorImage colors(const SceneFile& view, const ItemImage& items,
                           const ScalarField& field, const ColorScale& scale,
                           std::int32_t samples = 1) {
    fast::ScalarOptions how;
    how.samples = samples;
    how.threads = 2;
    return fast::color_scalars(view.scene, *view.camera, view.options, items,
                               fast::prepare_scalars(view.scene, field, scale),
                               how);
  }
};

template <class Impl>
class S11Scalars : public ::testing::Test {};
using ScalarImplementations = ::testing::Types<RefScalars, FastScalars>;
TYPED_TEST_SUITE(S11Scalars, ScalarImplementations);

constexpr int kScalarViews = 150;

/// Numbers that are often equal, and on steps; one in nine is no data.
double number_of(std::size_t n, std::size_t salt) {
  const std::size_t k = (n * 7 + salt * 5 + n / 3) % 27;
  return k == 13 ? kNoData : static_cast<double>(k % 9) - 4;
}

ScalarField field_of(const Scene& scene, bool at_corners, std::size_t salt) {
  ScalarField field{at_corners, {}};
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const std::size_t count = scene.corners(static_cast<PolygonId>(p)).size();
    for (std::size_t k = 0; k < (at_corners ? count : 1); ++k)
      field.values.push_back(number_of(p + (count == 3 ? k : 0), salt));
  }
  return *make_scalars(scene, std::move(field));
}

ColorScale scale_of(std::size_t salt) {
  ColorScale scale;
  scale.steps = {-3, -2.5, -1, 0, 0.5, 1, 3};
  scale.colors = {{255, 0, 3},   {0, 9, 255}, {90, 200, 5}, {255, 255, 0},
                  {1, 128, 250}, {77, 77, 7}, {0, 0, 1},    {254, 255, 253}};
  scale.no_data = {13, 14, 15};
  if (salt % 2 == 1) scale.limits = ScaleLimits{-3.5, 3, {7, 200, 100}};
  return scale;
}

/// A view with corner colours that differ on triangles, lit by them or not.
SceneFile lit_view(const SceneFile& view, std::size_t salt) {
  SceneData data = view.scene.data();
  data.corner_colors.assign(data.corners.size(), {});
  for (std::size_t p = 0; p + 1 < data.first_corner.size(); ++p) {
    const std::size_t first = data.first_corner[p];
    const std::size_t count = data.first_corner[p + 1] - first;
    for (std::size_t k = 0; k < count; ++k) {
      const auto c = static_cast<int>(count == 3 ? k : 0);
      const auto own = static_cast<int>(p % 50);
      data.corner_colors[first + k] = {
          static_cast<std::uint8_t>(255 - 100 * c),
          static_cast<std::uint8_t>(200 + 20 * c - own),
          static_cast<std::uint8_t>(c == 2 ? 3 : 255)};
    }
  }
  SceneFile changed = with_scene(view, *make_scene(std::move(data)));
  changed.options.shading = salt % 3 == 0 ? Shading::kFlat : Shading::kGouraud;
  changed.options.background = {1, 2, 3};
  return changed;
}

/// A triangle's function with these values at the corners, at the centre of
/// pixel (i, j).
Fraction affine_at(const SceneFile& view, PolygonId id, std::int32_t i,
                   std::int32_t j, const std::array<Fraction, 3>& values) {
  const definition::Projection seen = definition::project(
      definition::facet_of(view.scene, definition::whole(view.scene, id)),
      *view.camera, false);
  definition::Integer weights = 0;
  Fraction sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const definition::Affine& f = seen.edges[k];
    const definition::Integer weight =
        2 * f.c + (2 * i + 1) * f.x + (2 * j + 1) * f.y;
    weights += weight;
    // The edge that leaves corner k is opposite corner k + 2.
    sum += Fraction(weight) * values[(k + 2) % 3];
  }
  return sum / Fraction(weights);
}

/// All values here are multiples of a half.
Fraction exact(double value) {
  return Fraction(static_cast<int>(2 * value)) / 2;
}

/// The scalar at the centre of pixel (i, j), by S11.2.
std::optional<Fraction> scalar_at(const SceneFile& view,
                                  const ScalarField& field, PolygonId id,
                                  std::int32_t i, std::int32_t j) {
  const auto values = field.of(view.scene, id);
  bool are_equal = true;
  for (const double v : values) {
    if (std::isnan(v)) return std::nullopt;
    are_equal = are_equal && v == values[0];
  }
  if (are_equal) return exact(values[0]);
  return affine_at(view, id, i, j,
                   {exact(values[0]), exact(values[1]), exact(values[2])});
}

/// S11.3, from the highest class down.
Rgb scale_color(const ColorScale& scale, const std::optional<Fraction>& v,
                std::size_t& ties) {
  if (!v) return scale.no_data;
  if (scale.limits &&
      (*v < exact(scale.limits->low) || *v > exact(scale.limits->high)))
    return scale.limits->color;
  for (std::size_t k = scale.steps.size(); k > 0; --k) {
    const Fraction step = exact(scale.steps[k - 1]);
    if (*v == step) ++ties;
    if (*v >= step) return scale.colors[k];
  }
  return scale.colors[0];
}

/// The greatest integer below x + 1/2, or it.
std::uint8_t half_up(const Fraction& x) {
  const definition::Integer twice = 2 * numerator(x) + denominator(x);
  return static_cast<std::uint8_t>(twice / (2 * denominator(x)));
}

/// The colour of a polygon at pixel (i, j) by S11.4.
Rgb polygon_color(const SceneFile& view, PolygonId id, const ScalarField& field,
                  const ColorScale& scale, std::int32_t i, std::int32_t j,
                  std::size_t& ties) {
  const Rgb full = scale_color(scale, scalar_at(view, field, id, i, j), ties);
  const auto lights = view.scene.corner_colors(id);
  Rgb result;
  for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    Fraction light = view.scene.color(id).*channel;
    if (view.options.shading == Shading::kGouraud) {
      light = int{lights[0].*channel};
      if (lights.size() == 3 &&
          !(lights[0] == lights[1] && lights[1] == lights[2])) {
        light = affine_at(view, id, i, j,
                          {Fraction(int{lights[0].*channel}),
                           Fraction(int{lights[1].*channel}),
                           Fraction(int{lights[2].*channel})});
      }
    }
    result.*channel = half_up(Fraction(int{full.*channel}) * light / 255);
  }
  return result;
}

/// The colour of pixel (i, j).
Rgb expected_color(const SceneFile& view, const ItemImage& items,
                   const ScalarField& field, const ColorScale& scale,
                   std::int32_t i, std::int32_t j, std::size_t& ties) {
  const PolygonId id = items.at(i, j);
  return id == kBackground ? view.options.background
                           : polygon_color(view, id, field, scale, i, j, ties);
}

TYPED_TEST(S11Scalars, L1TheColourIsThatOfTheScalarSeen) {
  std::size_t ties = 0;
  std::size_t compared = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t salt = seed_of(original);
        const SceneFile view = lit_view(original, salt);
        const ItemImage items =
            definition::item_image(view.scene, *view.camera, view.options);
        const ScalarField field = field_of(view.scene, salt % 4 != 0, salt);
        const ColorScale scale = scale_of(salt);
        const ColorImage image = TypeParam::colors(view, items, field, scale);
        for (std::int32_t j = 0; j < items.height_px; ++j) {
          for (std::int32_t i = 0; i < items.width_px; ++i) {
            HALFSPACE_LAW(image.at(i, j) == expected_color(view, items, field,
                                                           scale, i, j, ties));
            compared += items.at(i, j) != kBackground;
          }
        }
      },
      kScalarViews);
  EXPECT_GT(compared, 1000u);
  EXPECT_GT(ties, 100u);
}

TYPED_TEST(S11Scalars, L2AWhiteScaleIsTheLightAlone) {
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t salt = seed_of(original);
        const SceneFile view = lit_view(original, salt);
        ColorScale white = scale_of(0);
        white.colors.assign(white.colors.size(), {255, 255, 255});
        white.no_data = {255, 255, 255};
        const Image image = picture<TypeParam>(view);
        HALFSPACE_LAW(TypeParam::colors(view, image.items,
                                        field_of(view.scene, true, salt),
                                        white) == image.colors);
      },
      kScalarViews);
}

TYPED_TEST(S11Scalars, L3NumbersMayBeScaledByPowersOfTwo) {
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t salt = seed_of(original);
        const SceneFile view = lit_view(original, salt);
        const ItemImage items =
            definition::item_image(view.scene, *view.camera, view.options);
        const ScalarField field = field_of(view.scene, true, salt);
        const ColorScale scale = scale_of(salt);
        const ColorImage image = TypeParam::colors(view, items, field, scale);
        for (const int power : {-1070, 1020}) {
          const auto scaled = [power](double v) {
            return std::isnan(v) ? v : std::ldexp(v, power);
          };
          ScalarField other = field;
          for (double& v : other.values) v = scaled(v);
          ColorScale same = scale;
          for (double& v : same.steps) v = scaled(v);
          if (same.limits) {
            same.limits->low = scaled(same.limits->low);
            same.limits->high = scaled(same.limits->high);
          }
          HALFSPACE_LAW(TypeParam::colors(view, items, other, same) == image);
        }
      },
      kScalarViews);
}

TYPED_TEST(S11Scalars, L4APixelIsTheMeanOfItsSamplesColours) {
  std::size_t compared = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t salt = seed_of(original);
        const SceneFile view = lit_view(original, salt);
        const std::int32_t k = salt % 8 != 0 ? 2 : 4;
        const auto large = magnified(view, k);
        if (!large) return;
        const ScalarField field = field_of(view.scene, true, salt);
        const ColorScale scale = scale_of(salt);
        const auto items = definition::item_image(large->scene, *large->camera,
                                                  large->options);
        const ColorImage fine = TypeParam::colors(*large, items, field, scale);
        const ColorImage image =
            TypeParam::colors(view, items, field, scale, k);
        for (std::int32_t j = 0; j < image.height_px; ++j) {
          for (std::int32_t i = 0; i < image.width_px; ++i) {
            for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
              int sum = 0;
              for (std::int32_t s = 0; s < k * k; ++s)
                sum += fine.at(i * k + s % k, j * k + s / k).*channel;
              HALFSPACE_LAW(image.at(i, j).*channel ==
                            half_up(Fraction(sum) / (k * k)));
            }
            ++compared;
          }
        }
      },
      kScalarViews);
  EXPECT_GT(compared, 1000u);
}

TYPED_TEST(S11Scalars, L5PolygonsAreBlendedInTheColoursOfTheirScalars) {
  std::size_t layered = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t salt = seed_of(original);
        SceneFile view = lit_view(original, salt);
        view.options.clips.clear();
        view.options.caps.reset();
        const ScalarField field = field_of(view.scene, salt % 4 != 0, salt);
        const ColorScale scale = scale_of(salt);
        const auto alpha =
            static_cast<std::uint8_t>(salt % 5 == 0   ? 255
                                      : salt % 7 == 0 ? 0
                                                      : salt >> 9 & 255);
        std::vector<definition::Projection> seen;
        for (const PolygonId id : ids_of(view.scene)) {
          seen.push_back(definition::project(
              definition::facet_of(view.scene,
                                   definition::whole(view.scene, id)),
              *view.camera, view.options.cull));
        }
        ColorImage expected((*view.camera)->width_px, (*view.camera)->height_px,
                            view.options.background);
        std::size_t ties = 0;
        for (std::int32_t j = 0; j < expected.height_px; ++j) {
          for (std::int32_t i = 0; i < expected.width_px; ++i) {
            std::vector<PolygonId> here;
            for (const PolygonId id : ids_of(view.scene)) {
              if (definition::covers(seen[static_cast<std::size_t>(id)], i, j))
                here.push_back(id);
            }
            std::sort(here.begin(), here.end(), [&](PolygonId p, PolygonId q) {
              const int order =
                  p == q ? 0
                         : definition::compare_depth(
                               seen[static_cast<std::size_t>(p)],
                               seen[static_cast<std::size_t>(q)], i, j);
              return order != 0 ? order > 0 : p > q;
            });
            layered += here.size() > 1;
            Rgb& color = expected.at(i, j);
            for (const PolygonId id : here) {
              color = composed_color(
                  polygon_color(view, id, field, scale, i, j, ties), color,
                  alpha);
            }
          }
        }
        const Numbers numbers = {field, scale};
        for (const Image& image :
             looks_of<TypeParam>(view, {alpha, 1, std::nullopt}, &numbers))
          HALFSPACE_LAW(image.colors == expected);
      },
      kScalarViews);
  EXPECT_GT(layered, 500u);
}

TYPED_TEST(S11Scalars, L6SamplesAreBlendedInTheColoursOfTheirScalars) {
  std::size_t compared = 0;
  law::for_all_views(
      [&](const SceneFile& original) {
        const std::uint64_t salt = seed_of(original);
        const SceneFile view = lit_view(original, salt);
        const std::int32_t k = salt % 8 != 0 ? 2 : 4;
        const auto large = magnified(view, k);
        if (!large) return;
        const ScalarField field = field_of(view.scene, salt % 4 != 0, salt);
        const ColorScale scale = scale_of(salt);
        const Numbers numbers = {field, scale};
        Look look = {static_cast<std::uint8_t>(salt >> 9)};
        if (salt % 5 == 0) look.alpha = kOpaque;
        const ColorImage expected =
            smaller(looks_of<RefScalars>(*large, look, &numbers)[0].colors, k);
        look.samples = k;
        for (const Image& image : looks_of<TypeParam>(view, look, &numbers))
          HALFSPACE_LAW(image.colors == expected);
        ++compared;
      },
      kScalarViews);
  EXPECT_GT(compared, 100u);
}

}  // namespace
}  // namespace halfspace
