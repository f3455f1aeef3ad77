#include <algorithm>
#include <vector>

#include "peers/peer.hpp"
#include "peers/scan_lines.hpp"

namespace halfspace::bench {
namespace {

class ZBuffer final : public Peer {
 public:
  ZBuffer(const Soup& soup, std::vector<std::uint32_t> order)
      : soup_(soup), order_(std::move(order)) {
    const auto size = static_cast<std::size_t>(soup.width_px) *
                      static_cast<std::size_t>(soup.height_px);
    frame_.resize(size);
    depth_.resize(size);
  }

  void draw(Look look) override {
    std::fill(frame_.begin(), frame_.end(), kWhite);
    // 1 / w is affine over the image; nearer is greater.
    std::fill(depth_.begin(), depth_.end(), 0.0f);
    for (const std::uint32_t index : order_) {
      const SoupTriangle& triangle = soup_.triangles[index];
      const std::array<ImagePoint, 3> p = {project(soup_, triangle.corners[0]),
                                           project(soup_, triangle.corners[1]),
                                           project(soup_, triangle.corners[2])};
      if (look == Look::kSmooth) {
        draw_smooth(triangle, p);
      } else {
        draw_flat(
            look == Look::kIds ? id_pixel(triangle.source) : triangle.color, p);
      }
    }
  }

  std::vector<Pixel> pixels() override { return frame_; }

 private:
  void draw_flat(Pixel color, const std::array<ImagePoint, 3>& p) {
    const Gradient depth = depth_of(p);
    for_each_scan_line(
        p, soup_.width_px, soup_.height_px,
        [&](std::int32_t j, std::int32_t first, std::int32_t end) {
          const auto offset = static_cast<std::ptrdiff_t>(j) * soup_.width_px;
          Pixel* const out = frame_.data() + offset;
          float* const nearest = depth_.data() + offset;
          float here = depth.value(first, j);
          for (std::int32_t i = first; i < end; ++i) {
            if (here > nearest[i]) {
              nearest[i] = here;
              out[i] = color;
            }
            here += depth.dx;
          }
        });
  }

  void draw_smooth(const SoupTriangle& triangle,
                   const std::array<ImagePoint, 3>& p) {
    const auto channel = [&](int shift) {
      std::array<float, 3> values{};
      for (std::size_t k = 0; k < 3; ++k) {
        values[k] =
            static_cast<float>(triangle.corner_colors[k] >> shift & 255) + 0.5f;
      }
      return gradient(p, values);
    };
    const Gradient red = channel(0), green = channel(8), blue = channel(16);
    const Gradient depth = depth_of(p);
    for_each_scan_line(
        p, soup_.width_px, soup_.height_px,
        [&](std::int32_t j, std::int32_t first, std::int32_t end) {
          const auto offset = static_cast<std::ptrdiff_t>(j) * soup_.width_px;
          Pixel* const out = frame_.data() + offset;
          float* const nearest = depth_.data() + offset;
          float here = depth.value(first, j);
          for (std::int32_t i = first; i < end; ++i) {
            if (here > nearest[i]) {
              nearest[i] = here;
              const auto byte = [&](const Gradient& gradient) {
                return static_cast<Pixel>(
                    static_cast<std::int32_t>(gradient.value(i, j)) & 255);
              };
              out[i] = byte(red) | byte(green) << 8 | byte(blue) << 16 |
                       Pixel{255} << 24;
            }
            here += depth.dx;
          }
        });
  }

  static Gradient depth_of(const std::array<ImagePoint, 3>& p) {
    return gradient(p, {p[0].inverse_w, p[1].inverse_w, p[2].inverse_w});
  }

  const Soup& soup_;
  std::vector<std::uint32_t> order_;
  std::vector<Pixel> frame_;
  std::vector<float> depth_;
};

}  // namespace

std::unique_ptr<Peer> make_z_buffer(const Soup& soup,
                                    std::vector<std::uint32_t> order) {
  return std::make_unique<ZBuffer>(soup, std::move(order));
}

}  // namespace halfspace::bench
