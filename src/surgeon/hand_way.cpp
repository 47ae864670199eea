#include "hand_way.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace osteon {
namespace {

constexpr int kRoundSteps = 6;  // of each part of a way round
// A command comes at the end of what was done before it.
constexpr double kSaid_s = 0.02, kJaw_s = 0.4;

// Over the great circle, the last of them `to`.
void lead_on(const Vec3& from, const Vec3& to, std::vector<Vec3>& out) {
  for (int i = 1; i <= kRoundSteps; ++i) {
    const double share = static_cast<double>(i) / kRoundSteps;
    out.push_back(((1 - share) * from + share * to).normalized());
  }
}

// Cosine of the least angle between a way and the bones.
double nearness(const std::vector<Vec3>& way, const std::vector<Vec3>& bones) {
  double most = -1;
  for (const Vec3& at : way)
    for (const Vec3& bone : bones) most = std::max(most, at.dot(bone));
  return most;
}

}  // namespace

RoundJoint round_joint(const Case& the_case, const BoneSnapshot& bones, const Vec3& middle_W) {
  constexpr double kFar_m = 0.15;
  constexpr std::size_t kEach = 20;  // of the vertices
  RoundJoint out{middle_W, {}};
  for (std::size_t b = 0; b < the_case.bones.size() && b < bones.count; ++b) {
    if (the_case.bones[b].beside) continue;
    const std::vector<Vec3>& vertices = the_case.bones[b].mesh.vertices;
    for (std::size_t v = 0; v < vertices.size(); v += kEach) {
      const Vec3 way = bones.bones[b].X_WB * vertices[v] - middle_W;
      if (way.norm() > kFar_m) out.bones.push_back(way.normalized());
    }
  }
  return out;
}

std::vector<Vec3> way_round(const Vec3& from, const Vec3& to, const std::vector<Vec3>& bones) {
  constexpr double kFarEnough = 0.82;  // cosine of 35 degrees
  constexpr int kDetours = 16;
  std::vector<Vec3> best;
  lead_on(from, to, best);
  double least = nearness(best, bones);
  if (least < kFarEnough) return best;
  const Vec3 apart = to - from;
  const Vec3 axis = apart.norm() > 1e-6 ? Vec3(apart.normalized()) : Vec3(from.unitOrthogonal());
  const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
  for (int k = 0; k < kDetours; ++k) {
    const double angle = 2 * std::numbers::pi * k / kDetours;
    const Vec3 over = std::cos(angle) * x + std::sin(angle) * y;
    std::vector<Vec3> way;
    lead_on(from, over, way);
    lead_on(over, to, way);
    const double near = nearness(way, bones);
    if (!(near < least - 1e-9)) continue;
    least = near;
    best = std::move(way);
  }
  return best;
}

HandWay::HandWay(const std::string& instrument, const Pose& X, double pace) : pace_(pace) {
  path_.with_instruments = true;
  at_.X_WD = X;
  at_.instrument = instrument;
  path_.samples.push_back(at_);
}

void HandWay::go(const Pose& X, double m_per_s) {
  const double seconds = (X.p - at_.X_WD.p).norm() / (m_per_s * pace_);
  at_.X_WD = X;
  stay(std::max(seconds, 0.05));
}

void HandWay::stay(double seconds) {
  at_.time_s += seconds;
  path_.samples.push_back(at_);
}

void HandWay::take(const std::string& instrument, double size_mm) {
  stay(0.2);
  at_.instrument = instrument;
  at_.size_mm = size_mm;
  at_.jaw = at_.power = 0;
  path_.samples.back() = at_;
  stay(0.3);
}

void HandWay::power(double share) {
  stay(kSaid_s);
  at_.power = share;
  path_.samples.back().power = share;
  stay(0.2);
}

void HandWay::jaw(double open) {
  stay(kSaid_s);
  at_.jaw = open;
  path_.samples.back().jaw = open;
  stay(kJaw_s);
}

void change_round(HandWay& way, const RoundJoint& joint, const std::string& instrument,
                  const Vec3& to_W, const Vec3& back_W) {
  const Vec3 from = (way.pose().p - joint.middle_W).normalized();
  const Vec3 to = (to_W - joint.middle_W).normalized();
  way.go({joint.middle_W + kRound_m * from, way.pose().q}, kHandCarry_m_per_s);
  way.take(instrument);
  for (const Vec3& out : way_round(from, to, joint.bones))
    way.go(held_by_shaft(joint.middle_W + kRound_m * out, out), kHandCarry_m_per_s);
  way.go(held_by_shaft(to_W, back_W), kHandCarry_m_per_s);
}

}  // namespace osteon
