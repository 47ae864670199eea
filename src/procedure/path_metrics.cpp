#include "osteon/procedure/path_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/procedure/report.h"
#include "path_units.h"

namespace osteon {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;
constexpr double kActionSpeed_mm_s = 50;
constexpr double kActionTurn_deg_s = 50;
constexpr double kActionTime_s = 0.2;
constexpr double kNoChord_mm = 1e-6;

using Samples = std::vector<PathSample>;

// Counts the times that a value goes above its threshold for good: the state changes once the value
// has been on the other side for kActionTime_s.
class ActionCounter {
 public:
  ActionCounter(double threshold, double start_s) : threshold_(threshold), settled_s_(start_s) {}
  void add(double time_s, double value) {
    const bool above = value > threshold_;
    if (above != active_ && !(time_s - settled_s_ > kActionTime_s)) return;
    if (above != active_ && above) ++count_;
    active_ = above;
    settled_s_ = time_s;
  }
  int count() const { return count_; }

 private:
  double threshold_;
  double settled_s_;
  bool active_ = false;
  int count_ = 0;
};

double turned_deg(const Quat& a, const Quat& b) {
  const Quat d = a.conjugate() * b;
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w())) * kDegPerRad;
}

Result<void> check_samples(const Samples& samples, const PathMetricsOptions& options) {
  if (samples.size() < 2)
    return fail("the path holds " + std::to_string(samples.size()) + " sample; measures need two",
                "path", "Record a movement");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string where = "path, sample " + std::to_string(i + 1);
    if (!std::isfinite(samples[i].time_s) || !is_finite(samples[i].X_WD))
      return fail("holds a value that is not a finite number", where);
    if (i > 0 && !(samples[i].time_s > samples[i - 1].time_s))
      return fail("the time does not increase", where, "Sort the samples and drop repeated ones");
  }
  if (options.axis_W && (!is_finite(*options.axis_W) || !(options.axis_W->norm() > 0)))
    return fail("the axis has no direction", "axis", "Give three numbers, not all zero");
  return {};
}

// Third divided difference times 3!: the jerk of the cubic through four samples. With even steps
// this is the third backward difference that PerkTutor takes.
Vec3 jerk_mm_s3(const Samples& s, std::size_t i) {
  std::array<Vec3, 4> d;
  for (std::size_t k = 0; k < 4; ++k) d[k] = s[i - k].X_WD.p * kMmPerM;
  for (std::size_t order = 1; order < 4; ++order)
    for (std::size_t k = 0; k + order < 4; ++k)
      d[k] = (d[k] - d[k + 1]) / (s[i - k].time_s - s[i - k - order].time_s);
  return 6 * d[0];
}

std::optional<double> smoothness_of(const Samples& s) {
  if (s.size() < 4) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 3; i < s.size(); ++i)
    sum += jerk_mm_s3(s, i).squaredNorm() * (s[i].time_s - s[i - 1].time_s);
  return std::sqrt(sum);
}

std::optional<double> sparc_of(const std::vector<Vec3>& tip) {
  std::vector<double> speed;
  for (std::size_t i = 1; i < tip.size(); ++i)
    speed.push_back((tip[i] - tip[i - 1]).norm() * kPathRateHz);
  const double value = sparc(speed, kPathRateHz);
  return value < 0 ? std::optional<double>(value) : std::nullopt;
}

void add_motion(const Samples& s, const PathMetricsOptions& options, PathMetrics& m) {
  ActionCounter moves(kActionSpeed_mm_s, s[0].time_s);
  ActionCounter turns(kActionTurn_deg_s, s[0].time_s);
  double speeds = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double dt = s[i].time_s - s[i - 1].time_s;
    const Vec3 dp_mm = (s[i].X_WD.p - s[i - 1].X_WD.p) * kMmPerM;
    const double turn = turned_deg(s[i - 1].X_WD.q, s[i].X_WD.q);
    const Vec3 axis =
        options.axis_W ? options.axis_W->normalized() : Vec3(s[i].X_WD.rotate(Vec3::UnitZ()));
    m.path_mm += dp_mm.norm();
    speeds += dp_mm.norm() / dt;
    m.depth_mm += std::abs(dp_mm.dot(axis));
    m.rotation_deg += turn;
    moves.add(s[i].time_s, dp_mm.norm() / dt);
    turns.add(s[i].time_s, turn / dt);
  }
  m.speed_mm_s = speeds / static_cast<double>(s.size() - 1);
  m.translational_actions = moves.count();
  m.rotational_actions = turns.count();
  const double chord_mm = (s.back().X_WD.p - s.front().X_WD.p).norm() * kMmPerM;
  if (chord_mm > kNoChord_mm) m.inefficiency_percent = 100 * (m.path_mm / chord_mm - 1);
}

// Where the shaft leaves the tissue, walking from a tip inside: the distance to the surface is how
// far it can go without meeting it (sphere tracing, Hart 1996). Ends at the surface, at the shaft's
// end, or after a bounded number of strides.
Vec3 leaves_tissue(const PathMetricsOptions& options, const Pose& X_WT) {
  constexpr int kStrides = 10000;
  constexpr double kAtSurface_m = 1e-9;
  double along = 0;
  for (int i = 0; i < kStrides && along < options.shaft_m; ++i) {
    const double room = -options.tissue_W(X_WT * Vec3(0, 0, along));
    if (!(room > kAtSurface_m)) break;
    along += room;
  }
  return X_WT * Vec3(0, 0, std::min(along, options.shaft_m));
}

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

void add_tissue(const Samples& s, const PathMetricsOptions& options, PathMetrics& m) {
  double time_s = 0, path_mm = 0, damage_m2 = 0;
  bool was_inside = options.tissue_W(s[0].X_WD.p) < 0;
  Vec3 last_out = was_inside ? leaves_tissue(options, s[0].X_WD) : Vec3(s[0].X_WD.p);
  for (std::size_t i = 1; i < s.size(); ++i) {
    const Vec3& p = s[i].X_WD.p;
    const Vec3& last = s[i - 1].X_WD.p;
    const bool inside = options.tissue_W(p) < 0;
    const Vec3 out = inside ? leaves_tissue(options, s[i].X_WD) : p;
    if (inside) {
      time_s += s[i].time_s - s[i - 1].time_s;
      path_mm += (p - last).norm() * kMmPerM;
    }
    if (inside && was_inside)
      damage_m2 += triangle_area(p, last, out) + triangle_area(out, last, last_out);
    was_inside = inside;
    last_out = out;
  }
  m.time_in_tissue_s = time_s;
  m.path_in_tissue_mm = path_mm;
  m.tissue_damage_mm2 = damage_m2 * kMmPerM * kMmPerM;
}

}  // namespace

Result<PathMetrics> path_metrics(const ProbePath& path, const PathMetricsOptions& options) {
  if (const auto ok = check_samples(path.samples, options); !ok) return tl::unexpected(ok.error());
  PathMetrics m;
  m.elapsed_s = path.duration_s();
  add_motion(path.samples, options, m);
  m.smoothness = smoothness_of(path.samples);
  const std::vector<Vec3> tip = resampled_tip(path, kPathRateHz);
  m.sparc = sparc_of(tip);
  m.ldlj = ldlj(tip, kPathRateHz);
  if (options.tissue_W) add_tissue(path.samples, options, m);
  return m;
}

}  // namespace osteon
