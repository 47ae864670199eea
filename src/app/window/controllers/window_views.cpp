// Which views the window shows and where; see PictureViews for what is in them.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "window/window_app.h"

namespace osteon {
namespace {

constexpr double kScopeAhead_m = 0.02;  // where a hand moves as far as its picture does

const Pane* find_pane(const std::vector<Pane>& panes, PaneKind kind) {
  const auto at = std::find_if(panes.begin(), panes.end(),
                               [kind](const Pane& pane) { return pane.kind == kind; });
  return at == panes.end() ? nullptr : &*at;
}

}  // namespace

// A bone's surface is edited from outside.
PictureLayout WindowApp::picture_layout() const {
  return edit_ ? PictureLayout::kOutside : layout_;
}

// From outside the cards may cover the picture's sides; what else is shown stands between them.
std::vector<Pane> WindowApp::panes() const {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float scale = ui_->scale();
  const UiLayout layout = make_layout(size.x, size.y, scale, settings_.panels_open,
                                      static_cast<float>(settings_.left_card));
  UiRect free = layout.picture;
  if (settings_.panels_open && picture_layout() != PictureLayout::kOutside) {
    const float gap = std::round(8 * scale);
    free.x = layout.left.right() + gap;
    free.w = std::max(1.0f, layout.right.x - gap - free.x);
    free.y += gap;
    free.h = std::max(1.0f, free.h - 2 * gap);
  }
  return panes_of(picture_layout(), free, scale, views_.has_shot());
}

Viewport WindowApp::pixels_of(const UiRect& r) const {
  const double ratio = window_->pixel_ratio();
  const auto px = [ratio](float v) {
    return static_cast<int>(std::lround(static_cast<double>(v) * ratio));
  };
  return {px(r.x), px(ImGui::GetIO().DisplaySize.y - r.bottom()), px(r.w), px(r.h)};
}

bool WindowApp::shows_outside() const {
  const PictureLayout layout = picture_layout();
  return layout == PictureLayout::kOutside || layout == PictureLayout::kAll;
}

// Of the view from outside; where that is not shown, the large pane.
Viewport WindowApp::viewport() const {
  const std::vector<Pane> all = panes();
  const Pane* outside = find_pane(all, PaneKind::kOutside);
  return pixels_of(outside ? outside->area : all.front().area);
}

// The active hand first: what it holds counts before what rests.
FilmMoment WindowApp::moment() const {
  FilmMoment moment;
  moment.time_s = shown_.tool.time_s;
  moment.bones = shown_.bones;
  moment.tools[0] = shown_.tool;
  if (live_ && shown_.tool.tick == 0) moment.tools[0].X_WP.p = Vec3::Constant(std::nan(""));
  const auto add = [&](const ToolState& tool) {
    if (moment.hands < kMaxHands) moment.tools[moment.hands++] = tool;
  };
  if (live_)
    for (const ToolState& tool : live_->others()) add(tool);
  if (replay_ && player_)
    for (const ReplayTrack& track : replay_->more)
      if (!track.empty()) add(track.at(player_->position_s()).tool);
  return moment;
}

void WindowApp::tell_tray(const std::vector<std::string>& names, const Tray& tools) {
  if (auto told = views_.set_tray(names, tools); !told)
    note(ToastKind::kWarning, told.error().message());
}

void WindowApp::update_views() {
  if (auto ok = views_.set_moment(moment()); !ok) note(ToastKind::kError, ok.error().message());
}

void WindowApp::draw_panes(const ViewState& outside) {
  const std::vector<Pane> all = panes();
  int most_px = observer_scope_px();
  for (const Pane& pane : all) {
    const Viewport at = pixels_of(pane.area);
    if (pane.kind == PaneKind::kScope) most_px = std::max(most_px, std::min(at.width, at.height));
  }
  for (const Pane& pane : all) {
    const Viewport at = pixels_of(pane.area);
    switch (pane.kind) {
      case PaneKind::kOutside:
        renderer_->draw(shown_, outside, at);
        break;
      case PaneKind::kScope:
        views_.draw_scope(at, most_px);
        break;
      case PaneKind::kPanorama:
        views_.draw_panorama(at);
        break;
      case PaneKind::kFluoro:
        views_.draw_fluoro(at);
        break;
    }
  }
}

// With the scope's picture large, a hand goes where it is seen to go there.
Camera WindowApp::hand_camera() const {
  const PictureLayout layout = picture_layout();
  const bool through = layout == PictureLayout::kScope || layout == PictureLayout::kAll;
  const auto scope = through ? views_.scope_camera() : std::nullopt;
  if (!scope) return view_.camera;
  Camera camera = view_.camera;
  camera.q_WC = scope->X_WC().q;
  camera.orthographic = true;
  camera.vertical_fov_rad = 2 * scope->half_field_rad();
  camera.distance_m = kScopeAhead_m;
  return camera;
}

Viewport WindowApp::hand_viewport() const { return pixels_of(panes().front().area); }

void WindowApp::apply_views(const ViewsRequests& requests) {
  if (requests.layout) layout_ = *requests.layout;
  if (requests.observer_layout) observer_layout_ = *requests.observer_layout;
  if (requests.toggle_observer) {
    if (observer_)
      observer_.reset();
    else
      open_observer();
  }
  if (requests.toggle_film) toggle_film();
  if (requests.shoot) {
    views_.shoot();
    if (layout_ != PictureLayout::kAll) layout_ = PictureLayout::kFluoro;
  }
  if (requests.take_scope && live_) {
    HandsRequests hands;
    hands.take = views_.scope_in_tray();
    apply_exchange(hands);
  }
}

std::string WindowApp::pane_message(PaneKind kind) const {
  if (kind == PaneKind::kFluoro && !views_.has_shot())
    return views_.shooting() ? "The X-ray picture is being made." : "B takes an X-ray picture.";
  if (kind != PaneKind::kScope) return {};
  if (!views_.looking())
    return replay_ ? "No hand holds a scope at this moment of the recording."
                   : "No hand holds a scope. Take one here or from the tray (T); with X a second "
                     "hand comes in, and the scope then rests as if an assistant held it.";
  if (views_.scope_is_outside())
    return "The scope is far from the joint. G brings the hand before a portal, the wheel goes in.";
  return {};
}

ViewsModel WindowApp::views_model() const {
  ViewsModel model;
  model.layout = picture_layout();
  for (const Pane& pane : panes()) {
    PaneModel shown{pane, pane_message(pane.kind), false};
    shown.offers_scope =
        pane.kind == PaneKind::kScope && live_ && !views_.looking() && views_.scope_in_tray();
    model.panes.push_back(std::move(shown));
  }
  model.can_shoot = !views_.shooting();
  model.shooting = views_.shooting();
  model.observer = {observer_ != nullptr, observer_layout_};
  model.film = film_model();
  return model;
}

}  // namespace osteon
