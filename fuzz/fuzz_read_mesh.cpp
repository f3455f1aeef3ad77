#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "fuzz.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/write_mesh.hpp"

namespace halfspace {
namespace {

/// A grid coordinate in model units.
io::Number number_of(std::int64_t coordinate, Unit unit) {
  return io::normalised(coordinate, unit.exponent,
                        unit.base == 10 ? unit.exponent : 0);
}

/// The corners of a scene's polygon, exactly, in model units.
std::vector<std::array<io::Number, 3>> corners_of(const Scene& scene,
                                                  std::size_t polygon) {
  std::vector<std::array<io::Number, 3>> corners;
  for (const VertexId v : scene.corners(static_cast<PolygonId>(polygon))) {
    const GridPoint& p = scene.point(v);
    corners.push_back({number_of(p.x, scene.unit()),
                       number_of(p.y, scene.unit()),
                       number_of(p.z, scene.unit())});
  }
  return corners;
}

/// The corners of a mesh's face.
std::vector<std::array<io::Number, 3>> corners_of(const io::Mesh& mesh,
                                                  std::size_t face) {
  std::vector<std::array<io::Number, 3>> corners;
  for (std::uint32_t c = mesh.first_corner[face];
       c < mesh.first_corner[face + 1]; ++c) {
    corners.push_back(mesh.vertices[static_cast<std::size_t>(mesh.corners[c])]);
  }
  return corners;
}

/// mantissa * 2^(two - low) * 5^(five - low), an integer for low enough `low`.
io::Integer scaled(const io::Number& number, std::int32_t low) {
  return (number.mantissa << static_cast<unsigned>(number.two - low)) *
         pow(io::Integer(5), static_cast<unsigned>(number.five - low));
}

/// Whether `read` is what was written for `number`: the number itself; or, if
/// its digits are too many, one with the same double, to 17 digits.
bool is_same(const io::Number& number, const io::Number& read) {
  if (number == read) return true;
  const std::int32_t low =
      std::min({number.two, number.five, read.two, read.five, std::int32_t{0}});
  const io::Integer exact = scaled(number, low);
  const io::Integer error = abs(io::Integer(scaled(read, low) - exact));
  const std::int32_t places = -std::min({number.two, number.five, 0});
  const auto digits = scaled(number, -places).str().size();
  const bool is_long =
      std::max(digits + 1, static_cast<std::size_t>(places) + 2) > 78;
  return is_long && (error << 50) <= abs(exact);
}

/// Writes the scene in the format and reads it back: the same polygons.
void expect_round_trip(const Scene& scene, const char* ending) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("halfspace-fuzz-" + std::to_string(::getpid()) + ending);
  const auto written = io::write_scene_mesh(path, scene);
  if (!written) return;  // beyond the doubles of the format
  const auto mesh = io::read_mesh(path);
  std::filesystem::remove(path);
  if (scene.polygon_count() == 0) return;  // a file of nothing may be refused
  HALFSPACE_FUZZ_EXPECT(mesh.has_value(), mesh.error().message);
  HALFSPACE_FUZZ_EXPECT(mesh->face_count() == scene.polygon_count(), ending);
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto before = corners_of(scene, p);
    const auto after = corners_of(*mesh, p);
    HALFSPACE_FUZZ_EXPECT(before.size() == after.size(), ending);
    if (written->moved > 0) continue;
    for (std::size_t k = 0; k < before.size(); ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        HALFSPACE_FUZZ_EXPECT(is_same(before[k][axis], after[k][axis]), ending);
      }
    }
  }
}

}  // namespace
}  // namespace halfspace

/// The first byte names the format. A mesh that is read has valid indices, its
/// scene is valid, and what is written of it reads back the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  if (size == 0) return 0;
  const char name = static_cast<char>(data[0]);
  const io::Format format = name == 'o'   ? io::Format::kObj
                            : name == 's' ? io::Format::kStl
                            : name == 'p' ? io::Format::kPly
                            : name == '3' ? io::Format::k3mf
                            : name == 'g' ? io::Format::kGlb
                            : name == 'j' ? io::Format::kGltf
                                          : io::Format::kOff;
  const auto mesh = io::read_mesh(fuzz::text_of(data + 1, size - 1), format);
  if (!mesh) {
    HALFSPACE_FUZZ_EXPECT(!mesh.error().message.empty());
    return 0;
  }
  for (const VertexId v : mesh->corners) {
    HALFSPACE_FUZZ_EXPECT(v >= 0 &&
                          static_cast<std::size_t>(v) < mesh->vertices.size());
  }
  for (const bool gouraud : {false, true}) {
    const auto imported = io::import_scene(*mesh, {std::nullopt, 0, gouraud});
    if (!imported) {
      HALFSPACE_FUZZ_EXPECT(!imported.error().message.empty());
      return 0;
    }
    const auto scene = make_scene(imported->scene.data());
    HALFSPACE_FUZZ_EXPECT(scene.has_value() && *scene == imported->scene);
    HALFSPACE_FUZZ_EXPECT(imported->report.polygons == mesh->face_count());
    for (const char* ending : {".obj", ".off", ".ply"})
      expect_round_trip(imported->scene, ending);
  }
  return 0;
}
