#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "osteon/base/result.h"

namespace osteon {

/// Writes a WAV file: 16 bits, one channel, kSoundHz. It replaces what is in its place when it is
/// finished; given up before, it leaves nothing.
class WavWriter {
 public:
  /// `samples`: how many there will be. Fails where the file cannot be written or would be larger
  /// than WAV allows (4 GiB).
  static Result<WavWriter> create(const std::filesystem::path& file, std::uint64_t samples);
  ~WavWriter();
  WavWriter(WavWriter&&) noexcept;
  WavWriter& operator=(WavWriter&&) noexcept;

  /// -1 to 1; more is cut off. Samples past the number given at first are ignored.
  Result<void> add(std::span<const float> samples);
  /// Fills with silence up to the number given at first.
  Result<void> finish();

 private:
  struct Impl;
  explicit WavWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
