#include "core/session.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
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
      seeker_(wake),
      loader_(first_view_, wake) {
  if (!state_.parts.empty()) load();
}

void Session::load() {
  note_file_times();
  loader_.request(state_, model_);
}

void Session::say(std::string message) {
  message_ = std::move(message);
  is_about_files_ = false;
}

void Session::note_file_times() { file_times_ = file_times_of(state_); }

bool Session::update() {
  std::optional<Loaded> loaded = loader_.take();
  if (loaded) take(*std::move(loaded));
  const bool is_found = take_sought();
  return add_lines() || loaded || is_found;
}

bool Session::has_its_lines() const {
  return !model_ || state_.looks.lines == Lines::kNone ||
         lined_number_ == frame_number_;
}

bool Session::add_lines() {
  // Not while the camera moves: they take longer than pictures.
  if (!camera_ || has_its_lines() || loader_.is_busy() || !frames_.is_done())
    return false;
  PictureRequest picture = picture_of(state_, model_, *camera_, numbers_);
  auto drawing = edges_.drawing_of(frame_number_);
  if (!drawing) {
    edges_.request(frame_number_, picture, state_.looks.lines);
    return false;
  }
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
  if (loaded.is_opened) {
    note_change();
    gesture_ = 0;
    const auto camera = state_.camera;
    state_ = loaded.state;
    wants_first_view_ = !state_.camera;
    if (!state_.camera) state_.camera = camera;
    if (state_.camera) {
      state_.camera->width_px = width_px_;
      state_.camera->height_px = height_px_;
    }
    note_file_times();
  }
  model_ = *std::move(loaded.model);
  first_look_ = std::move(loaded.first_look);
  shown_ = std::move(loaded.state);
  message_.clear();
  camera_.reset();
  // It may be out of the new scene's range.
  const bool is_kept =
      !wants_first_view_ && state_.camera && set_camera(*state_.camera);
  if (!is_kept) {
    seek_first();
  } else {
    stop_seeking();
  }
}

void Session::give_up(const Error& error) {
  if (error.code != ErrorCode::kStopped) {
    message_ = error.message;
    is_about_files_ = true;
  }
  // What was shown is shown still, so it is the state again: as it was before
  // the changes that are given up, with sections and looks that came since.
  const auto camera = state_.camera;
  const auto is_shown = [this](const State& state) {
    return have_same_scene(state, shown_);
  };
  if (!is_shown(state_)) {
    const auto last =
        std::find_if(undone_from_.rbegin(), undone_from_.rend(), is_shown);
    const Looks looks = state_.looks;
    if (last != undone_from_.rend()) {
      state_ = std::move(*last);
      undone_from_.erase(std::prev(last.base()), undone_from_.end());
    } else {
      state_ = shown_;
      if (!model_) state_.looks = looks;
    }
  }
  state_.camera = camera;
  if (camera_) wants_first_view_ = false;
  ask_for_frame();
}

void Session::seek_fit() {
  if (!state_.camera) return;
  const CameraAxes axes = axes_of(*state_.camera);
  seek_side({axes.back, axes.up});
}

void Session::seek_side(const io::ViewDirection& direction) {
  if (!model_ || !camera_) return;
  sought_first_.reset();
  found_.reset();
  seeker_.seek(model_,
               [camera = *state_.camera, direction](const Scene& scene) {
                 return fitted(scene, camera, direction);
               });
}

void Session::seek_first() {
  if (!model_) return;
  seeker_.stop();
  found_.reset();
  const glm::ivec2 size(width_px_, height_px_);
  if (first_look_ && first_look_->width_px == size.x &&
      first_look_->height_px == size.y) {
    see_first();
    return;
  }
  sought_first_ = size;
  seeker_.seek(model_, [first_view = first_view_, size](const Scene& scene) {
    return first_view(scene, size.x, size.y);
  });
}

void Session::stop_seeking() {
  found_.reset();
  // Without a camera nothing is seen until one is found.
  if (camera_ || !model_) seeker_.stop();
}

bool Session::take_sought() {
  std::optional<Result<io::ViewOptions>> sought = seeker_.take();
  if (!sought) return false;
  if (sought_first_) {
    first_look_ = {sought_first_->x, sought_first_->y, *std::move(sought)};
    see_first();
  } else if (*sought) {
    found_ = **sought;
  }
  return true;
}

void Session::see_first() {
  const Result<io::ViewOptions>& view = first_look_->view;
  if (!view) {
    message_ = view.error().message;
    return;
  }
  wants_first_view_ = false;
  found_ = *view;
  // There is nothing to come from.
  if (!camera_) set_camera(*take_found());
}

std::optional<io::ViewOptions> Session::take_found() {
  std::optional<io::ViewOptions> found = std::exchange(found_, std::nullopt);
  if (found) {
    found->width_px = width_px_;
    found->height_px = height_px_;
  }
  return found;
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
  return !loader_.is_busy() && !seeker_.is_busy() && frames_.is_done() &&
         has_its_lines();
}

void Session::change(const std::function<void(State&)>& edit,
                     unsigned gesture) {
  State next = state_;
  edit(next);
  if (have_same_scene(next, state_) && next.looks == state_.looks &&
      next.sections == state_.sections)
    return;
  if (gesture == 0 || gesture != gesture_) note_change();
  gesture_ = gesture;
  redone_from_.clear();
  follow(std::exchange(state_, std::move(next)));
}

void Session::note_change() {
  undone_from_.push_back(state_);
  if (undone_from_.size() > kMostUndone)
    undone_from_.erase(undone_from_.begin());
  redone_from_.clear();
}

void Session::follow(const State& before) {
  if (have_same_scene(before, state_)) {
    ask_for_frame();
  } else if (!state_.parts.empty()) {
    load();
  } else {
    loader_.forget();
    model_.reset();
    camera_.reset();
    stop_seeking();
    shown_ = state_;
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
  const State before = state_;
  if (exchange(state_, undone_from_, redone_from_)) follow(before);
}

void Session::redo() {
  const State before = state_;
  if (exchange(state_, redone_from_, undone_from_)) follow(before);
}

void Session::open(const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  if (std::any_of(paths.begin(), paths.end(),
                  [](const std::string& path) { return is_view_name(path); })) {
    // It is the state when it was read and has a model.
    loader_.open(state_, paths, model_);
    return;
  }
  change([&paths](State& state) {
    State next;
    next.looks = state.looks;
    // Other files have other numbers.
    next.looks.scalar.reset();
    next.camera = state.camera;
    for (const std::string& path : paths)
      next.parts.push_back({path, true, std::nullopt, {}});
    state = std::move(next);
  });
  wants_first_view_ = true;
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
