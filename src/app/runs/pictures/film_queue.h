#pragma once

#include <vector>

#include "osteon/media/film_writer.h"
#include "osteon/render/renderer.h"
#include "runs/pictures/film_line.h"

namespace osteon {

/// Writes a film on a thread of its own, picture by picture in the order in which they are given,
/// so that the next one is drawn while one is encoded. The film's bytes are those of a FilmWriter.
class FilmQueue {
 public:
  /// What is not written at its end is given up, and so is the film unless it was finished.
  explicit FilmQueue(FilmWriter writer);

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
  FilmWriter writer_;
  FilmLine<Next> line_;  ///< after what it writes with
};

}  // namespace osteon
