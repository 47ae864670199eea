#include "tool_walls.h"

#include <algorithm>

#include "osteon/collide/round_box.h"
#include "osteon/scene/tool_rods.h"

namespace osteon {
namespace {

// Tools farther apart than both hands may bring them together in a tick, and this, do not meet, m.
constexpr double kRoom_m = 0.002;

}  // namespace

ToolWalls::ToolWalls(const Tool& own, std::span<const std::shared_ptr<const Tool>> tray)
    : own_(parts_of(own)) {
  std::size_t most = 0;
  for (const auto& tool : tray) {
    tray_.push_back(parts_of(*tool));
    most = std::max(most, tray_.back().size());
  }
  middles_W_.resize(most);
}

std::vector<ToolWalls::Part> ToolWalls::parts_of(const Tool& tool) {
  std::vector<Part> parts;
  for (const RoundBox& box : tool_shapes(tool))
    parts.push_back({box, middle_of(box), reach_of(box)});
  return parts;
}

void ToolWalls::start(const OtherTools& before, const OtherTools& now, const Pose& X_WT,
                      const Vec3& to_hand_W) {
  find(before, now, X_WT, to_hand_W);
}

void ToolWalls::look(const OtherTools& now, const Pose& X_WT, const Vec3& to_hand_W) {
  find(now, now, X_WT, to_hand_W);
}

void ToolWalls::find(const OtherTools& line_from, const OtherTools& now, const Pose& X_WT,
                     const Vec3& to_hand_W) {
  count_ = 0;
  for (std::uint32_t hand = 0; hand < now.size(); ++hand) {
    if (now[hand].tick == 0 || now[hand].instrument >= tray_.size()) continue;
    const bool known =
        line_from[hand].tick != 0 && line_from[hand].instrument == now[hand].instrument;
    meet(hand, known ? line_from[hand] : now[hand], now[hand], X_WT, to_hand_W);
  }
}

// Along n, the unit vector from the other's part to this one: where the two hands want the parts'
// surfaces is `mine` and `theirs`, and the wall stands between the two. Most parts are far apart:
// the balls about them say so before anything is put in its place.
void ToolWalls::meet(std::uint32_t hand, const OtherTool& line_from, const OtherTool& now,
                     const Pose& X_WT, const Vec3& to_hand_W) {
  const Vec3 to_their_hand_W = now.p_WD - now.X_WP.p;
  const double nearby = to_hand_W.norm() + to_their_hand_W.norm() + kRoom_m;
  const std::vector<Part>& others = tray_[now.instrument];
  for (std::size_t k = 0; k < others.size(); ++k) middles_W_[k] = now.X_WP * others[k].middle_T;
  for (std::uint32_t r = 0; r < own_.size(); ++r) {
    const Vec3 middle_W = X_WT * own_[r].middle_T;
    for (std::size_t k = 0; k < others.size(); ++k) {
      const double reach = own_[r].reach_m + others[k].reach_m + nearby;
      if ((middle_W - middles_W_[k]).squaredNorm() > reach * reach) continue;
      const RoundBox& part = others[k].box;
      const RoundBox mine_W = placed(X_WT, own_[r].box), theirs_W = placed(now.X_WP, part);
      const AxisPoints line = nearest_on_cores(mine_W, placed(line_from.X_WP, part));
      const Vec3 apart = line.a - line.b;
      const double distance = apart.norm();
      if (!(distance > 0)) continue;
      const Vec3 n = apart / distance;
      const double low = lowest(mine_W, n);
      const double high = highest(theirs_W, n);
      if (low - high > nearby) continue;
      const double mine = low + n.dot(to_hand_W);
      const double theirs = high + n.dot(to_their_hand_W);
      keep({hand, r, low - high, 0.5 * (mine + theirs), n, line.a - mine_W.rod.radius * n});
    }
  }
}

// The nearest ones stay, in the order of their gaps.
void ToolWalls::keep(const Wall& wall) {
  std::uint32_t at = count_;
  while (at > 0 && wall.gap < walls_[at - 1].gap) --at;
  if (at == kMostPlanes) return;
  count_ = std::min<std::uint32_t>(count_ + 1, kMostPlanes);
  for (std::uint32_t i = count_ - 1; i > at; --i) walls_[i] = walls_[i - 1];
  walls_[at] = wall;
}

void ToolWalls::raise(const Quat& q_WT, std::span<FreeHalfSpace> out) const {
  for (std::uint32_t i = 0; i < count_; ++i) {
    const Wall& wall = walls_[i];
    const Vec3 n_T = q_WT.conjugate() * wall.n_W;
    out[i] = {wall.n_W, wall.level - lowest(own_[wall.part].box, n_T)};
  }
}

}  // namespace osteon
