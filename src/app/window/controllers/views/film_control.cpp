#include "window/controllers/views/film_control.h"

#include <system_error>
#include <utility>

#include "cases/xdg.h"
#include "ui/screenshot.h"

namespace osteon {

void FilmControl::begin(const std::filesystem::path& file) {
  const auto size = host_.pixels();
  auto film = ScreenFilm::begin(file, size.width, size.height);
  if (!film) return host_.note(ToastKind::kError, film.error().message());
  film_ = std::move(*film);
  from_s_ = host_.now_s;
}

void FilmControl::toggle() {
  if (film_) return film_->end(time_s());
  const std::filesystem::path folder = data_home_dir() / "films";
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  begin(dated_file(folder, "osteon", ".webm"));
}

void FilmControl::poll() {
  if (!film_) return;
  if (film_->due(time_s())) {
    const auto size = host_.pixels();
    if (size.width > 0 && size.height > 0)
      film_->add(time_s(), read_framebuffer(size.width, size.height));
  }
  if (!film_->done()) return;
  if (film_->result())
    host_.note(ToastKind::kInfo, "Saved as " + film_->file().string());
  else
    host_.note(ToastKind::kError, film_->result().error().message());
  film_.reset();
}

Result<void> FilmControl::finish() {
  if (!film_) return {};
  film_->end(time_s());
  return film_->wait();
}

ScreenFilmModel FilmControl::model() const {
  ScreenFilmModel model;
  if (!film_) return model;
  model.on = true;
  model.ending = film_->ending();
  model.seconds = film_->ending() ? film_->seconds() : time_s();
  model.megabytes = static_cast<double>(film_->bytes()) * 1e-6;
  model.file = film_->file().string();
  return model;
}

}  // namespace osteon
