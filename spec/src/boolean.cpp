#include "halfspace/boolean.hpp"

#include <map>
#include <utility>

namespace halfspace {
namespace {

std::string text_of(const GridPoint& p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
         std::to_string(p.z) + ")";
}

}  // namespace

std::vector<BadEdge> bad_edges(const Scene& scene) {
  // Uses from the lesser end to the greater one count up, the others down.
  std::map<std::pair<GridPoint, GridPoint>, std::int64_t> balance;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const GridPoint& from = scene.point(corners[i]);
      const GridPoint& to = scene.point(corners[(i + 1) % corners.size()]);
      if (from < to) {
        ++balance[{from, to}];
      } else {
        --balance[{to, from}];
      }
    }
  }
  std::vector<BadEdge> bad;
  for (const auto& [ends, excess] : balance) {
    if (excess > 0) bad.push_back({ends.first, ends.second, excess});
    if (excess < 0) bad.push_back({ends.second, ends.first, -excess});
  }
  return bad;
}

Result<Solid> make_solid(Scene scene) {
  const std::vector<BadEdge> bad = bad_edges(scene);
  if (!bad.empty()) {
    const BadEdge& first = bad.front();
    return Error{ErrorCode::kNotClosed,
                 "the surface is not closed or not consistently oriented: " +
                     std::to_string(bad.size()) +
                     (bad.size() == 1 ? " bad edge" : " bad edges") +
                     ", the first from " + text_of(first.from) + " to " +
                     text_of(first.to) + " (in grid steps)",
                 static_cast<std::int64_t>(bad.size())};
  }
  Solid solid;
  solid.scene_ = std::move(scene);
  return solid;
}

}  // namespace halfspace
