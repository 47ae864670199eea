#include "window/jobs/screen_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <system_error>
#include <utility>

namespace osteon {
namespace {

constexpr std::size_t kMostWaiting = 4;

std::uint64_t number_at(double time_s) {
  return static_cast<std::uint64_t>(std::max(0.0, time_s) * ScreenFilm::kFps + 1e-6);
}

/// Where a length begins in a longer or shorter one that has the same middle.
int shift(int from, int to) { return (to - from) / 2; }

}  // namespace

Image centred(const Image& image, int width, int height) {
  Image out{width, height, {}};
  out.rgb.assign(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const int dx = shift(image.width, width), dy = shift(image.height, height);
  const int from = std::max(0, -dx), count = std::min(image.width, width);
  for (int y = std::max(0, dy); y < std::min(height, dy + image.height); ++y) {
    const auto source = 3 * (static_cast<std::ptrdiff_t>(y - dy) * image.width + from);
    const auto target = 3 * (static_cast<std::ptrdiff_t>(y) * width + from + dx);
    std::copy_n(image.rgb.begin() + source, 3 * count, out.rgb.begin() + target);
  }
  return out;
}

Result<std::unique_ptr<ScreenFilm>> ScreenFilm::begin(const std::filesystem::path& file, int width,
                                                      int height) {
  width = std::clamp(width, kLeastFilmSide, kMostFilmSide);
  height = std::clamp(height, kLeastFilmSide, kMostFilmSide);
  auto writer = FilmWriter::create(file, {width, height, kFps, true});
  if (!writer) return tl::unexpected(writer.error());
  return std::unique_ptr<ScreenFilm>(new ScreenFilm(std::move(*writer), file, width, height));
}

ScreenFilm::ScreenFilm(FilmWriter writer, std::filesystem::path file, int width, int height)
    : writer_(std::move(writer)),
      file_(std::move(file)),
      width_(width),
      height_(height),
      thread_([this] { run(); }) {}

ScreenFilm::~ScreenFilm() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

const Result<void>& ScreenFilm::wait() {
  if (thread_.joinable()) thread_.join();
  return result_;
}

bool ScreenFilm::due(double time_s) const {
  return !ending_ && !done() && number_at(time_s) >= next_;
}

void ScreenFilm::add(double time_s, Image image) {
  if (!due(time_s) || image.rgb.empty()) return;
  if (image.width != width_ || image.height != height_) image = centred(image, width_, height_);
  next_ = number_at(time_s) + 1;
  {
    const std::scoped_lock lock(mutex_);
    if (waiting_.size() >= kMostWaiting) return;
    waiting_.push_back({next_, std::move(image)});
  }
  changed_.notify_all();
}

void ScreenFilm::hear(std::span<const float> samples) {
  if (ending_ || done()) return;
  const std::scoped_lock lock(mutex_);
  sound_.insert(sound_.end(), samples.begin(), samples.end());
}

void ScreenFilm::end(double time_s) {
  if (std::exchange(ending_, true)) return;
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back({number_at(time_s), {}});
    closed_ = true;
  }
  changed_.notify_all();
}

bool ScreenFilm::take(Picture& next) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
  if (waiting_.empty()) return false;
  next = std::move(waiting_.front());
  waiting_.pop_front();
  return true;
}

/// Of one picture. Where there is too little sound, the rest is silent.
Result<void> ScreenFilm::write_sound() {
  std::array<float, kSoundHz / kFps> samples{};
  {
    const std::scoped_lock lock(mutex_);
    const std::size_t count = std::min(samples.size(), sound_.size());
    const auto end = sound_.begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(sound_.begin(), end, samples.begin());
    sound_.erase(sound_.begin(), end);
  }
  return writer_.add_sound(samples);
}

/// A picture is shown from where the one before ends; that one fills what was left out between.
void ScreenFilm::run() {
  try {
    Image shown;
    Picture next;
    const auto show_until = [&](std::uint64_t until) {
      while (result_ && !shown.rgb.empty() && written_ < until) {
        result_ = write_sound();
        if (result_) result_ = writer_.add_picture(shown.rgb);
        if (result_) ++written_;
      }
    };
    while (result_ && take(next)) {
      if (next.until > 0 && !next.image.rgb.empty()) {
        show_until(next.until - 1);
        shown = std::move(next.image);
      }
      show_until(next.until);
    }
    if (result_) result_ = writer_.finish();
  } catch (const std::bad_alloc&) {
    result_ = fail("there is not enough memory", file_.string(), "Close other programs");
  }
  done_.store(true, std::memory_order_release);
}

double ScreenFilm::seconds() const { return static_cast<double>(written_) / kFps; }

std::uint64_t ScreenFilm::bytes() const {
  std::error_code none;
  const auto part = std::filesystem::file_size(file_.string() + ".part", none);
  if (!none) return part;
  const auto whole = std::filesystem::file_size(file_, none);
  return none ? 0 : whole;
}

}  // namespace osteon
