#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "loops/hand_guide.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/state.h"

namespace osteon {

/// How often an expert's instruments are kept, Hz.
inline constexpr double kGhostHz = 50;
/// At the end of a stretch a ghost stays this long before it begins the stretch again, s.
inline constexpr double kGhostRest_s = 1.0;

/// One thing that a stage asks for: a bone or a landmark of a goal; of a goal without any, part 0.
struct GoalPart {
  std::uint32_t goal = 0, part = 0;
  bool operator==(const GoalPart&) const = default;
};

/// What an expert did to get one step further: samples `from` to `to`, both included, at whose end
/// these parts of the stage's goals were done.
struct GhostStretch {
  std::uint32_t stage = 0;
  std::vector<GoalPart> done;
  std::size_t from = 0, to = 0;
};

/// An expert's way through an exercise, cut where something was done. It says where the expert was
/// at any stage of the work, whatever time another one takes for it.
struct GhostTrack {
  struct Sample {
    Pose X_WT;                     ///< the instrument, kept out of bone
    std::uint32_t instrument = 0;  ///< in `tray`
  };
  std::vector<std::string> tray;           ///< names of instruments
  std::vector<std::vector<Sample>> hands;  ///< kGhostHz a second, all hands equally many
  std::vector<GhostStretch> stretches;     ///< in the order of their times
};

/// Makes a track while an attempt is judged, tick by tick.
class GhostTrackMaker {
 public:
  explicit GhostTrackMaker(double tick_s);
  /// `state`: after this tick.
  void add(std::span<const ToolState* const> tools, const ScenarioState& state);
  GhostTrack finish(std::vector<std::string> tray);
  /// As far as it has come.
  const GhostTrack& so_far() const { return track_; }

 private:
  void keep(std::span<const ToolState* const> tools);
  void cut(std::vector<GoalPart> done);

  std::uint64_t stride_;
  GhostTrack track_;
  std::optional<ScenarioState> before_;
  std::size_t from_ = 0;
};

/// Whether that part has been done in the live stage.
bool is_done(const ScenarioState& state, const GoalPart& part);

/// Index of the stretch that shows the next step of somebody who is at `state`: the first of its
/// stage with a part that he has not done yet. None: the stages are over, or the expert did nothing
/// that is left to do.
std::optional<std::size_t> next_stretch(const GhostTrack& track, const ScenarioState& state);
/// All of that stage with such a part, that one first: somebody may do them in another order.
std::vector<std::size_t> stretches_left(const GhostTrack& track, const ScenarioState& state);

/// One hand `since_s` seconds after its stretch began: it moves as the expert did, rests at the end
/// and begins again. None: the track has no such hand or stretch, or the pose is not finite.
std::optional<GhostTrack::Sample> ghost_at(const GhostTrack& track, std::size_t stretch,
                                           std::size_t hand, double since_s);

/// How that hand holds this instrument (of the track's tray) in a stretch, at the place of its way
/// that is nearest to a tip. None: it does not hold it there.
std::optional<Pose> ghost_beside(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                                 std::uint32_t instrument, const Vec3& tip_W);
/// The same of an instrument in whatever size he holds it: "graft_sizer:8.5" as "graft_sizer".
std::optional<Pose> ghost_beside_in_any_size(const GhostTrack& track, std::size_t stretch,
                                             std::size_t hand, std::string_view name,
                                             const Vec3& tip_W);

/// How that hand goes on along its way in a stretch, from a tip at `tip_W`: kStepOn_m farther, or
/// less where it turns by kTurnOn_rad or its stretch ends. From sample `at`, where a hand was
/// brought to before, while the tip is still near it, and else from the place that is nearest to
/// the tip; `at` moves on. From the end of its way it begins once more, where that first came by
/// the tip. None: nowhere in the stretch does it hold an instrument that `holds` accepts.
inline constexpr double kStepOn_m = 0.008, kTurnOn_rad = 0.35;
std::optional<Pose> ghost_onward(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                                 const std::function<bool(std::uint32_t)>& holds, const Vec3& tip_W,
                                 std::optional<std::size_t>& at);

/// A place of a way: a sample, and the share of the time to the next one.
struct GhostPlace {
  std::size_t at = 0;
  double beyond = 0;
};
/// How that hand moves on from `place` in its own time, up to where its stretch ends or it takes
/// another instrument; `place` moves on. None: it does not hold what `holds` accepts there, or a
/// tip at `tip_W` has not come there.
std::optional<Pose> ghost_along(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                                const std::function<bool(std::uint32_t)>& holds, const Vec3& tip_W,
                                double for_s, GhostPlace& place);
/// Whether its way in a stretch that the track has goes no farther than sample `at`.
bool ghost_ends(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                const std::function<bool(std::uint32_t)>& holds, std::size_t at);

/// The piece of that hand's way in a stretch along which a tip at `tip_W` shall be led, with full
/// strength. `at`: the sample at which it was led before, which moves on: to the place nearest to
/// the tip of those up to kGuideAhead_m farther along the way, and kGuideBack_m back. Off where the
/// track has no such hand or stretch, and where a place on the way is not finite.
inline constexpr double kGuideAhead_m = 0.015, kGuideBack_m = 0.005;
GuideLine guide_along(const GhostTrack& track, std::size_t stretch, std::size_t hand,
                      const Vec3& tip_W, std::size_t& at);

/// Follows somebody's progress: the ghost begins its stretch anew whenever the next step is another
/// one.
class GhostFollower {
 public:
  /// `now_s` of the attempt: pauses left out.
  void follow(const GhostTrack& track, const ScenarioState& state, double now_s);
  /// The same stretch from its begin: the stage begins again.
  void restart(double now_s) { since_s_ = now_s; }
  std::optional<GhostTrack::Sample> at(const GhostTrack& track, std::size_t hand,
                                       double now_s) const;
  std::optional<std::size_t> stretch() const { return stretch_; }

 private:
  std::optional<std::size_t> stretch_;
  double since_s_ = 0;
};

/// How strongly a ghost is drawn, 0..1, for a learner with these attempts at the exercise, oldest
/// first: fully for a beginner, less with each step of the learning curve (LC-CUSUM) towards its
/// limit, not at all for somebody competent. After a relapse it is drawn fully again.
double ghost_strength(const std::vector<bool>& passed);

}  // namespace osteon
