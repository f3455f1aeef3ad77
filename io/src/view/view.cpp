#include "halfspace/io/view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>

#include "view/vectors.hpp"

namespace halfspace::io {
namespace {

using glm::dvec3;

constexpr double kLatticePerGrid = 1 << kLatticeBits;

/// What the lattice holds is a little more than we use: this much less leaves
/// room for rounding.
constexpr double kUsedRange = 1 - 0x1p-10;

/// Lattice steps in a model unit.
double lattice_per_model_unit(const Unit& unit) {
  if (unit.base == 2) return std::ldexp(kLatticePerGrid, -unit.exponent);
  double power = 1;
  for (int i = 0; i < std::abs(unit.exponent); ++i) power *= 10;
  // A division where powers of ten are exact rounds once, not twice.
  return unit.exponent <= 0 ? kLatticePerGrid * power : kLatticePerGrid / power;
}

/// How far the lattice reaches along each axis. Units: lattice steps.
double lattice_limit(const Scene& scene) {
  return std::ldexp(1, scene.grid_bits() - 1 + kLatticeBits + kCameraRangeBits);
}

bool is_finite(const dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The axes of a view, of length 1.
struct Axes {
  dvec3 forward;
  dvec3 right;
  dvec3 down;
};

Result<Axes> axes_of(const ViewOptions& options) {
  Axes axes;
  // Halves, for the difference of two doubles may be none.
  axes.forward = unit_vector(options.target / 2.0 - options.eye / 2.0);
  if (greatest(axes.forward) == 0) {
    return Error{ErrorCode::kBadCamera, "the eye is at its target"};
  }
  if (greatest(options.up) == 0) {
    return Error{ErrorCode::kBadCamera,
                 "the camera's up is zero, which points nowhere"};
  }
  axes.right = glm::cross(axes.forward, unit_vector(options.up));
  constexpr double kLeast = 1e-9;  // far more than rounding leaves
  if (!(greatest(axes.right) > kLeast)) {
    return Error{ErrorCode::kBadCamera,
                 "the camera's up is along its direction of view"};
  }
  axes.right = glm::normalize(axes.right);
  axes.down = glm::cross(axes.forward, axes.right);
  return axes;
}

std::optional<Error> options_error(const ViewOptions& options) {
  const double scalars[] = {options.fov_deg, options.ortho_height,
                            options.near.value_or(0)};
  if (!is_finite(options.eye) || !is_finite(options.target) ||
      !is_finite(options.up) ||
      !std::all_of(std::begin(scalars), std::end(scalars),
                   [](double value) { return std::isfinite(value); })) {
    return Error{ErrorCode::kNotFinite, "a number of the view is not finite"};
  }
  for (const std::int32_t size : {options.width_px, options.height_px}) {
    if (size >= 1 && size <= kMaxImageSize) continue;
    return Error{ErrorCode::kOutOfRange,
                 "an image has 1 to 65536 columns and rows, not " +
                     std::to_string(size)};
  }
  if (!options.orthographic &&
      !(options.fov_deg > 0 && options.fov_deg < 180)) {
    return Error{ErrorCode::kBadCamera,
                 "a field of view is between 0 and 180 degrees, not " +
                     std::to_string(options.fov_deg)};
  }
  if (options.orthographic && !(options.ortho_height > 0)) {
    return Error{ErrorCode::kBadCamera,
                 "the height of an orthographic view is above 0, not " +
                     std::to_string(options.ortho_height)};
  }
  if (!options.orthographic && options.near.value_or(0) < 0) {
    return Error{ErrorCode::kOutOfRange, "the near distance is negative"};
  }
  return std::nullopt;
}

Int128 rounded(double value) { return static_cast<Int128>(std::round(value)); }

/// Makes one camera. Units: lattice steps, in doubles until they are rounded.
class CameraMaker {
 public:
  CameraMaker(const Scene& scene, const ViewOptions& options, const Axes& axes)
      : options_(options),
        axes_(axes),
        scale_(lattice_per_model_unit(scene.unit())),
        limit_(lattice_limit(scene)),
        grid_bits_(scene.grid_bits()),
        eye_(options.eye * scale_) {}

  Result<Viewed> make();

 private:
  Result<Viewed> make_perspective();
  Result<Viewed> make_orthographic();
  Result<Viewed> finish();
  LatticeVector round(const dvec3& v);
  dvec3 corner(double x, double y) const;
  double farthest_plane() const;
  double note_corners() const;
  std::optional<double> length_for_near(double near, double longest);

  const ViewOptions& options_;
  const Axes& axes_;
  double scale_;
  double limit_;
  int grid_bits_;
  dvec3 eye_;
  dvec3 middle_{};    // of the image
  double pixel_ = 0;  // length of sx and sy
  double eye_move_ = 0;
  CameraData data_;
};

/// The greatest distance of the image plane at which the image's corners are
/// still on the lattice.
double CameraMaker::farthest_plane() const {
  const double half_height = std::tan(glm::radians(options_.fov_deg) / 2);
  const double half_width =
      half_height * options_.width_px / options_.height_px;
  double distance = std::numeric_limits<double>::infinity();
  for (const double x : {-half_width, half_width}) {
    for (const double y : {-half_height, half_height}) {
      const dvec3 direction = axes_.forward + x * axes_.right + y * axes_.down;
      for (int axis = 0; axis < 3; ++axis) {
        const double room = kUsedRange * limit_ - std::abs(eye_[axis]);
        distance = std::min(distance, room / std::abs(direction[axis]));
      }
    }
  }
  return distance;
}

/// The point of the image (x, y), before rounding.
dvec3 CameraMaker::corner(double x, double y) const {
  return middle_ + pixel_ * ((x - options_.width_px / 2.0) * axes_.right +
                             (y - options_.height_px / 2.0) * axes_.down);
}

/// How far rounding moved the farthest corner of the image, in one axis.
double CameraMaker::note_corners() const {
  double most = 0;
  for (const std::int32_t x : {0, options_.width_px}) {
    for (const std::int32_t y : {0, options_.height_px}) {
      const dvec3 wanted = corner(x, y);
      const Int128 got[] = {data_.s0.x + x * data_.sx.x + y * data_.sy.x,
                            data_.s0.y + x * data_.sx.y + y * data_.sy.y,
                            data_.s0.z + x * data_.sx.z + y * data_.sy.z};
      for (int axis = 0; axis < 3; ++axis) {
        // The difference of integers, and then of what doubles dropped.
        const Int128 whole = rounded(wanted[axis]);
        const double rest = wanted[axis] - std::round(wanted[axis]);
        most = std::max(
            most, std::abs(static_cast<double>(got[axis] - whole) - rest));
      }
    }
  }
  return most;
}

LatticeVector CameraMaker::round(const dvec3& v) {
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

Result<Viewed> CameraMaker::finish() {
  // Far beyond the lattice, and still an integer of 128 bits when rounded.
  constexpr double kTooFar = 0x1p100;
  const dvec3 first = corner(0, 0);
  const dvec3 last = corner(options_.width_px, options_.height_px);
  if (!(greatest(first) < kTooFar && greatest(last) < kTooFar)) {
    return Error{ErrorCode::kOutOfRange,
                 "the image is larger than cameras of this scene reach"};
  }
  data_.width_px = options_.width_px;
  data_.height_px = options_.height_px;
  data_.sx = round(pixel_ * axes_.right);
  data_.sy = round(pixel_ * axes_.down);
  data_.s0 = round(first);
  Result<Camera> camera = make_camera(data_, grid_bits_);
  if (!camera && pixel_ < 2) {
    return Error{ErrorCode::kBadCamera,
                 "a pixel is less than a step of the camera's lattice: the "
                 "view is too narrow for this number of rows"};
  }
  if (!camera) return camera.error();
  const double most = std::max(note_corners(), eye_move_);
  return Viewed{*camera, most / kLatticePerGrid, options_};
}

/// The length, at most `longest`, of which `near` is 2^(16 - j) / 2^16 for an
/// integer j; sets the camera's near distance to that.
std::optional<double> CameraMaker::length_for_near(double near,
                                                   double longest) {
  const double size = std::abs(near);
  const double j = std::clamp(std::floor(std::log2(longest / size)),
                              -double{kNearBits}, double{kNearBits});
  const double length = std::ldexp(size, static_cast<int>(j));
  if (!(length <= longest)) return std::nullopt;
  const std::int64_t k = std::int64_t{1} << (kNearBits - static_cast<int>(j));
  data_.near = near < 0 ? -k : k;
  return length;
}

Result<Viewed> CameraMaker::make_perspective() {
  const dvec3 wanted = eye_;
  // The rest starts from where the eye has come to be, so that the directions
  // of the rays are as good as the image plane's distance makes them.
  eye_ = glm::round(eye_);
  eye_move_ = greatest(wanted - eye_);
  std::optional<double> distance = farthest_plane();
  const double near = options_.near.value_or(0) * scale_;
  if (options_.near) data_.near = 0;
  if (near > 0) distance = length_for_near(near, *distance);
  if (!distance) {
    return Error{ErrorCode::kOutOfRange, "the near distance is too far"};
  }
  data_.perspective = true;
  data_.eye = round(eye_);
  middle_ = eye_ + *distance * axes_.forward;
  pixel_ = 2 * *distance * std::tan(glm::radians(options_.fov_deg) / 2) /
           options_.height_px;
  return finish();
}

Result<Viewed> CameraMaker::make_orthographic() {
  data_.perspective = false;
  // As long as the lattice allows: it is a direction, so this costs nothing.
  std::optional<double> length = kUsedRange * limit_ / greatest(axes_.forward);
  const double near = options_.near.value_or(0) * scale_;
  if (options_.near) data_.near = 0;
  if (near != 0) length = length_for_near(near, *length);
  if (!length) {
    return Error{ErrorCode::kOutOfRange, "the near distance is too far"};
  }
  data_.eye = round(-*length * axes_.forward);
  middle_ = eye_;
  pixel_ = options_.ortho_height * scale_ / options_.height_px;
  return finish();
}

Result<Viewed> CameraMaker::make() {
  if (options_.orthographic) return make_orthographic();
  return make_perspective();
}

/// What is wrong with the place of the eye.
std::optional<Error> eye_error(const Scene& scene, const dvec3& eye) {
  const double scale = lattice_per_model_unit(scene.unit());
  const double limit = lattice_limit(scene);
  if (std::isfinite(scale) && greatest(eye) * scale < kUsedRange * limit) {
    return std::nullopt;
  }
  char reach[32];
  std::snprintf(reach, sizeof reach, "%g", limit / scale);
  return Error{ErrorCode::kOutOfRange,
               "the eye is farther away than cameras of this scene reach, " +
                   std::string(reach) + " model units"};
}

}  // namespace

Result<Viewed> look_at(const Scene& scene, const ViewOptions& options) {
  if (auto error = options_error(options)) return *error;
  if (auto error = eye_error(scene, options.eye)) return *error;
  const Result<Axes> axes = axes_of(options);
  if (!axes) return axes.error();
  return CameraMaker(scene, options, *axes).make();
}

}  // namespace halfspace::io
