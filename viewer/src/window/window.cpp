#include "window/window.hpp"

#include <imgui.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/moves.hpp"
#include "work/recent.hpp"

namespace halfspace::viewer {
namespace {

/// Width of the panel, height of the status line. Units: pixels at scale 1.
constexpr double kPanelPx = 316;
constexpr double kStatusPx = 27;
/// How long the screen waits for a picture before it shows panels without.
constexpr double kPatienceMs = 30;
constexpr double kWatchMs = 500;
constexpr double kFlightMs = 180;

}  // namespace

int panel_px(double scale) {
  return static_cast<int>(std::round(kPanelPx * scale));
}

int status_px(double scale) {
  return static_cast<int>(std::round(kStatusPx * scale));
}

double window_now_ms() {
  return static_cast<double>(SDL_GetPerformanceCounter()) * 1000 /
         static_cast<double>(SDL_GetPerformanceFrequency());
}

double window_work_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1000 +
         static_cast<double>(time.tv_nsec) / 1e6;
}

void Window::note_request() { asked_ms_ = window_now_ms(); }

Window::Window(const WindowOptions& options, SDL_Window* window,
               SDL_Renderer* renderer, double scale, Player* player)
    : options_(options),
      window_(window),
      renderer_(renderer),
      wake_event_(SDL_RegisterEvents(1)),
      imgui_(window, renderer, scale),
      session_(options.state, options.first_view,
               [this] {
                 // One event is enough until it is taken.
                 if (is_woken_.exchange(true)) return;
                 SDL_Event event{};
                 event.type = wake_event_;
                 SDL_PushEvent(&event);
               }),
      jobs_([this] {
        if (is_woken_.exchange(true)) return;
        SDL_Event event{};
        event.type = wake_event_;
        SDL_PushEvent(&event);
      }),
      player_(player) {
  ui_.scale = scale;
  ui_.animates = player == nullptr;
  ui_.draw_figure = options.draw_figure;
  ui_.has_headlight = options.headlight;
  if (player == nullptr) ui_.recent = read_recent(recent_file());
  SDL_RendererInfo info;
  is_kept_ = SDL_GetRendererInfo(renderer, &info) == 0 &&
             (info.flags & SDL_RENDERER_SOFTWARE) != 0;
  lay_out();
}

Window::~Window() {
  if (texture_ != nullptr) SDL_DestroyTexture(texture_);
}

void Window::lay_out() {
  int width = 0, height = 0;
  SDL_GetRendererOutputSize(renderer_, &width, &height);
  const bool is_bare = ui_.is_fullscreen;
  const int panel = is_bare || !ui_.has_panel ? 0 : panel_px(ui_.scale);
  const int status = is_bare ? 0 : status_px(ui_.scale);
  ui_.view = {0, 0, std::clamp(width - panel, 1, kMaxImageSize),
              std::clamp(height - status, 1, kMaxImageSize)};
  session_.set_size(ui_.view.width, ui_.view.height);
}

Result<WindowReport> Window::run() {
  while (!ui_.wants_to_quit) {
    wait();
    const double start = window_now_ms();
    const double work_start = window_work_ms();
    SDL_Event event;
    // Motion that has piled up is one move: pictures do not lag behind it.
    while (SDL_PollEvent(&event) != 0) {
      record(event);
      handle(event);
      ++event_count_;
    }
    if (player_ != nullptr) {
      const auto played = play();
      if (!played) return played.error();
    }
    update();
    if (!is_drawn_later()) draw();
    longest_block_ms_ = std::max(longest_block_ms_, window_now_ms() - start);
    longest_work_ms_ =
        std::max(longest_work_ms_, window_work_ms() - work_start);
  }
  if (options_.record_file) {
    const auto written = write_recorded();
    if (!written) return written.error();
  }
  return report();
}

void Window::wait() {
  if (player_ != nullptr) {
    // The script goes on by itself, but for pictures it waits for.
    SDL_WaitEventTimeout(nullptr, redraws_ > 0 ? 0 : 1);
    return;
  }
  if (redraws_ > 0 && !is_drawn_later()) return;
  if (ui_.flight || redraws_ > 0) {
    SDL_WaitEventTimeout(nullptr, 4);
  } else if (ImGui::GetIO().WantTextInput) {
    SDL_WaitEventTimeout(nullptr, 250);  // the cursor blinks
    redraws_ = std::max(redraws_, 1);
  } else if (options_.watch) {
    SDL_WaitEventTimeout(nullptr, static_cast<int>(kWatchMs));
  } else {
    SDL_WaitEvent(nullptr);
  }
}

bool Window::is_drawn_later() const {
  // While a picture is on its way, panels wait for it: one frame shows both.
  return first_draw_ms_ >= 0 && !session_.is_settled() &&
         !session_.is_loading() && !session_.frames().has_changes() &&
         window_now_ms() - asked_ms_ < kPatienceMs && player_ == nullptr;
}

void Window::update() {
  is_woken_ = false;
  if (session_.update()) {
    redraws_ = std::max(redraws_, 2);
    lay_out();
    note_opened();
  }
  if (const auto found = session_.take_found()) {
    note_request();
    fly_to(session_, ui_, *found);
  }
  while (const auto result = jobs_.saving.take()) note_done(*result);
  while (const auto result = jobs_.solids.take()) note_done(*result);
  if (options_.watch && window_now_ms() >= next_look_ms_) {
    next_look_ms_ = window_now_ms() + kWatchMs;
    session_.reload_if_changed();
  }
  fly();
  follow_eye();
  if (ui_.is_fullscreen != is_fullscreen_) {
    is_fullscreen_ = ui_.is_fullscreen;
    SDL_SetWindowFullscreen(window_,
                            is_fullscreen_ ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
    redraws_ = 3;
  }
  lay_out();
  show_title();
}

void Window::note_done(const Result<std::string>& result) {
  if (!result) {
    if (result.error().code != ErrorCode::kStopped)
      session_.say(result.error().message);
  } else if (result->starts_with("Saved")) {
    ui_.note = *result;
  } else {
    ui_.measures_text = *result;
  }
  redraws_ = 3;
}

void Window::note_opened() {
  // What scripts open nobody looks for later.
  if (player_ != nullptr || !session_.message().empty()) return;
  const auto& parts = session_.state().parts;
  if (parts.empty() || parts.back().path == last_opened_) return;
  last_opened_ = parts.back().path;
  note_recent(recent_file(), last_opened_);
}

void Window::fly() {
  if (!ui_.flight) return;
  const double passed =
      static_cast<double>(SDL_GetTicks64()) - ui_.flight->start_ms;
  const double share = std::min(passed / kFlightMs, 1.0);
  // Slow at both ends.
  const double eased = share * share * (3 - 2 * share);
  io::ViewOptions to = ui_.flight->to;
  to.width_px = ui_.view.width;
  to.height_px = ui_.view.height;
  session_.set_camera(between(ui_.flight->from, to, eased));
  if (share >= 1) ui_.flight.reset();
  redraws_ = std::max(redraws_, 1);
}

void Window::follow_eye() {
  // Colours hold the light, so it follows when the camera rests.
  if (!ui_.has_headlight || button_ != 0 || ui_.flight ||
      !session_.is_settled() || !session_.camera() ||
      !session_.message().empty())
    return;
  const glm::dvec3 back = axes_of(*session_.camera()).back;
  constexpr unsigned kGesture = 2;  // all its lights are taken back as one
  session_.change(
      [&back](State& state) {
        state.looks.light = {back.x, back.y, back.z};
      },
      kGesture);
}

void Window::show_title() {
  const std::string name = name_of(session_.state());
  const std::string title = name.empty() ? "Halfspace" : name + " - Halfspace";
  if (title == title_) return;
  title_ = title;
  SDL_SetWindowTitle(window_, title.c_str());
}

bool Window::take_rows() {
  bool is_changed = false;
  session_.frames().read_changes([this, &is_changed](const Canvas& canvas,
                                                     std::int32_t first,
                                                     std::int32_t end) {
    if (texture_ == nullptr || texture_width_ != canvas.width_px ||
        texture_height_ != canvas.height_px) {
      if (texture_ != nullptr) SDL_DestroyTexture(texture_);
      texture_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888,
                                   SDL_TEXTUREACCESS_STREAMING, canvas.width_px,
                                   canvas.height_px);
      texture_width_ = canvas.width_px;
      texture_height_ = canvas.height_px;
      first = 0;
      end = canvas.height_px;
    }
    is_changed = true;
    // The next rows are waited for anew.
    asked_ms_ = window_now_ms();
    if (texture_ == nullptr) return;
    const SDL_Rect rows = {0, first, canvas.width_px, end - first};
    SDL_UpdateTexture(
        texture_, &rows,
        canvas.pixels.data() + static_cast<std::size_t>(first) *
                                   static_cast<std::size_t>(canvas.width_px),
        4 * canvas.width_px);
  });
  return is_changed;
}

void Window::paint(const SDL_Rect& region) {
  const SDL_Rect place = {ui_.view.x, ui_.view.y, texture_width_,
                          texture_height_};
  const bool has_picture = texture_ != nullptr && session_.model();
  if (!has_picture || SDL_RectEquals(&place, &region) == SDL_FALSE) {
    const Rgb paper = session_.state().looks.background;
    // Nothing is blended: of a whole screen that would take 5 ms.
    SDL_SetRenderDrawBlendMode(renderer_, SDL_BLENDMODE_NONE);
    SDL_SetRenderDrawColor(renderer_, paper.r, paper.g, paper.b, 255);
    SDL_RenderFillRect(renderer_, &region);
    SDL_SetRenderDrawBlendMode(renderer_, SDL_BLENDMODE_BLEND);
  }
  if (has_picture) {
    SDL_SetTextureBlendMode(texture_, SDL_BLENDMODE_NONE);
    SDL_RenderCopy(renderer_, texture_, nullptr, &place);
  }
  imgui_.paint(region);
}

void Window::draw() {
  if (redraws_ <= 0) return;
  --redraws_;
  const bool has_rows = take_rows();
  imgui_.begin_frame();
  is_hover_known_ = true;
  if (imgui_.has_pending()) redraws_ = std::max(redraws_, 3);
  draw_panels(session_, jobs_, ui_);
  draw_overlay(session_, jobs_, ui_);
  const SDL_Rect view = {ui_.view.x, ui_.view.y, ui_.view.width,
                         ui_.view.height};
  const ImguiBackend::Changes changes = imgui_.end_frame(view);
  // Panels are asked a few times, but mostly look as they did; and while the
  // model turns they are on the screen already.
  if (is_exposed_ || changes.outside) {
    int width = 0, height = 0;
    SDL_GetRendererOutputSize(renderer_, &width, &height);
    paint({0, 0, width, height});
  } else if (has_rows || changes.inside) {
    paint(view);
  } else {
    return;
  }
  // Only what is drawn by software stays there for the next frame.
  is_exposed_ = !is_kept_;
  SDL_RenderPresent(renderer_);
  if (first_draw_ms_ < 0) first_draw_ms_ = window_now_ms();
}

WindowReport Window::report() const {
  WindowReport result;
  result.events = event_count_ + (player_ != nullptr ? player_->count() : 0);
  std::vector<double> times = session_.frames().times_ms();
  result.frames = times.size();
  if (!times.empty()) {
    std::sort(times.begin(), times.end());
    result.median_frame_ms = times[times.size() / 2];
  }
  result.longest_block_ms = longest_block_ms_;
  result.longest_work_ms = longest_work_ms_;
  result.first_window_ms = first_draw_ms_;
  return result;
}

}  // namespace halfspace::viewer
