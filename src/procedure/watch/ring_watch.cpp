#include "osteon/procedure/ring_watch.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kSame_m = 0.00005;  // between two looks: it has not moved
constexpr double kOnGround_m = 0.0005;

std::uint8_t nearest_hand(std::span<const ToolState* const> tools, const Vec3& p_W) {
  std::uint8_t best = kNoHand;
  double least = 1e9;
  for (std::size_t h = 0; h < tools.size(); ++h) {
    const double off = (tools[h]->X_WP.p - p_W).norm();
    if (!(off < least)) continue;
    least = off;
    best = static_cast<std::uint8_t>(h);
  }
  return best;
}

}  // namespace

RingWatch::RingWatch(const Case& the_case, double tick_s)
    : set_(find_rings(the_case)),
      stride_(static_cast<std::uint64_t>(std::max(1.0, std::round(0.01 / tick_s)))),
      still_ticks_(static_cast<std::uint64_t>(std::llround(kStill_s / tick_s))) {
  for (const RingShape& ring : set_.rings) {
    const Vec3 center_W = the_case.bones[ring.bone].X_WB * ring.center_B;
    centers_W_.push_back(center_W);
    rings_.push_back({true, center_W, center_W, 0});
  }
}

void RingWatch::follow(std::size_t i, std::span<const ToolState* const> tools,
                       std::vector<Event>& out) {
  Followed& ring = rings_[i];
  const std::uint64_t tick = tools[0]->tick;
  const Vec3& now_W = centers_W_[i];
  if ((now_W - ring.at_W).norm() > kSame_m) ring.moved_tick = tick;
  ring.at_W = now_W;
  double what = -1;
  if (ring.lies && (now_W - ring.lay_W).norm() > kTaken_m) {
    what = 0;
  } else if (!ring.lies && tick - ring.moved_tick >= still_ticks_ &&
             now_W.z() - rest_height_m(set_, i, now_W, centers_W_) < kOnGround_m) {
    what = peg_in_ring(set_, set_.rings[i], now_W) ? 1 : 2;
    ring.lay_W = now_W;
  }
  if (what < 0) return;
  ring.lies = what > 0;
  Event made;
  made.tick = tick;
  made.kind = kRingMoved;
  made.hand = nearest_hand(tools, now_W);
  made.subject_kind = SubjectKind::kBone;
  made.subject = set_.rings[i].bone;
  made.p_W = ring.lay_W;
  made.values = {what, 0, 0};
  out.push_back(made);
}

void RingWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                    std::vector<Event>& out) {
  if (rings_.empty() || tools.empty() || tools[0]->tick % stride_ != 0) return;
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    const RingShape& ring = set_.rings[i];
    if (ring.bone < bones.count && is_finite(bones.bones[ring.bone].X_WB))
      centers_W_[i] = bones.bones[ring.bone].X_WB * ring.center_B;
  }
  for (std::size_t i = 0; i < rings_.size(); ++i) follow(i, tools, out);
}

}  // namespace osteon
