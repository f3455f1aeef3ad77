#include "peers/shared_vertices.hpp"

#include <bit>
#include <cstddef>
#include <unordered_map>

#include "halfspace/bsp_tree.hpp"

namespace halfspace::bench {
namespace {

struct Key {
  std::array<float, 3> position;
  Pixel color;
  friend bool operator==(const Key&, const Key&) = default;
};

struct Hash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = key.color;
    for (const float c : key.position) h = mix(h ^ std::bit_cast<Pixel>(c));
    return static_cast<std::size_t>(h);
  }
};

/// Vertices found again by what they must agree in.
class Pool {
 public:
  explicit Pool(std::vector<SharedVertex>& vertices) : vertices_(vertices) {}

  /// The index of the key's vertex, which is added if it is new.
  std::uint32_t index_of(const Key& key) {
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [found, added] = indices_.try_emplace(key, next);
    if (added) vertices_.push_back({key.position, key.color, 0});
    return found->second;
  }

 private:
  std::vector<SharedVertex>& vertices_;
  std::unordered_map<Key, std::uint32_t, Hash> indices_;
};

}  // namespace

SharedVertices shared_for_smooth(const Soup& soup,
                                 const std::vector<std::uint32_t>& order) {
  SharedVertices shared;
  Pool pool(shared.vertices);
  for (const std::uint32_t index : order) {
    const SoupTriangle& triangle = soup.triangles[index];
    for (std::size_t k = 0; k < 3; ++k) {
      shared.indices.push_back(
          pool.index_of({triangle.corners[k], triangle.corner_colors[k]}));
    }
  }
  return shared;
}

SharedVertices shared_for_flat(const Soup& soup,
                               const std::vector<std::uint32_t>& order) {
  SharedVertices shared;
  Pool pool(shared.vertices);
  std::vector<bool> taken;  // is some triangle's last corner
  for (const std::uint32_t index : order) {
    const SoupTriangle& triangle = soup.triangles[index];
    std::array<std::uint32_t, 3> corner{};
    std::size_t last = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = pool.index_of({triangle.corners[k], 0});
      taken.resize(shared.vertices.size());
      if (!taken[corner[k]]) last = k;
    }
    if (last == 3) {
      last = 2;
      corner[last] = static_cast<std::uint32_t>(shared.vertices.size());
      shared.vertices.push_back({triangle.corners[last], 0, 0});
      taken.push_back(false);
    }
    taken[corner[last]] = true;
    shared.vertices[corner[last]].color = triangle.color;
    shared.vertices[corner[last]].id = id_pixel(triangle.source);
    for (std::size_t turn = 1; turn <= 3; ++turn) {
      shared.indices.push_back(corner[(last + turn) % 3]);
    }
  }
  return shared;
}

}  // namespace halfspace::bench
