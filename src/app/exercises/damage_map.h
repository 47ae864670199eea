#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What an attempt leaves on surfaces.
enum class DamageKind { kForce, kScratch, kHeat };
inline constexpr std::array kDamageKinds = {DamageKind::kForce, DamageKind::kScratch,
                                            DamageKind::kHeat};

/// A place of a bone's surface, about 0.5 mm wide, with what it bore. In Bone.
struct DamageSpot {
  Vec3 p_B = Vec3::Zero();
  Vec3 n_B = Vec3::Zero();  ///< outwards; zero: only heated
  double force_n = 0;       ///< the greatest
  double scratch_nmm = 0;   ///< force times the way that a tool slid under it, summed
  double heat_c = 0;        ///< the greatest; 0: not followed
  double of(DamageKind kind) const;
};
/// Where a map shows nothing, and where it shows its full colour: N, N mm, degrees Celsius.
struct DamageScale {
  double none = 0, full = 1;
  std::string_view title, unit;
};
const DamageScale& scale_of(DamageKind kind);
/// 0..1 on that scale.
double share_of(DamageKind kind, double value);

/// By bone of the case.
using DamageMap = std::vector<std::vector<DamageSpot>>;

/// Whether anything of that kind would be seen.
bool shows_damage(const DamageMap& map, DamageKind kind);

/// 0..1 at points of a bone's surface, in Bone: full within 0.5 mm of a spot, none from 1.2 mm on.
std::vector<float> damage_at(std::span<const DamageSpot> spots, DamageKind kind,
                             std::span<const std::array<float, 3>> points_B);

/// Gathers a map, tick by tick of each hand. A function of tools and bones alone.
class DamageMaker {
 public:
  DamageMaker(const Case& the_case, std::size_t hands);
  void touch(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones);
  /// A place of a bone's surface is so warm now.
  void warm(std::uint32_t bone, const Vec3& p_B, double celsius);
  DamageMap finish() const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Before {  ///< of a hand, a tick ago
    bool known = false;
    std::uint32_t epoch = 0, instrument = 0;
    Pose X_WP;
    std::array<Pose, kMaxBones> X_WB{};
  };
  DamageSpot* spot(std::uint32_t bone, const Vec3& p_B);

  std::vector<std::map<Cell, DamageSpot>> bones_;
  std::vector<Before> before_;
};

}  // namespace osteon
