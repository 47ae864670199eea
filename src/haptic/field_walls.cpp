#include "field_walls.h"

#include <algorithm>
#include <limits>

#include "rigid_motion.h"

namespace osteon {
namespace {

// A bone farther than this needs no plane: the way to it is looked at.
constexpr double kNearGap_m = 5e-4;
constexpr double kFarGap_m = ContactField::kFarGap_m;
// A stride along a surface, m, and how many of them a way may have.
constexpr double kStride = 5e-5;
constexpr int kMostStrides = 64;
constexpr int kHalvings = 8;
// Share of a gap that a stride may take: a spline's slope may exceed 1 a little.
constexpr double kSafeShare = 0.8;
// A gap is told to within this, m: in a hole walls are looked for at some places of the rod's
// surface only.
constexpr double kRough = 5e-5;
// A bone farther than kNotClose_m has the plane that it had while the tool moves by kHardly_m.
constexpr double kNotClose_m = 1e-5;
constexpr double kHardly_m = 5e-5;

}  // namespace

void FieldWalls::start(const CandidateList& near) {
  fields_ = near.field;
  field_count_ = near.field_count;
  count_ = 0;
  looks_ = {0, &before_};
  before_.begin_tick();
  known_.set = false;
  for (Seen& seen : std::span(seen_).first(field_count_)) {
    seen.gap = -std::numeric_limits<double>::infinity();
    seen.places.count = 0;
  }
}

// Each point of the tool has come no farther than its origin has, and its own turn.
double FieldWalls::moved_m(std::size_t field, const Pose& X_BT) const {
  const Pose& before = seen_[field].X_BT;
  const double turn = 2 * (before.q.conjugate() * X_BT.q).vec().norm();
  return (X_BT.p - before.p).norm() + turn * field_.tool_radius();
}

double FieldWalls::least_gap(std::size_t field, double moved_m) const {
  return seen_[field].gap - FieldView::kSteepest * moved_m - kRough;
}

bool FieldWalls::has_wall(std::uint32_t pair) const {
  return std::any_of(walls_.begin(), walls_.begin() + count_,
                     [pair](const Wall& wall) { return wall.pair == pair; });
}

// A plane found elsewhere is right while bone comes up to it or over it. Where the bone has bent
// away from it, or it says what the new one says, it would only be in the way.
bool FieldWalls::still_right(const Wall& wall, const PartingPlane& now, const Pose& X_WB,
                             const Pose& X_WT) const {
  constexpr double kSlack = 1e-6;
  constexpr double kSameDirection = 0.9998;
  if (wall.plane.nhat_BT_B.dot(now.nhat_BT_B) > kSameDirection) return false;
  const FreeHalfSpace old = field_.half_space(wall.pair, wall.plane, X_WB, X_WT.q);
  const double foretold = old.n.dot(X_WT.p) - old.c + kFieldSkin;
  return now.gap <= foretold + kSlack;
}

// In a hole that it just fills, a tool has walls all round at about one distance, and the slope in
// the middle belongs to none of them alone: the plane across it may reach into the tool's end
// though the bone is a gap away, and would hold the tool off what it does not touch.
void FieldWalls::lay_back(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT,
                          PartingPlane& plane) const {
  constexpr double kSlack = 1e-6;
  const FreeHalfSpace space = field_.half_space(pair, plane, X_WB, X_WT.q);
  const double missing = plane.gap - (space.n.dot(X_WT.p) - space.c + kFieldSkin);
  if (!(missing > kSlack)) return;
  plane.bone_support -= missing;
  plane.p_B -= missing * plane.nhat_BT_B;
}

bool FieldWalls::look(std::span<const Pose> X_WB, const Pose& X_WT) {
  if (field_count_ == 0) return true;
  std::uint32_t count = 0;
  Nearest least;
  for (std::size_t field = 0; field < field_count_; ++field) {
    const std::uint32_t pair = fields_[field];
    const Pose& bone = bone_pose(pair, X_WB);
    const Pose X_BT = bone.inverse() * X_WT;
    // What is neither near nor the nearest has no plane. What this tick has found hardly moved from
    // here, and not close, has the planes that it had.
    const double moved = moved_m(field, X_BT), known = least_gap(field, moved);
    const double enough = has_wall(pair) ? kFarGap_m : std::clamp(least.gap, kNearGap_m, kFarGap_m);
    const bool far = known >= enough;
    const bool as_it_was = known >= kNotClose_m && moved <= kHardly_m;
    if (far || as_it_was) {
      if (known < least.gap) least = {known, pair};
      for (std::uint32_t i = 0; i < count_ && count < kMostPlanes; ++i)
        if (walls_[i].pair == pair) next_[count++] = walls_[i];
      continue;
    }
    PartingPlane now;
    const ContactField::Wanted wanted{.far_m = enough, .places = &seen_[field].places};
    if (!field_.separate_field(pair, X_BT, looks_, wanted, now)) return false;
    note_gap(field, X_BT, now.gap);
    if (now.gap < least.gap) least = {now.gap, pair};
    lay_back(pair, bone, X_WT, now);
    std::size_t room = kPlanesEach;
    if (now.gap < kNearGap_m) {
      if (count == kMostPlanes) return false;
      next_[count++] = {pair, now};
      --room;
    }
    // Newer ones stand first.
    for (std::uint32_t i = 0; i < count_ && room > 0 && count < kMostPlanes; ++i) {
      if (walls_[i].pair != pair || !still_right(walls_[i], now, bone, X_WT)) continue;
      next_[count++] = walls_[i];
      --room;
    }
  }
  std::copy_n(next_.begin(), count, walls_.begin());
  count_ = count;
  keep(X_WB, X_WT, least);
  return true;
}

bool FieldWalls::knows(std::span<const Pose> X_WB, const Pose& X_WT) const {
  if (!known_.set || !same_pose(known_.X_WT, X_WT)) return false;
  for (std::uint32_t i = 0; i < field_count_; ++i)
    if (!same_pose(known_.X_WB[i], bone_pose(fields_[i], X_WB))) return false;
  return true;
}

void FieldWalls::keep(std::span<const Pose> X_WB, const Pose& X_WT, const Nearest& found) {
  known_.set = true;
  known_.X_WT = X_WT;
  known_.found = found;
  for (std::uint32_t i = 0; i < field_count_; ++i) known_.X_WB[i] = bone_pose(fields_[i], X_WB);
}

// The one that was nearest at the last place comes first: of the others it is enough to know that
// they are farther, and most are by what is known of them.
FieldWalls::Nearest FieldWalls::nearest(std::span<const Pose> X_WB, const Pose& X_WT,
                                        double low_m) {
  if (knows(X_WB, X_WT)) return known_.found;
  Nearest least;
  const auto look_at = [&](std::size_t field) {
    const std::uint32_t pair = fields_[field];
    const double enough = least.gap < kFarGap_m ? least.gap : kFarGap_m;
    const Pose X_BT = bone_pose(pair, X_WB).inverse() * X_WT;
    double gap = least_gap(field, moved_m(field, X_BT));
    if (!(gap >= enough)) {
      gap = field_.gap(pair, X_BT, looks_, {enough, low_m, &seen_[field].places});
      if (gap >= low_m) note_gap(field, X_BT, gap);
    }
    if (!(gap >= least.gap)) least = {gap, pair};  // takes what is not a number as well
  };
  const std::uint32_t first = known_.set ? known_.found.pair : kNoPair;
  for (std::size_t field = 0; field < field_count_; ++field)
    if (fields_[field] == first) look_at(field);
  for (std::size_t field = 0; field < field_count_; ++field)
    if (fields_[field] != first && !(least.gap < low_m)) look_at(field);
  if (least.gap < low_m) return least;
  keep(X_WB, X_WT, least);
  return least;
}

bool FieldWalls::clear(std::span<const Pose> X_WB, const Pose& X_WT) {
  return nearest(X_WB, X_WT, kSkin).gap >= kSkin;
}

Vec3 FieldWalls::way(std::span<const Pose> X_WB, const Quat& q_WT, const Vec3& from_W,
                     const Vec3& to_W) {
  const double length = (to_W - from_W).norm();
  blocked_.by = kNoPair;
  if (field_count_ == 0 || !(length > 0)) return to_W;
  const Vec3 along = (to_W - from_W) / length;
  double gap = nearest(X_WB, {from_W, q_WT}).gap;
  const double limit = std::min(kSkin, gap);
  // The end is asked for as the next look will: then it is known.
  const auto look_at = [&](double s) {
    return nearest(X_WB, {s == length ? to_W : Vec3(from_W + s * along), q_WT}, limit);
  };
  double free = 0;
  for (int i = 0; i < kMostStrides && (i == 0 || !spent()); ++i) {
    const double next = std::min(length, free + std::max(kStride, kSafeShare * gap));
    const Nearest there = look_at(next);
    gap = there.gap;
    if (gap >= limit) {
      if (next == length) return to_W;
      free = next;
      continue;
    }
    double blocked = next;
    blocked_.by = there.pair;
    const int halvings = is_carved() ? kHalvings / 2 : kHalvings;
    for (int k = 0; k < halvings && !spent(); ++k) {
      const double middle = 0.5 * (free + blocked);
      (look_at(middle).gap >= limit ? free : blocked) = middle;
    }
    // Without this, a tick that has no looks left would leave the proxy where it is, and so would
    // the next: a burr stood still in its own cut.
    const double least = next / (1 << halvings);
    if (free == 0 && spent() && look_at(least).gap >= limit) free = least;
    blocked_.p_W = from_W + blocked * along;
    break;
  }
  return from_W + free * along;
}

bool FieldWalls::blocking(std::span<const Pose> X_WB, const Quat& q_WT, PartingPlane& out) {
  if (!is_blocked()) return false;
  const Pose X_BT = bone_pose(blocked_.by, X_WB).inverse() * Pose{blocked_.p_W, q_WT};
  return field_.separate_field(blocked_.by, X_BT, looks_, {}, out);
}

void FieldWalls::raise(std::span<const Pose> X_WB, const Quat& q_WT,
                       std::span<FreeHalfSpace> out) const {
  for (std::uint32_t i = 0; i < count_; ++i)
    out[i] =
        field_.half_space(walls_[i].pair, walls_[i].plane, bone_pose(walls_[i].pair, X_WB), q_WT);
}

}  // namespace osteon
