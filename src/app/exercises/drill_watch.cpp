#include "exercises/drill_watch.h"

#include <algorithm>
#include <utility>

#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

constexpr double kDrillWatchHz = 100, kFreeFor_s = 0.5;
constexpr double kThick_m = 0.004;      // a drill; what is thinner is a pin
constexpr double kDeep_m = 0.003;       // so deep a drill without a pin has begun a tunnel
constexpr double kOnPin_m = 0.003;      // so near its line a drill is on a pin
constexpr double kNearBone_m = 0.0005;  // a tip this near a bone drills it
constexpr double kMore_m = 0.001;       // farther beyond than told

Event drill_told(const ToolState& tool, std::size_t hand, EventKind kind, std::uint32_t bone,
                 double value) {
  return {tool.tick,   kind,         static_cast<std::uint8_t>(hand), SubjectKind::kBone, bone,
          tool.X_WP.p, {value, 0, 0}};
}

bool is_on_pin(const BoneSnapshot& bones, std::uint32_t bone, const Vec3& p_B) {
  return std::any_of(bones.rods.begin(), bones.rods.end(), [&](const GuideRod& rod) {
    if (rod.kind != GuideRod::Kind::kPin || rod.bone != bone) return false;
    const Vec3 out = rod.X_BR.q * Vec3::UnitZ(), off = p_B - rod.X_BR.p;
    return (off - off.dot(out) * out).norm() < kOnPin_m;
  });
}

bool has_pin(const BoneSnapshot& bones, std::uint32_t bone) {
  return std::any_of(bones.rods.begin(), bones.rods.end(), [&](const GuideRod& rod) {
    return rod.kind == GuideRod::Kind::kPin && rod.bone == bone;
  });
}

}  // namespace

DrillWatch::DrillWatch(const Case& the_case, const Bones& bones, std::vector<double> widths_m,
                       double tick_s, std::size_t hands)
    : case_(&the_case),
      bones_(bones),
      widths_m_(std::move(widths_m)),
      tick_s_(tick_s),
      stride_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(1 / (kDrillWatchHz * tick_s) + 0.5))) {
  for (Bone& bone : watched_) bone.hands.resize(hands);
}

const MeshDistance& DrillWatch::whole(std::size_t bone) {
  auto& of = watched_[bone].whole;
  if (!of) of.emplace(case_->bones[bones_[bone]].mesh);
  return *of;
}

void DrillWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                     std::vector<Event>& out) {
  for (std::size_t k = 0; k < kBones; ++k)
    if (bones_[k] < bones.count) watched_[k].pinned = has_pin(bones, bones_[k]);
  for (std::size_t h = 0; h < std::min(tools.size(), watched_[0].hands.size()); ++h) {
    const ToolState& tool = *tools[h];
    now_ = std::max(now_, tool.tick);
    const bool drills = tool.instrument < widths_m_.size() && widths_m_[tool.instrument] > 0 &&
                        is_finite(tool.X_WP);
    for (std::size_t k = 0; k < kBones; ++k) {
      if (bones_[k] >= bones.count) continue;
      if (!drills || !(tool.power > 0))
        watched_[k].hands[h] = {};
      else if (tool.tick % stride_ == 0)
        look(k, h, tool, bones, out);
    }
  }
}

// A tunnel is begun: told of every landmark, once for each bone.
void DrillWatch::begin(std::size_t bone, std::size_t hand, const ToolState& tool,
                       std::vector<Event>& out) {
  if (std::exchange(watched_[bone].begun, true)) return;
  for (std::uint32_t mark = 0; mark < case_->landmarks.size(); ++mark)
    out.push_back({tool.tick,
                   kTunnelBegun,
                   static_cast<std::uint8_t>(hand),
                   SubjectKind::kLandmark,
                   mark,
                   tool.X_WP.p,
                   {}});
}

void DrillWatch::look(std::size_t bone, std::size_t hand, const ToolState& tool,
                      const BoneSnapshot& bones, std::vector<Event>& out) {
  Bone& of = watched_[bone];
  Drilling& drilling = of.hands[hand];
  const Pose X_BT = bones.bones[bones_[bone]].X_WB.inverse() * tool.X_WP;
  const double away_m = whole(bone).closest(X_BT.p).signed_distance;
  if (!drilling.inside && away_m > kNearBone_m) return;
  of.busy_tick = tool.tick;
  const bool thick = widths_m_[tool.instrument] >= kThick_m;
  if (away_m < 0) {
    begin(bone, hand, tool, out);
    of.drilled = of.drilled || thick;
    if (!drilling.inside) drilling.entered_B = X_BT.p;
    drilling.inside = true;
    drilling.inside_B = X_BT.p;
    // Beside an old tunnel no place is far from a surface: the way counts.
    const double way_m = (drilling.entered_B - X_BT.p).dot(X_BT.q * Vec3::UnitZ());
    if (thick && way_m > kDeep_m && !std::exchange(of.told_deep, true))
      out.push_back(drill_told(tool, hand, kBoneDrilled, bones_[bone], 0));
    if (thick && away_m < -kDeep_m && !of.told_free && !is_on_pin(bones, bones_[bone], X_BT.p)) {
      of.told_free = true;
      out.push_back(drill_told(tool, hand, kDrilledFree, bones_[bone], -1e3 * away_m));
    }
    return;
  }
  if (!drilling.inside || !thick) return;
  const double beyond_m = (drilling.inside_B - X_BT.p).dot(X_BT.q * Vec3::UnitZ());
  if (beyond_m < drilling.told_m + kMore_m) return;
  drilling.told_m = beyond_m;
  out.push_back(drill_told(tool, hand, kDrillPlunged, bones_[bone], 1e3 * beyond_m));
}

bool DrillWatch::take_done(std::size_t bone) {
  const Bone& of = watched_[bone];
  if (!of.drilled || of.pinned || now_ % stride_ != 0) return false;
  if (static_cast<double>(now_ - of.busy_tick) * tick_s_ < kFreeFor_s) return false;
  return take_drilled(bone);
}

void DrillWatch::look_again(std::size_t bone) {
  watched_[bone].drilled = true;
  watched_[bone].busy_tick = now_;
}

bool DrillWatch::take_drilled(std::size_t bone) {
  return std::exchange(watched_[bone].drilled, false);
}

}  // namespace osteon
