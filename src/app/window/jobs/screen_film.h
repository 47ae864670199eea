#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <thread>

#include "osteon/base/result.h"
#include "osteon/media/film_writer.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// A film of the window as it is drawn, with its sound, encoded on a thread of its own. Where
/// pictures come late or the encoder is slow, the one before stays longer: the film keeps its time.
class ScreenFilm {
 public:
  static constexpr int kFps = 25;

  /// Fails as FilmWriter::create does. Sides outside of what a film may have are clamped.
  static Result<std::unique_ptr<ScreenFilm>> begin(const std::filesystem::path& file, int width,
                                                   int height);
  /// Ends the film and waits for the thread.
  ~ScreenFilm();
  ScreenFilm(const ScreenFilm&) = delete;
  ScreenFilm& operator=(const ScreenFilm&) = delete;

  /// Whether the film wants a picture, so many seconds after its begin.
  bool due(double time_s) const;
  /// The window then. One of another size (the window was resized) is put in the film's middle, cut
  /// or with black around it. Where the encoder is behind, the picture is left out.
  void add(double time_s, Image image);
  /// The sound that follows what was told before, from the film's begin on. Before the picture of
  /// its end is added.
  void hear(std::span<const float> samples);
  /// Ends the film at that time; `done` once the rest is written.
  void end(double time_s);
  bool ending() const { return ending_; }
  /// After `end`: until the rest is written.
  const Result<void>& wait();
  bool done() const { return done_.load(std::memory_order_acquire); }
  /// After `done`: whether the film is whole. Where it is not, its words say what is left of it.
  const Result<void>& result() const { return result_; }

  const std::filesystem::path& file() const { return file_; }
  double seconds() const;
  /// On the disk so far.
  std::uint64_t bytes() const;

 private:
  struct Picture {
    std::uint64_t until = 0;  ///< shown up to this number of pictures
    Image image;              ///< empty: the one before
  };
  ScreenFilm(FilmWriter writer, std::filesystem::path file, int width, int height);
  void run();
  Result<void> write_sound();
  bool take(Picture& next);

  FilmWriter writer_;
  std::filesystem::path file_;
  int width_, height_;
  bool ending_ = false;
  std::uint64_t next_ = 0;  ///< number of the picture that is due
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Picture> waiting_;
  std::deque<float> sound_;  ///< not written yet
  bool closed_ = false;      ///< nothing more comes
  std::atomic<std::uint64_t> written_{0};
  std::atomic<bool> done_{false};
  Result<void> result_;
  std::thread thread_;
};

/// A picture in the middle of one of another size: cut where it is larger, black around it where it
/// is smaller.
Image centred(const Image& image, int width, int height);

}  // namespace osteon
