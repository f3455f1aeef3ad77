#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera_seeker.hpp"
#include "core/frame_maker.hpp"
#include "core/loader.hpp"
#include "halfspace/viewer/model.hpp"
#include "halfspace/viewer/run.hpp"
#include "halfspace/viewer/state.hpp"

namespace halfspace::viewer {

/// What is seen at a pixel.
struct PickedPoint {
  PolygonId polygon = 0;
  std::uint32_t part = 0;  ///< kCapPart: a cap
  /// Of a cap, where parts are told apart, the one that it cuts, or whether it
  /// cuts several.
  std::optional<std::size_t> cap_part = std::nullopt;
  bool is_overlap = false;
  std::int32_t face = 0;  ///< of the part's file, counted from 0
  glm::dvec3 point{};     ///< where the ray through the pixel meets it
  glm::dvec3 normal{};    ///< of the polygon, of length 1
  /// The corner of the polygon that is nearest to it in the picture, exactly.
  glm::dvec3 corner{};
  std::array<std::string, 3> exact_corner;
  /// Of the part's face, which polygons may be parts of; none of a cap.
  double face_area = 0;
  std::vector<std::vector<glm::dvec3>> face_polygons;  ///< the first of them
};

/// What is shown, to be saved by any thread.
struct Shown {
  State state;
  PictureRequest picture;              ///< without its lines
  std::optional<ColorImage> finished;  ///< if it is there
};

/// The viewer without its window: a state, its model and its pictures.
///
/// All but the threads inside are for one thread. Nothing here waits, but for
/// finished_picture().
class Session {
 public:
  /// `wake` is called, from any thread, when there is something for update().
  Session(State state, FirstView first_view, std::function<void()> wake);

  /// Takes what threads have made; whether anything has changed.
  bool update();

  const State& state() const { return state_; }
  const std::shared_ptr<const Model>& model() const { return model_; }
  FrameMaker& frames() { return frames_; }
  const FrameMaker& frames() const { return frames_; }
  Progress progress() const { return loader_.progress(); }
  bool is_loading() const { return loader_.is_busy(); }
  void cancel_loading() { loader_.cancel(); }
  /// Whether the picture is that of the state, in full and with its lines.
  bool is_settled() const;

  /// The last error, until it is dismissed; empty if there is none.
  const std::string& message() const { return message_; }
  void say(std::string message);
  /// Whether it says why files are not shown.
  bool is_about_files() const { return is_about_files_; }

  /// Changes the picture's size. Requires: 1 to 65,536.
  void set_size(std::int32_t width_px, std::int32_t height_px);
  /// Moves the camera, where there is one of that kind; whether there is.
  bool set_camera(const io::ViewOptions& camera);
  const std::optional<io::ViewOptions>& camera() const { return state_.camera; }
  /// Begins to look for the camera that sees all of it from where the camera is
  /// or from a side, or for the one that saw it first.
  void seek_fit();
  void seek_side(const io::ViewDirection& direction);
  void seek_first();
  /// Leaves the camera as it is, if there is one.
  void stop_seeking();
  bool is_seeking() const { return seeker_.is_busy() || found_; }
  /// The camera that was found, once.
  std::optional<io::ViewOptions> take_found();

  /// Changes parts or looks, which undo() takes back; the model follows.
  /// Changes one after another with the same `gesture`, if that is not 0, are
  /// taken back as one.
  void change(const std::function<void(State&)>& edit, unsigned gesture = 0);
  bool can_undo() const { return !undone_from_.empty(); }
  bool can_redo() const { return !redone_from_.empty(); }
  void undo();
  void redo();

  /// Shows other files in place of these; a `.view` file brings its state.
  void open(const std::vector<std::string>& paths);
  /// Shows them beside these.
  void add(const std::vector<std::string>& paths);
  /// Reads all files again, and keeps the view.
  void reload();
  /// Reads again what has changed on the disk since it was read.
  void reload_if_changed();

  std::optional<PickedPoint> pick(std::int32_t x, std::int32_t y) const;

  /// What is shown; nothing without a model.
  std::optional<Shown> shown() const;
  /// The number of the picture that was asked for last.
  std::uint64_t frame_number() const { return frame_number_; }

 private:
  void load();
  void ask_for_frame();
  bool has_its_lines() const;
  bool add_lines();
  void prepare_numbers();
  void take(Loaded loaded);
  void note_change();
  void follow(const State& before);
  void give_up(const Error& error);
  bool take_sought();
  void see_first();
  void note_file_times();

  State state_;
  State shown_;  ///< of the model
  FirstView first_view_;
  std::optional<FirstLook> first_look_;  ///< of the model
  /// What is sought is the first view, for pictures of that size.
  std::optional<glm::ivec2> sought_first_;
  std::optional<io::ViewOptions> found_;
  std::vector<State> undone_from_, redone_from_;
  std::shared_ptr<const Model> model_;
  std::optional<Camera> camera_;
  /// The numbers shown, of that model and look; null: none.
  std::shared_ptr<const ShownNumbers> numbers_;
  std::shared_ptr<const Numbers> numbers_model_;
  std::optional<ScalarLook> numbers_look_;
  std::int32_t width_px_ = 640, height_px_ = 480;
  std::string message_;
  bool is_about_files_ = false;  ///< the message
  unsigned gesture_ = 0;
  bool wants_first_view_ = true;
  std::uint64_t frame_number_ = 0;
  std::uint64_t lined_number_ = 0;  ///< the last picture that has its lines
  std::string file_times_;
  FrameMaker frames_;
  EdgeLines edges_;
  CameraSeeker seeker_;
  Loader loader_;
};

}  // namespace halfspace::viewer
