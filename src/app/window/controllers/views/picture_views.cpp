#include "window/controllers/views/picture_views.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "cases/scoped_case.h"
#include "osteon/base/file.h"
#include "osteon/render/anatomical_view.h"

namespace osteon {
namespace {

constexpr double kWallMoves_m = 0.008;  // of the tip, before the joint's wall is shaped anew
constexpr double kConeStill_m = 1e-4;   // of a scope, before its cone is drawn anew
constexpr double kConeStill_rad = 2e-3;
constexpr int kShot_px = 512;
constexpr double kDegree_rad = std::numbers::pi / 180;

bool looks_alike(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm() < kConeStill_m && a.q.angularDistance(b.q) < kConeStill_rad;
}

std::span<const ToolState> tools_of(const FilmMoment& moment) {
  return {moment.tools.data(), moment.hands};
}

}  // namespace

void PictureViews::begin(std::shared_ptr<const Case> the_case, const Renderer& main,
                         bool same_case) {
  wall_job_.reset();
  shot_job_.reset();
  case_ = std::move(the_case);
  main_ = &main;
  joint_ = filled_joint(*case_);
  panorama_ = {};
  observer_panorama_ = {};
  observer_.reset();
  scope_.reset();
  scope_failed_ = false;
  room_.reset();
  roof_.reset();
  drift_.reset();
  wall_at_W_.reset();
  wall_known_ = wall_empty_ = false;
  panorama_view_.reset();
  fluoro_.reset();
  if (!same_case) shots_.clear();
  failure_.reset();
}

Result<void> PictureViews::set_tray(const std::vector<std::string>& names, const Tray& tools,
                                    std::span<const Instrument> instruments) {
  fluoro_.reset();
  tray_ = tools;
  drift_.reset();
  if (joint_) drift_.emplace(*joint_, tools);
  lenses_.clear();
  auto found = instruments.empty() ? lenses_of(names) : lenses_of(names, instruments);
  if (!found) return tl::unexpected(found.error());
  lenses_ = std::move(*found);
  return {};
}

Result<void> PictureViews::set_moment(const FilmMoment& moment) {
  moment_ = moment;
  scope_painted_ = false;
  if (scope_) scope_->set_water(joint_ ? scope_water(*joint_, moment_.bones) : ScopeWater());
  poll_wall();
  drift();
  if (auto shot = poll_shot(); !shot) failure_ = shot.error();
  if (!failure_) return {};
  return tl::unexpected(*std::exchange(failure_, {}));
}

// Before the joint's shape is known nothing rises in it.
void PictureViews::drift() {
  if (!drift_ || !scope_) return;
  const auto hand = looking();
  const auto roof = [this](const Vec3& p_W, double most_m) -> std::optional<double> {
    if (!roof_) return std::nullopt;
    return roof_->distance(moment_.bones, p_W, Vec3::UnitZ(), most_m);
  };
  drift_->go_to(moment_.time_s, tools_of(moment_), moment_.bones,
                hand ? std::optional(moment_.tools[*hand].X_WP.p) : std::nullopt, roof);
  scope_->set_water_bits(drift_->bits());
}

std::optional<std::size_t> PictureViews::looking() const {
  return first_looking(lenses_, tools_of(moment_));
}

// An expert's own scope would stand before the lens.
std::vector<GhostTool> PictureViews::ghosts_through_scope() const {
  std::vector<GhostTool> seen;
  for (const GhostTool& ghost : ghosts_)
    if (ghost.instrument >= lenses_.size() || !lenses_[ghost.instrument]) seen.push_back(ghost);
  return seen;
}

// A box for exercises has no wall, wherever the tip is.
bool PictureViews::scope_is_far() const {
  return wall_known_ && wall_empty_ && !case_->name.starts_with("fast_");
}

bool PictureViews::scope_is_before_skin() const {
  const auto hand = looking();
  return skin_felt_ && hand && moment_.tools[*hand].portal == kNoPortal;
}

std::optional<ScopeCamera> PictureViews::scope_camera() const {
  const auto hand = looking();
  if (!hand) return std::nullopt;
  const ToolState& tool = moment_.tools[*hand];
  return ScopeCamera(*lens_of_tool(lenses_, tool), scope_pose(tool.X_WP));
}

// The one that most look through: the angle of 30 degrees.
std::optional<std::uint32_t> PictureViews::scope_in_tray() const {
  constexpr double kUsual_rad = 0.52;
  std::optional<std::uint32_t> best;
  double least = 10;
  for (std::size_t k = 0; k < lenses_.size(); ++k) {
    if (!lenses_[k]) continue;
    const double off = std::abs(lenses_[k]->angle_rad - kUsual_rad);
    if (off >= least) continue;
    least = off;
    best = static_cast<std::uint32_t>(k);
  }
  return best;
}

Result<void> PictureViews::ensure_scope() {
  if (scope_) return {};
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  auto made = ScopeRenderer::create(*case_, *data, *main_);
  if (!made) return tl::unexpected(made.error());
  scope_.emplace(std::move(*made));
  return {};
}

void PictureViews::ask_for_wall(const Vec3& tip_W) {
  if (wall_job_) return;
  if (wall_at_W_ && (tip_W - *wall_at_W_).norm() < kWallMoves_m) return;
  wall_at_W_ = tip_W;
  wall_job_ = std::make_unique<SideJob<Wall>>([room = room_, roof = roof_, the_case = case_,
                                               bones = moment_.bones, tip_W](const Progress&) {
    Wall wall{room ? room : std::make_shared<const JointRoom>(*the_case), roof, {}};
    if (auto made = wall.room->wall(bones, tip_W)) wall.mesh = std::move(*made);
    if (!wall.mesh) return Result<Wall>(std::move(wall));
    const JointRoof parts = roof ? *roof : JointRoof(*the_case);
    wall.roof = std::make_shared<const JointRoof>(parts.with_wall(*wall.mesh));
    return Result<Wall>(std::move(wall));
  });
}

// Where the tip stands in bone for a moment, the wall stays as it was.
void PictureViews::poll_wall() {
  if (!wall_job_ || !wall_job_->done()) return;
  auto wall = wall_job_->take();
  wall_job_.reset();
  if (!wall) {
    failure_ = wall.error();
    return;
  }
  room_ = std::move(wall->room);
  roof_ = std::move(wall->roof);
  if (!wall->mesh || !scope_) return;
  wall_known_ = true;
  wall_empty_ = wall->mesh->triangles.empty();
  scope_->set_wall(*wall->mesh);
}

void PictureViews::set_scope_scene(std::size_t hand) {
  std::vector<ToolState> others;
  for (std::size_t h = 0; h < moment_.hands; ++h)
    if (h != hand) others.push_back(moment_.tools[h]);
  scope_->set_scene(moment_.bones, others);
  scope_->set_ghosts(ghosts_through_scope());
  scope_->set_white_balance(white_);
  ask_for_wall(moment_.tools[hand].X_WP.p);
}

Result<Image> PictureViews::scope_still(int side_px) {
  const auto hand = looking();
  if (!hand || scope_is_before_skin()) return Image{};
  if (auto ok = ensure_scope(); !ok) return tl::unexpected(ok.error());
  set_scope_scene(*hand);
  const bool slow = main_->software_driver();
  Image image = scope_->draw_image(*scope_camera(), side_px, side_px,
                                   slow ? RenderQuality::kFast : RenderQuality::kFine);
  if (image.rgb.empty()) return fail("the graphics driver has no memory for it", "the still");
  return image;
}

void PictureViews::draw_scope(const Viewport& viewport, int most_px) {
  fill_viewport(viewport, 0, 0, 0);
  const auto hand = looking();
  if (!hand || viewport.empty() || scope_failed_ || scope_is_before_skin()) return;
  if (auto ok = ensure_scope(); !ok) {
    scope_failed_ = true;
    failure_ = ok.error();
    return;
  }
  if (!scope_painted_) {
    set_scope_scene(*hand);
    scope_painted_ = scope_->paint(*scope_camera(), most_px);
  }
  if (scope_painted_) scope_->show(fitted(viewport, 1, 1));
}

void PictureViews::update_cones(Panorama& panorama) const {
  std::vector<Pose> now;
  for (const ToolState& tool : tools_of(moment_))
    if (lens_of_tool(lenses_, tool)) now.push_back(tool.X_WP);
  if (std::equal(now.begin(), now.end(), panorama.cones.begin(), panorama.cones.end(), looks_alike))
    return;
  panorama.renderer->set_moving_marks(sight_marks(lenses_, tools_of(moment_)));
  panorama.cones = std::move(now);
}

void PictureViews::draw_panorama(const Viewport& viewport, bool observer) {
  if (!main_ || viewport.empty()) return;
  Panorama& panorama = observer ? observer_panorama_ : panorama_;
  if (!panorama.renderer) panorama.renderer.emplace(main_->another_view());
  if (!panorama.camera || panorama.aspect != viewport.aspect()) {
    const auto camera = panorama_camera(*case_, "front", viewport.aspect());
    if (!camera) return;
    panorama.camera = *camera;
    panorama.aspect = viewport.aspect();
  }
  if (!panorama_view_) panorama_view_ = panorama_view(*case_, *panorama.camera);
  panorama_view_->camera = *panorama.camera;
  update_cones(panorama);
  panorama.renderer->set_others({moment_.tools.data() + 1, moment_.hands - 1});
  panorama.renderer->set_ghosts(ghosts_);
  panorama.renderer->draw({moment_.bones, moment_.tools[0]}, *panorama_view_, viewport);
}

void PictureViews::draw_outside(const Viewport& viewport, const ViewState& view) {
  if (!main_ || viewport.empty()) return;
  if (!observer_) observer_.emplace(main_->another_view());
  ViewState front = view;
  front.camera = preset_camera(ViewPreset::kDorsal, *case_, viewport.aspect());
  observer_->set_others({moment_.tools.data() + 1, moment_.hands - 1});
  observer_->set_ghosts(ghosts_);
  observer_->draw({moment_.bones, moment_.tools[0]}, front, viewport);
}

void PictureViews::draw_fluoro(const Viewport& viewport) const {
  fill_viewport(viewport, 0, 0, 0);
  shots_.show(viewport);
}

// The fluoroscope belongs to the thread that makes the picture until that is done.
void PictureViews::shoot(CutScene cut) {
  if (shot_job_ || !case_ || moment_.hands == 0) return;
  if (!fluoro_) fluoro_ = std::make_shared<std::optional<FilmFluoro>>();
  FilmFluoro::ShotOrder order;
  order.orbit_rad = turn_.orbit_deg * kDegree_rad;
  order.angulation_rad = turn_.tilt_deg * kDegree_rad;
  order.side = kShot_px;
  order.seed = ++pulses_;
  shot_job_ = std::make_unique<SideJob<XrayPicture>>(
      [fluoro = fluoro_, the_case = case_, tray = tray_, moment = moment_, order, turn = turn_,
       cut = std::move(cut)](const Progress&) -> Result<XrayPicture> {
        if (!*fluoro) {
          auto made = FilmFluoro::create(*the_case, tray);
          if (!made) return tl::unexpected(made.error());
          fluoro->emplace(std::move(*made));
        }
        auto shot = (*fluoro)->shoot(moment, order, [&cut] { return cut; });
        if (!shot) return tl::unexpected(shot.error());
        return XrayPicture{grey_image(*shot), turn,        shot->exposure,
                           shot->dose,        shot->hands, moment.time_s};
      });
}

Result<void> PictureViews::poll_shot() {
  if (!shot_job_ || !shot_job_->done()) return {};
  auto picture = shot_job_->take();
  shot_job_.reset();
  if (!picture) return tl::unexpected(picture.error());
  shots_.add(std::move(*picture));
  return {};
}

void PictureViews::apply(const XrayRequests& requests) {
  if (requests.turn)
    turn_ = {std::clamp(requests.turn->orbit_deg, -kMostOrbit_deg, kMostOrbit_deg),
             std::clamp(requests.turn->tilt_deg, -kMostTilt_deg, kMostTilt_deg)};
  if (requests.show) shots_.choose(*requests.show);
  if (requests.begin_again) shots_.clear();
}

XrayModel PictureViews::xray_model() const {
  XrayModel model = shots_.model();
  model.turn = turn_;
  return model;
}

}  // namespace osteon
