#include "files/exact_file.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/csg/part_names.hpp"
#include "halfspace/io/format.hpp"
#include "halfspace/io/load_scene.hpp"

namespace halfspace::detail {
namespace {

/// The operands as a file names them: files without their folders, as the
/// program does, others with a hash of what they are, so that parts of one name
/// and place are one solid.
std::vector<csg::OperandPart> parts_of(const Evaluation& evaluation) {
  std::vector<csg::OperandPart> parts;
  std::map<std::string, std::string> paths;  // of the first file of a name
  for (const Evaluation::Use& use : evaluation.uses) {
    const detail::LeafData& data = *use.node->leaf->data();
    const csg::Source& source = *data.source;
    std::string name = SolidNode::solid_of(use.node).name();
    std::int32_t alone = -1;
    if (name == source.path &&
        (io::is_scene_name(name) || io::format_of(name).has_value())) {
      name = std::filesystem::path(name).filename().string();
      const bool is_other =
          paths.try_emplace(name, source.path).first->second != source.path;
      if (is_other || source.attributed)
        alone = static_cast<std::int32_t>(parts.size());
    } else if (name == source.path && !data.part.empty()) {
      name = data.part;
    } else if (!source.exact) {
      name = csg::scene_name(name, source.scene);
    }
    parts.push_back({std::move(name), source.exact.get(), use.matrix, alone});
  }
  for (const Evaluation::Cut& cut : evaluation.cuts)
    parts.push_back(csg::half_part(cut.said));
  return parts;
}

}  // namespace

csg::FileSolid for_file(const Evaluation& evaluation, fast::Solid solid) {
  return csg::for_file(std::move(solid), parts_of(evaluation));
}

}  // namespace halfspace::detail
