#pragma once

#include <cstdint>
#include <vector>

#include "osteon/scene/state.h"
#include "runs/reports/contact_timeline.h"

namespace osteon {

/// A repeated recording as pictures, 60 a second, with its force and its touches. Where a stretch
/// is missing, the nearest picture stands.
class ReplayTrack {
 public:
  static constexpr double kPictureHz = 60;
  /// Tick by tick, in order.
  void add(const ToolState& tool, const BoneSnapshot& bones);
  /// Puts in what a track of another stretch of the same run holds; nothing is added after that.
  void join(const ReplayTrack& stretch);
  bool empty() const { return frames_.empty(); }
  double duration_s() const { return end_s_; }
  /// Picture at a time, between the two nearest that were kept; the first or last outside.
  RenderSnapshot at(double time_s) const;
  const ContactTimeline& contacts() const { return contacts_; }
  /// The `count` values of force that end at `time_s`, N, kForceHistoryHz; zeros before the start.
  std::vector<float> force_until(double time_s, std::size_t count) const;

 private:
  struct Frame {
    ToolState tool;
    std::size_t bones = 0;
    std::size_t around = 0;
    std::size_t loose = 0;
  };
  /// What lies, flows and is held about the bones. Kept a few times a second: it changes slowly.
  struct Around {
    double time_s = 0;
    GuideRods rods{};
    GraftBenchState bench{};
    GraftPlacingState placing{};
    WaterState water{};
  };
  std::size_t keep_bones(const BoneSnapshot& bones);
  std::size_t keep_around(double time_s, const BoneSnapshot& bones);
  std::size_t keep_loose(const LooseBones& loose);
  void add_force(const ToolState& tool);

  std::vector<Frame> frames_;
  std::vector<std::vector<BoneMotion>> bones_;  ///< kept once while they do not move
  std::vector<Around> arounds_;
  std::vector<std::vector<LooseBone>> loose_;  ///< pieces of bone; as bones_
  std::vector<float> force_n_;
  std::size_t force_begin_ = 0;  ///< place of the first of them in the whole run
  ContactTimeline contacts_;
  float peak_n_ = 0;
  std::uint64_t mask_ = 0;
  double end_s_ = 0;
};

}  // namespace osteon
