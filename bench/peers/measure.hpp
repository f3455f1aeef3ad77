#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "peers/soup.hpp"
#include "timing.hpp"

namespace halfspace::bench {

/// The peers' costs for one workload. Units: ms of processor time a frame, in
/// one thread; nothing where it was not measured.
struct PeerCosts {
  std::optional<double> llvmpipe_flat;      ///< z-buffer, the best of orders
  std::optional<double> llvmpipe_smooth;    ///< in that same order
  std::optional<double> llvmpipe_no_depth;  ///< back to front, flat
  std::optional<double> embree;             ///< the fastest packet size
  std::optional<double> embree_build;
  std::optional<double> z_buffer;
  std::optional<double> painter_flat;
  std::optional<double> painter_smooth;
  std::string llvmpipe_order;
  std::string embree_packets;
};

/// A peer whose picture is wrong.
struct WrongPicture {
  std::string peer;
  double share_equal;  ///< of the pixels that are compared
};

/// Which pictures are compared.
struct Checks {
  /// The item image that all peers should give, up to rounding.
  std::vector<PolygonId> items;
  /// Whether painting whole triangles back to front gives that image. Else only
  /// the background of painters' pictures is compared.
  bool painters_agree;
  /// The least share of equal pixels.
  double share_least = 0.99;
};

/// Measures every peer on the soup, and checks what each draws.
PeerCosts measure_peers(const Soup& soup, const Checks& checks,
                        const Repeats& repeats,
                        std::vector<WrongPicture>& wrong_pictures);

}  // namespace halfspace::bench
