#include "peers/peer.hpp"

#include "peers/scan_lines.hpp"

namespace halfspace::bench {

std::vector<PolygonId> items_of(Peer& peer) {
  peer.draw(Look::kIds);
  const std::vector<Pixel> pixels = peer.pixels();
  std::vector<PolygonId> items(pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k) items[k] = id_of(pixels[k]);
  return items;
}

double share_equal(const std::vector<PolygonId>& a,
                   const std::vector<PolygonId>& b) {
  if (a.size() != b.size() || a.empty()) return 0;
  std::size_t equal = 0;
  for (std::size_t k = 0; k < a.size(); ++k) equal += a[k] == b[k] ? 1u : 0u;
  return static_cast<double>(equal) / static_cast<double>(a.size());
}

double overdraw_of(const Soup& soup) {
  double covered = 0;
  for (const SoupTriangle& triangle : soup.triangles) {
    for_each_scan_line(
        {project(soup, triangle.corners[0]), project(soup, triangle.corners[1]),
         project(soup, triangle.corners[2])},
        soup.width_px, soup.height_px,
        [&](std::int32_t, std::int32_t first, std::int32_t end) {
          covered += end - first;
        });
  }
  return covered / soup.width_px / soup.height_px;
}

}  // namespace halfspace::bench
