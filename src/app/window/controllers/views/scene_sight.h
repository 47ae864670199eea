#pragma once

#include <optional>
#include <string>
#include <vector>

#include "osteon/render/scope_renderer.h"
#include "ui/camera_control.h"
#include "window/controllers/cases/shown_case.h"
#include "window/controllers/window_host.h"
#include "window/ui_requests.h"

namespace osteon {

struct UiModel;

/// What the user looks at: the camera, the looks of bones, which views the picture has and where,
/// and what the pointer is on.
class SceneSight {
 public:
  SceneSight(WindowHost& host, ShownCase& scene)
      : host_(host), scene_(scene), layout_(host.order.layout) {}

  ViewState& view() { return view_; }
  const ViewState& view() const { return view_; }
  /// What stands in the picture now.
  RenderSnapshot& shown() { return shown_; }
  const RenderSnapshot& shown() const { return shown_; }
  /// Instruments that are only shown.
  void set_ghosts(std::vector<GhostTool> ghosts) { ghosts_ = std::move(ghosts); }
  const std::vector<GhostTool>& ghosts() const { return ghosts_; }
  BoneId picked() const { return picked_; }
  void pick(BoneId bone) { picked_ = bone; }

  /// A case has been opened. The same one felt otherwise: the user goes on looking at what he
  /// looked at.
  void begin_case(bool same_case);
  /// Null: nothing does.
  void show_what_gives_way(const SoftSetup* setup);
  void apply(const UiRequests& requests);
  void set_layout(PictureLayout layout) { layout_ = layout; }
  /// While a bone's surface is edited the picture is the one from outside.
  void keep_outside(bool on) { outside_only_ = on; }
  PictureLayout layout() const { return outside_only_ ? PictureLayout::kOutside : layout_; }
  void fly_to(const Camera& camera) { control_.fly_to(view_.camera, camera); }
  /// As a case is looked at when it is opened: all of it, between the cards.
  void look_at_all();
  /// Close up on a bone; on none: on the joint.
  void fly_close_up(BoneId bone);

  /// From outside the cards may cover the picture's sides; what else is shown stands between them.
  std::vector<Pane> panes() const;
  Viewport pixels_of(const UiRect& r) const;
  /// Of the view from outside; where that is not shown, the large pane.
  Viewport viewport() const;
  bool shows_outside() const;
  CoveredEdges covered_edges() const;
  /// A point of the window in the picture's pixels; may lie beside it.
  struct PicturePoint {
    double x = 0, y = 0;
    bool inside = false;
  };
  PicturePoint in_picture(double x, double y) const;
  /// Gives points of the scene in the interface's coordinates; none behind the eye, and none where
  /// the view from outside is not shown. For one picture.
  class Projector {
   public:
    explicit Projector(const SceneSight& sight);
    std::optional<Vec3> operator()(const Vec3& p_W) const;

   private:
    const Camera& camera_;
    Viewport viewport_;
    bool shown_;
    double ratio_, below_;  ///< pixels a unit; pixels of the window under the viewport's top
  };
  Projector projector() const { return Projector(*this); }
  std::optional<Vec3> on_screen(const Vec3& p_W) const { return projector()(p_W); }
  /// As a hand by mouse is led: with the scope's picture large, it goes where it is seen to go
  /// there.
  Camera hand_camera() const;
  Viewport hand_viewport() const { return pixels_of(panes().front().area); }

  /// Pointer and wheel turn the camera.
  void move_camera(const SceneInput& input);
  bool dragging() const { return control_.dragging(); }
  /// `free`: no panel and no hand has the pointer.
  void pick_under_pointer(const SceneInput& input, bool free);
  void highlight(ViewState& view) const;

  /// What hands may hold, for who draws it.
  void set_tray(const std::vector<std::string>& names, const Tray& tools,
                std::span<const Instrument> instruments = {});
  void describe(UiModel& model) const;

 private:
  void recall();

  WindowHost& host_;
  ShownCase& scene_;
  ViewState view_;
  RenderSnapshot shown_;
  std::vector<GhostTool> ghosts_;
  CameraControl control_;
  PictureLayout layout_;
  bool outside_only_ = false;
  BoneId hovered_, picked_, hovered_row_;
  double pointer_x_ = 0, pointer_y_ = 0;
  bool pointer_moved_ = false;  ///< since the program began
};

}  // namespace osteon
