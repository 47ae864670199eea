#include "skin/skin_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace osteon {
namespace {

// Own default: skin over bone yields so much at least.
constexpr double kThinnestCover_m = 0.0025;
constexpr const char* kTendonKind = "tendon";

/// The highest surface that is not over the skin, at each node.
class GroundUnder {
 public:
  GroundUnder(const SkinRelief& relief, double most_m)
      : relief_(relief), ground_m_(relief.heights_m().begin(), relief.heights_m().end()) {
    for (double& z : ground_m_) z -= most_m;
  }

  void add(const TriMesh& mesh, const Pose& X_SM) {
    for (const Triangle& t : mesh.triangles)
      add({X_SM * mesh.vertices[t[0]], X_SM * mesh.vertices[t[1]], X_SM * mesh.vertices[t[2]]});
  }

  std::vector<double> covers_m() const {
    std::vector<double> out;
    for (std::size_t n = 0; n < ground_m_.size(); ++n)
      out.push_back(std::max(kThinnestCover_m, relief_.heights_m()[n] - ground_m_[n]));
    return out;
  }

 private:
  void add(const std::array<Vec3, 3>& p) {
    const auto [first_i, last_i] = nodes(p, 0, relief_.nx());
    const auto [first_j, last_j] = nodes(p, 1, relief_.ny());
    for (long j = first_j; j <= last_j; ++j)
      for (long i = first_i; i <= last_i; ++i) add(p, i, j);
  }

  double place(long node, long count) const {
    return relief_.cell_m() * (static_cast<double>(node) - 0.5 * static_cast<double>(count - 1));
  }

  /// Of the grid, those between the triangle's least and greatest place along an axis.
  std::pair<long, long> nodes(const std::array<Vec3, 3>& p, int axis, long count) const {
    const auto [lo, hi] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
    const double middle = 0.5 * static_cast<double>(count - 1), last = static_cast<double>(count);
    const double from = std::clamp(std::ceil(lo / relief_.cell_m() + middle), 0.0, last);
    const double to = std::clamp(std::floor(hi / relief_.cell_m() + middle), -1.0, last - 1);
    return {static_cast<long>(from), static_cast<long>(to)};
  }

  void add(const std::array<Vec3, 3>& p, long i, long j) {
    const double x = place(i, relief_.nx()), y = place(j, relief_.ny());
    const auto side = [&](const Vec3& from, const Vec3& to) {
      return (to.x() - from.x()) * (y - from.y()) - (to.y() - from.y()) * (x - from.x());
    };
    const double wc = side(p[0], p[1]), wa = side(p[1], p[2]), wb = side(p[2], p[0]);
    const double sum = wa + wb + wc;
    const bool inside = (wa >= 0 && wb >= 0 && wc >= 0) || (wa <= 0 && wb <= 0 && wc <= 0);
    if (!inside || sum == 0) return;
    const auto node = static_cast<std::size_t>(j * relief_.nx() + i);
    const double z = (wa * p[0].z() + wb * p[1].z() + wc * p[2].z()) / sum;
    if (z <= relief_.heights_m()[node]) ground_m_[node] = std::max(ground_m_[node], z);
  }

  const SkinRelief& relief_;
  std::vector<double> ground_m_;
};

// What a column of fat bears goes as one over its height. The mean of that over a node's
// neighbours, by weights 1, 2, 1 along each axis.
std::vector<double> shared(const std::vector<double>& covers_m, long nx, long ny) {
  std::vector<double> out;
  for (long j = 0; j < ny; ++j)
    for (long i = 0; i < nx; ++i) {
      double bears = 0;
      for (long b = -1; b <= 1; ++b)
        for (long a = -1; a <= 1; ++a) {
          const long at = std::clamp(j + b, 0l, ny - 1) * nx + std::clamp(i + a, 0l, nx - 1);
          const auto weight = static_cast<double>((2 - std::abs(a)) * (2 - std::abs(b)));
          bears += weight / covers_m[static_cast<std::size_t>(at)];
        }
      out.push_back(16 / bears);
    }
  return out;
}

}  // namespace

SkinRelief cover_of(const Case& the_case, const Pose& X_WS, const SkinRelief& relief,
                    double most_m) {
  const Pose X_SW = X_WS.inverse();
  GroundUnder ground(relief, most_m);
  for (const Bone& bone : the_case.bones) ground.add(bone.mesh, X_SW * bone.X_WB);
  for (const SoftPart& soft : the_case.softs)
    if (soft.kind == kTendonKind) ground.add(soft.mesh_W, X_SW);
  return SkinRelief(relief.cell_m(), static_cast<std::size_t>(relief.nx()),
                    shared(ground.covers_m(), relief.nx(), relief.ny()));
}

}  // namespace osteon
