#include "peers/measure.hpp"

#include <array>
#include <utility>

#include "peers/peer.hpp"

namespace halfspace::bench {
namespace {

/// The measurements of one workload, one peer after the other.
class Bench {
 public:
  Bench(const Soup& soup, const Checks& checks, const Repeats& repeats,
        std::vector<WrongPicture>& wrong_pictures)
      : soup_(soup),
        checks_(checks),
        repeats_(repeats),
        wrong_pictures_(wrong_pictures) {}

  PeerCosts costs() {
    plain_peers();
    llvmpipe();
    llvmpipe_without_depth();
    embree();
    return costs_;
  }

 private:
  double time(Peer& peer, Look look) const {
    return processor_time([&] { peer.draw(look); }, repeats_).least;
  }

  void check(Peer& peer, const std::string& name, bool exact) {
    std::vector<PolygonId> items = items_of(peer);
    double share = 0;
    if (exact) {
      share = share_equal(items, checks_.items);
    } else {
      std::vector<PolygonId> expected = checks_.items;
      for (std::vector<PolygonId>* list : {&items, &expected}) {
        for (PolygonId& id : *list) id = id == kBackground ? id : 0;
      }
      share = share_equal(items, expected);
    }
    if (share < checks_.share_least) wrong_pictures_.push_back({name, share});
  }

  void plain_peers() {
    const auto painter =
        make_span_painter(soup_, order_of(soup_, Order::kBackToFront));
    check(*painter, "span painter", checks_.painters_agree);
    costs_.painter_flat = time(*painter, Look::kFlat);
    costs_.painter_smooth = time(*painter, Look::kSmooth);
    const auto z_buffer = make_z_buffer(soup_, order_of(soup_, Order::kInput));
    check(*z_buffer, "z-buffer", true);
    costs_.z_buffer = time(*z_buffer, Look::kFlat);
  }

  void llvmpipe() {
    constexpr std::array<std::pair<Order, const char*>, 3> kOrders = {
        {{Order::kInput, "input"},
         {Order::kFrontToBack, "front to back"},
         {Order::kBackToFront, "back to front"}}};
    for (const auto& [order, name] : kOrders) {
      std::string why;
      const auto peer = make_llvmpipe(soup_, order_of(soup_, order), true, why);
      if (!peer) {
        wrong_pictures_.push_back({"llvmpipe: " + why, 0});
        return;
      }
      check(*peer, std::string("llvmpipe, ") + name, true);
      const double flat = time(*peer, Look::kFlat);
      if (costs_.llvmpipe_flat && flat >= *costs_.llvmpipe_flat) continue;
      costs_.llvmpipe_flat = flat;
      costs_.llvmpipe_smooth = time(*peer, Look::kSmooth);
      costs_.llvmpipe_order = name;
    }
  }

  void llvmpipe_without_depth() {
    std::string why;
    const auto peer =
        make_llvmpipe(soup_, order_of(soup_, Order::kBackToFront), false, why);
    if (!peer) return;  // llvmpipe() has reported it
    check(*peer, "llvmpipe without depth", checks_.painters_agree);
    costs_.llvmpipe_no_depth = time(*peer, Look::kFlat);
  }

  void embree() {
    constexpr std::array<std::pair<RayPackets, const char*>, 3> kPackets = {
        {{RayPackets::k8, "8"},
         {RayPackets::k16, "16"},
         {RayPackets::kStream, "stream"}}};
    for (const auto& [packets, name] : kPackets) {
      double build_ms = 0;
      const auto peer = make_embree(soup_, packets, build_ms);
      if (!costs_.embree_build || build_ms < *costs_.embree_build) {
        costs_.embree_build = build_ms;
      }
      check(*peer, std::string("Embree, ") + name, true);
      const double flat = time(*peer, Look::kFlat);
      if (costs_.embree && flat >= *costs_.embree) continue;
      costs_.embree = flat;
      costs_.embree_packets = name;
    }
  }

  const Soup& soup_;
  const Checks& checks_;
  Repeats repeats_;
  std::vector<WrongPicture>& wrong_pictures_;
  PeerCosts costs_;
};

}  // namespace

PeerCosts measure_peers(const Soup& soup, const Checks& checks,
                        const Repeats& repeats,
                        std::vector<WrongPicture>& wrong_pictures) {
  return Bench(soup, checks, repeats, wrong_pictures).costs();
}

}  // namespace halfspace::bench
