#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/render/joint_roof.h"
#include "osteon/render/joint_room.h"
#include "osteon/render/scope_renderer.h"
#include "runs/pictures/film_fluoro.h"
#include "runs/pictures/film_view.h"
#include "runs/pictures/panorama.h"
#include "runs/pictures/scope_lens.h"
#include "ui/side_job.h"
#include "water/scope_water.h"
#include "water/water_drift.h"
#include "window/pictures/kept_shots.h"
#include "window/views_model.h"

namespace osteon {

/// Views of an open case beside the one from outside: through a scope, panorama, X-ray pictures.
/// They share the surfaces of the window's renderer. Needs the window's context in every call and
/// in the destructor. What takes long is made beside the window: the joint's wall, X-ray pictures.
class PictureViews {
 public:
  /// What was open before is forgotten, but for X-ray pictures of the same case felt otherwise.
  /// `main` draws the case.
  void begin(std::shared_ptr<const Case> the_case, const Renderer& main, bool same_case);
  /// What hands may hold, by ToolState::instrument. Fails where a scope's file cannot be read; no
  /// instrument is looked through then.
  /// `instruments`: those of the names, where they have been read already.
  Result<void> set_tray(const std::vector<std::string>& names, const Tray& tools,
                        std::span<const Instrument> instruments = {});

  /// How the scene stands now, its first tool the active hand's; before any drawing of a picture.
  /// Fails once where something could not be made: the text is for the user.
  Result<void> set_moment(const FilmMoment& moment);
  /// Shown in the panorama as well, from now on.
  void set_ghosts(const std::vector<GhostTool>& ghosts) { ghosts_ = ghosts; }
  const FilmMoment& moment() const { return moment_; }
  /// None: no case with a joint that is filled is open.
  const std::optional<FluidJoint>& joint() const { return joint_; }

  /// Through which tool one looks: the active hand's, else the first other's; none: through none.
  std::optional<std::size_t> looking() const;
  /// Its camera; none where nobody looks.
  std::optional<ScopeCamera> scope_camera() const;
  /// The tip is so far from the joint that nothing of it is lit, or before the skin.
  bool scope_is_outside() const { return scope_is_far() || scope_is_before_skin(); }
  /// Skin that is felt has a way in by its portals alone: in none of them a scope sees no joint.
  bool scope_is_before_skin() const;
  void set_skin_felt(bool felt) { skin_felt_ = felt; }
  /// By place in the tray: a scope to take; none: the tray has none.
  std::optional<std::uint32_t> scope_in_tray() const;

  /// Draws into viewports of the framebuffer that is bound. One drawing through the scope serves
  /// all places: `most_px` is the side of the largest.
  void draw_scope(const Viewport& viewport, int most_px);
  /// What the scope shows now, a square of so many pixels a side. Empty where nobody looks through
  /// one; fails where it cannot be drawn.
  Result<Image> scope_still(int side_px);
  /// From the next picture on.
  void set_white_balance(const WhiteBalance& white) { white_ = white; }
  const WhiteBalance& white_balance() const { return white_; }
  /// `observer`: in the second window, whose pictures are kept by themselves.
  void draw_panorama(const Viewport& viewport, bool observer = false);
  /// As the observer sees the scene: `view`'s looks from the front.
  void draw_outside(const Viewport& viewport, const ViewState& view);
  void draw_fluoro(const Viewport& viewport) const;

  /// Takes an X-ray picture of the scene as it stands; while one is made, nothing.
  void shoot(CutScene cut);
  bool shooting() const { return shot_job_ != nullptr; }
  bool has_shot() const { return !shots_.empty(); }
  void apply(const XrayRequests& requests);
  XrayModel xray_model() const;
  /// Something is being made that will change the picture.
  bool busy() const { return wall_job_ || shot_job_; }

 private:
  std::vector<GhostTool> ghosts_through_scope() const;
  bool scope_is_far() const;
  struct Wall {
    std::shared_ptr<const JointRoom> room;
    std::shared_ptr<const JointRoof> roof;
    std::optional<TriMesh> mesh;  ///< none: the tip lies in bone
  };
  Result<void> ensure_scope();
  void set_scope_scene(std::size_t hand);
  void ask_for_wall(const Vec3& tip_W);
  void poll_wall();
  void drift();
  Result<void> poll_shot();
  /// A view of the scene with what it shows beside it.
  struct Panorama {
    std::optional<Renderer> renderer;
    std::vector<Pose> cones;       ///< that it has
    std::optional<Camera> camera;  ///< for `aspect`: finding it asks every vertex
    double aspect = 0;
  };
  void update_cones(Panorama& panorama) const;

  std::shared_ptr<const Case> case_;
  const Renderer* main_ = nullptr;  ///< of the window
  std::optional<Renderer> observer_;
  Panorama panorama_, observer_panorama_;
  std::optional<ScopeRenderer> scope_;
  bool scope_failed_ = false;
  std::optional<FluidJoint> joint_;
  std::optional<WaterDrift> drift_;  ///< none: there is no joint with water
  Lenses lenses_;
  Tray tray_;
  FilmMoment moment_;
  std::vector<GhostTool> ghosts_;
  bool scope_painted_ = false;  ///< of this moment
  bool skin_felt_ = false;
  WhiteBalance white_;

  std::shared_ptr<const JointRoom> room_;
  std::shared_ptr<const JointRoof> roof_;
  std::unique_ptr<SideJob<Wall>> wall_job_;
  std::optional<Vec3> wall_at_W_;  ///< that the newest wall was asked for
  bool wall_known_ = false, wall_empty_ = false;

  std::optional<ViewState> panorama_view_;

  std::shared_ptr<std::optional<FilmFluoro>> fluoro_;  ///< made with the first picture
  std::unique_ptr<SideJob<XrayPicture>> shot_job_;
  KeptShots shots_;
  CArmTurn turn_;
  std::uint64_t pulses_ = 0;  ///< that were asked for: each has noise of its own
  std::optional<Error> failure_;
};

}  // namespace osteon
