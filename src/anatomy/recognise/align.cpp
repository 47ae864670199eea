#include "recognise/align.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr ScaleRange kScales = {0.72, 1.35};
// Shares of the surfaces that must lie together: forearm and fingers may be cut elsewhere.
constexpr double kModelShare = 0.85, kDataShare = 0.75;
constexpr std::size_t kCoarsePoints = 350, kFinePoints = 1500;
constexpr double kBoneReach_m = 0.004, kBoneMove_m = 0.006;

Vec3 mirror(const Vec3& p, bool mirrored) { return Vec3(p.x(), mirrored ? -p.y() : p.y(), p.z()); }

struct Match {
  std::size_t from, to;
  double distance_m;
};

/// The nearest matches, `share` of them.
void trim(std::vector<Match>& matches, double share) {
  const auto keep = static_cast<std::size_t>(share * static_cast<double>(matches.size()));
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.distance_m < b.distance_m; });
  matches.resize(std::max<std::size_t>(4, std::min(keep, matches.size())));
}

double mean_distance(const std::vector<Match>& matches) {
  double sum = 0;
  for (const Match& m : matches) sum += m.distance_m;
  return sum / static_cast<double>(matches.size());
}

/// One round of closest points in both directions.
ModelFit icp_step(const ModelFit& fit, const std::vector<Vec3>& model_M,
                  const std::vector<Vec3>& data_P, const PointCloud& data) {
  std::vector<Vec3> model_P;
  for (const Vec3& p : model_M) model_P.push_back(fit.to_patient(p));
  const PointCloud model(model_P);
  std::vector<Match> there, back;
  for (std::size_t m = 0; m < model_P.size(); ++m) {
    const auto hit = data.nearest(model_P[m]);
    there.push_back({m, hit.index, hit.distance_m});
  }
  for (std::size_t d = 0; d < data_P.size(); ++d) {
    const auto hit = model.nearest(data_P[d]);
    back.push_back({hit.index, d, hit.distance_m});
  }
  trim(there, kModelShare);
  trim(back, kDataShare);
  Pairs pairs;
  for (const auto* matches : {&there, &back})
    for (const Match& m : *matches) {
      pairs.model_M.push_back(model_M[m.from]);
      pairs.data_P.push_back(data_P[m.to]);
    }
  ModelFit next = best_fit(pairs, kScales, fit.mirrored);
  next.residual_m = 0.5 * (mean_distance(there) + mean_distance(back));
  return next;
}

ModelFit icp(ModelFit fit, const std::vector<Vec3>& model_M, const std::vector<Vec3>& data_P,
             int rounds) {
  const PointCloud data(data_P);
  for (int round = 0; round < rounds; ++round) fit = icp_step(fit, model_M, data_P, data);
  return fit;
}

/// Every way to lay the principal axes over each other, at three places along the longest.
std::vector<ModelFit> first_guesses(const std::vector<Vec3>& model_M,
                                    const std::vector<Vec3>& data_P) {
  std::vector<ModelFit> guesses;
  const Vec3 data_middle = mean_of(data_P);
  const Mat3 data_axes = principal_axes(data_P);
  for (const bool mirrored : {false, true}) {
    std::vector<Vec3> seen;
    for (const Vec3& p : model_M) seen.push_back(mirror(p, mirrored));
    const Vec3 middle = mean_of(seen);
    const Mat3 axes = principal_axes(seen);
    for (int turn = 0; turn < 4; ++turn)
      for (const double along : {-0.03, 0.0, 0.03}) {
        const double a = turn & 1 ? -1 : 1, b = turn & 2 ? -1 : 1;
        const Mat3 R = data_axes * Vec3(a, b, a * b).asDiagonal() * axes.transpose();
        ModelFit guess;
        guess.mirrored = mirrored;
        guess.X_PM.q = Quat(R).normalized();
        guess.X_PM.p = data_middle + along * data_axes.col(0) - guess.X_PM.rotate(middle);
        guesses.push_back(guess);
      }
  }
  return guesses;
}

}  // namespace

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

Mat3 principal_axes(const std::vector<Vec3>& points) {
  const Vec3 middle = mean_of(points);
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  Mat3 axes;
  axes.col(0) = solver.eigenvectors().col(2);
  axes.col(1) = solver.eigenvectors().col(1);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

ModelFit best_fit(const Pairs& pairs, ScaleRange scales, bool mirrored) {
  std::vector<Vec3> from;
  for (const Vec3& p : pairs.model_M) from.push_back(mirror(p, mirrored));
  const Vec3 middle = mean_of(from), data_middle = mean_of(pairs.data_P);
  Mat3 covariance = Mat3::Zero();
  double spread = 0;
  for (std::size_t n = 0; n < from.size(); ++n) {
    covariance += (pairs.data_P[n] - data_middle) * (from[n] - middle).transpose();
    spread += (from[n] - middle).squaredNorm();
  }
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 sign(1, 1, 1);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign.z() = -1;
  const Mat3 R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  ModelFit fit;
  fit.mirrored = mirrored;
  fit.scale =
      std::clamp(svd.singularValues().dot(sign) / std::max(spread, 1e-300), scales.lo, scales.hi);
  fit.X_PM.q = Quat(R).normalized();
  fit.X_PM.p = data_middle - fit.X_PM.rotate(fit.scale * middle);
  return fit;
}

ModelFit align_model(const std::vector<Vec3>& model_M, const std::vector<Vec3>& data_P) {
  const std::vector<Vec3> few_M = thinned(model_M, kCoarsePoints);
  const std::vector<Vec3> few_P = thinned(data_P, kCoarsePoints);
  std::vector<ModelFit> fits = first_guesses(few_M, few_P);
  for (ModelFit& fit : fits) fit = icp(fit, few_M, few_P, 15);
  std::stable_sort(fits.begin(), fits.end(), [](const ModelFit& a, const ModelFit& b) {
    return a.residual_m < b.residual_m;
  });
  const std::vector<Vec3> many_M = thinned(model_M, kFinePoints);
  const std::vector<Vec3> many_P = thinned(data_P, kFinePoints);
  ModelFit best;
  for (std::size_t n = 0; n < 4; ++n) {
    const ModelFit fine = icp(fits[n], many_M, many_P, 30);
    if (fine.residual_m < best.residual_m) best = fine;
  }
  return best;
}

ModelFit align_bone(const ModelFit& start, const std::vector<Vec3>& bone_M, const PointCloud& data,
                    const std::vector<Vec3>& data_P) {
  ModelFit fit = start;
  for (int round = 0; round < 12; ++round) {
    Pairs pairs;
    for (const Vec3& p_M : bone_M) {
      const auto hit = data.nearest(fit.to_patient(p_M));
      if (hit.distance_m > kBoneReach_m) continue;
      pairs.model_M.push_back(p_M);
      pairs.data_P.push_back(data_P[hit.index]);
    }
    if (pairs.model_M.size() < bone_M.size() / 3 || pairs.model_M.size() < 6) return start;
    fit = best_fit(pairs, {start.scale, start.scale}, start.mirrored);
  }
  const Vec3 middle = mean_of(bone_M);
  const bool near = (fit.to_patient(middle) - start.to_patient(middle)).norm() < kBoneMove_m &&
                    fit.X_PM.q.angularDistance(start.X_PM.q) < 0.45;
  fit.residual_m = start.residual_m;
  return near ? fit : start;
}

}  // namespace osteon
