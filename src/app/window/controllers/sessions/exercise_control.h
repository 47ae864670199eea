#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "window/controllers/cases/case_control.h"
#include "window/controllers/sessions/exercise_run.h"
#include "window/controllers/sessions/ghost_control.h"

namespace osteon {

/// An exercise is played in the window: ExerciseRun knows what it asks and how far it is, this one
/// opens its patient, starts its hands and records them.
class ExerciseControl {
 public:
  ExerciseControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live,
                  CaseControl& cases)
      : host_(host),
        scene_(scene),
        sight_(sight),
        live_(live),
        cases_(cases),
        ghost_(host, sight, live) {}

  /// Opens its briefing, as the command line names it.
  void show(const std::string& name);
  bool opening() const { return exercise_.page() == ExercisePage::kOpening; }
  bool running() const { return exercise_.page() == ExercisePage::kRunning; }
  /// The expert does what comes before the part that is played; nobody works meanwhile.
  bool beginning() const { return beginning_ != nullptr; }
  bool judging() const { return exercise_.page() == ExercisePage::kJudging; }
  /// Its patient is on show.
  void begin();
  void end();
  /// By a key or a button: the first time the user is told that once more ends it.
  void ask_to_end();
  void apply(const ExerciseRequests& requests);
  /// The user took the force off: the end of a pause does not bring it back.
  void close_page() { exercise_.close_page(); }
  void forget_force() { exercise_.keep_force_wish(false); }
  bool paused() const { return exercise_.paused(); }
  /// What the exercise has the active hand use; empty: none runs.
  std::vector<std::string> used_by_active_hand() const;
  void count_undo();
  /// Once a picture.
  void poll();
  ExerciseModel model() const;

 private:
  void go_to_start_of(std::size_t stage);
  void tell_what_is_undone(std::size_t stage);
  void stop_working();
  void follow_marks(LiveRun& run);
  void open_patient();
  void hold_as_expert(bool comes_to_him);
  void go_on_as_expert(LiveRun& run);
  Pose on_own_line(const LiveRun& run, const Pose& expert) const;
  void follow_expert(double for_s);
  void tell_end_of_way();
  void tell_no_expert();
  bool is_near_expert(const Vec3& tip_W, const Vec3& expert_W);
  void take_made_before();
  bool places_portals();
  std::function<std::optional<CarvedField>(std::uint32_t)> carved_now() const;
  void poll_begin();
  void stop_begin(const std::string& why);
  void begin_to_work(const std::vector<PlannedHand>& hands);
  bool want_instruments(const Scenario& scenario);
  std::vector<LiveControl::PlacedHand> placed(const std::vector<PlannedHand>& hands) const;
  void save_pages();
  void show_debrief();
  void look_at_the_box(const std::vector<PlannedHand>& hands);
  void show_scope();
  void go_in_with_scope();
  void show_skin();
  std::optional<Camera> camera_at(WorkPlace place) const;
  void go_with_stage();
  void bring_to_bench(bool at_bench);

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  CaseControl& cases_;
  ExerciseRun exercise_;
  GhostControl ghost_;
  std::unique_ptr<SideJob<std::string>> placing_;     ///< of portals, before the patient is opened
  std::unique_ptr<SideJob<BegunAttempt>> beginning_;  ///< of a part, by the expert
  std::vector<PlannedHand> begun_hands_;              ///< likewise: who goes on
  bool waits_for_portal_ = false;     ///< of the scope: till then one looks from outside
  std::optional<bool> skin_clear_;    ///< as it was shown last; none: as it was
  WorkPlace at_ = WorkPlace::kJoint;  ///< where the live stage is worked on
  Camera camera_at_joint_;            ///< while that is elsewhere
  PictureLayout layout_at_joint_ = PictureLayout::kOutside;  ///< likewise
  std::optional<Pose> hand_before_bench_;                    ///< of the one that was brought there
  std::deque<Pose> ways_;                                    ///< by which it goes on
  DebriefView wanted_ = DebriefView::kNothing, shown_ = DebriefView::kNothing;
};

}  // namespace osteon
