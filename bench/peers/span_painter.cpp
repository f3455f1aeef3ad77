#include <algorithm>
#include <vector>

#include "peers/peer.hpp"
#include "peers/scan_lines.hpp"

namespace halfspace::bench {
namespace {

class SpanPainter final : public Peer {
 public:
  SpanPainter(const Soup& soup, std::vector<std::uint32_t> order)
      : soup_(soup), order_(std::move(order)) {
    frame_.resize(static_cast<std::size_t>(soup.width_px) *
                  static_cast<std::size_t>(soup.height_px));
  }

  void draw(Look look) override {
    std::fill(frame_.begin(), frame_.end(), kWhite);
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
  Pixel* row(std::int32_t j) {
    return frame_.data() + static_cast<std::ptrdiff_t>(j) * soup_.width_px;
  }

  void draw_flat(Pixel color, const std::array<ImagePoint, 3>& p) {
    for_each_scan_line(
        p, soup_.width_px, soup_.height_px,
        [&](std::int32_t j, std::int32_t first, std::int32_t end) {
          std::fill(row(j) + first, row(j) + end, color);
        });
  }

  void draw_smooth(const SoupTriangle& triangle,
                   const std::array<ImagePoint, 3>& p) {
    const auto channel = [&](int shift) {
      std::array<float, 3> values{};
      for (std::size_t k = 0; k < 3; ++k) {
        values[k] =
            static_cast<float>(triangle.corner_colors[k] >> shift & 255);
      }
      return gradient(p, values);
    };
    const Gradient red = channel(0), green = channel(8), blue = channel(16);
    for_each_scan_line(
        p, soup_.width_px, soup_.height_px,
        [&](std::int32_t j, std::int32_t first, std::int32_t end) {
          // Values at the centres of covered pixels lie between the corners'
          // but for rounding; a half added keeps them from 0 to 255.5.
          float r = red.value(first, j) + 0.5f;
          float g = green.value(first, j) + 0.5f;
          float b = blue.value(first, j) + 0.5f;
          Pixel* const out = row(j);
          for (std::int32_t i = first; i < end; ++i) {
            out[i] = static_cast<Pixel>(static_cast<std::int32_t>(r)) |
                     static_cast<Pixel>(static_cast<std::int32_t>(g)) << 8 |
                     static_cast<Pixel>(static_cast<std::int32_t>(b)) << 16 |
                     Pixel{255} << 24;
            r += red.dx;
            g += green.dx;
            b += blue.dx;
          }
        });
  }

  const Soup& soup_;
  std::vector<std::uint32_t> order_;
  std::vector<Pixel> frame_;
};

}  // namespace

std::unique_ptr<Peer> make_span_painter(const Soup& soup,
                                        std::vector<std::uint32_t> order) {
  return std::make_unique<SpanPainter>(soup, std::move(order));
}

}  // namespace halfspace::bench
