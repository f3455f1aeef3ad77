#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/span.hpp"

/// The words of spec/ as the JSON of spec/vectors/, and back. What is read is
/// ours: where it is not as the schema says, the JSON library throws.
namespace halfspace::vectors {

using Json = nlohmann::json;

Json to_json(const Scene& scene);
Json to_json(const Camera& camera);
Json to_json(const ImageOptions& options);
Json to_json(const BuildOptions& options);
Json to_json(const FragmentName& fragment);
Json to_json(const TreeName& tree);
Json to_json(const std::vector<Span>& spans);
Json to_json(const ItemImage& image);
Json to_json(const ColorImage& image);

Scene scene_of(const Json& json);
Camera camera_of(const Json& json, int grid_bits);
ImageOptions image_options_of(const Json& json);
BuildOptions build_options_of(const Json& json);
std::vector<Span> spans_of(const Json& json);

}  // namespace halfspace::vectors
