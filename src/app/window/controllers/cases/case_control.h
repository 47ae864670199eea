#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ui/side_job.h"
#include "window/controllers/sessions/live_control.h"
#include "window/controllers/sessions/replay_control.h"
#include "window/jobs/load_job.h"
#include "window/jobs/window_jobs.h"

namespace osteon {

struct UiModel;

/// What is being opened and what is open. A case that was opened at once gets its light and what is
/// felt of it later.
class CaseControl {
 public:
  CaseControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live,
              ReplayControl& replay)
      : host_(host), scene_(scene), sight_(sight), live_(live), replay_(replay) {}

  /// `as_ordered`: whole, though that takes longer. Refused while a run is recorded.
  void open(LoadOrder order, bool as_ordered = false);
  bool loading() const { return job_ != nullptr; }
  /// Something is on show and nothing is being opened.
  bool ready() const { return scene_.renderer.has_value() && !job_; }
  const std::string& failure() const { return failure_; }
  void cancel();
  /// Loading has ended, well or not, since the last call: `loaded` is set where it ended well.
  bool poll(std::optional<Loaded>& loaded);
  /// Puts a loaded case on show. False: it could not be drawn, and the reason is told.
  bool show(Loaded& loaded);

  /// Once a picture. `at_rest`: what is felt may change unnoticed. True: the renderer has new
  /// surfaces.
  bool poll_finer(bool at_rest);
  /// Opens the case again: what is felt is part of it, and of what a recording names.
  void choose_felt(const FeltWish& wish);
  /// What is felt is known to the renderer.
  bool felt_known() const { return felt_known_; }
  /// Something is being made that will change the picture.
  bool busy() const { return felt_job_ || refining_ || lighting_; }
  /// Since the program began; 0: not yet, or from the start.
  double pieces_after_s() const { return pieces_after_s_; }
  /// While nothing can be shown.
  void describe_loading(UiModel& model) const;
  void describe(UiModel& model) const;

 private:
  void fail_loading(const std::string& message);
  void begin_finer(const Loaded& loaded);
  bool poll_light();
  void poll_pieces();
  bool poll_felt();
  void exchange(FinerCase finer);

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  ReplayControl& replay_;
  std::unique_ptr<SideJob<Loaded>> job_;
  std::string failure_;
  std::unique_ptr<SideJob<FinerCase>> refining_;
  std::unique_ptr<SideJob<PreparedCase>> lighting_;
  std::vector<bool> open_bones_;          ///< of the case on show, as its bones
  std::optional<PreparedCase> prepared_;  ///< of the case, until what is felt was measured over it
  std::unique_ptr<SideJob<PreparedCase>> felt_job_;  ///< while that is under way
  bool felt_known_ = false;
  double pieces_after_s_ = 0;
};

}  // namespace osteon
