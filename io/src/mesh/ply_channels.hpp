#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/io/mesh.hpp"
#include "mesh/ply.hpp"

namespace halfspace::io {

/// The property of a face that is 0 where its colour stands for none.
constexpr const char* kPlyHasColor = "halfspace_has_color";

/// What a line `comment halfspace material ...` says of one: the colour or
/// `none`, the opacity, and the name; and the reverse.
std::string ply_material_comment(std::size_t index, const Material& material);
/// The same of `comment halfspace surface ...`: how metallic and how rough it
/// is, or `none`.
std::string ply_surface_comment(std::size_t index, const Material& material);

/// Collects the numbers of one element, vertices or faces, that are neither
/// coordinates nor colours nor indices.
class PlyChannels {
 public:
  /// Wants each property of the element but those that are read elsewhere, and
  /// lists that are no numbers of corners.
  void begin(const PlyElement& element, const std::vector<bool>& is_read);

  bool wants(int place) const {
    return columns_[static_cast<std::size_t>(place)].is_wanted;
  }
  /// The next number of a property, by its place.
  void add(int place, double value) {
    columns_[static_cast<std::size_t>(place)].values.push_back(value);
  }
  /// A face's numbers are all there: lists must have some for each corner.
  void end_face(const Mesh& mesh);

  /// Makes channels of them, of the corners that vertices are.
  void add_to_corners(Mesh& mesh);
  /// The same of faces and, in lists, corners; names are from the comments.
  void add_to_faces(const std::vector<std::string>& comments, Mesh& mesh);

 private:
  struct Column {
    std::string name;
    bool is_wanted = false;
    bool is_list = false;
    bool is_integer = false;
    std::vector<double> values;
    std::size_t width = 0;  ///< of a list, for each corner
    std::size_t done = 0;   ///< numbers of lists of faces that are finished
  };
  /// The columns of these names, if all are there and are not lists.
  std::vector<Column*> all_of(const std::vector<std::string>& names);
  std::vector<Channel> channels();

  std::vector<Column> columns_;  // by property
};

}  // namespace halfspace::io
