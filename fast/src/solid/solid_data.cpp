#include "halfspace/fast/solid_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "halfspace/fast/bad_edges.hpp"
#include "solid/face_projection.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Numbers in the order in which they are asked for.
class Numbering {
 public:
  /// `is_new`: it was not asked for before.
  std::uint32_t of(std::int32_t id, bool& is_new) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    const auto [at, inserted] = numbers_.try_emplace(id, next);
    is_new = inserted;
    return at->second;
  }
  std::uint32_t at(std::int32_t id) const { return numbers_.at(id); }

 private:
  std::unordered_map<std::int32_t, std::uint32_t> numbers_;
};

/// Makes the data of a solid.
class DataWriter {
 public:
  DataWriter(const Solid& solid, const std::vector<std::string>& names)
      : solid_(solid) {
    data_.parts = names;
  }
  SolidData data();

 private:
  std::uint32_t plane(std::int32_t id);
  void name_vertex(std::int32_t id);
  std::uint32_t origin_of(const Face& face);
  void add_face(const Face& face);
  void add_corners(const Face& face);

  const Solid& solid_;
  SolidData data_;
  Numbering planes_, points_, meets_;
  std::map<std::pair<std::int32_t, PolygonId>, std::uint32_t> origins_;
};

std::uint32_t DataWriter::plane(std::int32_t id) {
  bool is_new = false;
  const std::uint32_t number = planes_.of(id, is_new);
  if (is_new) {
    const SolidPlane plane = plane_at(solid_, id);
    data_.planes.push_back({plane.normal, plane.origin});
  }
  return number;
}

void DataWriter::name_vertex(std::int32_t id) {
  const SolidVertex vertex = vertex_at(solid_, id);
  bool is_new = false;
  if (vertex.is_grid) {
    points_.of(id, is_new);
    if (is_new) data_.points.push_back(vertex.point);
    return;
  }
  meets_.of(id, is_new);
  if (!is_new) return;
  std::array<std::uint32_t, 3> planes{};
  for (std::size_t i = 0; i < 3; ++i) planes[i] = plane(vertex.planes[i]);
  std::sort(planes.begin(), planes.end());
  data_.meets.push_back(planes);
}

std::uint32_t DataWriter::origin_of(const Face& face) {
  const auto next = static_cast<std::uint32_t>(data_.origins.size());
  const auto [at, is_new] =
      origins_.try_emplace({face.part, face.polygon}, next);
  if (is_new) {
    data_.origins.push_back({static_cast<std::uint32_t>(face.part),
                             static_cast<std::uint32_t>(face.polygon)});
  }
  return at->second;
}

/// Adds the face, and names what it has.
void DataWriter::add_face(const Face& face) {
  data_.faces.push_back(
      {plane(face.plane), face.flipped, face.color, origin_of(face), 0});
  std::uint32_t count = 0;
  std::int32_t first = -1;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[face.first_edge + i];
    name_vertex(edge.from);
    if (edge.other >= 0) plane(edge.other);
    if (count++ == 0) first = edge.from;
    if (edge.to != first) continue;
    data_.loops.push_back(count);
    ++data_.faces.back().loop_count;
    count = 0;
  }
}

/// Adds the corners, now that it is known how many points there are.
void DataWriter::add_corners(const Face& face) {
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[face.first_edge + i];
    const bool is_grid = vertex_at(solid_, edge.from).is_grid;
    const std::uint32_t vertex =
        is_grid ? points_.at(edge.from)
                : static_cast<std::uint32_t>(data_.points.size()) +
                      meets_.at(edge.from);
    data_.corners.push_back({vertex, edge.other < 0 ? SolidData::kNoPlane
                                                    : planes_.at(edge.other)});
  }
}

SolidData DataWriter::data() {
  data_.unit = solid_.unit;
  data_.grid_bits = grid_bits_of(solid_);
  data_.is_checked = true;
  data_.is_conforming = solid_.is_conforming;
  for (const Face& face : solid_.faces) add_face(face);
  for (const Face& face : solid_.faces) add_corners(face);
  return std::move(data_);
}

/// The face's edges with each loop in a row.
std::vector<SolidEdge> in_rows(const Solid& solid, const Face& face) {
  const auto first = solid.edges.begin() + face.first_edge;
  std::vector<SolidEdge> left(first, first + face.edge_count), rows;
  std::int32_t begin = -1;
  while (!left.empty()) {
    const auto next =
        begin < 0 || rows.back().to == begin
            ? left.begin()
            : std::find_if(left.begin(), left.end(), [&](const SolidEdge& e) {
                return e.from == rows.back().to;
              });
    if (begin < 0 || rows.back().to == begin) begin = next->from;
    rows.push_back(*next);
    left.erase(next);
  }
  return rows;
}

/// Whether each loop of the face stands in a row.
bool is_in_rows(const Solid& solid, const Face& face) {
  std::int32_t first = -1, last = -1;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid.edges[face.first_edge + i];
    if (first < 0) first = edge.from;
    if (last >= 0 && edge.from != last) return false;
    last = edge.to;
    if (edge.to == first) first = last = -1;
  }
  return first < 0;
}

/// Makes the solid of data.
class DataReader {
 public:
  DataReader(const SolidData& data, TableLease lease, std::int32_t part)
      : data_(data), lease_(std::move(lease)), part_(part) {
    solid_.unit = data.unit;
    solid_.table = lease_.shared();
  }
  Result<Solid> solid();

 private:
  bool fail(ErrorCode code, std::size_t face, const std::string& what) {
    error_ = Error{code, "face " + std::to_string(face) + what,
                   static_cast<std::int64_t>(face)};
    return false;
  }
  bool add_vertices();
  bool add_face(std::size_t f, std::size_t& loop, std::size_t& corner);
  bool check_edges(std::size_t f);
  bool check_side(std::size_t f);
  bool check_closed();

  const SolidData& data_;
  TableLease lease_;
  std::int32_t part_;
  Solid solid_;
  std::vector<std::int32_t> planes_, vertices_;
  Error error_{};
};

bool DataReader::add_vertices() {
  GeometryTable& table = lease_.table();
  table.reserve(data_.points.size() + data_.meets.size(), data_.planes.size());
  for (const SolidData::Plane& plane : data_.planes) {
    const auto& n = plane.normal;
    planes_.push_back(
        table.add_plane(Vector3<Int128>{n[0], n[1], n[2]}, plane.origin).plane);
  }
  table.add_points(data_.points, vertices_);
  const double limit = std::ldexp(1.0, table.grid_bits() - 1);
  for (std::size_t m = 0; m < data_.meets.size(); ++m) {
    const auto& meet = data_.meets[m];
    const std::int32_t v =
        table.meet(planes_[meet[0]], planes_[meet[1]], planes_[meet[2]]);
    const Vertex& at = table.vertex(v).approximate;
    if (!(std::abs(at.x) <= limit && std::abs(at.y) <= limit &&
          std::abs(at.z) <= limit)) {
      error_ = Error{ErrorCode::kOutOfRange,
                     "meet " + std::to_string(m) + " is beyond the grid",
                     static_cast<std::int64_t>(m)};
      return false;
    }
    vertices_.push_back(v);
  }
  return true;
}

bool DataReader::add_face(std::size_t f, std::size_t& loop,
                          std::size_t& corner) {
  const SolidData::Face& from = data_.faces[f];
  Face& face = solid_.faces.emplace_back();
  face.plane = planes_[from.plane];
  face.flipped = from.flipped;
  face.color = from.color;
  face.source = static_cast<PolygonId>(f);
  face.part = part_;
  face.polygon = static_cast<PolygonId>(from.origin);
  face.first_edge = static_cast<std::uint32_t>(solid_.edges.size());
  for (std::uint32_t l = 0; l < from.loop_count; ++l, ++loop) {
    const std::size_t count = data_.loops[loop];
    for (std::size_t i = 0; i < count; ++i) {
      const SolidData::Corner& at = data_.corners[corner + i];
      const SolidData::Corner& next = data_.corners[corner + (i + 1) % count];
      solid_.edges.push_back(
          {vertices_[at.vertex], vertices_[next.vertex],
           at.plane == SolidData::kNoPlane ? -1 : planes_[at.plane]});
    }
    corner += count;
  }
  face.edge_count =
      static_cast<std::uint32_t>(solid_.edges.size()) - face.first_edge;
  if (!check_edges(f)) return false;
  face.box = face_box(solid_, face);
  return check_side(f);
}

bool DataReader::check_edges(std::size_t f) {
  const GeometryTable& table = *solid_.table;
  const Face& face = solid_.faces[f];
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[face.first_edge + i];
    if (edge.from == edge.to)
      return fail(ErrorCode::kRepeatedVertex, f, " has an edge of no length");
    if (table.side(face.plane, edge.from) != 0)
      return fail(ErrorCode::kNotPlanar, f, " has a vertex off its plane");
    if (edge.other < 0) continue;
    if (edge.other == face.plane || table.side(edge.other, edge.from) != 0 ||
        table.side(edge.other, edge.to) != 0)
      return fail(ErrorCode::kNotPlanar, f,
                  " has an edge off the edge's plane");
  }
  return true;
}

/// At the vertex that a sweep comes to first the face turns left, if it is on
/// the left of its loops. Where loops touch there, nothing is said.
bool DataReader::check_side(std::size_t f) {
  const Face& face = solid_.faces[f];
  const FaceProjection projection(solid_, face);
  std::int32_t least = solid_.edges[face.first_edge].from;
  for (std::uint32_t i = 1; i < face.edge_count; ++i) {
    const std::int32_t v = solid_.edges[face.first_edge + i].from;
    if (v != least && projection.before(v, least)) least = v;
  }
  std::int32_t before = -1, after = -1;
  int count = 0;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid_.edges[face.first_edge + i];
    if (edge.to == least) before = edge.from;
    if (edge.from == least) after = edge.to, ++count;
  }
  if (count > 1 || projection.turn(before, least, after) > 0) return true;
  return fail(ErrorCode::kNotConvex, f,
              " is on the right of its loops, or has no area");
}

bool DataReader::check_closed() {
  const std::size_t bad = bad_edges(solid_).size();
  if (bad == 0) return true;
  error_ =
      Error{ErrorCode::kOpen,
            "the surface is not closed: " + std::to_string(bad) + " bad edges"};
  return false;
}

Result<Solid> DataReader::solid() {
  if (!add_vertices()) return error_;
  solid_.faces.reserve(data_.faces.size());
  solid_.edges.reserve(data_.corners.size());
  std::size_t loop = 0, corner = 0;
  for (std::size_t f = 0; f < data_.faces.size(); ++f) {
    if (!add_face(f, loop, corner)) return error_;
  }
  if (!check_closed()) return error_;
  solid_.is_conforming = data_.is_conforming && data_.is_checked;
  return std::move(solid_);
}

}  // namespace

SolidData data_of(const Solid& solid, const std::vector<std::string>& names) {
  const bool is_fine =
      std::all_of(solid.faces.begin(), solid.faces.end(),
                  [&](const Face& face) { return is_in_rows(solid, face); });
  if (is_fine) return DataWriter(solid, names).data();
  Solid ordered = solid;
  for (const Face& face : ordered.faces) {
    const std::vector<SolidEdge> rows = in_rows(solid, face);
    std::copy(rows.begin(), rows.end(),
              ordered.edges.begin() + face.first_edge);
  }
  return DataWriter(ordered, names).data();
}

Result<Solid> to_solid(const SolidData& data, const Solid& with,
                       std::int32_t part) {
  return DataReader(data, lease_beside(with), part).solid();
}

Result<Solid> to_solid(const SolidData& data, std::int32_t part) {
  return DataReader(data, TableLease::of_new(data.grid_bits), part).solid();
}

}  // namespace halfspace::fast
