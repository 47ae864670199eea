#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "osteon/base/result.h"

namespace osteon {

/// Samples a second of all sound; one channel.
inline constexpr int kSoundHz = 48000;

struct FilmFormat {
  int width = 1280, height = 720;  ///< pixels, kLeastFilmSide to kMostFilmSide
  int fps = 30;                    ///< pictures a second, 1 to 120
  bool sound = true;
};
inline constexpr int kLeastFilmSide = 16, kMostFilmSide = 4096;

/// Writes a film: WebM with VP9 pictures (BT.709) and an Opus track, by FFmpeg's libraries, which
/// are loaded when the first film is begun. The same pictures and sound give the same bytes from
/// the same libraries.
///
/// Until `finish` the film stands beside its place as FILE.part; what is there is replaced only
/// then. Where the disk has no more room, what was written so far is moved to its place all the
/// same and can be played; the error says so. A film that is given up in any other
/// way leaves nothing. A device or pipe is written straight away.
class FilmWriter {
 public:
  /// Fails on a format out of range, where FFmpeg's libraries or their encoders are missing, and
  /// where the file cannot be written.
  static Result<FilmWriter> create(const std::filesystem::path& file, const FilmFormat& format);
  ~FilmWriter();
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;

  /// The next picture: 8-bit RGB, rows from the top, width x height.
  Result<void> add_picture(std::span<const std::uint8_t> rgb);
  /// The next samples, -1 to 1; of a film without sound they are ignored. Add a picture's sound
  /// before the picture.
  Result<void> add_sound(std::span<const float> samples);
  /// Writes what is pending. Nothing may follow.
  Result<void> finish();

 private:
  struct Impl;
  explicit FilmWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
