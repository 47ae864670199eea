#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "osteon/media/film_writer.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// Writes a film on a thread of its own, picture by picture in the order in which they are given,
/// so that the next one is drawn while one is encoded. The film's bytes are those of a FilmWriter.
class FilmQueue {
 public:
  explicit FilmQueue(FilmWriter writer);
  /// What is not written yet is given up, and so is the film unless it was finished.
  ~FilmQueue();
  FilmQueue(const FilmQueue&) = delete;
  FilmQueue& operator=(const FilmQueue&) = delete;

  /// The next picture and the sound that goes with it. Waits while the writer is two behind. Fails
  /// where the writer failed with this one or one before it.
  Result<void> add(std::vector<float> sound, Image picture);
  /// Waits until all is written, and ends the film. Once.
  Result<void> finish();

 private:
  struct Next {
    std::vector<float> sound;
    Image picture;
  };
  void run();
  bool take(Next& next);
  void close();

  FilmWriter writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Next> waiting_;
  bool closed_ = false;           ///< nothing more comes
  std::optional<Error> failure_;  ///< of the first that could not be written
  std::thread thread_;
};

}  // namespace osteon
