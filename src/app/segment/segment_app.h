#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "segment/segment_panels.h"
#include "segment/segment_work.h"
#include "segment/segmenting.h"
#include "segment/slice_texture.h"
#include "segment/solid_view.h"
#include "ui/app_settings.h"
#include "ui/desktop_chooser.h"
#include "ui/frame_stats.h"
#include "ui/gl_window.h"
#include "ui/imgui_host.h"
#include "ui/side_job.h"
#include "ui/toasts.h"

namespace osteon {

/// What the command line asks of the segmentation window.
struct SegmentOrder {
  ScanOrder scan;                    ///< without a source the user chooses one
  std::filesystem::path out;         ///< the case to save; empty: a new one among the user's
  std::filesystem::path screenshot;  ///< saved after `frames` pictures; then the program ends
  int frames = 0;                    ///< pictures to draw once all is ready; 0: no end
  int width = 0, height = 0;         ///< 0: as the simulator's window was last time
  double interface_scale = 0;        ///< 0: the display's, times the user's zoom
  bool suggest = false;              ///< begins with the bones that the import finds
  std::string choose;                ///< name of the bone to begin with; empty: none
  bool fresh = false;                ///< does not read the settings file
  bool returns = false;              ///< the simulator's window comes after this one
};

/// The main loop of the segmentation window. Runs on the main thread.
class SegmentApp {
 public:
  static Result<std::unique_ptr<SegmentApp>> create(const SegmentOrder& order);
  /// Until the user closes the window. Fails when an ordered picture could not be made.
  Result<void> run();
  const FrameStats& frame_stats() const { return work_; }
  /// The saved case that the user wants to go on with in the simulator; empty: none.
  const std::filesystem::path& case_to_open() const { return case_to_open_; }

 private:
  explicit SegmentApp(const SegmentOrder& order);

  void frame();
  void tell_title();
  SegmentModel shown_model();
  void place_panes(const SegmentLayout& layout);
  void draw_panes();
  void draw_solid(const SegmentLayout& layout);
  Viewport viewport_of(const UiRect& rect) const;
  void choose(std::uint16_t label);
  void apply(const SegmentRequests& requests, const SegmentLayout& layout);
  void apply_window(const SegmentRequests& requests);
  void apply_closing(const SegmentRequests& requests);
  SegmentRequests in_pane_pixels(SegmentRequests requests) const;
  bool changed() const { return segmenting_ && segmenting_->edit().is_changed(); }
  bool wants_to_end();
  bool measured_run_over();
  Result<void> finish_measured_run();
  bool holds_saved_case() const;
  // segment_app_work.cpp
  void choose_scan(const std::filesystem::path& near);
  void apply_chooser(const SegmentRequests& requests);
  void ask_desktop(const SegmentRequests& requests);
  void open_together(const std::vector<std::string>& paths);
  void open_chosen(const std::filesystem::path& source);
  void begin_opening();
  void cancel_opening();
  void poll_opening();
  void begin_suggestion();
  void poll_suggestion();
  void begin_heavy(const SegmentRequests& requests);
  void poll_heavy();
  void begin_saving();
  void poll_saving();
  bool at_work() const;
  // segment_app_model.cpp
  static LoadingModel job_model(const LoadProgress& progress);
  SegmentModel build_model() const;
  void fill_panes(SegmentModel& model) const;
  void fill_bones(SegmentModel& model) const;
  std::string under_pointer() const;

  void note(ToastKind kind, std::string text);

  SegmentOrder order_;
  AppSettings settings_;
  std::optional<GlWindow> window_;
  std::unique_ptr<ImGuiHost> ui_;
  Toasts toasts_;
  FrameStats work_;
  double now_s_ = 0;
  int measured_frames_ = 0;
  std::string title_;
  bool help_open_ = false, panels_open_ = true;
  bool asks_to_close_ = false, ends_ = false, ends_when_saved_ = false;

  std::optional<ScanChooserModel> chooser_;  ///< while a scan is being chosen
  DesktopChooser desktop_;
  bool chosen_in_window_ = false;  ///< the scan, not on the command line
  bool out_given_ = false;
  std::filesystem::path case_to_open_;
  std::unique_ptr<SideJob<OpenedScan>> opening_;
  std::string failure_;  ///< of opening, in words
  std::optional<Segmenting> segmenting_;
  HuRange values_;
  Pose X_WP_;         ///< of the case
  std::string side_;  ///< of the case
  std::unique_ptr<SideJob<SuggestedLabels>> suggesting_;
  std::unique_ptr<SideJob<SavedSegments>> saving_;
  /// A change that may take seconds on a large scan. While it runs, nobody else touches
  /// `segmenting_`, and the window shows `last_model_`.
  std::unique_ptr<SideJob<bool>> heavy_;
  double heavy_since_s_ = 0;
  SegmentModel last_model_;
  bool saved_before_ = false;  ///< the case at `order_.out` is this window's own
  std::uint64_t saving_version_ = 0;

  std::array<SliceTexture, 3> textures_;
  struct Drawn {
    std::uint64_t look = ~std::uint64_t{0};
    int slice = -1;
  };
  std::array<Drawn, 3> drawn_;  ///< what the textures show
  std::vector<Rgba> pixels_;
  std::unique_ptr<SolidView> solid_;
  std::optional<PaneInput> pointer_;  ///< over a slice, in its pixels
};

}  // namespace osteon
