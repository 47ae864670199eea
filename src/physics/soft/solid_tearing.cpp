// What jaws and hooks tear off a solid.
#include <algorithm>

#include "osteon/physics/soft_world.h"
#include "pieces/piece_surroundings.h"
#include "soft/solid_cutting.h"

namespace osteon {
namespace {

// K, not looked up: across its fibres a meniscus tears at 1 to 4 MPa.
constexpr double kTears_pa = 2e6;
constexpr double kPull_n = 0.3;      // who pulls less tears nothing
constexpr double kStrongest_n = 25;  // no jaws of the tray hold so much
constexpr double kHooks_n = 0.5;     // of a hook: it lies on what it presses with a little
constexpr double kLookStep_m = 0.0005, kLookThrough_m = 0.015;
constexpr double kOutside_m = 0.0005;
constexpr double kLiesOn_m = 0.003;   // of bone so near under it a solid lies on it
constexpr double kLookFurther = 1.3;  // so that a pull that rises is not looked at in each look
constexpr std::uint64_t kGraphAfter = 8, kGraphSteps = 15;  // steps without a cut; to make it
constexpr double kInJaws_m = 0.0012;                        // about the place that they hold

}  // namespace

// Wider sections than that force tears are not looked for, or the search would take long.
const std::optional<SolidBridge>& SolidCutting::bridge_at(std::uint32_t s, const Vec3& p_B,
                                                          double force_n) {
  Solid& solid = solids_[s];
  const bool same = solid.bridged == solid.field.step() && solid.bridged_B == p_B;
  if (same && (solid.bridge || force_n <= solid.bridged_n)) return solid.bridge;
  solid.bridged_n = std::min(kStrongest_n, kLookFurther * force_n);
  solid.bridge = solid.bridges->narrowest(solid.field, *solid.loose, p_B, kInJaws_m,
                                          solid.bridged_n / kTears_pa);
  solid.bridged = solid.field.step();
  solid.bridged_B = p_B;
  return solid.bridge;
}

// Ahead of a pull, a little in each step in which nothing is cut: no part of the state.
void SolidCutting::look_ahead(Solid& solid) {
  if (!solid.bridges || solid.field.block_count() == 0) return;
  if (solid.ahead_of != solid.field.step()) {
    solid.ahead_of = solid.field.step();
    solid.ahead = 0;
  }
  if (++solid.ahead < kGraphAfter || solid.ahead > kGraphAfter + kGraphSteps) return;
  (void)solid.bridges->prepare(solid.field, 5 * solid.bridges->layers() / kGraphSteps + 1);
}

// What is whole bears more than jaws hold.
void SolidCutting::pull(std::uint32_t s, std::size_t hand, const Vec3& p_B, double force_n,
                        std::uint64_t step) {
  Solid& solid = solids_[s];
  if (!solid.bridges || step % kSolidLookEvery != 0 || !(force_n > kPull_n)) return;
  if (solid.field.block_count() == 0) return;
  const auto& bridge = bridge_at(s, p_B, force_n);
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

// The way it is pushed, bone or the rest of the solid lies under the place: what is pressed on that
// is not pulled off.
bool SoftWorld::lies_on_something(const SolidNear& near, const BoneSnapshot& bones) const {
  const FieldView field = solids_->view(near.contact.solid);
  const Pose X_WB = solids_->X_WB(near.contact.solid);
  double beyond_m = 0;
  for (double way_m = kLookStep_m; way_m < kLookThrough_m; way_m += kLookStep_m) {
    const Vec3 p_B = near.contact.p_B - way_m * near.contact.nhat_B;
    if (field.at(p_B).distance < 0) {
      if (beyond_m > 0) return true;
      continue;
    }
    // The place itself may lie a little outside.
    beyond_m += way_m > kOutside_m ? kLookStep_m : 0;
    if (beyond_m > kLiesOn_m) return false;
    const Vec3 p_W = X_WB * p_B;
    for (std::size_t b = 0; b < setup_->pieces->bones.size() && b < bones.count; ++b)
      if (push_of(setup_->pieces->bones[b], bones.bones[b].X_WB.inverse() * p_W).depth_m > 0)
        return true;
  }
  return false;
}

// What a blunt part presses, and nothing holds up, is pulled as by jaws, from the place that it
// presses.
void SoftWorld::hook_solids(std::size_t h, const SolidHand& with, const BoneSnapshot& bones) {
  if (bones.step % kSolidLookEvery != 0) return;
  const SolidHandState& state = state_.solid_hands[h];
  const std::uint32_t instrument = state.instrument;
  if (instrument < setup_->cutters.size() && setup_->cutters[instrument]) return;
  for (std::uint32_t i = 0; i < state.count; ++i) {
    const SolidNear& near = state.near[i];
    if (near.contact.solid == with.held || !(near.force_n > kHooks_n)) continue;
    if (!cutting_->is_cut(near.contact.solid) || lies_on_something(near, bones)) continue;
    cutting_->pull(near.contact.solid, h, near.contact.p_B, near.force_n, bones.step);
  }
}

}  // namespace osteon
