#include "window/controllers/views/views_control.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "cases/xdg.h"
#include "runs/pictures/heat_picture.h"

namespace osteon {

std::vector<ToolState> ViewsControl::others() const {
  return live_.run() ? live_.run()->others() : replay_.others();
}

// The active hand first: what it holds counts before what rests.
FilmMoment ViewsControl::moment() const {
  FilmMoment moment;
  const RenderSnapshot& shown = sight_.shown();
  moment.time_s = shown.tool.time_s;
  moment.bones = shown.bones;
  moment.tools[0] = shown.tool;
  if (live_.run() && shown.tool.tick == 0) moment.tools[0].X_WP.p = Vec3::Constant(std::nan(""));
  for (const ToolState& tool : others())
    if (moment.hands < kMaxHands) moment.tools[moment.hands++] = tool;
  return moment;
}

CarvedPicture* ViewsControl::carved() {
  return live_.run() ? &live_.run()->carved() : replay_.carved();
}

// What was carved since the picture before. A processor that draws has to draw all of it anew then.
void ViewsControl::show_carved() {
  constexpr double kRest_s = 0.1;
  LiveRun* const live = live_.run();
  const auto run = live ? std::pair(live_.runs_made(), live->run_number())
                        : std::pair<std::uint64_t, std::uint64_t>();
  if (live && carved_run_ != run) scene_.renderer->clear_cubes();
  carved_run_ = run;
  if (scene_.renderer->software_driver() && host_.now_s - carved_s_ < kRest_s) return;
  CarvedPicture* const picture = carved();
  if (!picture) return;
  for (const CarvedPicture::Changed& changed : picture->changes()) {
    scene_.renderer->set_cubes(changed.bone, changed.grid, changed.cubes);
    carved_s_ = host_.now_s;
  }
  for (const CarvedPicture::Piece& piece : picture->new_pieces())
    scene_.renderer->set_loose(piece.shape, BoneId{piece.bone}, piece.surface);
  if (sight_.view().show_heat) show_heat(*picture);
}

// Two seconds of a run in a picture: what passed before anybody asked is soon worked out.
void ViewsControl::show_heat(CarvedPicture& picture) {
  constexpr std::size_t kPulses = 40;
  constexpr double kHeatRest_s = 0.25;
  const bool newest = picture.follow_heat(kPulses);
  if (newest && host_.now_s - heat_s_ < kHeatRest_s) return;
  for (const CarvedPicture::Warmed& warmed : picture.warmed()) {
    scene_.renderer->set_heat(warmed.bone, heat_cells(warmed.volume));
    heat_s_ = host_.now_s;
  }
}

// While a run begins anew nothing presses.
void ViewsControl::show_softs() {
  LiveRun* const live = live_.run();
  const auto setup = live ? live->softs() : replay_.softs();
  scene_.views.set_skin_felt(setup && !setup->skins.empty());
  softs_.show(scene_.the_case, setup, live ? live->pushes() : replay_.pushes(), host_.now_s,
              *scene_.renderer);
}

// The pump of a session that begins anew stands as the user has set it.
void ViewsControl::set_pump_again() {
  LiveRun* const live = live_.run();
  if (!live || !pump_) return;
  const std::pair run(live_.runs_made(), live->run_number());
  if (pump_run_ == run) return;
  if (live->set_pump(pump_->pump_pa, pump_->outlet_open)) pump_run_ = run;
}

Viewport ViewsControl::xray_viewport(const Pane& pane) const {
  const float scale = host_.ui->scale();
  return sight_.pixels_of(pane.large ? xray_places(pane.area, scale).picture : pane.area);
}

void ViewsControl::draw(const ViewState& looks) {
  scene_.renderer->set_others(others());
  scene_.renderer->set_ghosts(sight_.ghosts());
  show_carved();
  show_softs();
  PictureViews& views = scene_.views;
  views.set_ghosts(sight_.ghosts());
  if (auto ok = views.set_moment(moment()); !ok)
    host_.note(ToastKind::kError, ok.error().message());
  set_pump_again();
  const std::vector<Pane> all = sight_.panes();
  int most_px = observer_.scope_px();
  for (const Pane& pane : all) {
    const Viewport at = sight_.pixels_of(pane.area);
    if (pane.kind == PaneKind::kScope) most_px = std::max(most_px, std::min(at.width, at.height));
  }
  for (const Pane& pane : all) {
    const Viewport at = sight_.pixels_of(pane.area);
    if (pane.kind == PaneKind::kOutside) scene_.renderer->draw(sight_.shown(), looks, at);
    if (pane.kind == PaneKind::kScope) views.draw_scope(at, most_px);
    if (pane.kind == PaneKind::kPanorama) views.draw_panorama(at);
    if (pane.kind == PaneKind::kFluoro) views.draw_fluoro(xray_viewport(pane));
  }
}

void ViewsControl::picture_took(double picture_s) {
  if (!scene_.renderer || !scene_.renderer->software_driver() || !host_.order.screenshot.empty())
    return;
  if (scene_.renderer->drew_all()) detail_.took(picture_s);
  scene_.renderer->set_moving_detail(detail_.share());
}

// Beside the screenshots, under a name that tells of nobody.
void ViewsControl::keep_still() {
  constexpr int kStill_px = 1080;
  const auto image = scene_.views.scope_still(kStill_px);
  if (!image) return host_.note(ToastKind::kError, image.error().message());
  if (image->rgb.empty()) return host_.note(ToastKind::kInfo, "No hand looks through a scope");
  const std::filesystem::path folder = data_home_dir() / "pictures";
  std::error_code ignored;  // saving tells what is wrong
  std::filesystem::create_directories(folder, ignored);
  const std::filesystem::path file = dated_file(folder, "scope", ".png");
  if (const auto saved = save_png(*image, file); !saved)
    return host_.note(ToastKind::kError, saved.error().message());
  host_.note(ToastKind::kInfo, "Still saved as " + file.string());
}

void ViewsControl::apply(const ViewsRequests& requests) {
  if (requests.layout) sight_.set_layout(*requests.layout);
  if (requests.observer_layout) observer_.set_layout(*requests.observer_layout);
  if (requests.toggle_observer) observer_.toggle();
  if (requests.water) {
    pump_ = requests.water;
    pump_run_ = {};
    set_pump_again();
  }
  if (requests.white_balance) scene_.views.set_white_balance(*requests.white_balance);
  if (requests.keep_still) keep_still();
  scene_.views.apply(requests.xray);
  if (requests.shoot) {
    const CarvedPicture* const picture = carved();
    scene_.views.shoot(picture ? picture->cut_scene() : CutScene{});
    if (sight_.layout() != PictureLayout::kAll) sight_.set_layout(PictureLayout::kFluoro);
  }
  if (!requests.take_scope || !live_.run()) return;
  const auto scope = scene_.views.scope_in_tray();
  if (scope && *scope != sight_.shown().tool.instrument) hands_.take(*scope);
}

std::string ViewsControl::message_on(PaneKind kind) const {
  const PictureViews& views = scene_.views;
  if (kind == PaneKind::kFluoro && !views.has_shot())
    return views.shooting() ? "The X-ray picture is being made." : "B takes an X-ray picture.";
  if (kind != PaneKind::kScope) return {};
  if (!views.looking())
    return replay_.on() ? "No hand holds a scope at this moment of the recording."
                        : "No hand holds a scope. Take one here or from the tray (T). X adds a "
                          "second hand; the scope then rests as if an assistant held it.";
  if (views.scope_is_before_skin())
    return "The scope is not in the joint. It goes in by a portal that was made in the skin: G "
           "moves "
           "the hand to one, the wheel turned forward moves it in.";
  if (views.scope_is_outside())
    return "The scope is far from the joint. G moves the hand to a portal, the wheel turned "
           "forward moves it in.";
  return {};
}

std::optional<WaterModel> ViewsControl::water_model() const {
  const auto& joint = scene_.views.joint();
  const WaterState& water = scene_.views.moment().bones.water;
  if (!joint || !water.on) return std::nullopt;
  WaterModel model;
  model.settings = live_.run() && pump_ ? *pump_ : WaterSettings{water.pump_pa, water.outlet_open};
  model.pressure_pa = water.pressure_pa;
  FluidState mixture = fluid_of(water);
  model.turbidity = turbidity(*joint, mixture);
  mixture.blood = mixture.debris = 0;
  model.collapsed = is_obscured(*joint, mixture);
  model.can_set = live_.run() != nullptr;
  return model;
}

ViewsModel ViewsControl::model() const {
  const PictureViews& views = scene_.views;
  ViewsModel model;
  model.layout = sight_.layout();
  for (const Pane& pane : sight_.panes()) {
    PaneModel shown{pane, message_on(pane.kind), false};
    shown.offers_scope =
        pane.kind == PaneKind::kScope && live_.run() && !views.looking() && views.scope_in_tray();
    model.panes.push_back(std::move(shown));
  }
  model.can_shoot = !views.shooting();
  model.shooting = views.shooting();
  model.xray = views.xray_model();
  model.observer = observer_.model();
  const bool scope = std::any_of(model.panes.begin(), model.panes.end(), [](const PaneModel& pane) {
    return pane.pane.kind == PaneKind::kScope;
  });
  if (scope) model.water = water_model();
  if (scope)
    model.scope_camera = ScopeCameraModel{views.white_balance(), views.looking().has_value()};
  return model;
}

}  // namespace osteon
