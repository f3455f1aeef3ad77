#include "core/combine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace halfspace::viewer {
namespace {

/// The sum of two numbers. Exact.
io::Number sum(const io::Number& a, const io::Number& b) {
  const std::int32_t two = std::min(a.two, b.two);
  const std::int32_t five = std::min(a.five, b.five);
  const auto scaled = [&](const io::Number& n) -> io::Integer {
    io::Integer value = n.mantissa;
    value <<= static_cast<unsigned>(n.two - two);
    return value * boost::multiprecision::pow(
                       io::Integer(5), static_cast<unsigned>(n.five - five));
  };
  return io::normalised(scaled(a) + scaled(b), two, five);
}

/// The shortest decimal that the double reads back from.
io::Number decimal_of(double value) {
  const Result<io::Number> number = io::parse_number(fmt::format("{}", value));
  return number ? *number : io::number_of(value);
}

void append(const ReadPart& from, CombinedMesh& to) {
  const io::Mesh& mesh = *from.mesh;
  const auto first = static_cast<VertexId>(to.mesh.vertices.size());
  const bool is_shifted = from.part->shift != std::array<double, 3>{};
  to.mesh.vertices.insert(to.mesh.vertices.end(), mesh.vertices.begin(),
                          mesh.vertices.end());
  if (is_shifted) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const io::Number by = decimal_of(from.part->shift[axis]);
      for (std::size_t v = static_cast<std::size_t>(first);
           v < to.mesh.vertices.size(); ++v) {
        io::Number& at = to.mesh.vertices[v][axis];
        at = sum(at, by);
      }
    }
  }
  const auto corners = static_cast<std::uint32_t>(to.mesh.corners.size());
  for (const VertexId corner : mesh.corners)
    to.mesh.corners.push_back(first + corner);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    to.mesh.first_corner.push_back(corners + mesh.first_corner[f + 1]);
    std::optional<Rgb> color = from.part->color;
    if (!color && !mesh.face_colors.empty()) color = mesh.face_colors[f];
    to.mesh.face_colors.push_back(color);
  }
  to.mesh.vertex_colors.resize(to.mesh.vertices.size());
  if (!mesh.vertex_colors.empty() && !from.part->color) {
    std::copy(mesh.vertex_colors.begin(), mesh.vertex_colors.end(),
              to.mesh.vertex_colors.begin() + first);
  }
  to.parts.resize(to.mesh.face_count(), from.index);
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    to.faces.push_back(static_cast<PolygonId>(f));
}

Solid solid_of_part(const Part& part) {
  const auto [x, y, z] = part.shift;
  // As in scripts: coordinates of floats and cuts by decimals seldom have a
  // grid in common.
  OperandOptions how;
  how.may_round = true;
  const Solid solid = Solid::from_file(part.path, how);
  return (x == 0 && y == 0 && z == 0 ? solid : solid.translated({x, y, z}))
      .named(part.path);
}

Solid expression(const std::vector<const Part*>& parts,
                 Combination combination) {
  std::vector<Solid> solids;
  for (const Part* part : parts) solids.push_back(solid_of_part(*part));
  if (solids.empty()) return {};
  Solid result = solids.front();
  const std::vector<Solid> others(solids.begin() + 1, solids.end());
  switch (combination) {
    case Combination::kNone:
    case Combination::kUnion:
      return Solid::union_of(solids);
    case Combination::kDifference:
      return others.empty() ? result : result - Solid::union_of(others);
    case Combination::kIntersection:
      return Solid::intersection_of(solids);
    case Combination::kSymmetricDifference:
      for (const Solid& other : others) result ^= other;
      return result;
  }
  return result;
}

Result<Done> evaluated(const Solid& solid, const Report& report) {
  WorkOptions options;
  options.progress = [&report](double share) {
    return report("boolean", share);
  };
  return solid.evaluate(options);
}

/// The colours of parts that have none of their own: a boolean shows whose a
/// face was.
constexpr Rgb kPartColors[] = {{0x8f, 0xb8, 0xde}, {0xf2, 0xa6, 0x5a},
                               {0x8c, 0xc0, 0x84}, {0xd9, 0x8b, 0xb0},
                               {0xe3, 0xc5, 0x5b}, {0x9f, 0x9b, 0xd6}};
constexpr Rgb kCapColor = {0xc9, 0x4f, 0x4f};

}  // namespace

CombinedMesh joined(const std::vector<ReadPart>& parts) {
  CombinedMesh result;
  result.mesh.decimal = true;
  for (const ReadPart& part : parts) {
    append(part, result);
    result.mesh.decimal = result.mesh.decimal && part.mesh->decimal;
  }
  const auto has_none = [](const std::vector<std::optional<Rgb>>& colors) {
    return std::none_of(colors.begin(), colors.end(),
                        [](const auto& color) { return color.has_value(); });
  };
  if (has_none(result.mesh.face_colors)) result.mesh.face_colors.clear();
  if (has_none(result.mesh.vertex_colors)) result.mesh.vertex_colors.clear();
  return result;
}

namespace {

/// Colours that neighbours are told apart by.
constexpr Rgb kFaceColors[] = {
    {0xa6, 0xce, 0xe3}, {0xf7, 0xa8, 0x72}, {0xb2, 0xdf, 0x8a},
    {0xe7, 0x9c, 0xb7}, {0xf6, 0xd5, 0x7d}, {0xb9, 0xac, 0xdb},
    {0x8f, 0xd1, 0xc4}, {0xd7, 0xb4, 0x98}, {0x9b, 0xb0, 0xe0},
    {0xd5, 0xd8, 0x86}, {0xe0, 0x8f, 0x86}};

}  // namespace

void color_faces(const std::vector<ReadPart>& parts, Coloring coloring,
                 CombinedMesh& mesh) {
  if (coloring == Coloring::kFile) return;
  io::Mesh& to = mesh.mesh;
  to.vertex_colors.clear();
  to.face_colors.resize(to.face_count());
  for (std::size_t f = 0; f < to.face_count(); ++f) {
    const std::uint32_t part = mesh.parts[f];
    if (part == kCapPart) continue;
    if (coloring == Coloring::kFaces) {
      const auto number = static_cast<std::size_t>(mesh.faces[f]) + part;
      to.face_colors[f] = kFaceColors[number % std::size(kFaceColors)];
      continue;
    }
    const auto from =
        std::find_if(parts.begin(), parts.end(),
                     [part](const ReadPart& p) { return p.index == part; });
    to.face_colors[f] =
        from->part->color.value_or(kPartColors[part % std::size(kPartColors)]);
  }
}

namespace {

/// The solid cut by the planes that are on.
Solid cut(Solid solid, const State& state) {
  for (const Section& section : state.sections) {
    if (!section.is_on) continue;
    const auto& [x, y, z] = section.normal;
    solid = solid & Solid::half_space({{x, y, z}, section.offset});
  }
  return solid;
}

/// Adds what is left of a solid of parts.
Result<Done> add_solid(const Solid& solid, const std::vector<ReadPart>& parts,
                       CombinedMesh& to) {
  const auto mesh = solid.mesh();
  if (!mesh) return mesh.error();
  const auto operands = solid.operands();
  if (!operands) return operands.error();
  const auto first = static_cast<VertexId>(to.mesh.vertices.size());
  for (const Point& p : mesh->vertices) {
    to.mesh.vertices.push_back(
        {io::number_of(p.x), io::number_of(p.y), io::number_of(p.z)});
  }
  const auto corners = static_cast<std::uint32_t>(to.mesh.corners.size());
  for (const std::int32_t corner : mesh->corners)
    to.mesh.corners.push_back(first + corner);
  for (std::size_t p = 0; p < mesh->polygon_count(); ++p) {
    to.mesh.first_corner.push_back(corners + mesh->first_corner[p + 1]);
    // An operand that occurs twice stands for the first of its parts.
    const Origin& origin = mesh->origins[p];
    const std::string name = (*operands)[origin.operand].name();
    const auto from = std::find_if(
        parts.begin(), parts.end(),
        [&name](const ReadPart& part) { return part.part->path == name; });
    const bool is_cap = from == parts.end();
    to.parts.push_back(is_cap ? kCapPart : from->index);
    to.faces.push_back(origin.polygon);
    to.mesh.face_colors.push_back(
        is_cap ? kCapColor
               : from->part->color.value_or(
                     kPartColors[from->index % std::size(kPartColors)]));
  }
  return Done{};
}

}  // namespace

Result<CombinedMesh> combined(const std::vector<ReadPart>& parts,
                              const State& state, Sections sections,
                              const Report& report) {
  // Parts that are not combined are cut one by one.
  std::vector<std::vector<const Part*>> groups;
  for (const ReadPart& part : parts) {
    if (groups.empty() || state.combination == Combination::kNone)
      groups.emplace_back();
    groups.back().push_back(part.part);
  }
  CombinedMesh result;
  for (const auto& group : groups) {
    const Solid whole = expression(group, state.combination);
    const Solid solid =
        sections == Sections::kOfSolids ? cut(whole, state) : whole;
    const Result<Done> done = evaluated(solid, report);
    if (!done) return done.error();
    const Result<Done> added = add_solid(solid, parts, result);
    if (!added) return added.error();
  }
  if (result.mesh.face_count() == 0)
    return Error{ErrorCode::kEmpty, "nothing is left of these parts"};
  return result;
}

Solid solid_of(const State& state) {
  std::vector<const Part*> shown;
  for (const Part& part : state.parts) {
    if (part.is_visible) shown.push_back(&part);
  }
  return cut(expression(shown, state.combination), state);
}

Result<Done> save_combined(const State& state,
                           const std::filesystem::path& path,
                           const Report& report) {
  if (!report("boolean", 0)) return io::stopped();
  const Solid solid = solid_of(state);
  const Result<Done> done = evaluated(solid, report);
  if (!done) return done.error();
  return solid.save(path);
}

Result<io::Mesh> mesh_of_solid(const std::string& path) {
  const Result<Mesh> from = Solid::from_file(path).mesh();
  if (!from) return from.error();
  io::Mesh mesh;
  for (const Point& p : from->vertices) {
    mesh.vertices.push_back(
        {io::number_of(p.x), io::number_of(p.y), io::number_of(p.z)});
  }
  mesh.first_corner = from->first_corner;
  mesh.corners = from->corners;
  if (from->colors.size() == from->polygon_count())
    mesh.face_colors.assign(from->colors.begin(), from->colors.end());
  return mesh;
}

io::Mesh mesh_of(const Scene& scene) {
  io::Mesh mesh;
  const Unit unit = scene.unit();
  const std::int32_t five = unit.base == 10 ? unit.exponent : 0;
  for (const GridPoint& p : scene.data().vertices) {
    mesh.vertices.push_back({io::normalised(p.x, unit.exponent, five),
                             io::normalised(p.y, unit.exponent, five),
                             io::normalised(p.z, unit.exponent, five)});
  }
  mesh.first_corner = scene.data().first_corner;
  mesh.corners = scene.data().corners;
  mesh.face_colors.assign(scene.data().colors.begin(),
                          scene.data().colors.end());
  mesh.decimal = unit.base == 10;
  return mesh;
}

}  // namespace halfspace::viewer
