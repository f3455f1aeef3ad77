#include "halfspace/csg/carry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "exact/weights.hpp"

namespace halfspace::csg {
namespace {

DoublePoint cross_of(const DoublePoint& a, const DoublePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

std::size_t longest_axis_of(const DoublePoint& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  }
  return axis;
}

/// Twice the area that points go round, as a vector along their normal.
DoublePoint area_vector(std::span<const DoublePoint> points) {
  DoublePoint sum{};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    DoublePoint a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = points[i][k] - points[0][k];
      b[k] = points[i + 1][k] - points[0][k];
    }
    const DoublePoint part = cross_of(a, b);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

/// 1 where a polygon with this area faces as the face does, -1 where it faces
/// the other way; nothing where it is in quite another plane, as is what fills
/// a hole beside the face.
double outwards_of(const DoublePoint& normal, const DoublePoint& area) {
  double cosine = 0;
  for (std::size_t k = 0; k < 3; ++k) cosine += normal[k] * area[k];
  const double most = std::hypot(normal[0], normal[1], normal[2]) *
                      std::hypot(area[0], area[1], area[2]);
  // Rounding turns a polygon by as little as this only where it has no width.
  if (std::abs(cosine) < most / 2) return io::kNoValue;
  return cosine < 0 ? -1 : 1;
}

/// A leaf's file, moved to where the leaf is.
class PlacedFaces {
 public:
  PlacedFaces(const io::AttributedFaces& faces, const Matrix& matrix)
      : faces_(faces),
        matrix_(matrix),
        is_moved_(matrix != identity_matrix()),
        turns_(determinant_sign(matrix)) {
    if (is_moved_) {
      images_.resize(faces.vertices.size());
      is_known_.resize(faces.vertices.size());
    }
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column)
        linear_[row][column] = io::to_double(matrix.rows[row][column]);
    }
  }

  const io::AttributedFaces& faces() const { return faces_; }
  bool is_moved() const { return is_moved_; }
  /// -1 where the map mirrors.
  int turns() const { return turns_; }

  DoublePoint point(std::size_t corner) {
    const auto vertex = static_cast<std::size_t>(faces_.corners[corner]);
    if (!is_moved_) return faces_.vertices[vertex];
    if (!is_known_[vertex]) {
      const DoublePoint& p = faces_.vertices[vertex];
      const Numbers3 at = image_of(
          matrix_,
          {io::number_of(p[0]), io::number_of(p[1]), io::number_of(p[2])});
      images_[vertex] = {io::to_double(at[0]), io::to_double(at[1]),
                         io::to_double(at[2])};
      is_known_[vertex] = true;
    }
    return images_[vertex];
  }

  /// A normal, turned as the map turns planes; of the length that it had.
  DoublePoint turned(const DoublePoint& normal) const {
    // The cofactors of the map, a vector product of its rows each.
    DoublePoint result{};
    for (std::size_t row = 0; row < 3; ++row) {
      const DoublePoint cofactors =
          cross_of(linear_[(row + 1) % 3], linear_[(row + 2) % 3]);
      for (std::size_t k = 0; k < 3; ++k)
        result[row] += cofactors[k] * normal[k];
    }
    const double before = std::hypot(normal[0], normal[1], normal[2]);
    const double after = std::hypot(result[0], result[1], result[2]);
    if (!(after > 0)) return result;
    for (double& value : result) value *= turns_ * before / after;
    return result;
  }

 private:
  const io::AttributedFaces& faces_;
  const Matrix& matrix_;
  bool is_moved_;
  int turns_;
  std::array<DoublePoint, 3> linear_{};
  std::vector<DoublePoint> images_;  // by vertex
  std::vector<bool> is_known_;
};

/// Where a corner of the result is in a face: at a corner of it, or in a
/// triangle of three.
struct Spot {
  std::size_t corner = 0;
  std::optional<Weights> weights;
  std::array<std::size_t, 3> corners{};
};

/// One channel of the result, and by leaf the operand's that it is made of.
struct CarriedChannel {
  io::Channel channel;
  std::vector<const io::Channel*> sources;
};

class AttributeCarrier {
 public:
  AttributeCarrier(const AttributedLeaves& from, const Outcome& result,
                   const EvaluateOptions& options);
  std::shared_ptr<const io::Attributes> carried();

 private:
  void collect_channels();
  void add_channels(std::size_t leaf,
                    const std::vector<io::Channel> io::Attributes::*which,
                    std::vector<CarriedChannel>& all);
  std::int32_t material_of(std::size_t leaf, std::int32_t material);
  std::int32_t added(const io::Material& material);
  std::int32_t name_of(const io::Labels& labels, std::size_t face,
                       io::Labels& all,
                       std::map<std::string, std::int32_t>& places);
  void add_polygon(std::size_t polygon);
  void add_corners(std::size_t leaf, std::size_t face,
                   std::span<const DoublePoint> points);
  Spot spot_of(PlacedFaces& placed, std::size_t face, const DoublePoint& at,
               std::size_t axis);
  std::optional<std::size_t> corner_near(PlacedFaces& placed, std::size_t leaf,
                                         std::size_t face,
                                         const DoublePoint& at);
  void append(const CarriedChannel& carried, std::size_t leaf,
              PlacedFaces& placed, const Spot& spot, double outwards,
              io::Channel& to);
  /// The colour of a polygon whose file says nothing else of it: that of a
  /// scene, or of an exact solid.
  std::optional<Rgb> bare_color(std::size_t polygon) const;
  bool has_bare_colors() const;
  void add_origins();

  const AttributedLeaves& from_;
  const Outcome& result_;
  bool keep_origin_;
  bool is_merged_;  // polygons of several faces may be one
  double tolerance_ = 0;
  std::vector<DoublePoint> vertices_;
  std::span<const std::uint32_t> first_corner_;
  std::span<const VertexId> corners_;
  std::vector<std::optional<PlacedFaces>> leaves_;
  std::vector<CarriedChannel> corner_channels_;
  std::vector<CarriedChannel> face_channels_;
  // By leaf its materials' places in the result, -1 where not yet known.
  std::vector<std::vector<std::int32_t>> materials_of_leaf_;
  std::map<std::string, std::int32_t> materials_;
  std::map<std::string, std::int32_t> objects_;
  std::map<std::string, std::int32_t> groups_;
  // Of faces of many corners, by leaf and face, those by their first
  // coordinate.
  std::map<std::pair<std::size_t, std::size_t>,
           std::vector<std::pair<double, std::size_t>>>
      sorted_;
  std::shared_ptr<io::Attributes> made_ = std::make_shared<io::Attributes>();
};

AttributeCarrier::AttributeCarrier(const AttributedLeaves& from,
                                   const Outcome& result,
                                   const EvaluateOptions& options)
    : from_(from),
      result_(result),
      keep_origin_(options.keep_origin),
      is_merged_(options.merge == MergeRule::kColor ||
                 options.merge == MergeRule::kPlane) {
  leaves_.resize(from.leaves.size());
  materials_of_leaf_.resize(from.leaves.size());
  for (std::size_t i = 0; i < from.leaves.size(); ++i) {
    const AttributedLeaf& leaf = from.leaves[i];
    if (leaf.faces != nullptr) leaves_[i].emplace(*leaf.faces, leaf.matrix);
  }
}

/// Adds what a leaf has to the channels of the result.
void AttributeCarrier::add_channels(
    std::size_t leaf, const std::vector<io::Channel> io::Attributes::*which,
    std::vector<CarriedChannel>& all) {
  for (const io::Channel& source : leaves_[leaf]->faces().attributes.*which) {
    const auto is_same = [&](const CarriedChannel& other) {
      return other.channel.kind == source.kind &&
             other.channel.name == source.name &&
             (other.channel.width == source.width ||
              source.kind == io::ChannelKind::kColor);
    };
    auto found = std::find_if(all.begin(), all.end(), is_same);
    if (found == all.end()) {
      all.push_back(
          {{source.name, source.kind, source.width, {}, source.is_integer},
           std::vector<const io::Channel*>(leaves_.size())});
      found = all.end() - 1;
    }
    found->channel.width = std::max(found->channel.width, source.width);
    found->channel.is_integer = found->channel.is_integer && source.is_integer;
    found->sources[leaf] = &source;
  }
}

void AttributeCarrier::collect_channels() {
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    if (!leaves_[leaf]) continue;
    add_channels(leaf, &io::Attributes::faces, face_channels_);
    if (!is_merged_)
      add_channels(leaf, &io::Attributes::corners, corner_channels_);
  }
  const bool has_colors = std::any_of(
      face_channels_.begin(), face_channels_.end(), [](const auto& carried) {
        return carried.channel.kind == io::ChannelKind::kColor;
      });
  if (has_colors || !has_bare_colors()) return;
  face_channels_.push_back({{"color", io::ChannelKind::kColor, 3, {}, false},
                            std::vector<const io::Channel*>(leaves_.size())});
}

std::optional<Rgb> AttributeCarrier::bare_color(std::size_t polygon) const {
  if (result_.color_sources.empty() ||
      result_.color_sources[polygon] == ColorSource::kNone)
    return std::nullopt;
  const auto leaf = static_cast<std::size_t>(result_.origins[polygon].leaf);
  if (leaf >= leaves_.size() || leaves_[leaf]) return std::nullopt;
  return result_.scene ? result_.scene->color(static_cast<PolygonId>(polygon))
                       : result_.mesh.colors[polygon];
}

bool AttributeCarrier::has_bare_colors() const {
  for (std::size_t p = 0; p < result_.color_sources.size(); ++p) {
    if (bare_color(p)) return true;
  }
  return false;
}

/// The result's material that is a leaf's. Materials of one name that are not
/// the same are two.
std::int32_t AttributeCarrier::material_of(std::size_t leaf,
                                           std::int32_t material) {
  if (material < 0) return -1;
  const auto place = static_cast<std::size_t>(material);
  const std::vector<io::Material>& all =
      leaves_[leaf]->faces().attributes.materials;
  std::vector<std::int32_t>& known = materials_of_leaf_[leaf];
  known.resize(all.size(), -1);
  if (known[place] < 0) known[place] = added(all[place]);
  return known[place];
}

/// The place of the material in the result, which has it from here on.
std::int32_t AttributeCarrier::added(const io::Material& material) {
  // What is not in the key is looked at where keys are equal.
  const Rgb color = material.color.value_or(Rgb{});
  std::string key = material.name + '\n' + material.texture + '\n' +
                    std::to_string(color.r) + ' ' + std::to_string(color.g) +
                    ' ' + std::to_string(color.b) + ' ' +
                    std::to_string(material.opacity);
  const auto next = static_cast<std::int32_t>(made_->materials.size());
  while (true) {
    const auto [at, is_new] = materials_.try_emplace(key, next);
    if (is_new) made_->materials.push_back(material);
    if (is_new ||
        made_->materials[static_cast<std::size_t>(at->second)] == material)
      return at->second;
    key += '\n';
  }
}

std::int32_t AttributeCarrier::name_of(
    const io::Labels& labels, std::size_t face, io::Labels& all,
    std::map<std::string, std::int32_t>& places) {
  const std::int32_t at = labels.of_face.empty() ? -1 : labels.of_face[face];
  if (at < 0) return -1;
  const std::string& name = labels.names[static_cast<std::size_t>(at)];
  const auto next = static_cast<std::int32_t>(all.names.size());
  const auto [place, is_new] = places.try_emplace(name, next);
  if (is_new) all.names.push_back(name);
  return place->second;
}

/// The corner of the face that is where the point is, but for rounding.
std::optional<std::size_t> AttributeCarrier::corner_near(
    PlacedFaces& placed, std::size_t leaf, std::size_t face,
    const DoublePoint& at) {
  constexpr std::size_t kMany = 16;
  const std::size_t first = placed.faces().first_corner[face];
  const std::size_t end = placed.faces().first_corner[face + 1];
  std::optional<std::size_t> nearest;
  double least = tolerance_;
  const auto look_at = [&](std::size_t corner) {
    const DoublePoint p = placed.point(corner);
    double distance = 0;
    for (std::size_t k = 0; k < 3; ++k)
      distance = std::max(distance, std::abs(p[k] - at[k]));
    if (!(distance <= least) || (nearest && distance == least)) return;
    nearest = corner;
    least = distance;
  };
  if (end - first <= kMany) {
    for (std::size_t corner = first; corner < end; ++corner) look_at(corner);
    return nearest;
  }
  auto& sorted = sorted_[{leaf, face}];
  if (sorted.empty()) {
    for (std::size_t corner = first; corner < end; ++corner)
      sorted.emplace_back(placed.point(corner)[0], corner);
    std::sort(sorted.begin(), sorted.end());
  }
  for (auto i = std::lower_bound(sorted.begin(), sorted.end(),
                                 std::pair(at[0] - tolerance_, std::size_t{0}));
       i != sorted.end() && i->first <= at[0] + tolerance_; ++i)
    look_at(i->second);
  return nearest;
}

/// In which triangle of the face's fan the point is.
Spot AttributeCarrier::spot_of(PlacedFaces& placed, std::size_t face,
                               const DoublePoint& at, std::size_t axis) {
  const std::size_t first = placed.faces().first_corner[face];
  const std::size_t end = placed.faces().first_corner[face + 1];
  Spot spot;
  spot.corner = first;
  for (std::size_t i = first + 1; i + 1 < end; ++i) {
    Weights weights = weights_of(
        {placed.point(first), placed.point(i), placed.point(i + 1)}, at, axis);
    if (weights.below == 0) continue;
    const bool holds =
        std::all_of(weights.weight.begin(), weights.weight.end(),
                    [](const Integer& weight) { return weight >= 0; });
    if (!holds && spot.weights) continue;
    spot.weights = std::move(weights);
    spot.corners = {first, i, i + 1};
    if (holds) break;
  }
  return spot;
}

void AttributeCarrier::append(const CarriedChannel& carried, std::size_t leaf,
                              PlacedFaces& placed, const Spot& spot,
                              double outwards, io::Channel& to) {
  const io::Channel* from = carried.sources[leaf];
  const std::size_t begin = to.values.size();
  for (std::size_t i = 0; i < to.width; ++i) {
    if (from == nullptr) {
      to.values.push_back(io::kNoValue);
    } else if (i >= from->width) {
      to.values.push_back(1);  // of a colour without opacity
    } else if (!spot.weights) {
      to.values.push_back(from->at(spot.corner)[i]);
    } else {
      std::array<double, 3> values;
      for (std::size_t k = 0; k < 3; ++k)
        values[k] = from->at(spot.corners[k])[i];
      to.values.push_back(mean_of(*spot.weights, values));
    }
  }
  if (to.kind != io::ChannelKind::kNormal || to.width != 3) return;
  DoublePoint normal = {to.values[begin], to.values[begin + 1],
                        to.values[begin + 2]};
  if (placed.is_moved()) normal = placed.turned(normal);
  for (std::size_t i = 0; i < 3; ++i)
    to.values[begin + i] = outwards * normal[i] + 0.0;
}

void AttributeCarrier::add_corners(std::size_t leaf, std::size_t face,
                                   std::span<const DoublePoint> points) {
  PlacedFaces& placed = *leaves_[leaf];
  std::vector<DoublePoint> own;
  for (std::size_t corner = placed.faces().first_corner[face];
       corner < placed.faces().first_corner[face + 1]; ++corner)
    own.push_back(placed.point(corner));
  const DoublePoint normal = area_vector(own);
  const std::size_t axis = longest_axis_of(normal);
  const double outwards = outwards_of(normal, area_vector(points));
  for (const DoublePoint& at : points) {
    Spot spot;
    if (const auto corner = corner_near(placed, leaf, face, at)) {
      spot.corner = *corner;
    } else {
      spot = spot_of(placed, face, at, axis);
    }
    for (CarriedChannel& carried : corner_channels_) {
      append(carried, leaf, placed, spot, outwards * placed.turns(),
             carried.channel);
      if (spot.weights) carried.channel.is_integer = false;
    }
  }
}

void AttributeCarrier::add_polygon(std::size_t polygon) {
  const Origin& origin = result_.origins[polygon];
  const auto leaf = static_cast<std::size_t>(origin.leaf);
  const auto face = static_cast<std::size_t>(origin.polygon);
  const bool is_known = leaf < leaves_.size() && leaves_[leaf] &&
                        origin.polygon >= 0 &&
                        face + 1 < leaves_[leaf]->faces().first_corner.size();
  const std::size_t first = first_corner_[polygon];
  const std::size_t end = first_corner_[polygon + 1];
  const io::Attributes none;
  const io::Attributes& from =
      is_known ? leaves_[leaf]->faces().attributes : none;
  made_->face_materials.push_back(material_of(
      leaf, from.face_materials.empty() ? -1 : from.face_materials[face]));
  made_->objects.of_face.push_back(
      name_of(from.objects, face, made_->objects, objects_));
  made_->groups.of_face.push_back(
      name_of(from.groups, face, made_->groups, groups_));
  for (CarriedChannel& carried : face_channels_) {
    const io::Channel* source = is_known ? carried.sources[leaf] : nullptr;
    if (const auto color = carried.channel.kind == io::ChannelKind::kColor
                               ? bare_color(polygon)
                               : std::nullopt) {
      const double shares[] = {color->r / 255.0, color->g / 255.0,
                               color->b / 255.0, 1};
      carried.channel.values.insert(carried.channel.values.end(), shares,
                                    shares + carried.channel.width);
      continue;
    }
    for (std::size_t i = 0; i < carried.channel.width; ++i) {
      carried.channel.values.push_back(source == nullptr || i >= source->width
                                           ? io::kNoValue
                                           : source->at(face)[i]);
    }
  }
  if (corner_channels_.empty()) return;
  if (is_known) {
    std::vector<DoublePoint> points;
    for (std::size_t i = first; i < end; ++i)
      points.push_back(vertices_[static_cast<std::size_t>(corners_[i])]);
    return add_corners(leaf, face, points);
  }
  for (CarriedChannel& carried : corner_channels_) {
    carried.channel.values.insert(carried.channel.values.end(),
                                  (end - first) * carried.channel.width,
                                  io::kNoValue);
  }
}

void AttributeCarrier::add_origins() {
  io::Channel solid{"origin_solid", io::ChannelKind::kNumber, 1, {}, true};
  io::Channel polygon{"origin_polygon", io::ChannelKind::kNumber, 1, {}, true};
  for (const Origin& origin : result_.origins) {
    solid.values.push_back(origin.leaf);
    polygon.values.push_back(origin.polygon);
  }
  for (const AttributedLeaf& leaf : from_.leaves)
    made_->origins.push_back(leaf.name);
  made_->origins.resize(from_.leaves.size() + from_.planes, "half");
  // Those of an operand are of what it was made of: the new ones are these.
  std::erase_if(made_->faces, [](const io::Channel& other) {
    return other.name == "origin_solid" || other.name == "origin_polygon";
  });
  made_->faces.push_back(std::move(solid));
  made_->faces.push_back(std::move(polygon));
}

std::shared_ptr<const io::Attributes> AttributeCarrier::carried() {
  const bool any =
      std::any_of(leaves_.begin(), leaves_.end(),
                  [](const auto& leaf) { return leaf.has_value(); });
  if (result_.data || result_.origins.empty()) return nullptr;
  if (!any && !keep_origin_ && !has_bare_colors()) return nullptr;
  if (result_.scene) {
    const SceneData& data = result_.scene->data();
    const Unit unit = data.unit;
    const auto number = [unit](std::int64_t steps) {
      return io::to_double(io::normalised(steps, unit.exponent,
                                          unit.base == 10 ? unit.exponent : 0));
    };
    for (const GridPoint& p : data.vertices)
      vertices_.push_back({number(p.x), number(p.y), number(p.z)});
    first_corner_ = data.first_corner;
    corners_ = data.corners;
  } else {
    vertices_ = result_.mesh.vertices;
    first_corner_ = result_.mesh.first_corner;
    corners_ = result_.mesh.corners;
  }
  if (first_corner_.size() != result_.origins.size() + 1) return nullptr;
  // Doubles of the file's decimals, moved, and doubles of the result are a few
  // times 2^-53 of the greatest coordinate apart.
  double greatest = 0;
  for (const DoublePoint& p : vertices_) {
    for (const double value : p) greatest = std::max(greatest, std::abs(value));
  }
  tolerance_ = from_.max_move + result_.max_move + 0x1p-50 * greatest;
  collect_channels();
  for (std::size_t polygon = 0; polygon < result_.origins.size(); ++polygon)
    add_polygon(polygon);
  const auto drop_if_none = [](std::vector<std::int32_t>& of_face) {
    if (std::all_of(of_face.begin(), of_face.end(),
                    [](std::int32_t at) { return at < 0; }))
      of_face.clear();
  };
  drop_if_none(made_->face_materials);
  drop_if_none(made_->objects.of_face);
  drop_if_none(made_->groups.of_face);
  for (CarriedChannel& carried : face_channels_)
    made_->faces.push_back(std::move(carried.channel));
  for (CarriedChannel& carried : corner_channels_)
    made_->corners.push_back(std::move(carried.channel));
  if (keep_origin_) add_origins();
  return made_->empty() ? nullptr : made_;
}

}  // namespace

AttributedLeaves attributed_leaves(const Plan& plan, const Operands& operands) {
  AttributedLeaves all;
  for (std::size_t i = 0; i < plan.leaves.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    all.leaves.push_back(
        {operands.attributed(id),
         plan.matrices[static_cast<std::size_t>(plan.leaves[i].matrix)],
         operands.name_in_files(id)});
  }
  all.planes = plan.planes.size();
  all.max_move = operands.report().max_move;
  return all;
}

std::shared_ptr<const io::Attributes> carried_attributes(
    const AttributedLeaves& from, const Outcome& result,
    const EvaluateOptions& options) {
  return AttributeCarrier(from, result, options).carried();
}

}  // namespace halfspace::csg
