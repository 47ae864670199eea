#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/xdg.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/portal.h"
#include "runs/device_choices.h"
#include "runs/live_run.h"
#include "runs/pedals.h"
#include "runs/replay_player.h"
#include "ui/app_settings.h"
#include "ui/camera_control.h"
#include "ui/frame_stats.h"
#include "ui/gl_window.h"
#include "ui/imgui_host.h"
#include "ui/toasts.h"
#include "window/controllers/bone_edit.h"
#include "window/controllers/case_browser.h"
#include "window/controllers/exercise_run.h"
#include "window/controllers/instrument_tray.h"
#include "window/controllers/observer_window.h"
#include "window/controllers/picture_views.h"
#include "window/controllers/scene_poll.h"
#include "window/controllers/tip_gauge.h"
#include "window/controllers/tray_pictures.h"
#include "window/jobs/load_job.h"
#include "window/jobs/screen_film.h"
#include "window/jobs/window_jobs.h"
#include "window/panels/panels.h"

namespace osteon {

/// What the command line asks of the window.
struct WindowOrder {
  std::string case_spec = "builtin:wrist";
  std::filesystem::path replay;      ///< a recording to open; empty: the live case
  std::filesystem::path screenshot;  ///< saved after `frames` pictures; then the program ends
  int frames = 0;                    ///< pictures to draw once loaded before ending; 0: no end
  bool at_once = false;              ///< with `frames`: begins as for a user, with what is there
  double at_s = 0;                   ///< of simulated time, reached before `frames` are counted
  int width = 0, height = 0;         ///< 0: as last time
  double interface_scale = 0;        ///< 0: the display's, times the user's zoom
  PictureLayout layout = PictureLayout::kOutside;  ///< to begin with
  std::optional<PictureLayout> observer;  ///< the second window begins with it; none: no window
  std::filesystem::path film;             ///< of the window, from the first picture on; empty: none
  bool felt = false;                      ///< begins with bones coloured by what is felt
  bool softs = false;                     ///< begins with the soft parts shown
  bool close_up = false;                  ///< begins close up on the joint
  bool demo = false;                      ///< the virtual hand plays the case's path
  /// Hands to begin with, as parse_hand_order takes them: "phantom:left=hook_probe"; none: one
  /// hand with the device of last time.
  std::vector<std::string> devices;
  std::filesystem::path path;       ///< what an emulated hand plays; empty: the case's own
  std::filesystem::path record;     ///< recorded from the start; empty: nothing
  std::filesystem::path force_log;  ///< of the device's last seconds; empty: none
  std::string edit;                 ///< name of the bone whose editing begins; empty: none
  bool checkup = false;             ///< opens the check-up and begins one
  bool new_patient = false;         ///< opens the panel that makes one
  std::string exercise;             ///< whose briefing is opened; empty: none
  bool fresh = false;               ///< neither reads nor writes the settings file
};

/// The window's main loop: draws, and passes between panels, live run and replay. Runs on the main
/// thread. Its parts are in window_*.cpp.
class WindowApp {
 public:
  static Result<std::unique_ptr<WindowApp>> create(const WindowOrder& order);
  ~WindowApp();
  /// Until the user closes the window. Fails when an ordered screenshot could not be made.
  Result<void> run();
  const FrameStats& frame_stats() const { return work_; }
  /// Processor time of the whole program for one measured picture, ms, and its share in drawing the
  /// scene.
  double processor_ms_per_picture() const;
  bool software_driver() const { return renderer_ && renderer_->software_driver(); }
  /// The window was closed to segment a scan; the case that was open comes back after that.
  bool wants_segmentation() const { return wants_segmentation_; }
  const std::string& scan_to_segment() const { return scan_to_segment_; }
  const std::string& case_source() const {
    return case_source_.empty() ? order_.case_spec : wanted_source();
  }
  /// Since the program began: when the first picture with bones stood, and when the last of what is
  /// felt was there; 0: not yet, or from the start.
  double first_picture_s() const { return first_picture_s_; }
  double pieces_after_s() const { return pieces_after_s_; }

 private:
  explicit WindowApp(const WindowOrder& order);

  // window_app.cpp
  void frame(double dt_s);
  void draw_picture();
  bool measured_run_over();
  Result<void> finish_measured_run();
  // window_open.cpp: what is being opened and what is open
  void open(LoadOrder order);
  void poll_loading();
  void install(Loaded loaded);
  void begin_live();
  void start_live(const std::string& device);  ///< key of a choice
  void show_carved();
  bool start_hands(const std::vector<std::string>& devices);
  void make_live();
  MappingSettings mapping_for(const DeviceChoice& choice) const;
  void leave_replay();
  void choose_felt(const FeltWish& wish);
  void poll_felt();
  // window_refine.cpp: light and pieces of a case that was opened at once
  void begin_refining(const Loaded& loaded);
  const std::string& wanted_source() const;
  void poll_refining();
  bool may_exchange() const;
  void exchange(FinerCase finer);
  double share_refined() const;
  ViewState picture_view() const;  ///< `view_`, as far as it can be drawn yet
  void fail_loading(const std::string& message);
  // window_model.cpp
  UiModel build_model();
  // window_requests.cpp
  void apply(const UiRequests& requests);
  void go_to_segmentation();
  void apply_view(const UiRequests& requests);
  void apply_run(const UiRequests& requests);
  void learn_pedal(const PedalReadings& now);
  void apply_device(const UiRequests& requests);
  void apply_replay(const UiRequests& requests);
  void toggle_recording();
  void save_screenshot(bool whole_window);
  // window_checkup.cpp
  void begin_checkup(bool push);
  void poll_checkup();
  void end_checkup();
  void apply_checkup(const UiRequests& requests);
  void install_udev();
  std::string no_checkup_because() const;
  CheckupModel checkup_model() const;
  // window_scene.cpp: pointer and keys over the picture
  void poll_scene(double dt_s, double wheel);
  HandWishes poll_pedals();
  void hold_probe(bool held);
  void pick_under_pointer(const SceneInput& input);
  bool over_outside(const SceneInput& input) const;
  CoveredEdges covered_edges() const;
  // window_edit.cpp: a bone's surface is edited
  void begin_edit();
  void end_edit();
  bool poll_edit(const SceneInput& input);
  void drag_edit(const SceneInput& input, const Pose& X_WB);
  void show_edit();
  void apply_edit(const EditRequests& requests);
  void poll_edit_save();
  EditModel edit_model() const;
  std::vector<EditDot> edit_dots() const;
  Pose edited_pose() const;
  // window_bend.cpp: a joint is bent
  bool can_bend() const;
  void apply_bend(const BendWish& wish);
  void end_bend();
  void show_bend();
  void hide_while_bending(ViewState& view) const;
  std::vector<JointModel> joint_models() const;
  // window_patient.cpp: a patient is made
  void choose_patient(PatientOrder order);
  void apply_patient(const PatientRequests& requests);
  void poll_patient();
  PatientModel patient_model() const;
  // window_exercise.cpp: an exercise is played
  void apply_exercise(const ExerciseRequests& requests);
  void show_exercise(const std::string& name);
  void open_exercise();
  bool want_instruments(const Scenario& scenario);
  void begin_exercise();
  void poll_exercise();
  void end_exercise();
  std::vector<Pose> exercise_poses(const std::vector<PlannedHand>& hands) const;
  Result<void> start_exercise_hands(const std::vector<PlannedHand>& hands);
  // window_hands.cpp: two hands, what they hold, the way back
  void make_tray();
  void apply_hands(const HandsRequests& requests);
  void apply_exchange(const HandsRequests& requests);
  void change_hands();
  void bring_to(std::size_t portal);
  const Vec3* portal_near() const;
  bool nudge_rested(SceneInput& input);
  void poll_device_buttons();
  void show_others();
  std::optional<Vec3> on_screen(const Vec3& p_W) const;
  void tell_marks();
  HandsModel hands_model();
  std::vector<HandRow> hand_rows() const;
  TipModel tip_model();
  std::vector<NameTag> name_tags() const;
  // window_views.cpp: what the picture shows
  PictureLayout picture_layout() const;
  std::vector<Pane> panes() const;
  Viewport pixels_of(const UiRect& r) const;
  Viewport viewport() const;
  bool shows_outside() const;
  FilmMoment moment() const;
  void tell_tray(const std::vector<std::string>& names, const Tray& tools);
  void update_views();
  void draw_panes(const ViewState& outside);
  Camera hand_camera() const;
  Viewport hand_viewport() const;
  void apply_views(const ViewsRequests& requests);
  std::string pane_message(PaneKind kind) const;
  ViewsModel views_model() const;
  // window_observer.cpp: the second window, and the film of this one
  void open_observer();
  void poll_observer();
  std::vector<Pane> observer_panes() const;
  int observer_scope_px() const;
  void draw_observer();
  void begin_film(const std::filesystem::path& file);
  void toggle_film();
  void poll_film();
  ScreenFilmModel film_model() const;
  // window_browser.cpp: what can be opened
  void apply_browser(const BrowserRequests& requests);
  void open_any(const std::string& path);
  // window_settings.cpp
  void recall_view();
  void remember_view();
  void remember();
  void recall_looks();
  void remember_looks();
  void remember_feel();

  bool ready() const { return renderer_.has_value() && !job_; }
  void note(ToastKind kind, const std::string& text) { toasts_.add(kind, text, now_s_); }

  WindowOrder order_;
  AppSettings settings_;
  std::optional<GlWindow> window_;
  std::unique_ptr<ImGuiHost> ui_;
  Toasts toasts_;
  FrameStats frames_;  ///< from picture to picture
  FrameStats work_;    ///< the work of each picture
  double now_s_ = 0;
  int first_pictures_ = 3;  ///< that still belong to loading: shaders are compiled for them
  int measured_frames_ = 0;
  double processor_start_s_ = 0;  ///< when the measured pictures began

  std::int64_t created_ns_ = 0;
  double first_picture_s_ = 0, pieces_after_s_ = 0;

  std::unique_ptr<SideJob<Loaded>> job_;
  std::string load_failure_;
  std::shared_ptr<const Case> case_;
  std::string case_source_;
  std::string finer_source_;  ///< the case as asked for, while bones are felt as hulls; else empty
  std::unique_ptr<SideJob<FinerCase>> refining_;
  std::unique_ptr<SideJob<PreparedCase>> lighting_;
  bool wants_segmentation_ = false;
  ProbePath demo_;
  std::optional<Renderer> renderer_;
  std::optional<PreparedCase> prepared_;  ///< of the case, until what is felt was measured over it
  std::unique_ptr<SideJob<PreparedCase>> felt_job_;  ///< while that is under way
  bool felt_known_ = false;                          ///< to the renderer
  std::shared_ptr<const CarvingSetup> carving_;      ///< for a live run of the case
  std::vector<std::string> instruments_;  ///< ordered by the command line: always in the tray
  std::optional<CarvedPicture> carved_;   ///< of the replay
  std::size_t carved_place_ = 0;          ///< of its cuts, that `carved_` shows
  std::uint64_t carved_run_ = 0;          ///< live run whose cuts the renderer shows
  double carved_s_ = 0;                   ///< when they were shown last
  PictureViews views_;
  PictureLayout layout_;
  ShownImage observer_picture_;
  std::unique_ptr<ObserverWindow> observer_;
  PictureLayout observer_layout_;
  std::unique_ptr<ScreenFilm> film_;  ///< while one is made
  double film_from_s_ = 0;
  std::unique_ptr<LiveRun> live_;
  std::optional<LoadedReplay> replay_;
  std::optional<ReplayPlayer> player_;
  std::vector<float> replay_force_;

  std::vector<DeviceChoice> choices_;
  ViewState view_;
  RenderSnapshot shown_;
  CameraControl control_;
  ScenePoll poll_;
  Pedals pedals_;
  double mapping_changed_s_ = -1;  ///< not yet in effect; -1: it is
  std::string learning_pedal_;     ///< waits for the input that shall drive it; empty: none
  PedalReadings learning_from_;    ///< as all inputs were when the wait began
  BoneId hovered_, picked_, hovered_row_;
  double pointer_x_ = 0, pointer_y_ = 0;
  bool pointer_moved_ = false;  ///< since the program began
  bool probe_held_ = false;     ///< now
  bool probe_toggled_ = false;  ///< by M, stays
  bool help_open_ = false;

  std::unique_ptr<BoneEdit> edit_;
  std::unique_ptr<SideJob<std::filesystem::path>> edit_save_;  ///< while one runs
  static constexpr std::uint64_t kEditNotDrawn = ~std::uint64_t{0};
  std::uint64_t edit_drawn_ = 0;      ///< version of the surface that the renderer has
  std::optional<Vec3> edit_hover_;    ///< under the pointer, in Bone
  Vec3 edit_moved_C_ = Vec3::Zero();  ///< by the mouse since the grab
  bool edit_left_was_down_ = false;

  CaseBrowser browser_{data_home_dir()};
  std::string scan_to_segment_;  ///< that the segmentation's window opens; empty: the user chooses

  ExerciseRun exercise_;

  InstrumentTray tray_;
  TrayPictures tray_pictures_;
  bool tray_open_ = false, names_on_ = false;
  std::string tray_search_;
  std::vector<Portal> portals_;       ///< of the case
  std::optional<std::size_t> aimed_;  ///< portal that a hand was brought to
  std::uint32_t buttons_before_ = 0;  ///< of the active hand's device
  TipGauge tip_;
  std::vector<Vec3> bone_middles_B_;  ///< where their names stand
  std::vector<TimelineMark> marks_;   ///< of the run or the replay
  std::size_t marks_told_ = 0;        ///< events that `marks_` has seen

  std::optional<BendWish> bend_;  ///< shown, until the case is open in that pose
  bool bend_had_force_ = true;    ///< before it began

  bool patient_open_ = false;
  PatientOrder patient_order_;
  PatientChoices patient_choices_;  ///< of its anatomy; empty until first needed
  std::string patient_problem_;
  std::unique_ptr<SideJob<SavedPatient>> patient_job_;  ///< while one is made

  bool checkup_open_ = false;
  std::unique_ptr<SideJob<CheckupOutcome>> checkup_;  ///< while one runs
  CheckupReport checkup_report_;                      ///< of the last one
};

}  // namespace osteon
