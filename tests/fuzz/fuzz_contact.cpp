// Two small hulls and a pose from the bytes: test and depth must end, agree on hit or miss away
// from touching, agree with the bodies swapped, and be the same warm as cold.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "osteon/collide/lp_contact.h"

namespace {

using osteon::ConvexBody;
using osteon::LpStatus;
using osteon::Pose;
using osteon::Vec3;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  // -128 to 127: small whole numbers make parallel facets and touching corners likely.
  double whole() { return at_ < size_ ? static_cast<std::int8_t>(data_[at_++]) : 0; }
  Vec3 vector() {
    const double x = whole();
    const double y = whole();
    const double z = whole();
    return {x, y, z};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

std::optional<ConvexBody> read_body(Bytes& bytes) {
  const int count = 4 + static_cast<int>(bytes.whole() + 128) % 12;
  const double unit = std::ldexp(1.0, -10 - static_cast<int>(bytes.whole() + 128) % 8);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(unit * bytes.vector());
  auto outcome = osteon::build_hull(points);
  if (!outcome.hull) return std::nullopt;
  return make_convex_body(*outcome.hull);
}

void demand(bool holds) {
  if (!holds) std::abort();
}

bool ended(LpStatus status) {
  return status == LpStatus::kOptimal || status == LpStatus::kUnbounded;
}

void check(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB) {
  // Sizes are 1e-3 to 0.2 m; slivers may be as thin as 1e-7 of that.
  constexpr double kNear = 1e-9;
  osteon::LpBasis basis, warm_basis;
  const osteon::LpHit hit = lp_test(a, b, X_AB, &basis);
  const osteon::LpDepth depth = lp_depth(a, b, X_AB, &warm_basis);
  demand(ended(hit.status) && depth.status == LpStatus::kOptimal);
  demand(std::abs(depth.nhat_AB_A.norm() - 1) < 1e-9 && std::isfinite(depth.gap));
  if (std::abs(depth.t) > kNear) demand(hit.hit == (depth.t < 0));
  demand(std::abs(lp_depth(b, a, X_AB.inverse()).t - depth.t) < kNear);
  demand(std::abs(lp_depth(a, b, X_AB, &warm_basis).t - depth.t) < kNear);
  Pose moved = X_AB;
  moved.p += (kNear * 10 - depth.gap) * depth.nhat_AB_A;
  demand(!lp_test(a, b, moved, &basis).hit);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  Pose X_AB;
  X_AB.p = std::ldexp(1.0, -11) * bytes.vector();
  const double w = bytes.whole();
  const Vec3 v = bytes.vector();
  const osteon::Quat q(w, v.x(), v.y(), v.z());
  if (q.squaredNorm() > 0) X_AB.q = q.normalized();
  const auto a = read_body(bytes);
  const auto b = read_body(bytes);
  if (a && b) check(*a, *b, X_AB);
  return 0;
}
