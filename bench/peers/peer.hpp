#pragma once

#include <memory>
#include <string>
#include <vector>

#include "peers/soup.hpp"

namespace halfspace::bench {

/// The content of a frame.
enum class Look {
  kFlat,    ///< the colour of each triangle
  kSmooth,  ///< corner colours, interpolated
  kIds,     ///< id_pixel() of each triangle, to check the picture
};

/// Another program that draws the same picture, set up for one scene and one
/// camera. Like our tree, vertex buffers, a sorted order or a ray tracer's
/// hierarchy are made beforehand.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  /// Draws one frame, up to the last pixel in memory.
  virtual void draw(Look look) = 0;

  /// The frame that was drawn last, row by row from the top.
  virtual std::vector<Pixel> pixels() = 0;
};

/// The item image as the peer draws it.
std::vector<PolygonId> items_of(Peer& peer);

/// The share of equal pixels; 0 where the sizes differ.
double share_equal(const std::vector<PolygonId>& a,
                   const std::vector<PolygonId>& b);

/// How many triangles cover a pixel, on average over the image.
double overdraw_of(const Soup& soup);

/// Whole triangles in the order given, scan line by scan line, each written
/// over what is there. Corner colours are interpolated in the image.
std::unique_ptr<Peer> make_span_painter(const Soup& soup,
                                        std::vector<std::uint32_t> order);

/// A z-buffer in single precision, one pixel at a time.
std::unique_ptr<Peer> make_z_buffer(const Soup& soup,
                                    std::vector<std::uint32_t> order);

/// Mesa's software rasteriser, through EGL without a surface, in the calling
/// thread; with or without a depth test.
/// Returns null, and says why in `why`, where the machine has no EGL that
/// draws in software.
std::unique_ptr<Peer> make_llvmpipe(const Soup& soup,
                                    const std::vector<std::uint32_t>& order,
                                    bool depth_test, std::string& why);

/// How Embree is asked for the first hits.
enum class RayPackets { k8, k16, kStream };

/// Embree's primary rays through the pixel centres, in one thread; its tree
/// built at high quality.
/// Units: build_ms in processor time.
std::unique_ptr<Peer> make_embree(const Soup& soup, RayPackets packets,
                                  double& build_ms);

}  // namespace halfspace::bench
