#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "osteon/scene/graft_bench.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What an instrument of a tray can do at a bench.
struct BenchTool {
  enum class Kind : std::uint8_t { kOther, kBlade, kStripper, kSizer, kButton, kClamp, kNeedle };
  Kind kind = Kind::kOther;
  double size_m = 0;  ///< bore of a sizer, length of a loop
};

/// Making a graft at a bench: fascia is opened by a blade that is drawn along it, tendons are
/// lifted out from under it by a clamp that shuts on them in the slit and is drawn up, bands are
/// cut by a blade that is drawn over them, tendons stripped, their muscle scraped off by a blade's
/// strokes over the table beside their free ends, thread put through those by a needle holder that
/// shuts there, tendons carried and folded by a clamp, sized, pulled on a board and hung on a
/// button. A function of its state and the tools' states; a step allocates nothing.
///
/// Guided one-dimensional model. An instrument that is pushed along a line stays on it, as in a
/// hole, and the line's front stops it. F, its push along the line; R(s), the resistance at the
/// front s: over R the front goes on with (F - R) / kSlow, at most kFastest. So the hand feels R.
/// R of a tendon grows towards its muscle and peaks at a band that is not cut; pushed beyond the
/// peak the stripper cuts the tendon off there. R of a sizer grows with its tightness; R of the
/// board is a spring's, kLever times less than the tension that it keeps, which is no more than
/// what the fewest passes of thread through a folded tendon hold; open jaws let its slide back. A
/// graft that hangs on the thread in a knee has left the bench. Forces are a fraction of those of
/// the operation, so that devices can show them: own defaults.
class GraftBenchWork {
 public:
  static constexpr double kStrip_n = 1.2, kMuscle_n = 2.2;  ///< at the insertion, at the muscle
  static constexpr double kBand_n = 5.5, kBandReach_m = 0.003;
  static constexpr double kCutOff_n = 0.3;  ///< of a tendon that is cut off
  static constexpr double kSlow_n_s_per_m = 15, kFastest_m_per_s = 0.15;
  static constexpr double kTight_n = 2.5;  ///< of a sizer that is just wide enough, 0.5 mm tighter
  static constexpr double kWedge_m = 0.004, kWedge_n_per_m = 2500;  ///< of one that is too narrow
  static constexpr double kLever = 25;
  static constexpr double kClock = 20;  ///< the board's clock runs so much faster

  /// `tray`: by index of the session's tray.
  GraftBenchWork(GraftBenchPlan plan, std::vector<BenchTool> tray, double step_s);
  /// Steps `state`; a tool of another epoch than the world's does nothing.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            GraftBenchState& state);
  /// The lines that lead hands now; off: none of the bench's.
  const std::array<ToolGuide, kMaxHands>& guides() const { return guides_; }
  const GraftBenchPlan& plan() const { return plan_; }

  /// As it was then; what hands were doing is over.
  static GraftBenchState gone_back(const GraftBenchState& kept);

  /// Resistance at a front, N.
  double resistance_n(const GraftBenchState& state, std::uint32_t line, double front_m,
                      const BenchTool& tool) const;

 private:
  const BenchTool& held(const ToolState& tool) const;
  void follow_line(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                   GraftBenchState& state);
  bool may_lead(const GraftBenchState& state, std::uint32_t line, const BenchTool& tool) const;
  double& front_of(GraftBenchState& state, std::size_t hand, std::uint32_t line) const;
  void push(std::size_t hand, const ToolState& tool, GraftBenchState& state);
  void reach(std::size_t hand, const BenchTool& tool, GraftBenchState& state) const;
  void draw_blade(std::size_t hand, const ToolState& tool, GraftBenchState& state) const;
  void scrape(std::size_t hand, const ToolState& tool, GraftBenchState& state) const;
  void stitch(std::size_t hand, const ToolState& tool, GraftBenchState& state) const;
  void carry(std::size_t hand, const ToolState& tool, GraftBenchState& state) const;
  void hang(std::size_t hand, const ToolState& tool, GraftBenchState& state) const;
  void publish(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
               const GraftBenchState& state);

  GraftBenchPlan plan_;
  std::vector<BenchTool> tray_;
  double step_s_;
  bool in_knee_ = false;  ///< in this step: the graft hangs on the thread in the knee
  std::array<ToolGuide, kMaxHands> guides_{};
};

}  // namespace osteon
