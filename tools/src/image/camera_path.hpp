#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "image/clipping.hpp"
#include "image/object_file.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {

/// What is said of where an object stands: word by word.
using StandWords = std::map<std::string, std::string>;

/// What is said of the camera, and of objects, in one frame of a film.
struct KeyFrame {
  std::int64_t frame = 0;
  ViewArguments view;
  std::map<std::string, StandWords> objects = {};
  /// Instead of what `view` describes.
  std::optional<ChosenCamera> camera = std::nullopt;
  std::vector<ClipNumbers> planes = {};  ///< none: those of the options
  std::optional<double> yon = std::nullopt;
};

/// The way of a camera: its frames are those from the first key frame to the
/// last one.
class CameraPath {
 public:
  /// Requires: not empty; frames ascend; what one says, all after it say, of
  ///           planes as many.
  explicit CameraPath(std::vector<KeyFrame> keys);

  std::int64_t first_frame() const { return keys_.front().frame; }
  std::int64_t last_frame() const { return keys_.back().frame; }

  /// The camera of a frame: what two key frames say, in between in proportion
  /// to the frames; what a key frame says, exactly.
  /// Requires: first_frame() <= frame <= last_frame().
  ViewArguments at(std::int64_t frame) const;
  /// The camera of a frame that has one beside what is described.
  /// Requires: first_frame() <= frame <= last_frame().
  std::optional<ChosenCamera> camera_at(std::int64_t frame) const;

  /// What cuts in a frame, likewise, and else as `start` says.
  ClipArguments clip_at(std::int64_t frame, ClipArguments start) const;

  /// Where an object that stands so at first stands in a frame, likewise.
  Stand stand_at(const std::string& object, std::int64_t frame,
                 Stand start) const;
  /// The objects of which the path speaks.
  std::set<std::string> objects() const;

 private:
  /// The key frames on both sides of a frame, which are one where it is one,
  /// and its share of the way between them.
  struct Place {
    const KeyFrame& before;
    const KeyFrame& after;
    double share;
  };
  Place place_of(std::int64_t frame) const;

  std::vector<KeyFrame> keys_;
};

/// The way once round the scene in so many frames, about the z axis or --up.
///
/// It begins where the eye is, if that is said; else, unless a direction is
/// said, at the file's own camera, which is that of `own_view` if there is one.
/// The first frame is then the still picture of the same arguments. Else all of
/// the scene is in every picture.
/// Errors: those of io::automatic_options(), choose_camera() and
///         io::turned_about().
Result<CameraPath> turntable(const SceneFile& file,
                             const std::optional<io::ViewOptions>& own_view,
                             std::uint32_t frames, const ViewArguments& start);

/// The path that the text describes (docs/guide.md). What its lines do not say
/// is as the line before says, at first as `start` and `clip` do.
///
/// Errors: kSyntax, kOutOfRange with the number of the line; kEmpty.
Result<CameraPath> parse_camera_path(const std::string& text,
                                     const ViewArguments& start,
                                     const ClipArguments& clip);

/// The same from a file. Errors: kUnreadable, too; the file is named.
Result<CameraPath> read_camera_path(const std::string& path,
                                    const ViewArguments& start,
                                    const ClipArguments& clip);

}  // namespace halfspace::tools
