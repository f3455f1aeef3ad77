#include "core/loader.hpp"

#include <new>
#include <utility>

namespace halfspace::viewer {

std::shared_ptr<const Model> ModelBin::kept(
    const std::shared_ptr<ModelBin>& bin, std::shared_ptr<const Model> model) {
  const Model* const raw = model.get();
  return {raw, [bin, model = std::move(model)](const Model*) mutable {
            bin->worker_.add(std::move(model));
          }};
}

Loader::Loader(FirstView first_view, std::function<void()> wake)
    : first_view_(std::move(first_view)),
      wake_(std::move(wake)),
      worker_([this](const Job& job) { carry_out(job); }) {}

namespace {

/// The state of files that are opened. Looks stay, but for those of a view.
Result<State> state_of(const std::vector<std::string>& paths,
                       const State& before) {
  State state;
  state.looks = before.looks;
  state.looks.scalar.reset();
  for (const std::string& path : paths) {
    if (!is_view_name(path)) {
      state.parts.push_back({path, true, std::nullopt, {}});
      continue;
    }
    Result<State> read = read_state(path);
    if (!read) return read;
    state = *std::move(read);
  }
  return state;
}

}  // namespace

std::uint64_t Loader::request(const State& state,
                              std::shared_ptr<const Model> before) {
  return begin(state, std::move(before), {});
}

std::uint64_t Loader::open(const State& state, std::vector<std::string> paths,
                           std::shared_ptr<const Model> before) {
  return begin(state, std::move(before), std::move(paths));
}

std::uint64_t Loader::begin(State state, std::shared_ptr<const Model> before,
                            std::vector<std::string> opened) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++last_number_;
    wanted_ = number;
    result_.reset();
    is_busy_ = true;
  }
  worker_.replace(
      {number, std::move(state), std::move(before), std::move(opened)});
  return number;
}

void Loader::set_size(std::int32_t width_px, std::int32_t height_px) {
  const std::lock_guard lock(mutex_);
  width_px_ = width_px;
  height_px_ = height_px;
}

FirstLook Loader::first_look_of(const Scene& scene) const {
  std::int32_t width = 0, height = 0;
  {
    const std::lock_guard lock(mutex_);
    width = width_px_;
    height = height_px_;
  }
  return {width, height, first_view_(scene, width, height)};
}

void Loader::cancel() { wanted_ = 0; }

void Loader::forget() {
  const std::lock_guard lock(mutex_);
  ++last_number_;
  wanted_ = 0;
  is_busy_ = false;
  result_.reset();
}

std::optional<Loaded> Loader::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

Progress Loader::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool Loader::is_busy() const {
  const std::lock_guard lock(mutex_);
  return is_busy_ || result_.has_value();
}

void Loader::carry_out(const Job& job) {
  const auto report = [&](const std::string& work, double share) {
    const bool goes_on = wanted_ == job.number && !worker_.is_ending();
    {
      const std::lock_guard lock(mutex_);
      // A bar of a hundred steps: no more is shown.
      if (progress_.work == work && share < progress_.share + 0.01)
        return goes_on;
      progress_ = {work, share};
    }
    wake_();
    return goes_on;
  };
  Result<std::shared_ptr<const Model>> model =
      Error{ErrorCode::kOutOfRange, "there is not enough memory"};
  std::optional<FirstLook> look;
  State state = job.state;
  try {
    Result<State> opened =
        job.opened.empty() ? job.state : state_of(job.opened, job.state);
    if (opened) {
      state = *std::move(opened);
      model = make_model(state, cache_, job.before.get(), report);
    } else {
      model = opened.error();
    }
    if (model) model = ModelBin::kept(bin_, *std::move(model));
    if (model) look = first_look_of((*model)->loaded.file.scene);
  } catch (const std::bad_alloc&) {
    // The error is there already.
  }
  {
    const std::lock_guard lock(mutex_);
    progress_ = {};
    // A newer request has its own result.
    if (job.number != last_number_) return;
    is_busy_ = false;
    result_ = Loaded{job.number, std::move(state), !job.opened.empty(),
                     std::move(model), std::move(look)};
  }
  wake_();
}

}  // namespace halfspace::viewer
