#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "soup.hpp"

/// Shells round open surfaces.
namespace halfspace::csg {
namespace {

using Vector = std::array<double, 3>;
/// A symmetric matrix of three rows.
using Symmetric = std::array<Vector, 3>;

double product(const Vector& u, const Vector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// Twice the area that a polygon goes round, along its normal.
Vector area_of(const Soup& soup, const std::vector<VertexId>& polygon) {
  const GridPoint& o = soup.at(polygon[0]);
  const auto from_first = [&](VertexId v) {
    const GridPoint& p = soup.at(v);
    return Vector{static_cast<double>(p.x - o.x),
                  static_cast<double>(p.y - o.y),
                  static_cast<double>(p.z - o.z)};
  };
  Vector sum{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vector u = from_first(polygon[i]), v = from_first(polygon[i + 1]);
    sum[0] += u[1] * v[2] - u[2] * v[1];
    sum[1] += u[2] * v[0] - u[0] * v[2];
    sum[2] += u[0] * v[1] - u[1] * v[0];
  }
  return sum;
}

/// Turns the matrix, and the rows of `axes` with it, so that its entries at
/// (p, q) become 0: one rotation of Jacobi's.
void rotate(Symmetric& m, std::array<Vector, 3>& axes, std::size_t p,
            std::size_t q) {
  if (m[p][q] == 0) return;
  const double half = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double tangent =
      (half < 0 ? -1 : 1) / (std::abs(half) + std::sqrt(half * half + 1));
  const double cosine = 1 / std::sqrt(tangent * tangent + 1);
  const double sine = tangent * cosine;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = m[k][p], b = m[k][q];
    m[k][p] = cosine * a - sine * b;
    m[k][q] = sine * a + cosine * b;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = m[p][k], b = m[q][k];
    m[p][k] = cosine * a - sine * b;
    m[q][k] = sine * a + cosine * b;
    const double c = axes[p][k], d = axes[q][k];
    axes[p][k] = cosine * c - sine * d;
    axes[q][k] = sine * c + cosine * d;
  }
}

/// The shortest x with the least |m x - right|, where m has no negative
/// eigenvalues. What is small beside the greatest of them is taken for 0.
Vector least_solution(Symmetric m, const Vector& right) {
  constexpr double kSmall = 1e-5;
  constexpr int kSweeps = 12;
  std::array<Vector, 3> axes{Vector{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    rotate(m, axes, 0, 1);
    rotate(m, axes, 0, 2);
    rotate(m, axes, 1, 2);
  }
  const double most = std::max({m[0][0], m[1][1], m[2][2]});
  Vector x{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(m[i][i] > kSmall * most)) continue;
    const double share = product(axes[i], right) / m[i][i];
    for (std::size_t k = 0; k < 3; ++k) x[k] += share * axes[i][k];
  }
  return x;
}

/// How far each vertex goes for a shell that is 1 thick to each side: where the
/// planes of its polygons meet that have gone 1 along their normals. Where they
/// do not meet in a point, or far away, it is where they nearly do.
std::vector<Vector> moves_of(const Soup& soup,
                             const std::vector<Vector>& normals) {
  constexpr double kFarthest = 4;
  std::vector<Symmetric> squares(soup.points.size());
  std::vector<Vector> sums(soup.points.size());
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const double area = std::sqrt(product(normals[p], normals[p]));
    if (!(area > 0)) continue;
    for (const VertexId v : soup.polygons[p]) {
      const auto at = static_cast<std::size_t>(v);
      for (std::size_t i = 0; i < 3; ++i) {
        sums[at][i] += normals[p][i];
        for (std::size_t k = 0; k < 3; ++k)
          squares[at][i][k] += normals[p][i] * normals[p][k] / area;
      }
    }
  }
  std::vector<Vector> moves;
  for (std::size_t v = 0; v < squares.size(); ++v) {
    Vector move = least_solution(squares[v], sums[v]);
    const double far = std::sqrt(product(move, move));
    if (far > kFarthest) {
      for (double& c : move) c *= kFarthest / far;
    }
    moves.push_back(move);
  }
  return moves;
}

}  // namespace

Shell shell_of(const Soup& soup, double thickness) {
  const double step =
      std::pow(static_cast<double>(soup.unit.base), soup.unit.exponent);
  std::vector<Vector> normals;
  for (const auto& polygon : soup.polygons)
    normals.push_back(area_of(soup, polygon));
  const std::vector<Vector> moves = moves_of(soup, normals);
  Shell shell;
  const auto count = static_cast<VertexId>(soup.points.size());
  for (const double side : {0.5, -0.5}) {
    for (std::size_t v = 0; v < moves.size(); ++v) {
      const GridPoint& p = soup.points[v];
      const std::int64_t at[] = {p.x, p.y, p.z};
      std::array<io::Number, 3> numbers;
      for (std::size_t k = 0; k < 3; ++k)
        numbers[k] = io::number_of(static_cast<double>(at[k]) * step +
                                   side * thickness * moves[v][k]);
      shell.mesh.vertices.push_back(numbers);
    }
  }
  const auto add = [&](const std::vector<VertexId>& polygon,
                       std::size_t source) {
    io::Mesh& mesh = shell.mesh;
    mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.face_colors.push_back(soup.colors[source]);
    shell.sources.push_back(soup.sources[source]);
  };
  shell.least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    std::vector<VertexId> polygon = soup.polygons[p];
    const double area = std::sqrt(product(normals[p], normals[p]));
    for (const VertexId v : polygon) {
      const double here =
          thickness * product(normals[p], moves[static_cast<std::size_t>(v)]) /
          area;
      shell.least = std::min(shell.least, here);
      shell.most = std::max(shell.most, here);
    }
    add(polygon, p);
    std::reverse(polygon.begin(), polygon.end());
    for (VertexId& v : polygon) v += count;
    add(polygon, p);
  }
  for (const auto& [from, to] : open_edges(soup))
    add({to, from, from + count, to + count}, 0);
  return shell;
}

}  // namespace halfspace::csg
