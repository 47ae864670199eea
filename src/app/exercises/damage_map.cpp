// Force and heat of a spot are the greatest that it bore. A scratch is work: at each tick the force
// of a contact times the way that the tool's own material slid over the bone there. That way is not
// how far the contact moved: contacts jump from piece to piece of a bone, and roll. It is how far
// the point of the tool that touches moved against the bone since the tick before, without its part
// along the normal.
#include "exercises/damage_map.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kSpot_m = 0.0005;
constexpr double kFullWithin_m = 0.0005, kNoneFrom_m = 0.0012;
constexpr double kSeen = 0.02;        // of a scale: less is not seen
constexpr double kFastest_m = 0.002;  // a tick: farther is a jump, of an exchange or a restore

std::array<std::int32_t, 3> cell_of(const Vec3& p, double side_m) {
  return {static_cast<std::int32_t>(std::floor(p.x() / side_m)),
          static_cast<std::int32_t>(std::floor(p.y() / side_m)),
          static_cast<std::int32_t>(std::floor(p.z() / side_m))};
}

float weight(double far_m) {
  return static_cast<float>(
      std::clamp((kNoneFrom_m - far_m) / (kNoneFrom_m - kFullWithin_m), 0.0, 1.0));
}

}  // namespace

double DamageSpot::of(DamageKind kind) const {
  return kind == DamageKind::kForce ? force_n : kind == DamageKind::kScratch ? scratch_nmm : heat_c;
}

// Force and scratch: the limits of the shipped exercises (4 N; 2 N over 2 mm). Heat: where bone
// dies within a minute.
const DamageScale& scale_of(DamageKind kind) {
  static constexpr DamageScale kScales[] = {
      {0, 4, "Force", "N"}, {0, 4, "Scratches, force times way", "N mm"}, {37, 47, "Heat", "C"}};
  return kScales[static_cast<std::size_t>(kind)];
}

double share_of(DamageKind kind, double value) {
  const DamageScale& scale = scale_of(kind);
  return std::clamp((value - scale.none) / (scale.full - scale.none), 0.0, 1.0);
}

bool shows_damage(const DamageMap& map, DamageKind kind) {
  for (const auto& spots : map)
    for (const DamageSpot& spot : spots)
      if (share_of(kind, spot.of(kind)) > kSeen) return true;
  return false;
}

std::vector<float> damage_at(std::span<const DamageSpot> spots, DamageKind kind,
                             std::span<const std::array<float, 3>> points_B) {
  std::multimap<std::array<std::int32_t, 3>, const DamageSpot*> near;
  for (const DamageSpot& spot : spots)
    if (share_of(kind, spot.of(kind)) > 0) near.emplace(cell_of(spot.p_B, kNoneFrom_m), &spot);
  std::vector<float> shares(points_B.size(), 0);
  if (near.empty()) return shares;
  for (std::size_t i = 0; i < points_B.size(); ++i) {
    const Vec3 p_B(points_B[i][0], points_B[i][1], points_B[i][2]);
    const auto cell = cell_of(p_B, kNoneFrom_m);
    for (int k = 0; k < 27; ++k) {
      const std::array<std::int32_t, 3> beside = {cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1,
                                                  cell[2] + k / 9 - 1};
      const auto [from, to] = near.equal_range(beside);
      for (auto it = from; it != to; ++it)
        shares[i] =
            std::max(shares[i], weight((it->second->p_B - p_B).norm()) *
                                    static_cast<float>(share_of(kind, it->second->of(kind))));
    }
  }
  return shares;
}

DamageMaker::DamageMaker(const Case& the_case, std::size_t hands)
    : bones_(the_case.bones.size()), before_(hands) {}

DamageSpot* DamageMaker::spot(std::uint32_t bone, const Vec3& p_B) {
  if (bone >= bones_.size() || !is_finite(p_B)) return nullptr;
  const auto [it, made] = bones_[bone].try_emplace(cell_of(p_B, kSpot_m));
  if (made) it->second.p_B = p_B;
  return &it->second;
}

void DamageMaker::touch(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones) {
  if (hand >= before_.size() || !is_finite(tool.X_WP)) return;
  Before& before = before_[hand];
  const bool follows =
      before.known && before.epoch == tool.epoch && before.instrument == tool.instrument;
  for (std::size_t i = 0; i < std::min<std::size_t>(tool.contact_count, kMaxContacts); ++i) {
    const Contact& contact = tool.contacts[i];
    const std::uint32_t b = contact.bone.index;
    const double force_n = contact.force_on_tool_W.norm();
    if (b >= bones.count || !(force_n > 0) || !std::isfinite(force_n)) continue;
    const Pose& X_WB = bones.bones[b].X_WB;
    const Vec3 p_B = X_WB.inverse() * contact.p_W;
    const Vec3 n_B = X_WB.inverse().rotate(contact.nhat_BT_W);
    DamageSpot* const at = spot(b, p_B);
    if (!at) continue;
    at->n_B = n_B;
    at->force_n = std::max(at->force_n, force_n);
    if (!follows) continue;
    const Vec3 was_B =
        before.X_WB[b].inverse() * (before.X_WP * (tool.X_WP.inverse() * contact.p_W));
    const Vec3 moved_B = p_B - was_B;
    const double slid_m = (moved_B - moved_B.dot(n_B) * n_B).norm();
    if (slid_m < kFastest_m) at->scratch_nmm += force_n * slid_m * 1000;
  }
  before.known = true;
  before.epoch = tool.epoch;
  before.instrument = tool.instrument;
  before.X_WP = tool.X_WP;
  for (std::size_t b = 0; b < std::min<std::size_t>(bones.count, kMaxBones); ++b)
    before.X_WB[b] = bones.bones[b].X_WB;
}

void DamageMaker::warm(std::uint32_t bone, const Vec3& p_B, double celsius) {
  if (!(share_of(DamageKind::kHeat, celsius) > kSeen)) return;
  if (DamageSpot* const at = spot(bone, p_B)) at->heat_c = std::max(at->heat_c, celsius);
}

DamageMap DamageMaker::finish() const {
  DamageMap map(bones_.size());
  for (std::size_t b = 0; b < bones_.size(); ++b)
    for (const auto& [cell, spot] : bones_[b]) map[b].push_back(spot);
  return map;
}

}  // namespace osteon
