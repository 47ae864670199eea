#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "exercises/ghost/ghost_recording.h"
#include "ui/side_job.h"
#include "window/controllers/sessions/exercise_run.h"
#include "window/controllers/sessions/live_control.h"
#include "window/exercise_model.h"

namespace osteon {

/// An expert's instruments beside the learner's while an exercise goes on. Prepares them beside the
/// window, lets them follow the learner's progress, and tells the picture where they are and the
/// hands where to go.
class GhostControl {
 public:
  GhostControl(WindowHost& host, SceneSight& sight, LiveControl& live);

  /// An exercise has begun on the case on show.
  void begin(GhostWanted wanted);
  void end();
  void toggle();
  /// Whether hands are led along the expert's way, by devices with motors. Off at first.
  void toggle_guide();
  /// The learner went back: what is shown begins again.
  void restart() { restart_ = true; }
  /// Once a picture, while an exercise runs.
  void poll(const ExerciseRun& exercise);
  GhostModel model() const;
  /// How the expert holds what the active hand holds, near its tip, in the next step of the stage
  /// for which he does; none: for none, or he is not shown.
  std::optional<Pose> beside_active_hand() const;
  /// Where the active hand goes on along the expert's way, and whether that way ends there; none:
  /// as above. The next time it goes on from there.
  struct Onward {
    Pose X_WT;
    bool ends = false;
  };
  std::optional<Onward> onward_with_active_hand();
  /// From where it was brought to last, on along his way in his own time. None: it was brought
  /// nowhere, has gone to the way's end, or is held up.
  std::optional<Onward> along_with_active_hand(double for_s);
  /// Of the exercise that was begun last; null: not known, or not to its end yet.
  const GhostTrack* track() const { return job_ ? nullptr : track_.get(); }

 private:
  struct Prepared {
    std::shared_ptr<const GhostTrack> track;
    double strength = 1;
  };
  /// What a preparation knows before it is done.
  struct Early {
    std::mutex mutex;
    std::optional<Prepared> newest;
  };
  void prepare();
  void take_early();
  void take_prepared();
  void guide(const ExerciseRun& exercise);
  void lead_nobody();
  std::optional<Pose> beside_in(std::size_t stretch) const;
  bool is_held_alike(std::uint32_t ghosts, std::uint32_t held) const;
  std::optional<std::uint32_t> in_tray(std::uint32_t instrument) const;

  WindowHost& host_;
  SceneSight& sight_;
  LiveControl& live_;
  bool on_ = true, guides_ = false;
  bool allowed_ = false, restart_ = false;
  GhostWanted wanted_;
  std::shared_ptr<const GhostTrack> track_;
  std::shared_ptr<Early> early_;  ///< of the job
  std::unique_ptr<SideJob<Prepared>> job_;
  double strength_ = 1;
  std::string problem_;
  GhostFollower follower_;
  std::vector<std::size_t> left_;    ///< stretches of the stage that the learner has not done
  std::optional<std::size_t> led_;   ///< the stretch along which hands are led
  std::vector<std::size_t> led_to_;  ///< by hand: the sample
  /// Where a hand was brought to.
  struct Brought {
    std::size_t stretch = 0, hand = 0;
    std::optional<std::size_t> at;
    double beyond = 0;  ///< share of the time to the next sample
  };
  Brought brought_;
};

}  // namespace osteon
