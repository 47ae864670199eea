// What jaws tear off a solid.
#include "soft/solid_cutting.h"

namespace osteon {
namespace {

// K, not looked up: across its fibres a meniscus tears at 1 to 4 MPa.
constexpr double kTears_pa = 2e6;
constexpr double kPull_n = 0.3;       // who pulls less tears nothing
constexpr double kStrongest_n = 25;   // no jaws of the tray hold so much
constexpr double kInJaws_m = 0.0012;  // about the place that they hold

}  // namespace

const std::optional<SolidBridge>& SolidCutting::bridge_at(std::uint32_t s, const Vec3& p_B) {
  Solid& solid = solids_[s];
  if (solid.bridged == solid.field.step() && solid.bridged_B == p_B) return solid.bridge;
  solid.bridge =
      solid.bridges->narrowest(solid.field, *solid.loose, p_B, kInJaws_m, kStrongest_n / kTears_pa);
  solid.bridged = solid.field.step();
  solid.bridged_B = p_B;
  return solid.bridge;
}

// What is whole bears more than jaws hold.
void SolidCutting::pull(std::uint32_t s, std::size_t hand, const Vec3& p_B, double force_n,
                        std::uint64_t step) {
  Solid& solid = solids_[s];
  if (!solid.bridges || step % kSolidLookEvery != 0 || !(force_n > kPull_n)) return;
  if (solid.field.block_count() == 0) return;
  const auto& bridge = bridge_at(s, p_B);
  if (!bridge || !(force_n > kTears_pa * bridge->area_m2)) return;
  if (news_.size() < news_.capacity()) {
    News news;
    news.solid = s;
    news.hand = hand;
    news.torn = true;
    news.force_n = force_n;
    news.holds_n = kTears_pa * bridge->area_m2;
    news.p_B = bridge->middle_B;
    news_.push_back(std::move(news));
  }
  for (const Vec3& middle_B : bridge->middles_B) {
    const Pose X{middle_B, Quat::Identity()};
    (void)solid.field.cut(rip_, X, X);
  }
  catch_up(s);
}

}  // namespace osteon
