#include "runs/pictures/film_queue.h"

#include <utility>

namespace osteon {
namespace {

constexpr std::size_t kMostBehind = 2;  // pictures; one has 50 MB at most

}  // namespace

FilmQueue::FilmQueue(FilmWriter writer)
    : writer_(std::move(writer)),
      line_(
          [this]() -> Result<FilmLine<Next>::Work> {
            return [this](const Next& next) -> Result<void> {
              if (auto ok = writer_.add_sound(next.sound); !ok) return ok;
              return writer_.add_picture(next.picture.rgb);
            };
          },
          kMostBehind) {}

Result<void> FilmQueue::add(std::vector<float> sound, Image picture) {
  return line_.add({std::move(sound), std::move(picture)});
}

Result<void> FilmQueue::finish() {
  if (auto done = line_.finish(); !done) return done;
  return writer_.finish();
}

}  // namespace osteon
