#include "image/grounds.hpp"

#include <algorithm>
#include <utility>

#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

/// Adds rows below those that are there.
template <class T>
void add_rows(const Grid2<T>& more, Grid2<T>& image) {
  image.width_px = more.width_px;
  image.height_px += more.height_px;
  image.pixels.insert(image.pixels.end(), more.pixels.begin(),
                      more.pixels.end());
}

}  // namespace

Picture drawn(const Engine& engine, const Scene& scene, const Camera& camera,
              const Shot& shot) {
  return shot.anti_aliasing == AntiAliasing::kExact
             ? engine.render_area(scene, camera, shot)
             : engine.render(scene, camera, shot);
}

Picture drawn_over_gradient(const Engine& engine, const Scene& scene,
                            const Camera& camera, const Shot& shot) {
  const Rows all = shot.rows.value_or(Rows{0, camera->height_px});
  Picture picture;
  Shot part = shot;
  for (Rows rows = {all.first, all.first}; rows.first < all.end;
       rows.first = rows.end) {
    const Rgb color = gradient_color(rows.first, camera->height_px);
    while (rows.end < all.end &&
           gradient_color(rows.end, camera->height_px) == color)
      ++rows.end;
    part.rows = rows;
    part.options.background = color;
    const Picture more = engine.render(scene, camera, part);
    add_rows(more.items, picture.items);
    add_rows(more.colors, picture.colors);
    picture.pixels_painted += more.pixels_painted;
    picture.fragments_displayed += more.fragments_displayed;
    picture.tiles_touched += more.tiles_touched;
    picture.exact_decisions += more.exact_decisions;
  }
  return picture;
}

Result<Done> add_lines(const Engine& engine, const Scene& scene,
                       const Camera& camera, const Shot& shot,
                       const LineArguments& arguments, ColorImage& colors) {
  if (!arguments.edges) return Done{};
  const ShownLines lines = shown_lines(arguments, shot.options);
  return engine.add_lines(scene, camera, shot, lines.drawing, lines.style,
                          colors);
}

Result<io::CoverageImage> coverage_of(const Engine& engine, const Scene& scene,
                                      const Camera& camera, const Shot& shot,
                                      LineArguments lines) {
  constexpr Rgb kWhite = {255, 255, 255};
  SceneData data = scene.data();
  data.corner_colors.clear();
  std::fill(data.colors.begin(), data.colors.end(), kWhite);
  const Result<Scene> white = make_scene(std::move(data));
  if (!white) return white.error();
  Shot own = shot;
  own.by_scalars = false;
  own.mark = std::nullopt;
  own.options.parts = nullptr;
  if (own.options.caps) own.options.caps = CapStyle{kWhite, std::nullopt};
  ColorImage colors = drawn(engine, *white, camera, own).colors;
  lines.color = kWhite;
  const auto added = add_lines(engine, *white, camera, own, lines, colors);
  if (!added) return added.error();
  io::CoverageImage coverage(colors.width_px, colors.height_px, 0);
  std::transform(colors.pixels.begin(), colors.pixels.end(),
                 coverage.pixels.begin(), [](const Rgb& c) { return c.r; });
  return coverage;
}

void divide(const io::CoverageImage& coverage, ColorImage& colors) {
  for (std::size_t k = 0; k < colors.pixels.size(); ++k) {
    const int whole = coverage.pixels[k];
    const auto full = [whole](std::uint8_t part) {
      const int value = whole == 0 ? 0 : (510 * part + whole) / (2 * whole);
      return static_cast<std::uint8_t>(std::min(value, 255));
    };
    Rgb& color = colors.pixels[k];
    color = {full(color.r), full(color.g), full(color.b)};
  }
}

}  // namespace halfspace::tools
