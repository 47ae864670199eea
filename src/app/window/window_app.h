#pragma once

#include <memory>
#include <string>

#include "ui/frame_stats.h"
#include "window/controllers/cases/bend_control.h"
#include "window/controllers/cases/browser_control.h"
#include "window/controllers/cases/checkup_control.h"
#include "window/controllers/cases/notes_control.h"
#include "window/controllers/cases/patient_control.h"
#include "window/controllers/sessions/exercise_control.h"
#include "window/controllers/sessions/run_marks.h"
#include "window/controllers/sessions/run_news.h"
#include "window/controllers/views/film_control.h"
#include "window/controllers/views/scene_pointer.h"
#include "window/controllers/views/sound_control.h"
#include "window/controllers/views/views_control.h"
#include "window/window_order.h"

namespace osteon {

/// The window's main loop: lets its controllers act, draws, and passes between them what the user
/// asked for. Runs on the main thread. A controller knows those above it in the list of members,
/// none below.
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
  bool software_driver() const { return scene_.renderer && scene_.renderer->software_driver(); }
  /// The window was closed to segment a scan; the case that was open comes back after that.
  bool wants_segmentation() const { return browser_.wants_segmentation(); }
  const std::string& scan_to_segment() const { return browser_.scan_to_segment(); }
  const std::string& case_source() const {
    return scene_.source.empty() ? host_.order.case_spec : scene_.wanted_source();
  }
  /// Since the program began: when the first picture with bones stood, and when the last of what is
  /// felt was there; 0: not yet, or from the start.
  double first_picture_s() const { return first_picture_s_; }
  double pieces_after_s() const { return cases_.pieces_after_s(); }

 private:
  explicit WindowApp(const WindowOrder& order) : host_(order) {}

  void frame(double dt_s);
  void poll_jobs();
  void poll_loading();
  void install(Loaded loaded);
  void begin_ordered();
  void move_scene(double dt_s, double wheel);
  void draw_picture();
  void make_sound();
  ViewState picture_view() const;  ///< as far as it can be drawn yet
  UiModel build_model();
  void apply(const UiRequests& requests);
  void apply_window(const UiRequests& requests);
  void apply_scene(const UiRequests& requests);
  bool may_change_case() const;
  void save_screenshot(bool whole_window);
  void remember();
  bool measured_run_over();
  Result<void> finish_measured_run();

  WindowHost host_;
  FrameStats frames_;       ///< from picture to picture
  FrameStats work_;         ///< the work of each picture
  int first_pictures_ = 3;  ///< that still belong to loading: shaders are compiled for them
  int measured_frames_ = 0;
  double processor_start_s_ = 0;  ///< when the measured pictures began
  double first_picture_s_ = 0;
  bool help_open_ = false;

  ShownCase scene_;
  SceneSight sight_{host_, scene_};
  LiveControl live_{host_, scene_, sight_};
  ReplayControl replay_{host_, sight_};
  RunMarks marks_{scene_, live_, replay_};
  RunNews run_news_{host_, scene_, live_};
  HandsControl hands_{host_, scene_, sight_, live_};
  ObserverControl observer_{host_, scene_};
  FilmControl film_{host_};
  SoundControl sound_{host_, film_};
  ViewsControl views_{host_, scene_, sight_, live_, replay_, hands_, observer_};
  CaseControl cases_{host_, scene_, sight_, live_, replay_};
  EditControl edit_{host_, scene_, sight_, live_, cases_};
  BendControl bend_{host_, scene_, sight_, live_, cases_};
  NotesControl notes_{host_, scene_, sight_, live_, cases_};
  PatientControl patient_{host_, cases_};
  CheckupControl checkup_{host_, live_, cases_};
  BrowserControl browser_{host_, scene_, live_, cases_};
  ExerciseControl exercise_{host_, scene_, sight_, live_, cases_};
  ScenePointer pointer_{host_, sight_, live_, hands_, edit_, notes_};
};

}  // namespace osteon
