#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/scene/path.h"

namespace osteon {

/// Measures of one instrument's way. Those that PerkTutor has too (Ungi et al., "Perk Tutor: an
/// open-source training platform for ultrasound-guided needle insertions", 2012; its metric
/// scripts) are computed as it does; docs/scoring.md names the two places where they are not.
/// A measure that the way does not define is empty.
struct PathMetrics {
  double elapsed_s = 0;
  double path_mm = 0;                       ///< sum of |dp| of the tip
  std::optional<double> time_in_tissue_s;   ///< of the steps that end inside; without tissue none
  std::optional<double> path_in_tissue_mm;  ///< likewise
  std::optional<double> tissue_damage_mm2;  ///< area that the shaft sweeps inside
  double speed_mm_s = 0;                    ///< mean of |dp| / dt over the steps, each counted once
  std::optional<double> smoothness;         ///< sqrt(integral |jerk|^2 dt), mm s^-2.5; 4 samples
  std::optional<double> sparc;              ///< spectral arc length of the speed at 100 Hz
  std::optional<double> ldlj;               ///< log dimensionless jerk at 100 Hz
  double depth_mm = 0;                      ///< sum of |dp . axis|
  double rotation_deg = 0;                  ///< sum of the angles from pose to pose
  std::optional<double> inefficiency_percent;  ///< 100 (way / chord - 1); none when it ends where
                                               ///< it began
  int translational_actions = 0;               ///< times that the tip went above 50 mm/s
  int rotational_actions = 0;                  ///< times that the turning went above 50 deg/s
};

struct PathMetricsOptions {
  /// Signed distance of a point in World to the tissue's surface, m, negative inside; empty: no
  /// tissue.
  std::function<double(const Vec3&)> tissue_W = {};
  /// Direction for `depth_mm`, in World, of any length above zero; none: the shaft's own.
  std::optional<Vec3> axis_W = {};
  double shaft_m = 0.3;  ///< how much behind the tip counts for `tissue_damage_mm2`
};

/// Tool frame: origin at the tip, the shaft along +z. Fails for fewer than two samples, for a
/// sample that is not finite, for times that do not rise and for an axis of no length.
Result<PathMetrics> path_metrics(const ProbePath& path, const PathMetricsOptions& options = {});

/// All measures as one JSON object, an empty one as null; the same text in every locale.
std::string to_json(const PathMetrics& metrics);
/// Table for a terminal.
std::string to_text(const PathMetrics& metrics);

/// The tip at a steady rate from the first sample's time on, by the cubic through the two samples
/// before and the two after (Lagrange): third differences of a smooth way that was sampled unevenly
/// stay true.
std::vector<Vec3> resampled_tip(const ProbePath& path, double rate_hz);

/// Log dimensionless jerk of a way sampled at `rate_hz`: -ln[(T^3 / v_peak^2) integral |v''|^2 dt],
/// v the velocity (Balasubramanian et al. 2015; Hogan and Sternad 2009). Nearer 0 is smoother.
/// Empty for fewer than four samples, no movement, or no jerk at all.
std::optional<double> ldlj(const std::vector<Vec3>& p, double rate_hz);

}  // namespace osteon
