#include "scenes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/int128.hpp"
#include "random.hpp"

namespace halfspace::bench {
namespace {

/// Whether the corners lie on one line. At 54 bits a difference has 55 and a
/// component of the cross product 111.
bool is_flat(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  const Int128 ux = q.x - p.x, uy = q.y - p.y, uz = q.z - p.z;
  const Int128 vx = r.x - p.x, vy = r.y - p.y, vz = r.z - p.z;
  return uy * vz == uz * vy && uz * vx == ux * vz && ux * vy == uy * vx;
}

struct Vector {
  double x, y, z;
};

/// Where smooth noise moves the direction `v`: a sum of sine waves with random
/// directions, each octave half as high and twice as fine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) {
    Random random(seed);
    const auto component = [&random] {
      return static_cast<double>(random.between(-1000, 1000)) / 1000;
    };
    for (Vector& wave : waves_) wave = {component(), component(), component()};
    for (double& phase : phases_) phase = 3 * component();
  }

  /// From -1 to 1.
  double at(const Vector& v) const {
    double sum = 0;
    for (std::size_t k = 0; k < waves_.size(); ++k) {
      const double octave = static_cast<double>(k / 4);
      const Vector& w = waves_[k];
      sum +=
          std::exp2(-octave) *
          std::sin(6 * std::exp2(octave) * (w.x * v.x + w.y * v.y + w.z * v.z) +
                   phases_[k]);
    }
    return sum / 8;
  }

 private:
  std::array<Vector, 24> waves_{};
  std::array<double, 24> phases_{};
};

/// The point of the surface at `u` and `v`, both from 0 to 1, within the cube
/// from -1 to 1.
Vector point_at(Surface surface, const Noise& noise, double u, double v) {
  const double a = 2 * std::numbers::pi * u;
  const double b = 2 * std::numbers::pi * v;
  switch (surface) {
    case Surface::kTorus: {
      const double r = (1 + 0.4 * std::cos(b)) / 1.4;
      return {r * std::cos(a), r * std::sin(a), 0.4 / 1.4 * std::sin(b)};
    }
    case Surface::kKleinBottle: {
      const double across = std::sin(b), twice = std::sin(2 * b);
      const double c = std::cos(a / 2), s = std::sin(a / 2);
      const double r = (2 + c * across - s * twice) / 3.5;
      return {r * std::cos(a), r * std::sin(a), (s * across + c * twice) / 3.5};
    }
    case Surface::kSphere:
    case Surface::kRock: {
      const double r = std::sin(b / 2);
      Vector p = {r * std::cos(a), r * std::sin(a), -std::cos(b / 2)};
      if (surface == Surface::kRock) {
        const double scale = 0.8 + 0.2 * noise.at(p);
        p = {p.x * scale, p.y * scale, p.z * scale};
      }
      return p;
    }
  }
  return {};
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(140 + 110 * value));
}

/// The vertices of a mesh over the unit square, which is closed in `u` (a
/// Klein bottle turns over there), and in `v` unless its ends are poles.
class MeshMaker {
 public:
  MeshMaker(Surface surface, std::int32_t rings, std::int32_t sectors,
            std::uint64_t seed)
      : surface_(surface), rings_(rings), sectors_(sectors), noise_(seed) {
    const std::int32_t last = has_poles() ? rings : rings - 1;
    for (std::int32_t j = 0; j <= last; ++j) {
      const bool pole = has_poles() && (j == 0 || j == rings);
      for (std::int32_t i = 0; i < (pole ? 1 : sectors); ++i) add(i, j);
    }
  }

  Scene scene() && {
    for (std::int32_t j = 0; j < rings_; ++j) {
      for (std::int32_t i = 0; i < sectors_; ++i) {
        const std::int32_t a = index(i, j), b = index(i + 1, j);
        const std::int32_t c = index(i + 1, j + 1), d = index(i, j + 1);
        if (a != b) triangle(a, b, c);
        if (c != d) triangle(a, c, d);
      }
    }
    return std::move(maker_).scene();
  }

 private:
  bool has_poles() const {
    return surface_ == Surface::kSphere || surface_ == Surface::kRock;
  }

  void add(std::int32_t i, std::int32_t j) {
    const Vector p =
        point_at(surface_, noise_, static_cast<double>(i) / sectors_,
                 static_cast<double>(j) / rings_);
    constexpr double kScale = kUniverse * kStepsPerUnit / 2;
    maker_.vertex({std::llround(p.x * kScale), std::llround(p.y * kScale),
                   std::llround(p.z * kScale)});
    colors_.push_back({channel(p.x), channel(p.y), channel(p.z)});
  }

  VertexId index(std::int32_t i, std::int32_t j) const {
    if (has_poles()) {
      if (j == 0) return 0;
      if (j == rings_) return 1 + (rings_ - 1) * sectors_;
      return 1 + (j - 1) * sectors_ + i % sectors_;
    }
    // Round the Klein bottle once, v runs the other way.
    if (surface_ == Surface::kKleinBottle && i == sectors_) j = rings_ - j;
    return j % rings_ * sectors_ + i % sectors_;
  }

  void triangle(VertexId a, VertexId b, VertexId c) {
    const auto color = [this](VertexId v) {
      return colors_[static_cast<std::size_t>(v)];
    };
    maker_.triangle({a, b, c}, {color(a), color(b), color(c)});
  }

  Surface surface_;
  std::int32_t rings_;
  std::int32_t sectors_;
  Noise noise_;
  SceneMaker maker_;
  std::vector<Rgb> colors_;
};

}  // namespace

VertexId SceneMaker::vertex(const GridPoint& p) {
  data_.vertices.push_back(p);
  return static_cast<VertexId>(data_.vertices.size() - 1);
}

void SceneMaker::polygon(const std::vector<VertexId>& corners, Rgb color) {
  for (const VertexId corner : corners) {
    data_.corners.push_back(corner);
    data_.corner_colors.push_back(color);
  }
  data_.first_corner.push_back(
      static_cast<std::uint32_t>(data_.corners.size()));
  data_.colors.push_back(color);
}

void SceneMaker::triangle(const VertexId (&corners)[3],
                          const Rgb (&corner_colors)[3]) {
  polygon({corners[0], corners[1], corners[2]}, color_of(data_.colors.size()));
  for (std::size_t k = 0; k < 3; ++k) {
    data_.corner_colors[data_.corner_colors.size() - 3 + k] = corner_colors[k];
  }
}

Scene SceneMaker::scene(Unit unit, int grid_bits) && {
  data_.unit = unit;
  data_.grid_bits = grid_bits;
  Result<Scene> made = make_scene(std::move(data_));
  HALFSPACE_ASSERT(made.has_value());
  return std::move(made).value();
}

Rgb color_of(std::uint64_t key) {
  const std::uint64_t bits = mix(key);
  const auto bright = [bits](int shift) {
    return static_cast<std::uint8_t>(64 + (bits >> shift) % 192);
  };
  return {bright(0), bright(16), bright(32)};
}

Scene random_triangles(const RandomTriangles& recipe) {
  constexpr std::int64_t kHalf = kUniverse * kStepsPerUnit / 2;
  const std::int64_t reach = recipe.size * kStepsPerUnit / 2;
  Random random(recipe.seed);
  SceneMaker maker;
  for (std::int64_t made = 0; made < recipe.count;) {
    const auto in_universe = [&random] {
      return random.between(-kHalf, kHalf);
    };
    const auto near = [&](std::int64_t centre) {
      return centre + random.between(-reach, reach);
    };
    const GridPoint centre = {in_universe(), in_universe(), in_universe()};
    GridPoint p[3];
    for (GridPoint& q : p) {
      q = {near(centre.x), near(centre.y), near(centre.z)};
      if (recipe.parallel) q.z = centre.z;
    }
    if (is_flat(p[0], p[1], p[2])) continue;
    const VertexId a = maker.vertex(p[0]);
    const VertexId b = maker.vertex(p[1]);
    const VertexId c = maker.vertex(p[2]);
    maker.triangle({a, b, c}, {color_of(random.next()), color_of(random.next()),
                               color_of(random.next())});
    ++made;
  }
  return std::move(maker).scene();
}

Scene in_floats(const Scene& scene, int grid_bits) {
  SceneData data = scene.data();
  data.grid_bits = grid_bits;
  // One bit is the sign's, ten are those of 1024.
  data.unit = {2, 11 - grid_bits};
  const auto rounded = [&](std::int64_t steps) {
    const auto value = static_cast<float>(static_cast<double>(steps) /
                                          static_cast<double>(kStepsPerUnit));
    return std::llround(std::ldexp(double{value}, -data.unit.exponent));
  };
  for (GridPoint& p : data.vertices) {
    p = {rounded(p.x), rounded(p.y), rounded(p.z)};
  }
  SceneMaker maker;
  for (const GridPoint& p : data.vertices) maker.vertex(p);
  for (std::size_t p = 0; p < data.colors.size(); ++p) {
    const std::size_t first = data.first_corner[p];
    const auto corner = [&](std::size_t k) { return data.corners[first + k]; };
    const auto point = [&](std::size_t k) {
      return data.vertices[static_cast<std::size_t>(corner(k))];
    };
    const auto color = [&](std::size_t k) {
      return data.corner_colors[first + k];
    };
    if (is_flat(point(0), point(1), point(2))) continue;
    maker.triangle({corner(0), corner(1), corner(2)},
                   {color(0), color(1), color(2)});
  }
  return std::move(maker).scene(data.unit, grid_bits);
}

Scene surface_mesh(Surface surface, std::int32_t rings, std::int32_t sectors,
                   std::uint64_t seed) {
  return MeshMaker(surface, rings, sectors, seed).scene();
}

}  // namespace halfspace::bench
