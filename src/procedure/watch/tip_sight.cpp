#include "watch/tip_sight.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kSeenFrom_m = 0.08;
constexpr double kTipHides_m = 0.003;  // what is so near to the tip does not hide it

}  // namespace

bool is_tip_seen(const Case& the_case, std::span<const std::optional<ScopeOptics>> optics,
                 std::span<const ToolState* const> tools, std::size_t by_hand,
                 const BoneSnapshot& bones) {
  const Vec3& tip_W = tools[by_hand]->X_WP.p;
  for (std::size_t h = 0; h < std::min(tools.size(), optics.size()); ++h) {
    if (h == by_hand || !optics[h] || tools[h]->portal == kNoPortal) continue;
    const ScopeView view = view_through(*optics[h], tools[h]->X_WP);
    const Vec3 way = tip_W - view.eye_W;
    const double far = way.norm();
    if (!(far > 0) || far > kSeenFrom_m) continue;
    if (way.dot(view.along_W) / far < std::cos(optics[h]->half_field_rad)) continue;
    if (!is_hidden(the_case, bones, view.eye_W, tip_W, kTipHides_m)) return true;
  }
  return false;
}

}  // namespace osteon
