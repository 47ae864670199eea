#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "loops/hand_share.h"
#include "loops/runtime.h"
#include "runs/hands/live_hand.h"
#include "runs/hands/pad_nudge.h"
#include "runs/hands/probe_drag.h"
#include "runs/pictures/carved_picture.h"
#include "runs/reports/run_events.h"

namespace osteon {

struct BegunRun;

/// How a run shall feel.
struct FeelSettings {
  double stiffness_n_per_m = 2000;
  double friction_scale = 1;
  bool bones_held = true;
};

/// The session's settings for a device: its profile's limits, the user's wishes within them. A
/// device without motors gets the limits of a teaching device, so that its force can be shown. A
/// hand that moves the tool by `scale` times its own way feels a coupling stiffer by as much.
SessionSettings settings_for(const DeviceInfo& info, const FeelSettings& feel, double scale = 1);

/// Where devices differ, the weakest one's limits hold for all.
void keep_to_weakest(const HapticParams& of_device, HapticParams& all);

/// What gives way to the hands of a run: the names, as SessionSettings has them, and what was made
/// of them. Null: nothing is soft.
struct RunSofts {
  std::vector<std::string> names;
  std::shared_ptr<const SoftSetup> setup;
};

/// The instruments that the hands of a run may take, with their names for the recording.
struct RunTray {
  /// What a pedal drives of an instrument: its motor, or its jaws shut.
  struct Driven {
    bool power = false, jaws = false;
  };
  std::vector<std::string> names;
  Tray tools;
  std::vector<Driven> driven;  ///< of each; those past its end: nothing
  /// What they remove bone with; null: nothing is carved.
  std::shared_ptr<const CarvingSetup> carving = nullptr;
  CarveSettings carve = {};  ///< with which that was made
  RunSofts softs = {};
};

/// A live case in the window: the runtime, what the hands hold, the recording. Every change of
/// device or number of hands and every start of a recording is a new run (a recording begins with
/// its session).
///
/// One device serves two hands by turns: it moves the active one, and the other rests as if held by
/// an assistant. Two hands by mouse have a mouse device each, of which one is moved. What has no
/// hand in its name is of the active one.
class LiveRun {
 public:
  LiveRun(std::shared_ptr<const Case> the_case, std::string case_source, ProbePath demo,
          const FeelSettings& feel, RunTray tray = {});

  /// From the next opening on, the last seconds of a device with motors go to this file when it is
  /// closed.
  void keep_force_log(std::filesystem::path file) { force_log_ = std::move(file); }
  /// Starts anew with this device, used as `user` says. `X_WD_start`: where a device without a pose
  /// of its own is; the middle of another's workspace is put there, with its axes tied to the
  /// camera's (`q_WC`) or to the patient's.
  Result<void> start(const DeviceChoice& choice, const Pose& X_WD_start,
                     const MappingSettings& user = {}, const Quat& q_WC = Quat::Identity());
  /// The same with a device for each of several hands; as many places as hands.
  Result<void> start(const std::vector<LiveHandOrder>& hands, const std::vector<Pose>& X_WD_start,
                     const Quat& q_WC = Quat::Identity());
  /// A second hand, at `X_WD_start`, which the only device or another mouse moves by turns; the
  /// first goes on where it is. Starts anew; not while recording.
  Result<void> add_hand(const Pose& X_WD_start, std::uint32_t instrument);
  /// Starts anew with the same device where the probe is, used in another way.
  Result<void> change_mapping(const MappingSettings& user, const Quat& q_WC);
  /// Starts anew where the probe is, on the same bones felt otherwise, which `carving` (may be
  /// null) carves and whose `softs` give way. Not while recording.
  Result<void> exchange_case(std::shared_ptr<const Case> the_case, std::string case_source,
                             ProbePath demo, std::shared_ptr<const CarvingSetup> carving = nullptr,
                             RunSofts softs = {});
  /// No hand touches anything: what is felt may change without being felt to.
  bool touches_nothing() const;
  Result<void> start_recording(const std::filesystem::path& file);
  /// The same, with every tick for who judges it: see Runtime::judge_ticks.
  Result<void> start_judged_recording(const std::filesystem::path& file);
  /// Goes on with a run that was begun with the same tray, where its hands are then; they are as
  /// many as this one's. Its recording goes on, and every tick is for who judges it.
  Result<void> go_on(BegunRun begun);
  bool pop_judged(ToolState& tool, std::size_t hand) {
    return runtime_ && runtime_->pop_judged(tool, hand);
  }
  /// Ends the recording; the run starts anew where the probe is.
  Result<void> stop_recording();
  /// Ends the run for good: zero force, closed devices, the recording whole.
  Result<void> end();
  /// Takes in what the loops reported. Once a frame.
  void update();

  std::size_t hands() const { return hands_.size(); }
  std::size_t active() const { return active_; }
  const LiveHand& hand(std::size_t i) const { return hands_[i]; }
  /// The next hand becomes the active one. False with one hand, and while the force of a device
  /// that serves both is off for a fault: the user resumes first.
  bool change_hands();
  /// Moves a resting hand along its shaft (in is positive), turns it about its shaft, and tilts it
  /// about its tip as seen by the camera. Nothing while a device moves that hand.
  void nudge(std::size_t hand, double in_m, double about_rad, double pitch_rad, double yaw_rad,
             const Quat& q_WC);
  bool rests(std::size_t hand) const;
  /// The active hand takes what stands at this place of the tray. Its force goes through zero.
  void take(std::uint32_t place);
  /// The pedal, 0 to 1, of what the active hand holds. Once a picture; a hand that plays a path is
  /// told by that.
  void drive(double pedal);
  /// What is left of carved bones, and the number of the run that it belongs to: each begins with
  /// whole bones.
  CarvedPicture& carved() { return *carved_; }
  std::uint64_t run_number() const { return run_number_; }
  /// What gives way in this run, and what presses it now.
  const std::shared_ptr<const SoftSetup>& softs() const { return tray_.softs.setup; }
  const SoftPushes& pushes() const { return pushes_; }
  /// A hand that the mouse moves goes there.
  void bring(const Pose& X_WD);
  /// Keeps the state as a restore point; returns its number.
  std::uint32_t mark();
  /// Back to a restore point. False: it has been written over since.
  bool go_back(std::uint32_t number);
  /// Back to the newest restore point; twice within two seconds of the run, to the one before it.
  /// False when there is none.
  bool undo();
  /// A restore point that was set, or that the run goes back to.
  struct MarkNews {
    std::uint32_t number = 0;
    bool goes_back = false;
  };
  /// Since it was last asked, in order.
  std::vector<MarkNews> take_mark_news() { return std::exchange(mark_news_, {}); }

  /// Ends the run and hands its device out for a check-up, open and at zero force; null where none
  /// is held. The run stands still until `take_back`. Not while recording.
  std::unique_ptr<HapticDevice> lend_device();
  /// Goes on where the probe was. The force is on again only if it was on before.
  Result<void> take_back(std::unique_ptr<HapticDevice> device);

  void set_feel(const Command& command);
  /// The pump that fills the joint: its pressure and how far the outlet is open. False: the run
  /// takes no command now.
  bool set_pump(double pump_pa, double outlet_open);
  /// What somebody beside the hands says. False: the run takes no command now.
  bool say(const Command& command);
  void set_force(bool on);
  /// The user's wish for the force: of the active hand alone where that one has a fault, else of
  /// all hands.
  void resume();
  bool force_wanted() const { return force_on_; }
  void calibrate();
  /// A device that a hand moves, not one that plays or is drawn on the screen.
  bool by_real_device() const;
  const MappingSettings& mapping_settings() const { return now().user; }
  /// The mouse moves its hand; no effect without one.
  /// `through`: a hole near by, or null. The wheel then goes along the shaft, and what is inside
  /// turns about the hole.
  void move_hand(const ProbeMotion& motion, const Camera& camera, const Viewport& viewport,
                 double dt_s, const Vec3* through_W = nullptr);
  /// Pedals and the camera, once a frame: a dead-man pedal that is not told again counts as let go.
  void tell_hand(HandWishes pedals, const Camera& camera);
  /// Where that hand shall be led from the next picture on: weakly, by a device with motors.
  void guide(std::size_t hand, const GuideLine& line);
  /// How long hands were led in this run, s: the longest of them.
  double guided_s() const;
  /// Some hand of the run has a device that can lead it.
  bool can_guide() const;
  /// A gamepad, as seen by the camera, once a picture: it moves the active hand where it is that
  /// hand's device, else the resting hand; with its second button held, the resting hand always.
  void move_pad(const PadSticks& sticks, const Camera& camera, double dt_s);

  const RenderSnapshot& snapshot() const { return now().snapshot; }
  /// Tools of the hands that are not active.
  std::vector<ToolState> others() const;
  const DeviceStatus& device_status() const { return now().status; }
  const LoopStats& haptic_stats() const { return now().haptic; }
  const LoopStats& physics_stats() const { return physics_stats_; }
  const FeelSettings& feel() const { return feel_; }
  const DeviceChoice& choice() const { return now().choice; }
  const ForceHistory& force() const { return now().force; }
  const ContactTimeline& contacts() const { return now().contacts; }
  const RunEvents& events() const { return events_; }
  const RunTray& tray() const { return tray_; }
  double force_limit_n() const { return settings_.haptic.max_force_n; }
  bool recording() const { return recording_; }
  const std::filesystem::path& recording_file() const { return recording_file_; }
  /// Why the recording ended by itself; empty otherwise. Given once.
  std::string take_recording_failure();
  /// What tripped on a device that can hurt nobody; the run has gone on. Empty: nothing. Given
  /// once.
  std::string take_harmless_trip();
  std::string realtime_warning() const;
  /// The mouse holds the active hand's instrument in this run.
  bool by_mouse() const { return now().mouse != nullptr; }

 private:
  const LiveHand& now() const { return hands_[active_]; }
  LiveHand& now() { return hands_[active_]; }
  bool shares() const { return shared_ && hands_.size() > 1; }
  std::vector<Pose> poses_now() const;
  Result<void> start_run(const std::vector<Pose>& X_WD_start, std::unique_ptr<RecordFeed> feed,
                         BegunRun* begun = nullptr);
  std::unique_ptr<Runtime> make_runtime(std::vector<HandPlan> hands,
                                        std::unique_ptr<RecordFeed> feed, BegunRun* begun);
  Result<std::unique_ptr<HapticDevice>> open_device(LiveHand& hand);
  Result<std::vector<HandPlan>> make_hands(const std::vector<Pose>& X_WD_start);
  Result<std::vector<HandPlan>> make_shared_hands(const std::vector<Pose>& X_WD_start);
  DeviceMapping mapping_at(const LiveHand& hand, const Pose& X_WD_start,
                           HapticDevice& device) const;
  SessionSettings settings_now() const;
  void stop_left_motors();
  void send_orders(std::size_t hand);
  void see_cuts();
  void forgive_the_harmless(std::size_t hand);
  void end_run();
  void keep_devices();
  RecordingHeader header() const;

  std::shared_ptr<const Case> case_;
  std::string case_source_;
  ProbePath demo_;
  FeelSettings feel_;
  RunTray tray_;
  std::vector<LiveHand> hands_;  ///< never empty
  std::size_t active_ = 0;
  bool shared_ = false;               ///< one device serves all hands
  std::shared_ptr<HandShare> share_;  ///< of the run under way
  SessionSettings settings_;
  Quat q_WC_ = Quat::Identity();
  std::unique_ptr<Runtime> runtime_;
  std::unique_ptr<CarvedPicture> carved_;
  std::uint64_t run_number_ = 0;
  bool force_on_ = true;
  bool recording_ = false;
  bool judged_next_ = false;  ///< the run that starts next
  std::filesystem::path recording_file_;
  std::filesystem::path force_log_;
  std::string recording_failure_, harmless_trip_;
  LoopStats physics_stats_;
  SoftPushes pushes_;
  RunEvents events_;
  std::vector<std::uint32_t> marks_;  ///< numbers of the restore points, oldest first
  std::vector<MarkNews> mark_news_;
  std::uint32_t next_mark_ = 0;
  double undone_at_s_ = -10;
};

}  // namespace osteon
