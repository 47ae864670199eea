#include "scope_parts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>

#include "osteon/base/turn.h"
#include "osteon/mesh/measure.h"
#include "surface/shapes.h"

namespace osteon {

namespace {

constexpr double kThickBand_m = 0.004;  // the fibres of a cruciate ligament are drawn as they are
constexpr double kFinestFibres = 3;

// From the footprints on one bone to those on the other; none where there are not just two bones.
std::optional<Vec3> between_footprints(const SoftPart& soft) {
  constexpr double kTooNear_m = 0.001;
  std::vector<BoneId> bones;
  std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
  std::array<int, 2> counts{};
  for (const Attachment& at : soft.attachments) {
    const auto known = std::find(bones.begin(), bones.end(), at.bone);
    const auto end = static_cast<std::size_t>(known - bones.begin());
    if (end == sums.size()) return std::nullopt;
    if (known == bones.end()) bones.push_back(at.bone);
    sums[end] += at.p_W;
    ++counts[end];
  }
  if (bones.size() != sums.size()) return std::nullopt;
  const Vec3 way = sums[1] / counts[1] - sums[0] / counts[0];
  if (!(way.norm() > kTooNear_m)) return std::nullopt;
  return way.normalized();
}

// Returns the middle between its rims: the mean of its points lies nearer to a crowded one.
Vec3 measure_disc(const std::vector<Vec3>& vertices, const Mat3& axes, TissuePart& tissue) {
  constexpr double kLeastHalf_m = 1e-4;
  Aabb box;  // in the frame of its axes
  for (const Vec3& v : vertices) box.include(axes.transpose() * v);
  const Vec3 half = (0.5 * box.extent()).cwiseMax(kLeastHalf_m);
  tissue.to_end = (axes.col(2) / half[2]).cast<float>();
  tissue.to_side = (axes.col(1) / half[1]).cast<float>();
  return axes * box.center();
}

}  // namespace

TissuePattern pattern_of(std::string_view kind) {
  if (kind == "cartilage") return TissuePattern::kCartilage;
  if (kind == "meniscus") return TissuePattern::kMeniscus;
  if (kind == "disc") return TissuePattern::kDisc;
  if (kind == "ligament" || kind == "tendon") return TissuePattern::kFibres;
  return kind == "fat" ? TissuePattern::kFat : TissuePattern::kBone;
}

void find_fibres(const SoftPart& soft, TissuePart& tissue) {
  const std::vector<Vec3>& vertices = soft.mesh_W.vertices;
  if (vertices.empty()) return;
  const double share = 1 / static_cast<double>(vertices.size());
  Vec3 center = Vec3::Zero();
  for (const Vec3& v : vertices) center += share * v;
  Mat3 spread = Mat3::Zero();
  for (const Vec3& v : vertices) spread += share * (v - center) * (v - center).transpose();
  if (!spread.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  const bool disc = tissue.pattern == TissuePattern::kDisc;
  const bool flat = disc || tissue.pattern == TissuePattern::kMeniscus;
  Vec3 fibre = axes.eigenvectors().col(flat ? 0 : 2);
  if (disc) center = measure_disc(vertices, axes.eigenvectors(), tissue);
  if (!flat)
    if (const auto way = between_footprints(soft)) fibre = *way;
  tissue.fibre = fibre.cast<float>();
  tissue.center = center.cast<float>();
  // Points of a band's two sides lie half its thickness off the middle.
  const double thick_m = 2 * std::sqrt(std::max(axes.eigenvalues()[0], 0.0));
  tissue.fineness =
      static_cast<float>(std::clamp(kThickBand_m / std::max(thick_m, 1e-6), 1.0, kFinestFibres));
}

bool faces_out(const TriMesh& mesh) {
  return !mesh.triangles.empty() && topology(mesh).closed() && volume(mesh) > 0;
}

double seen_radius(int side_px) {
  constexpr double kSpread_px = 16;
  return 1 + 2 * kSpread_px / side_px;
}

TriMesh unseen_corners(int side_px) {
  constexpr std::uint32_t kSegments = 8;
  const double radius = seen_radius(side_px);
  TriMesh mesh;
  if (radius >= std::numbers::sqrt2) return mesh;
  const double from = std::acos(1 / radius);
  const double step = (std::numbers::pi / 2 - 2 * from) / kSegments;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Eigen::AngleAxisd turn(quarter * std::numbers::pi / 2, Vec3::UnitZ());
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(turn * Vec3(1, 1, -1));
    for (std::uint32_t k = 0; k <= kSegments; ++k) {
      const double a = from + step * k;
      mesh.vertices.push_back(turn * Vec3(radius * std::cos(a), radius * std::sin(a), -1));
    }
    for (std::uint32_t k = 1; k <= kSegments; ++k)
      mesh.triangles.push_back({first, first + k + 1, first + k});
  }
  return mesh;
}

TissuePart steel() {
  TissuePart part;
  part.pattern = TissuePattern::kSteel;
  part.tint = {0.86f, 0.88f, 0.91f};
  return part;
}

TissuePart loose_part_of(const TissuePart& soft, const Pose& X_WB) {
  TissuePart part;
  part.pattern = soft.pattern;
  part.tint = soft.tint;
  const Pose X_BW = X_WB.inverse();
  part.fibre = X_BW.rotate(soft.fibre.cast<double>()).cast<float>();
  part.center = (X_BW * soft.center.cast<double>()).cast<float>();
  part.to_end = X_BW.rotate(soft.to_end.cast<double>()).cast<float>();
  part.to_side = X_BW.rotate(soft.to_side.cast<double>()).cast<float>();
  return part;
}

TissuePart ghost_part() {
  TissuePart part = steel();
  part.tint = {0.35f, 0.72f, 1.0f};
  return part;
}

TissuePart placed_part(const PlacingRod& rod) {
  constexpr int kSides = 20;
  TissuePart part = steel();
  const Vec3 along = rod.b_W - rod.a_W;
  if (rod.is == PlacingRod::Is::kGraft) {
    part.pattern = TissuePattern::kFibres;
    part.tint = {0.90f, 0.87f, 0.78f};
    part.fibre = along.normalized().cast<float>();
    part.center = (0.5 * (rod.a_W + rod.b_W)).cast<float>();
  } else if (rod.is == PlacingRod::Is::kThread) {
    part.tint = {0.16f, 0.42f, 0.30f};
  }
  TriMesh mesh = cylinder(kSides);
  const Quat q = turn_between(Vec3::UnitZ(), along);
  for (Vec3& v : mesh.vertices)
    v = rod.a_W + q * Vec3(rod.radius_m * v.x(), rod.radius_m * v.y(), along.norm() * v.z());
  part.surface = GpuMesh(plain_shaded(mesh));
  return part;
}

bool same_rods(const std::vector<PlacingRod>& a, const std::vector<PlacingRod>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const PlacingRod& x, const PlacingRod& y) {
        return x.is == y.is && x.a_W == y.a_W && x.b_W == y.b_W && x.radius_m == y.radius_m;
      });
}

}  // namespace osteon
