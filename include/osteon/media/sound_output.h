#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// Plays samples (kSoundHz, one channel) on the computer's sound device, by OpenAL, which is loaded
/// when the first device is opened. Nothing waits for the device: what it cannot take is left out,
/// and where it has run dry it begins again. One at a time in a program, used by one thread at a
/// time.
class SoundOutput {
 public:
  /// Fails where OpenAL is not installed and where there is no sound device. `library`: another
  /// file than the usual one.
  static Result<SoundOutput> open(const std::string& library = {});
  ~SoundOutput();
  SoundOutput(SoundOutput&&) noexcept;
  SoundOutput& operator=(SoundOutput&&) noexcept;

  /// 0 silent to 1 as it is.
  void set_volume(double volume);
  /// The next samples, -1 to 1; what is none counts as 0.
  void play(std::span<const float> samples);
  /// What waits to be heard, in samples.
  std::size_t waiting() const;
  /// A little more than waits at most.
  static std::size_t most_waiting();
  /// The device was taken away: open another one.
  bool lost() const;

 private:
  struct Impl;
  explicit SoundOutput(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
