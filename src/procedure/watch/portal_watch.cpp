#include "osteon/procedure/portal_watch.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "osteon/procedure/judge.h"
#include "osteon/scene/marks_now.h"
#include "osteon/scene/portal.h"
#include "watch/tip_sight.h"

namespace osteon {
namespace {

constexpr double kSamePlace_m = 1e-6;
// A needle counts from so deep under the skin, so near its landmark, and not along the skin.
constexpr double kNeedleDeep_m = 0.008, kNeedleNear_m = 0.02, kNeedleSlope = 0.2;

std::optional<Vec3> place_of(const Case& the_case, std::string_view name) {
  const auto at = find_landmark(the_case, name);
  return at ? std::optional<Vec3>(the_case.landmarks[*at].p_W) : std::nullopt;
}

Event of_portal(const ToolState& tool, std::size_t hand, std::uint32_t mark, EventKind kind) {
  Event event;
  event.tick = tool.tick;
  event.kind = kind;
  event.hand = static_cast<std::uint8_t>(hand);
  event.subject_kind = SubjectKind::kLandmark;
  event.subject = mark;
  event.p_W = tool.p_portal_W;
  return event;
}

}  // namespace

// Symbols: m, to the other portal; n, out of the skin; u, from the tubercle.
std::optional<PortalFrame> portal_frame(const Case& the_case, std::uint32_t landmark) {
  if (landmark >= the_case.landmarks.size()) return std::nullopt;
  const std::string& name = the_case.landmarks[landmark].name;
  if (name != "portal_al" && name != "portal_am") return std::nullopt;
  const auto other = place_of(the_case, name == "portal_al" ? "portal_am" : "portal_al");
  const auto tubercle = place_of(the_case, "tibial_tubercle");
  if (!other || !tubercle) return std::nullopt;
  PortalFrame out;
  for (const Portal& portal : find_portals(the_case))
    if (portal.landmark == landmark) out.in_W = portal.nhat_W;
  out.p_W = the_case.landmarks[landmark].p_W;
  const auto along_skin = [&](const Vec3& v) { return Vec3(v - v.dot(out.in_W) * out.in_W); };
  const Vec3 m = along_skin(*other - out.p_W);
  if (!(m.norm() > 0)) return std::nullopt;
  out.middle_W = m.normalized();
  const Vec3 u = along_skin(out.p_W - *tubercle);
  const Vec3 up = u - u.dot(out.middle_W) * out.middle_W;
  if (!(up.norm() > 0)) return std::nullopt;
  out.up_W = up.normalized();
  return out;
}

PortalWatch::PortalWatch(const Case& the_case, Settings settings)
    : case_(&the_case), settings_(std::move(settings)), told_(settings_.marks.size()) {
  for (const std::uint32_t mark : settings_.marks) frames_.push_back(portal_frame(the_case, mark));
}

// One that was made anew after a restore point is told again, one that the restore point has kept
// is not.
bool PortalWatch::is_news(const ToolState& tool) {
  Told& told = told_[tool.portal];
  const bool same =
      told.any && (told.epoch == tool.epoch || (told.p_W - tool.p_portal_W).norm() < kSamePlace_m);
  told = {true, tool.epoch, tool.p_portal_W};
  return !same;
}

bool PortalWatch::is_seen(std::span<const ToolState* const> tools, std::size_t by_hand,
                          const BoneSnapshot& bones) const {
  return is_tip_seen(*case_, settings_.optics, tools, by_hand, bones);
}

// Its hole is where its axis goes through the skin about the nearest landmark.
std::optional<PortalWatch::Needle> PortalWatch::needle_at(const ToolState& tool,
                                                          const BoneSnapshot& bones) const {
  std::optional<Needle> best;
  double nearest = kNeedleNear_m;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (!frames_[i]) continue;
    const PortalFrame& frame = *frames_[i];
    const Pose X_WP = moved_from_rest(*case_, settings_.marks[i], bones).inverse() * tool.X_WP;
    const Vec3 back = X_WP.rotate(Vec3::UnitZ());
    const double deep = frame.in_W.dot(X_WP.p - frame.p_W), slope = -frame.in_W.dot(back);
    if (deep < kNeedleDeep_m || slope < kNeedleSlope) continue;
    const Vec3 off = X_WP.p + deep / slope * back - frame.p_W;
    if (!(off.norm() < nearest)) continue;
    nearest = off.norm();
    best = Needle{settings_.marks[i], {0, off.dot(frame.up_W), off.dot(frame.middle_W)}};
  }
  return best;
}

void PortalWatch::follow_needle(std::span<const ToolState* const> tools, std::size_t hand,
                                const BoneSnapshot& bones, std::vector<Event>& out) {
  const ToolState& tool = *tools[hand];
  needle_told_.resize(std::max(needle_told_.size(), tools.size()), 0);
  const bool held = tool.instrument < needles_.size() && needles_[tool.instrument] != 0;
  const auto needle = held && is_finite(tool.X_WP) ? needle_at(tool, bones) : std::nullopt;
  int& told = needle_told_[hand];
  if (!needle) {
    told = 0;
    return;
  }
  const bool seen = told < 2 && is_seen(tools, hand, bones);
  const int now = std::max(told, seen ? 2 : 1);
  if (now == std::exchange(told, now)) return;
  std::erase_if(needle_holes_, [&](const Needle& known) { return known.mark == needle->mark; });
  needle_holes_.push_back(*needle);
  out.push_back(of_portal(tool, hand, needle->mark, kNeedleIn));
  out.back().p_W = tool.X_WP.p;
  out.back().values = {1e3 * needle->off_F.y(), 1e3 * needle->off_F.z(), seen ? 1.0 : 0.0};
}

std::optional<double> PortalWatch::from_needle(const MadePortalFound& portal) const {
  for (const Needle& needle : needle_holes_)
    if (needle.mark == portal.landmark)
      return std::hypot(portal.off_F.y() - needle.off_F.y(), portal.off_F.z() - needle.off_F.z());
  return std::nullopt;
}

void PortalWatch::keep(const MadePortalFound& portal) {
  const auto same = std::find_if(found_.begin(), found_.end(), [&](const MadePortalFound& known) {
    return known.landmark == portal.landmark;
  });
  if (same == found_.end())
    found_.push_back(portal);
  else
    *same = portal;
}

void PortalWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                      std::vector<Event>& out) {
  for (std::size_t h = 0; h < tools.size(); ++h) {
    const ToolState& tool = *tools[h];
    follow_needle(tools, h, bones, out);
    if (tool.portal_way == 0 || tool.portal >= frames_.size() || !frames_[tool.portal]) continue;
    if (!is_finite(tool.p_portal_W) || !is_news(tool)) continue;
    const PortalFrame& frame = *frames_[tool.portal];
    const std::uint32_t mark = settings_.marks[tool.portal];
    const Pose to_rest = moved_from_rest(*case_, mark, bones).inverse();
    const Vec3 off = to_rest * tool.p_portal_W - frame.p_W;
    out.push_back(of_portal(tool, h, mark, kPortalPlaced));
    out.back().values = {1e3 * off.dot(frame.up_W), 1e3 * off.dot(frame.middle_W), 0};
    out.push_back(of_portal(tool, h, mark, kPortalWay));
    const bool pierced = tool.portal_way == 2, seen = is_seen(tools, h, bones);
    out.back().values = {pierced ? 1.0 : 0.0, seen ? 1.0 : 0.0, 0};
    const auto in_frame = [&](const Vec3& v) {
      return Vec3(v.dot(frame.in_W), v.dot(frame.up_W), v.dot(frame.middle_W));
    };
    MadePortalFound made{mark, in_frame(off),
                         in_frame(to_rest.rotate(tool.X_WP.rotate(-Vec3::UnitZ()))), pierced, seen};
    made.from_needle_m = from_needle(made);
    keep(made);
  }
}

}  // namespace osteon
