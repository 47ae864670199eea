#include "osteon/anatomy/likeness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bone/surface_samples.h"
#include "osteon/base/turn.h"
#include "osteon/mesh/distance.h"
#include "recognise/align.h"

namespace osteon {
namespace {

constexpr ScaleRange kLikenessScales = {0.6, 1.6};
constexpr std::size_t kCoarse = 120, kFine = 500;
constexpr int kCoarseRounds = 10, kFineRounds = 30;
constexpr double kSettled_m = 1e-6;  // a round that gains less is the last
constexpr std::size_t kFinalists = 2;

/// The part of a bone that counts: all behind no plane, or all beyond one.
struct ComparedRegion {
  Vec3 direction = Vec3::Zero();
  double from = -1e300;
  bool holds(const Vec3& p) const { return direction.dot(p) >= from; }
};

ComparedRegion region_of(const std::vector<Vec3>& points, const LikenessOptions& options) {
  ComparedRegion region;
  if (options.end_m <= 0) return region;
  region.direction = principal_axes(points).col(0);
  if (region.direction.dot(options.towards_end_B) < 0) region.direction = -region.direction;
  double end = -1e300;
  for (const Vec3& p : points) end = std::max(end, region.direction.dot(p));
  region.from = end - options.end_m;
  return region;
}

std::vector<Vec3> kept(const std::vector<Vec3>& points, const ComparedRegion& region) {
  std::vector<Vec3> inside;
  for (const Vec3& p : points)
    if (region.holds(p)) inside.push_back(p);
  return inside;
}

/// Points of both surfaces that are matched; all of the bone's lie in its region.
struct Samples {
  std::vector<Vec3> bone_B, reference_R;
};

struct Surfaces {
  MeshDistance bone, reference;
  ComparedRegion region_B;
};

Vec3 to_bone(const ModelFit& fit, const Vec3& p_R) { return fit.to_model(p_R); }

/// Closest points both ways; a point of the reference counts where it lies in the bone's region.
Pairs match(const Surfaces& surfaces, const Samples& samples, const ModelFit& fit) {
  Pairs pairs;
  for (const Vec3& p_B : samples.bone_B) {
    pairs.model_M.push_back(p_B);
    pairs.data_P.push_back(surfaces.reference.closest(fit.to_patient(p_B)).point);
  }
  for (const Vec3& p_R : samples.reference_R) {
    const Vec3 p_B = to_bone(fit, p_R);
    if (!surfaces.region_B.holds(p_B)) continue;
    pairs.model_M.push_back(surfaces.bone.closest(p_B).point);
    pairs.data_P.push_back(p_R);
  }
  return pairs;
}

double mean_distance(const Pairs& pairs, const ModelFit& fit) {
  double sum = 0;
  for (std::size_t n = 0; n < pairs.model_M.size(); ++n)
    sum += (fit.to_patient(pairs.model_M[n]) - pairs.data_P[n]).norm();
  return sum / static_cast<double>(pairs.model_M.size());
}

ModelFit icp(const Surfaces& surfaces, const Samples& samples, ModelFit fit, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const Pairs pairs = match(surfaces, samples, fit);
    ModelFit next = best_fit(pairs, kLikenessScales, false);
    next.residual_m = mean_distance(pairs, next);
    const double gain = fit.residual_m - next.residual_m;
    fit = next;
    if (std::abs(gain) < kSettled_m) break;
  }
  return fit;
}

double spread_of(const std::vector<Vec3>& points, const Vec3& middle) {
  double sum = 0;
  for (const Vec3& p : points) sum += (p - middle).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

ModelFit guess(const std::vector<Vec3>& bone_B, const std::vector<Vec3>& reference_R,
               const Mat3& R_RB) {
  const Vec3 middle_B = mean_of(bone_B), middle_R = mean_of(reference_R);
  ModelFit fit;
  fit.scale =
      std::clamp(spread_of(reference_R, middle_R) / std::max(spread_of(bone_B, middle_B), 1e-9),
                 kLikenessScales.lo, kLikenessScales.hi);
  fit.X_PM.q = Quat(R_RB).normalized();
  fit.X_PM.p = middle_R - fit.X_PM.rotate(fit.scale * middle_B);
  return fit;
}

/// All 24 proper ways to lay one cross of axes over another.
std::vector<Mat3> proper_signs_and_orders() {
  std::vector<Mat3> all;
  for (int order = 0; order < 6; ++order)
    for (int signs = 0; signs < 8; ++signs) {
      const int a = order / 2, b = (a + 1 + order % 2) % 3, c = 3 - a - b;
      Mat3 m = Mat3::Zero();
      m(0, a) = signs & 1 ? -1 : 1;
      m(1, b) = signs & 2 ? -1 : 1;
      m(2, c) = signs & 4 ? -1 : 1;
      if (m.determinant() > 0) all.push_back(m);
    }
  return all;
}

std::vector<ModelFit> whole_guesses(const Samples& samples) {
  const Mat3 axes_B = principal_axes(samples.bone_B);
  const Mat3 axes_R = principal_axes(samples.reference_R);
  std::vector<ModelFit> guesses;
  for (const Mat3& m : proper_signs_and_orders())
    guesses.push_back(guess(samples.bone_B, samples.reference_R, axes_R * m * axes_B.transpose()));
  return guesses;
}

/// Long axes laid along each other, every 30 degrees about them, on both ends of the reference.
std::vector<ModelFit> end_guesses(const Samples& samples, const Surfaces& surfaces,
                                  const LikenessOptions& options) {
  constexpr int kTurns = 12;
  constexpr double kStep = 2 * 3.14159265358979323846 / kTurns;
  const Vec3 axis_R = principal_axes(samples.reference_R).col(0);
  std::vector<ModelFit> guesses;
  for (const double sign : {1.0, -1.0}) {
    LikenessOptions there = options;
    there.towards_end_B = sign * axis_R;
    const auto end_R = kept(samples.reference_R, region_of(samples.reference_R, there));
    const Quat along = turn_between(surfaces.region_B.direction, sign * axis_R);
    for (int turn = 0; turn < kTurns; ++turn) {
      const Mat3 R = Eigen::AngleAxisd(turn * kStep, sign * axis_R) * along.toRotationMatrix();
      guesses.push_back(guess(samples.bone_B, end_R, R));
    }
  }
  return guesses;
}

ModelFit best_alignment(const Surfaces& surfaces, const Samples& coarse, const Samples& fine,
                        std::vector<ModelFit> fits) {
  for (ModelFit& fit : fits) fit = icp(surfaces, coarse, fit, kCoarseRounds);
  std::stable_sort(fits.begin(), fits.end(), [](const ModelFit& a, const ModelFit& b) {
    return a.residual_m / a.scale < b.residual_m / b.scale;
  });
  fits.resize(std::min(fits.size(), kFinalists));
  ModelFit best;
  for (const ModelFit& start : fits) {
    const ModelFit fit = icp(surfaces, fine, start, kFineRounds);
    if (fit.residual_m < best.residual_m) best = fit;
  }
  return best;
}

/// Distances in the reference's metres, each way.
Likeness measure(const Surfaces& surfaces, const Samples& samples, const ModelFit& fit) {
  std::vector<double> distances;
  double there = 0, back = 0;
  for (const Vec3& p_B : samples.bone_B) {
    distances.push_back(std::abs(surfaces.reference.closest(fit.to_patient(p_B)).signed_distance));
    there += distances.back();
  }
  std::size_t counted = 0;
  for (const Vec3& p_R : samples.reference_R) {
    const Vec3 p_B = to_bone(fit, p_R);
    if (!surfaces.region_B.holds(p_B)) continue;
    distances.push_back(fit.scale * std::abs(surfaces.bone.closest(p_B).signed_distance));
    back += distances.back();
    ++counted;
  }
  Likeness likeness;
  likeness.mean_m = 0.5 * (there / static_cast<double>(samples.bone_B.size()) +
                           back / static_cast<double>(std::max<std::size_t>(counted, 1)));
  std::sort(distances.begin(), distances.end());
  likeness.p95_m = distances[(distances.size() - 1) * 95 / 100];
  likeness.scale = fit.scale;
  return likeness;
}

}  // namespace

Likeness compare_surfaces(const TriMesh& bone, const TriMesh& reference,
                          const LikenessOptions& options) {
  const ComparedRegion region = region_of(surface_samples(bone, options.samples), options);
  const Surfaces surfaces{MeshDistance(bone), MeshDistance(reference), region};
  const auto sampled = [&](std::size_t count) {
    return Samples{kept(surface_samples(bone, count), region), surface_samples(reference, count)};
  };
  const Samples coarse = sampled(kCoarse);
  const ModelFit fit = best_alignment(
      surfaces, coarse, sampled(kFine),
      options.end_m > 0 ? end_guesses(coarse, surfaces, options) : whole_guesses(coarse));
  return measure(surfaces, sampled(options.samples), fit);
}

}  // namespace osteon
