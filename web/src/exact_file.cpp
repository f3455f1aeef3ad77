#include "files/exact_file.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/fast/solid_data.hpp"

namespace halfspace::detail {

// In place of the library's: the solid as the boolean left it. Another order of
// faces and names, and it saves the module the canonical form of files, 8 kB
// (decision 0029).
csg::FileSolid for_file(const Evaluation& evaluation, fast::Solid solid) {
  std::vector<std::string> names;
  struct Part {
    const SolidData* data;  // null: a mesh, or a half-space
    std::int32_t first;     // of its names
  };
  std::vector<Part> parts;
  const auto add = [&](const std::shared_ptr<const SolidNode>& node,
                       const SolidData* data) {
    parts.push_back({data, static_cast<std::int32_t>(names.size())});
    if (data == nullptr) {
      names.push_back(SolidNode::solid_of(node).name());
    } else {
      names.insert(names.end(), data->parts.begin(), data->parts.end());
    }
  };
  for (const Evaluation::Use& use : evaluation.uses)
    add(use.node, use.node->leaf->data()->source->exact.get());
  for (const Evaluation::Cut& cut : evaluation.cuts) add(cut.node, nullptr);
  csg::FileSolid file;
  for (fast::Face& face : solid.faces) {
    file.origins.push_back({face.part, face.polygon});
    const Part& part = parts[static_cast<std::size_t>(face.part)];
    face.part = part.first;
    if (part.data == nullptr) continue;
    const SolidData::Origin& origin =
        part.data->origins[static_cast<std::size_t>(face.polygon)];
    face.part += static_cast<std::int32_t>(origin.part);
    face.polygon = static_cast<PolygonId>(origin.polygon);
  }
  file.data = fast::data_of(solid, names);
  return file;
}

}  // namespace halfspace::detail
