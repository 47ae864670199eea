#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "window/controllers/window_host.h"
#include "window/jobs/screen_film.h"
#include "window/views_model.h"

namespace osteon {

/// The film of the window.
class FilmControl {
 public:
  explicit FilmControl(WindowHost& host) : host_(host) {}
  void begin(const std::filesystem::path& file);
  void toggle();
  /// What the window sounded like since it was told last.
  void hear(std::span<const float> samples) {
    if (film_) film_->hear(samples);
  }
  /// After all of the window is drawn.
  void poll();
  /// Ends it and waits until it is written.
  Result<void> finish();
  void drop() { film_.reset(); }
  ScreenFilmModel model() const;

 private:
  double time_s() const { return host_.now_s - from_s_; }

  WindowHost& host_;
  std::unique_ptr<ScreenFilm> film_;  ///< while one is made
  double from_s_ = 0;
};

}  // namespace osteon
