#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// One wanted pose of the hand.
struct PathSample {
  PathSample() = default;
  PathSample(double t_s, const Pose& X, bool pressed) : time_s(t_s), X_WD(X), button(pressed) {}

  double time_s = 0;
  Pose X_WD;
  bool button = false;
  std::string instrument;  ///< that the hand takes; empty: it keeps what it has
  double size_mm = 0;      ///< of the instrument; 0: the usual one
  double power = 0;        ///< 0 to 1
  double jaw = 0;          ///< 0 closed to 1 open
};

/// Probe path in World, times strictly rising.
struct ProbePath {
  std::vector<PathSample> samples;
  bool with_instruments = false;  ///< the last four columns are there
  double duration_s() const;
  /// Pose at a time: linear between samples, spherical along the shorter arc for the rotation, held
  /// at both ends; the button is that of the sample before. The default pose when empty. Uses only
  /// + - * / and square roots, so it gives the same bits on every machine.
  PathSample at(double time_s) const;
};

/// Longer paths are refused.
inline constexpr std::size_t kMaxPathSamples = 10'000'000;

/// CSV with the header `time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button`: finite numbers, times strictly
/// rising, quaternions of unit length within 1e-3 (then scaled to it), button 0 or 1. Errors name
/// the line. The header may go on with `,instrument,size,power,jaw`: a name or nothing, mm (0: the
/// usual size), and two numbers from 0 to 1.
Result<ProbePath> load_path(const std::filesystem::path& file);
/// The same from memory; `where` names the source in errors.
Result<ProbePath> parse_path(std::string_view text, const std::string& where);
/// What was read from a file reads back with the same bits.
Result<void> save_path(const ProbePath& path, const std::filesystem::path& file);

}  // namespace osteon
