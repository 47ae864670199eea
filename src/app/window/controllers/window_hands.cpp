#include <algorithm>
#include <utility>

#include "runs/hand_order.h"
#include "ui/label.h"
#include "window/window_app.h"

namespace osteon {
namespace {

constexpr double kApart_m = 0.025;       // between two hands when they come in
constexpr double kBefore_m = 0.012;      // before a portal
constexpr double kPortalReach_m = 0.03;  // a portal that a hand was brought to leads it so far
constexpr double kNearEnough_m = 0.03;   // of the tip from bone: the line is drawn

std::string capital(std::string name) {
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 32);
  return name;
}

Pose beside(const Pose& X, const Quat& q_WC, double right_m) {
  return {X.p + right_m * (q_WC * Vec3::UnitX()), X.q};
}

}  // namespace

void WindowApp::make_tray() {
  auto made = InstrumentTray::make(region_of(*case_), instruments_);
  if (!made) note(ToastKind::kError, made.error().message());
  tray_ = made ? std::move(*made) : InstrumentTray();
  if (renderer_) renderer_->set_tray(tray_.run().tools);
  tell_tray(tray_.run().names, tray_.run().tools);
  if (tray_open_) tray_pictures_.want(tray_.instruments());
}

// As the command line orders them. False when one cannot be had: the reason is told.
bool WindowApp::start_hands(const std::vector<std::string>& devices) {
  std::vector<HandOrder> orders;
  for (const std::string& text : devices) orders.push_back(parse_hand_order(text));
  make_tray();
  std::vector<LiveHandOrder> hands;
  std::vector<DeviceChoice> taken;
  std::vector<Pose> poses;
  const Pose offered = offered_probe(view_.camera, case_->bounds_W());
  for (std::size_t i = 0; i < orders.size(); ++i) {
    auto choice = choice_of(orders[i], taken);
    if (!choice) {
      note(ToastKind::kError, choice.error().message());
      return false;
    }
    taken.push_back(*choice);
    hands.push_back({*choice, name_of_hand(orders[i], i, orders.size()),
                     tray_.find(orders[i].instrument).value_or(0), mapping_for(*choice)});
    const double middle = 0.5 * static_cast<double>(orders.size() - 1);
    poses.push_back(
        beside(offered, view_.camera.q_WC, kApart_m * (static_cast<double>(i) - middle)));
  }
  make_live();
  const Result<void> started = live_->start(hands, poses, view_.camera.q_WC);
  if (!started) note(ToastKind::kError, started.error().message());
  return started.has_value();
}

void WindowApp::apply_hands(const HandsRequests& requests) {
  if (requests.toggle_names) names_on_ = !names_on_;
  if (requests.search) tray_search_ = *requests.search;
  if (requests.toggle_tray && live_) {
    tray_open_ = !tray_open_;
    if (tray_open_) tray_pictures_.want(tray_.instruments());
  }
  tray_pictures_.poll();
  tell_marks();
  if (!live_ || checkup_ || edit_) return;
  if (requests.change) change_hands();
  apply_exchange(requests);
  if (requests.portal) bring_to(*requests.portal);
  if (requests.mark) {
    live_->mark();
    note(ToastKind::kInfo, "This moment is kept. U goes back to it.");
  }
  if (requests.undo && live_->undo()) {
    note(ToastKind::kInfo, "Back at the mark.");
    exercise_.count_undo();
  }
}

void WindowApp::apply_exchange(const HandsRequests& requests) {
  const std::uint32_t held = shown_.tool.instrument;
  std::optional<std::uint32_t> place = requests.take;
  if (requests.step != 0) place = tray_.next(held, requests.step);
  if (requests.next_size) place = tray_.next_size(held);
  if (!place || *place == held) return;
  live_->take(*place);
  tray_.took(*place);
  note(ToastKind::kInfo, "In your hand: " + tray_.title(*place));
}

void WindowApp::change_hands() {
  aimed_.reset();
  if (live_->hands() > 1) {
    if (!live_->change_hands())
      note(ToastKind::kWarning, "Resume the force first: this device serves both hands.");
    return;
  }
  const Pose start =
      beside(offered_probe(view_.camera, case_->bounds_W()), view_.camera.q_WC, -kApart_m);
  const Result<void> added = live_->add_hand(start, 0);
  if (!added) return note(ToastKind::kWarning, added.error().message());
  note(ToastKind::kInfo, "The left hand is yours now; the right one rests. X changes hands.");
}

// Before the portal, the shaft along its way in.
void WindowApp::bring_to(std::size_t portal) {
  if (portal >= portals_.size() || !live_->by_mouse()) return;
  const Portal& to = portals_[portal];
  live_->bring({to.p_W - kBefore_m * to.nhat_W,
                Quat::FromTwoVectors(Vec3::UnitZ(), -to.nhat_W).normalized()});
  aimed_ = portal;
}

// The one that the shaft is in, else the one that the hand was brought to and is still near.
const Vec3* WindowApp::portal_near() const {
  const ToolState& tool = shown_.tool;
  if (tool.portal < portals_.size()) return &portals_[tool.portal].p_W;
  if (!aimed_ || (tool.X_WP.p - portals_[*aimed_].p_W).norm() > kPortalReach_m) return nullptr;
  return &portals_[*aimed_].p_W;
}

// With Alt held the wheel and the turning keys are the resting hand's.
bool WindowApp::nudge_rested(SceneInput& input) {
  constexpr double kNotch_m = 0.001, kTurn_rad_per_s = 0.9;
  if (!live_ || live_->hands() < 2 || !ImGui::GetIO().KeyAlt) return false;
  const std::size_t other = (live_->active() + 1) % live_->hands();
  const double angle = kTurn_rad_per_s * input.dt_s;
  const bool turns = input.roll != 0 || input.pitch != 0 || input.yaw != 0;
  if (turns || input.wheel != 0)
    live_->nudge(other, kNotch_m * input.wheel, angle * input.roll, angle * input.pitch,
                 angle * input.yaw, view_.camera.q_WC);
  input.wheel = input.roll = input.pitch = input.yaw = 0;
  return true;
}

// The first button is the tip's; those after it page the tray. One that is the clutch does not.
void WindowApp::poll_device_buttons() {
  const std::uint32_t now = shown_.tool.buttons;
  const std::uint32_t pressed = now & ~std::exchange(buttons_before_, now);
  if (!live_->by_real_device()) return;
  const int clutch = live_->mapping_settings().clutch_button;
  const auto is_pressed = [&](int button) {
    return button != clutch && ((pressed >> button) & 1u) != 0;
  };
  HandsRequests requests;
  if (is_pressed(1)) requests.step = 1;
  if (is_pressed(2)) requests.step = -1;
  if (is_pressed(3)) requests.next_size = true;
  apply_exchange(requests);
}

void WindowApp::show_others() {
  std::vector<ToolState> others;
  if (live_) others = live_->others();
  if (replay_ && player_)
    for (const ReplayTrack& track : replay_->more)
      if (!track.empty()) others.push_back(track.at(player_->position_s()).tool);
  renderer_->set_others(others);
}

// A span's words are made once, when its event comes.
void WindowApp::tell_marks() {
  const RunEvents* events = replay_ ? &replay_->events : live_ ? &live_->events() : nullptr;
  if (!events || !case_) return;
  if (events->events().size() < marks_told_) {
    marks_.clear();
    marks_told_ = 0;
  }
  if (events->events().size() == marks_told_) return;
  const std::vector<std::string> titles = replay_ ? replay_->instruments : tray_.titles();
  std::vector<std::string> portals, hands;
  for (const Portal& portal : portals_) portals.push_back("portal " + portal.title);
  if (replay_ && replay_->hands.size() > 1) hands = replay_->hands;
  if (live_ && live_->hands() > 1)
    for (std::size_t i = 0; i < live_->hands(); ++i) hands.push_back(live_->hand(i).name);
  for (; marks_told_ < events->events().size(); ++marks_told_) {
    const RunEvent& run_event = events->events()[marks_told_];
    const EventKind kind = run_event.event.kind;
    marks_.push_back({run_event.time_s,
                      describe_event(run_event.event, *case_, titles, portals, hands),
                      kind == EventKind::kFault || kind == EventKind::kForceOver});
  }
}

std::vector<HandRow> WindowApp::hand_rows() const {
  std::vector<HandRow> rows;
  for (std::size_t i = 0; i < live_->hands(); ++i) {
    const LiveHand& hand = live_->hand(i);
    HandRow row;
    row.name = capital(hand.name);
    const bool ticks = hand.snapshot.tool.tick > 0;
    row.instrument = tray_.title(ticks ? hand.snapshot.tool.instrument : hand.instrument);
    if (ticks && hand.snapshot.tool.power > 0) row.instrument += ", running";
    const std::uint32_t portal = hand.snapshot.tool.portal;
    if (ticks && portal < portals_.size()) row.portal = portals_[portal].title;
    row.active = i == live_->active();
    row.rests = live_->rests(i);
    rows.push_back(std::move(row));
  }
  return rows;
}

HandsModel WindowApp::hands_model() {
  HandsModel model;
  model.tip = tip_model();
  model.names_on = names_on_;
  if (names_on_) model.names = name_tags();
  if (!live_) return model;
  model.rows = hand_rows();
  for (const Portal& portal : portals_) model.portals.push_back(portal.title);
  if (aimed_) model.next_portal = (*aimed_ + 1) % std::max<std::size_t>(1, portals_.size());
  model.can_bring = live_->by_mouse();
  model.can_add = live_->hands() == 1 && !live_->recording() && !checkup_;
  model.restore_points = 1;
  model.tray.open = tray_open_;
  if (!tray_open_) return model;
  model.tray.search = tray_search_;
  model.tray.items = tray_.items();
  model.tray.held = shown_.tool.instrument;
  model.tray.sheet = tray_pictures_.texture();
  model.tray.sheet_columns = TrayPictures::kColumns;
  model.tray.sheet_rows = tray_pictures_.rows();
  return model;
}

// In the interface's coordinates; none behind the eye.
std::optional<Vec3> WindowApp::on_screen(const Vec3& p_W) const {
  if (!shows_outside()) return std::nullopt;
  const Viewport v = viewport();
  const auto at = project(view_.camera, v, p_W);
  if (!at) return std::nullopt;
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const double ratio = window_->pixel_ratio();
  return Vec3((at->x + v.x) / ratio, (at->y + (height - v.y - v.height)) / ratio, 0);
}

TipModel WindowApp::tip_model() {
  TipModel model;
  const auto nearest = tip_.nearest(shown_, view_);
  if (!nearest || (live_ && shown_.tool.tick == 0)) return model;
  model.known = true;
  model.distance_mm = 1e3 * nearest->distance_m;
  model.bone = nearest->bone;
  const auto tip = on_screen(shown_.tool.X_WP.p), bone = on_screen(nearest->p_W);
  const bool near = nearest->distance_m > 0 && nearest->distance_m < kNearEnough_m;
  if (!tip || !bone || !near || !view_.show_proxy) return model;
  model.drawn = true;
  model.x0 = static_cast<float>(tip->x());
  model.y0 = static_cast<float>(tip->y());
  model.x1 = static_cast<float>(bone->x());
  model.y1 = static_cast<float>(bone->y());
  return model;
}

std::vector<NameTag> WindowApp::name_tags() const {
  std::vector<NameTag> tags;
  for (std::size_t i = 0; i < bone_middles_B_.size() && i < shown_.bones.count; ++i) {
    if (i < view_.bones.size() && !view_.bones[i].visible) continue;
    const auto at = on_screen(shown_.bones.bones[i].X_WB * bone_middles_B_[i]);
    if (at)
      tags.push_back({BoneId{static_cast<std::uint32_t>(i)}, static_cast<float>(at->x()),
                      static_cast<float>(at->y())});
  }
  return tags;
}

}  // namespace osteon
