#include "osteon/haptic/haptic_state.h"

#include "osteon/base/hash.h"

namespace osteon {

std::uint64_t hash_of(const HapticState& s) {
  Hasher h;
  h.add(s.tool.tick);
  h.add(s.tool.X_WD);
  h.add(s.tool.X_WP);
  h.add(s.tool.force_W);
  h.add(s.tool.buttons);
  h.add(s.tool.status);
  h.add(s.armed);
  h.add(s.sliding);
  h.add(s.carrier.index);
  h.add(s.grabbing);
  h.add(s.p_WG);
  h.add(s.fade_n);
  if (s.rub.sliding || !s.rub.lag_W.isZero(0)) {
    h.add(s.rub.lag_W);
    h.add(s.rub.sliding);
  }
  h.add(s.tool.epoch);
  h.add(s.tool.instrument);
  h.add(s.tool.power);
  h.add(s.tool.jaw);
  for (const OtherTool& other : s.others) {
    h.add(other.tick);
    if (other.tick == 0) continue;
    h.add(other.instrument);
    h.add(other.p_WD);
    h.add(other.X_WP);
    h.add(other.v_W);
  }
  if (s.portal.portal != kNoPortal || s.portal.nearest != kNoPortal || s.portal.grip > 0) {
    h.add(s.tool.portal);
    h.add(s.portal.portal);
    h.add(s.portal.anchor_m);
    h.add(s.portal.sliding);
    h.add(s.portal.grip);
    h.add(s.portal.tip_depth_m);
    h.add(s.portal.nearest);
    h.add(s.tool.p_portal_W);
    h.add(s.tool.portal_way);
  }
  for (std::uint32_t i = 0; i < s.bone_count; ++i) h.add(s.X_WB[i]);
  for (const PairMemory& pair : s.pairs) {
    if (pair.pair == PairMemory::kNone) break;
    h.add(pair.pair);
    h.add(pair.basis.count);
    for (std::uint8_t i = 0; i < pair.basis.count; ++i) h.add(pair.basis.rows[i]);
    h.add(pair.known);
    if (!pair.known) continue;
    h.add(pair.plane.nhat_BT_B);
    h.add(pair.plane.bone_support);
    h.add(pair.plane.p_B);
  }
  return h.value();
}

}  // namespace osteon
