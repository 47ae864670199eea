#include "runs/replays/replay_track.h"

#include <algorithm>
#include <cmath>

#include "loops/loop_exchange.h"
#include "runs/reports/force_history.h"

namespace osteon {
namespace {

// Pictures farther apart have a missing stretch between them.
constexpr double kLongestGap_s = 0.1;
constexpr double kAround_s = 0.2, kBench_s = 0.05;  // hands move a graft

bool same(const BoneMotion& a, const BoneMotion& b) {
  return a.X_WB.p == b.X_WB.p && a.X_WB.q.coeffs() == b.X_WB.q.coeffs();
}

bool same_piece(const LooseBone& a, const LooseBone& b) {
  return a.shape == b.shape && a.X_WB.p == b.X_WB.p && a.X_WB.q.coeffs() == b.X_WB.q.coeffs();
}

Pose between(const Pose& a, const Pose& b, double share) {
  return {a.p + share * (b.p - a.p), a.q.slerp(share, b.q)};
}

}  // namespace

std::size_t ReplayTrack::keep_bones(const BoneSnapshot& bones) {
  const std::size_t n = std::min<std::size_t>(bones.count, kMaxBones);
  const bool moved =
      bones_.empty() || bones_.back().size() != n ||
      !std::equal(bones_.back().begin(), bones_.back().end(), bones.bones.begin(), same);
  if (moved)
    bones_.emplace_back(bones.bones.begin(), bones.bones.begin() + static_cast<std::ptrdiff_t>(n));
  return bones_.size() - 1;
}

std::size_t ReplayTrack::keep_around(double time_s, const BoneSnapshot& bones) {
  const double due_s = bones.bench.on || bones.placing.on ? kBench_s : kAround_s;
  if (arounds_.empty() || time_s >= arounds_.back().time_s + due_s)
    arounds_.push_back({time_s, bones.rods, bones.bench, bones.placing, bones.water});
  return arounds_.size() - 1;
}

std::size_t ReplayTrack::keep_loose(const LooseBones& loose) {
  const auto begin = loose.bones.begin();
  const auto end = begin + std::min<std::ptrdiff_t>(loose.count, kMaxLoose);
  const bool moved = loose_.empty() || !std::equal(loose_.back().begin(), loose_.back().end(),
                                                   begin, end, same_piece);
  if (moved) loose_.emplace_back(begin, end);
  return loose_.size() - 1;
}

void ReplayTrack::add_force(const ToolState& tool) {
  peak_n_ = std::max(peak_n_, static_cast<float>(tool.force_W.norm()));
  for (std::uint32_t i = 0; i < tool.contact_count; ++i)
    mask_ |= std::uint64_t{1} << (tool.contacts[i].bone.index & 63u);
  if (tool.tick % kTelemetryTicks != 0) return;
  if (force_n_.empty()) force_begin_ = static_cast<std::size_t>(tool.tick / kTelemetryTicks - 1);
  force_n_.push_back(peak_n_);
  contacts_.add(tool.time_s, mask_, peak_n_);
  peak_n_ = 0;
  mask_ = 0;
}

void ReplayTrack::add(const ToolState& tool, const BoneSnapshot& bones) {
  add_force(tool);
  end_s_ = tool.time_s;
  const double due_s = static_cast<double>(frames_.size()) / kPictureHz;
  if (!frames_.empty() && tool.time_s < frames_.front().tool.time_s + due_s) return;
  frames_.push_back(
      {tool, keep_bones(bones), keep_around(tool.time_s, bones), keep_loose(bones.loose)});
}

void ReplayTrack::join(const ReplayTrack& stretch) {
  if (stretch.empty()) return;
  const std::size_t bones_before = bones_.size(), arounds_before = arounds_.size();
  const std::size_t loose_before = loose_.size();
  loose_.insert(loose_.end(), stretch.loose_.begin(), stretch.loose_.end());
  bones_.insert(bones_.end(), stretch.bones_.begin(), stretch.bones_.end());
  arounds_.insert(arounds_.end(), stretch.arounds_.begin(), stretch.arounds_.end());
  const auto place =
      std::upper_bound(frames_.begin(), frames_.end(), stretch.frames_.front().tool.time_s,
                       [](double t, const Frame& frame) { return t < frame.tool.time_s; });
  const auto put = frames_.insert(place, stretch.frames_.begin(), stretch.frames_.end());
  const auto count = static_cast<std::ptrdiff_t>(stretch.frames_.size());
  for (auto frame = put; frame != put + count; ++frame) {
    frame->bones += bones_before;
    frame->around += arounds_before;
    frame->loose += loose_before;
  }
  const std::size_t forces = stretch.force_begin_ + stretch.force_n_.size();
  if (force_n_.size() < forces) force_n_.resize(forces, 0.0f);
  std::copy(stretch.force_n_.begin(), stretch.force_n_.end(),
            force_n_.begin() + static_cast<std::ptrdiff_t>(stretch.force_begin_));
  contacts_.join(stretch.contacts_);
  end_s_ = std::max(end_s_, stretch.end_s_);
}

RenderSnapshot ReplayTrack::at(double time_s) const {
  RenderSnapshot snapshot;
  if (frames_.empty()) return snapshot;
  const auto later =
      std::upper_bound(frames_.begin(), frames_.end(), time_s,
                       [](double t, const Frame& frame) { return t < frame.tool.time_s; });
  const Frame& a = later == frames_.begin() ? frames_.front() : *(later - 1);
  const Frame& b = later == frames_.end() ? frames_.back() : *later;
  const double gap_s = b.tool.time_s - a.tool.time_s;
  double share = gap_s > 0 ? std::clamp((time_s - a.tool.time_s) / gap_s, 0.0, 1.0) : 0.0;
  if (gap_s > kLongestGap_s) share = share < 0.5 ? 0 : 1;

  snapshot.tool = a.tool;
  snapshot.tool.time_s = a.tool.time_s + share * gap_s;
  snapshot.tool.X_WD = between(a.tool.X_WD, b.tool.X_WD, share);
  snapshot.tool.X_WP = between(a.tool.X_WP, b.tool.X_WP, share);
  snapshot.tool.force_W = a.tool.force_W + share * (b.tool.force_W - a.tool.force_W);
  const std::vector<BoneMotion>& from = bones_[a.bones];
  const std::vector<BoneMotion>& to = bones_[b.bones];
  snapshot.bones.count = static_cast<std::uint32_t>(from.size());
  snapshot.bones.time_s = time_s;
  const Around& around = arounds_[a.around];
  snapshot.bones.rods = around.rods;
  snapshot.bones.bench = around.bench;
  snapshot.bones.placing = around.placing;
  snapshot.bones.water = around.water;
  const std::vector<LooseBone>& pieces = loose_[a.loose];
  const std::vector<LooseBone>& later_pieces = loose_[b.loose];
  snapshot.bones.loose.count = static_cast<std::uint32_t>(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    LooseBone& shown = snapshot.bones.loose.bones[i];
    shown = pieces[i];
    if (i < later_pieces.size() && later_pieces[i].shape == shown.shape)
      shown.X_WB = between(shown.X_WB, later_pieces[i].X_WB, share);
  }
  for (std::size_t i = 0; i < from.size(); ++i)
    snapshot.bones.bones[i].X_WB = between(from[i].X_WB, to[i].X_WB, share);
  return snapshot;
}

std::vector<float> ReplayTrack::force_until(double time_s, std::size_t count) const {
  std::vector<float> values(count, 0.0f);
  const auto end = static_cast<std::ptrdiff_t>(
      std::clamp(std::floor(time_s * kForceHistoryHz), 0.0, static_cast<double>(force_n_.size())));
  const auto n = std::min(end, static_cast<std::ptrdiff_t>(count));
  std::copy(force_n_.begin() + (end - n), force_n_.begin() + end, values.end() - n);
  return values;
}

}  // namespace osteon
