// Pictures of scenes with many awkward polygons, by the portable loops and by
// the best that there are: a line each, with a hash of ids and colours. Exits
// with 1 where the two differ. Built natively and for WebAssembly, whose lines
// are to be the same.
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/view.hpp"

namespace {

using namespace halfspace;

/// A sequence of numbers that is the same everywhere.
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : state_(seed) {}
  int next(int count) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<int>((state_ >> 33) % static_cast<unsigned>(count));
  }

 private:
  std::uint64_t state_;
};

/// Triangles of up to `size` in a cube of 1000, or a grid of them on a wave.
std::string triangles(int count, int size, std::uint64_t seed) {
  Sequence numbers(seed);
  std::string text;
  for (int t = 0; t < count; ++t) {
    int at[3];
    for (int& c : at) c = numbers.next(1000);
    for (int k = 0; k < 3; ++k) {
      text += "v";
      for (const int c : at)
        text += " " + std::to_string(c + numbers.next(size) - size / 2);
      for (int c = 0; c < 3; ++c)
        text += " 0." + std::to_string(numbers.next(1000) + 1000).substr(1);
      text += "\n";
    }
    const int v = 3 * t + 1;
    text += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " +
            std::to_string(v + 2) + "\n";
  }
  return text;
}

std::string wave(int side) {
  std::string text;
  for (int j = 0; j <= side; ++j) {
    for (int i = 0; i <= side; ++i) {
      text += "v " + std::to_string(i * 10) + " " + std::to_string(j * 10) +
              " " + std::to_string((i * i + 3 * j * i) % 37) + "\n";
    }
  }
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const int v = j * (side + 1) + i + 1;
      const int w = v + side + 1;
      text += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " +
              std::to_string(w + 1) + "\nf " + std::to_string(v) + " " +
              std::to_string(w + 1) + " " + std::to_string(w) + "\n";
    }
  }
  return text;
}

std::uint64_t hash_of(const fast::Rendering& image) {
  std::uint64_t hash = 1469598103934665603u;
  const auto add = [&hash](std::uint32_t v) {
    hash = (hash ^ v) * 1099511628211u;
  };
  for (const PolygonId id : image.items.pixels)
    add(static_cast<std::uint32_t>(id));
  for (const Rgb& c : image.colors.pixels)
    add(c.r | std::uint32_t{c.g} << 8 | std::uint32_t{c.b} << 16);
  return hash;
}

struct Case {
  const char* name;
  std::string text;
};

/// Whether all pictures of a scene agree.
bool compare(const Case& one, bool smooth) {
  const auto mesh = io::read_mesh(one.text, io::Format::kObj);
  if (!mesh) return false;
  io::ImportOptions options;
  options.refine_bits = 20;
  options.gouraud = smooth;
  const auto scene = io::import_scene(*mesh, options);
  if (!scene) return false;
  const fast::BspTree tree = fast::build_display_tree(scene->scene);
  bool same = true;
  for (const bool orthographic : {false, true}) {
    for (const std::int32_t width : {64, 333, 800}) {
      auto view = io::automatic_options(scene->scene, {}, width,
                                        width * 3 / 4 + 1, orthographic);
      if (!view) return false;
      if (width == 333) view->eye = view->target;  // within the scene
      if (width == 333) view->eye.x += 1;
      const auto seen = io::look_at(scene->scene, *view);
      if (!seen) return false;
      ImageOptions image;
      image.shading = smooth ? Shading::kGouraud : Shading::kFlat;
      for (const bool items : {false, true}) {
        fast::RenderOptions how;
        how.threads = 1;
        how.colors = true;
        how.items = items;
        how.simd = fast::SimdLevel::kPortable;
        const auto plain =
            fast::render(scene->scene, tree, seen->camera, image, how);
        how.simd = fast::SimdLevel::kBest;
        const auto best =
            fast::render(scene->scene, tree, seen->camera, image, how);
        const bool is_same = plain.items.pixels == best.items.pixels &&
                             plain.colors.pixels == best.colors.pixels;
        std::printf("%s%s%s %d%s %016llx%s\n", one.name,
                    smooth ? " smooth" : "", orthographic ? " ortho" : "",
                    width, items ? " items" : "",
                    static_cast<unsigned long long>(hash_of(best)),
                    is_same ? "" : " DIFFERS");
        same = same && is_same;
      }
    }
  }
  return same;
}

}  // namespace

int main() {
  const std::vector<Case> cases = {{"small", triangles(4000, 40, 1)},
                                   {"large", triangles(300, 900, 2)},
                                   {"thin", triangles(500, 3000, 3)},
                                   {"wave", wave(60)}};
  bool same = true;
  for (const Case& one : cases) {
    for (const bool smooth : {false, true}) same = compare(one, smooth) && same;
  }
  return same ? 0 : 1;
}
