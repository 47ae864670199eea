#include "osteon/anatomy/name_bones.h"

#include <algorithm>
#include <cmath>

#include "recognise/align.h"
#include "recognise/point_cloud.h"

namespace osteon {
namespace {

constexpr double kTogether_m = 0.004;
constexpr double kUnassignedCost = 0.8;
constexpr double kHeldShare = 0.5;    // of a bone's surface: the region holds the bone
constexpr double kPieceShare = 0.65;  // of a region's surface: it is a piece of the bone

/// All points with the number of the list that each is from.
struct Joined {
  std::vector<Vec3> points;
  std::vector<int> from;
  void add(const std::vector<Vec3>& list, int number) {
    points.insert(points.end(), list.begin(), list.end());
    from.insert(from.end(), list.size(), number);
  }
};

using Shares = std::vector<std::vector<double>>;

/// Of each list of `a`: the share of its points whose nearest point of `b` lies together with it,
/// for each list of `b`.
Shares shares_of(const Joined& a, std::size_t lists_a, const Joined& b, std::size_t lists_b) {
  Shares shares(lists_a, std::vector<double>(lists_b, 0));
  std::vector<double> total(lists_a, 0);
  const PointCloud cloud(b.points);
  for (std::size_t n = 0; n < a.points.size(); ++n) {
    const auto list = static_cast<std::size_t>(a.from[n]);
    total[list] += 1;
    const auto hit = cloud.nearest(a.points[n]);
    if (hit.distance_m < kTogether_m)
      shares[list][static_cast<std::size_t>(b.from[hit.index])] += 1;
  }
  for (std::size_t list = 0; list < lists_a; ++list)
    for (double& share : shares[list]) share /= std::max(1.0, total[list]);
  return shares;
}

/// Region of each bone, -1 where none fits.
std::vector<int> match(const Shares& of_region, const Shares& of_bone) {
  const std::size_t bones = of_bone.size(), regions = of_region.size();
  std::vector<std::vector<double>> cost(bones,
                                        std::vector<double>(regions + bones, kUnassignedCost));
  for (std::size_t b = 0; b < bones; ++b)
    for (std::size_t r = 0; r < regions; ++r)
      cost[b][r] = 1 - std::sqrt(of_region[r][b] * of_bone[b][r]);
  std::vector<int> region_of = least_cost_assignment(cost);
  for (int& region : region_of)
    if (region >= static_cast<int>(regions)) region = -1;
  return region_of;
}

void decide(const Shares& of_region, const Shares& of_bone, BoneNames& names) {
  const std::vector<int> region_of = match(of_region, of_bone);
  for (std::size_t b = 0; b < region_of.size(); ++b)
    if (region_of[b] >= 0)
      names.bone_of_region[static_cast<std::size_t>(region_of[b])] = static_cast<int>(b);
  for (std::size_t r = 0; r < of_region.size(); ++r) {
    const auto best = std::max_element(of_region[r].begin(), of_region[r].end());
    int& own = names.bone_of_region[r];
    if (own < 0 && *best > kPieceShare) own = static_cast<int>(best - of_region[r].begin());
    for (std::size_t b = 0; b < of_bone.size(); ++b)
      if (of_bone[b][r] > kHeldShare || static_cast<int>(b) == own)
        names.bones_in_region[r].push_back(static_cast<int>(b));
  }
}

}  // namespace

BoneNames name_bones(std::span<const ModelBone> model,
                     const std::vector<std::vector<Vec3>>& regions_P) {
  BoneNames names;
  names.bone_of_region.assign(regions_P.size(), -1);
  names.bones_in_region.resize(regions_P.size());
  Joined model_M, data;
  for (std::size_t b = 0; b < model.size(); ++b)
    model_M.add(model[b].points_M, static_cast<int>(b));
  for (std::size_t r = 0; r < regions_P.size(); ++r) data.add(regions_P[r], static_cast<int>(r));
  if (model_M.points.size() < 10 || data.points.size() < 10) return names;
  names.fit = align_model(model_M.points, data.points);
  names.fit_of_bone.assign(model.size(), names.fit);
  if (!names.recognised()) return names;
  const PointCloud cloud(data.points);
  Joined fitted;
  for (std::size_t b = 0; b < model.size(); ++b) {
    names.fit_of_bone[b] = align_bone(names.fit, model[b].points_M, cloud, data.points);
    std::vector<Vec3> points_P;
    for (const Vec3& p : model[b].points_M) points_P.push_back(names.fit_of_bone[b].to_patient(p));
    fitted.add(points_P, static_cast<int>(b));
  }
  decide(shares_of(data, regions_P.size(), fitted, model.size()),
         shares_of(fitted, model.size(), data, regions_P.size()), names);
  return names;
}

}  // namespace osteon
