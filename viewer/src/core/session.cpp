#include "core/session.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/moves.hpp"
#include "core/picking.hpp"

namespace halfspace::viewer {
namespace {

/// How many changes can be taken back.
constexpr std::size_t kMostUndone = 200;

/// Names what is in the files now.
std::string file_times_of(const State& state) {
  std::string text;
  for (const Part& part : state.parts) {
    std::error_code code;
    const auto time = std::filesystem::last_write_time(part.path, code);
    text += code ? "-" : std::to_string(time.time_since_epoch().count());
    const auto size = std::filesystem::file_size(part.path, code);
    text += code ? ";" : "," + std::to_string(size) + ";";
  }
  return text;
}

Result<io::ViewOptions> automatic_first_view(const Scene& scene,
                                             std::int32_t width_px,
                                             std::int32_t height_px) {
  return io::automatic_options(scene, {}, width_px, height_px);
}

}  // namespace

Session::Session(State state, FirstView first_view, std::function<void()> wake)
    : state_(std::move(state)),
      first_view_(first_view ? std::move(first_view)
                             : FirstView(automatic_first_view)),
      wants_first_view_(!state_.camera),
      frames_(wake),
      edges_(wake),
      loader_(first_view_, wake) {
  if (!state_.parts.empty()) load();
}

void Session::load() {
  note_file_times();
  loader_.request(state_, model_);
}

void Session::note_file_times() { file_times_ = file_times_of(state_); }

bool Session::update() {
  std::optional<Loaded> loaded = loader_.take();
  if (loaded) take(*std::move(loaded));
  return add_lines() || loaded;
}

bool Session::has_its_lines() const {
  return !model_ || lines_of(state_) == Lines::kNone ||
         lined_number_ == frame_number_;
}

bool Session::add_lines() {
  // Not while the camera moves: they take longer than pictures.
  if (!camera_ || has_its_lines() || loader_.is_busy() || !frames_.is_done())
    return false;
  auto drawing = edges_.drawing_of(frame_number_);
  if (!drawing) {
    edges_.request(frame_number_, model_, *camera_, lines_of(state_),
                   state_.looks.cull);
    return false;
  }
  PictureRequest picture = picture_of(state_, model_, *camera_, numbers_);
  picture.lines = std::move(drawing);
  lined_number_ = ++frame_number_;
  frames_.request({frame_number_, std::move(picture)});
  return true;
}

void Session::take(Loaded loaded) {
  if (!loaded.model) {
    give_up(loaded.model.error());
    return;
  }
  model_ = *std::move(loaded.model);
  first_look_ = std::move(loaded.first_look);
  shown_ = std::move(loaded.state);
  message_.clear();
  if (wants_first_view_ || !state_.camera) see_first();
  camera_.reset();
  if (!state_.camera || !set_camera(*state_.camera)) {
    // The camera is out of the new scene's range.
    see_first();
    if (state_.camera) set_camera(*state_.camera);
  }
}

void Session::give_up(const Error& error) {
  if (error.code != ErrorCode::kStopped) message_ = error.message;
  // What was shown is shown still, so it is the state again.
  if (!have_same_scene(state_, shown_) && !undone_from_.empty())
    undone_from_.pop_back();
  const auto camera = state_.camera;
  const Looks looks = state_.looks;
  const std::vector<Section> sections = state_.sections;
  state_ = shown_;
  state_.camera = camera;
  state_.sections = sections;
  if (!model_) state_.looks = looks;
}

void Session::see_first() {
  const bool is_known = first_look_ && first_look_->width_px == width_px_ &&
                        first_look_->height_px == height_px_;
  if (!is_known) {
    const Scene& scene = model_->loaded.file.scene;
    first_look_ = {width_px_, height_px_,
                   first_view_(scene, width_px_, height_px_)};
  }
  const Result<io::ViewOptions>& view = first_look_->view;
  if (!view) {
    message_ = view.error().message;
    return;
  }
  state_.camera = *view;
  wants_first_view_ = false;
}

void Session::reset_camera() {
  if (!model_) return;
  see_first();
  if (state_.camera) set_camera(*state_.camera);
}

void Session::set_size(std::int32_t width_px, std::int32_t height_px) {
  width_px_ = width_px;
  height_px_ = height_px;
  loader_.set_size(width_px, height_px);
  if (!state_.camera || (state_.camera->width_px == width_px &&
                         state_.camera->height_px == height_px))
    return;
  io::ViewOptions camera = *state_.camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  set_camera(camera);
}

bool Session::set_camera(const io::ViewOptions& camera) {
  if (!model_) return false;
  const Result<io::Viewed> viewed =
      io::look_at(model_->loaded.file.scene, camera);
  if (!viewed) return false;
  state_.camera = camera;
  camera_ = viewed->camera;
  ask_for_frame();
  return true;
}

void Session::fit() {
  if (!model_ || !state_.camera) return;
  const auto camera = fitted(model_->loaded.file.scene, *state_.camera);
  if (camera) set_camera(*camera);
}

void Session::see_from(const io::ViewDirection& direction) {
  if (!model_ || !state_.camera) return;
  const auto camera =
      fitted(model_->loaded.file.scene, *state_.camera, direction);
  if (camera) set_camera(*camera);
}

void Session::prepare_numbers() {
  const std::optional<ScalarLook>& look = state_.looks.scalar;
  if (!model_->numbers || !look || look->source != model_->numbers->source) {
    numbers_.reset();
    return;
  }
  if (numbers_ && numbers_model_ == model_->numbers && numbers_look_ == look)
    return;
  const auto shown = shown_numbers(*model_, *look);
  if (!shown) {
    // The scale before stays.
    message_ = shown.error().message;
    return;
  }
  numbers_ = *shown;
  numbers_model_ = model_->numbers;
  numbers_look_ = look;
}

void Session::ask_for_frame() {
  if (!model_ || !camera_) return;
  prepare_numbers();
  frames_.request(
      {++frame_number_, picture_of(state_, model_, *camera_, numbers_)});
}

bool Session::is_settled() const {
  return !loader_.is_busy() && frames_.is_done() && has_its_lines();
}

void Session::change(const std::function<void(State&)>& edit,
                     unsigned gesture) {
  State next = state_;
  edit(next);
  const bool same_scene = have_same_scene(next, state_);
  if (same_scene && next.looks == state_.looks &&
      next.sections == state_.sections)
    return;
  if (gesture == 0 || gesture != gesture_) undone_from_.push_back(state_);
  gesture_ = gesture;
  if (undone_from_.size() > kMostUndone)
    undone_from_.erase(undone_from_.begin());
  redone_from_.clear();
  state_ = std::move(next);
  if (same_scene) {
    ask_for_frame();
  } else if (!state_.parts.empty()) {
    load();
  }
}

namespace {

/// Takes parts and looks of the last of `from`, and notes them in `to`.
bool exchange(State& state, std::vector<State>& from, std::vector<State>& to) {
  if (from.empty()) return false;
  State next = std::move(from.back());
  from.pop_back();
  next.camera = state.camera;
  to.push_back(std::exchange(state, std::move(next)));
  return true;
}

}  // namespace

void Session::undo() {
  if (exchange(state_, undone_from_, redone_from_)) load();
}

void Session::redo() {
  if (exchange(state_, redone_from_, undone_from_)) load();
}

void Session::open(const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  State next;
  next.looks = state_.looks;
  for (const std::string& path : paths) {
    if (!is_view_name(path)) {
      next.parts.push_back({path, true, std::nullopt, {}});
      continue;
    }
    const Result<State> read = read_state(path);
    if (!read) {
      message_ = read.error().message;
      return;
    }
    next = *read;
  }
  const std::optional<io::ViewOptions> camera = next.camera;
  change([&next](State& state) {
    const auto before = state.camera;
    state = std::move(next);
    state.camera = before;
  });
  wants_first_view_ = !camera;
  if (camera) {
    state_.camera = camera;
    state_.camera->width_px = width_px_;
    state_.camera->height_px = height_px_;
  }
}

void Session::add(const std::vector<std::string>& paths) {
  if (state_.parts.empty() ||
      std::any_of(paths.begin(), paths.end(),
                  [](const std::string& path) { return is_view_name(path); })) {
    open(paths);
    return;
  }
  change([&paths](State& state) {
    for (const std::string& path : paths)
      state.parts.push_back({path, true, std::nullopt, {}});
  });
}

void Session::reload() {
  if (!state_.parts.empty()) load();
}

void Session::reload_if_changed() {
  if (!loader_.is_busy() && file_times_of(state_) != file_times_) reload();
}

std::optional<PickedPoint> Session::pick(std::int32_t x, std::int32_t y) const {
  if (!model_ || !camera_) return std::nullopt;
  return picked(*model_, *camera_, image_options(state_, *model_), x, y);
}

std::optional<Shown> Session::shown() const {
  if (!model_ || !camera_) return std::nullopt;
  Shown shown{state_, picture_of(state_, model_, *camera_, numbers_), {}};
  if (is_settled()) shown.finished = frames_.picture();
  return shown;
}

}  // namespace halfspace::viewer
