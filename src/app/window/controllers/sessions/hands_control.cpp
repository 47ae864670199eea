#include "window/controllers/sessions/hands_control.h"

#include <algorithm>
#include <utility>

#include "runs/hands/shaft_place.h"

namespace osteon {
namespace {

constexpr double kApart_m = 0.025;        // between two hands when they come in
constexpr double kBefore_m = 0.012;       // before a portal
constexpr double kStandsThere_m = 0.003;  // where a hand is brought to
constexpr double kPortalReach_m = 0.03;   // a portal that a hand was brought to leads it so far
constexpr double kNearEnough_m = 0.03;    // of the tip from bone: the line is drawn

std::string capital(std::string name) {
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 32);
  return name;
}

// Names of bones that skin hides would seem to be names of the skin.
bool is_covered(const Case& the_case, const ViewState& view) {
  for (std::size_t i = 0; i < the_case.softs.size() && i < view.softs.size(); ++i)
    if (the_case.softs[i].kind == "skin" && view.softs[i].visible && view.softs[i].opacity >= 1)
      return true;
  return false;
}

}  // namespace

void HandsControl::begin_case() { tip_.begin(scene_.the_case); }

bool HandsControl::apply(const HandsRequests& requests, bool free) {
  LiveRun* const run = live_.run();
  if (requests.toggle_names) names_on_ = !names_on_;
  if (requests.search) search_ = *requests.search;
  if (requests.toggle_tray && run) tray_open_ = !tray_open_;
  if (requests.take) tray_open_ = false;  // the picture is wanted again
  if (!tray_open_) search_.clear();
  if (tray_open_) pictures_.want(live_.tray().instruments());
  pictures_.poll();
  if (!run || !free) return false;
  if (requests.change) change_hands();
  exchange(requests);
  if (requests.portal) bring_to(*requests.portal);
  if (requests.upright) stand_upright();
  if (requests.mark) {
    run->mark();
    host_.note(ToastKind::kInfo, "This moment is marked. U goes back to it.");
  }
  if (!requests.undo || !run->undo()) return false;
  host_.note(ToastKind::kInfo, "Back at the mark.");
  return true;
}

void HandsControl::exchange(const HandsRequests& requests) {
  const std::uint32_t held = sight_.shown().tool.instrument;
  std::optional<std::uint32_t> place = requests.take;
  if (requests.step != 0) place = live_.tray().next(held, requests.step);
  if (requests.next_size) place = live_.tray().next_size(held);
  if (place && *place != held) take(*place);
}

// In a portal the new shaft is where the old one was: a hook's would else press the skin aside.
void HandsControl::take(std::uint32_t place) {
  LiveRun& run = *live_.run();
  const ToolState& tool = sight_.shown().tool;
  const Tool* const now = tool_at(place);
  const Tool* const before = tool_at(tool.instrument);
  if (run.by_mouse() && tool.portal < scene_.portals.size() && now && before)
    run.bring(on_the_same_line(*before, *now, run.hand(run.active()).X_WD_wanted));
  run.take(place);
  live_.tray().took(place);
  host_.note(ToastKind::kInfo, "In your hand: " + live_.tray().title(place));
}

void HandsControl::change_hands() {
  LiveRun& run = *live_.run();
  aimed_.reset();
  if (run.hands() > 1) {
    if (!run.change_hands())
      host_.note(ToastKind::kWarning, "Resume the force first: this device serves both hands.");
    return;
  }
  const Camera& camera = sight_.view().camera;
  const Pose offered = offered_probe(camera, scene_.the_case->bounds_W());
  const Result<void> added =
      run.add_hand({offered.p - kApart_m * (camera.q_WC * Vec3::UnitX()), offered.q}, 0);
  if (!added) return host_.note(ToastKind::kWarning, added.error().message());
  host_.note(ToastKind::kInfo, "You now move the left hand; the right one rests. X changes hands.");
}

const Tool* HandsControl::tool_at(std::uint32_t place) const {
  const Tray& tools = live_.tray().run().tools;
  return place < tools.size() ? tools[place].get() : nullptr;
}

// Before the portal, the shaft along its way in.
std::vector<HandsControl::WayIn> HandsControl::ways_in() const {
  std::vector<WayIn> out;
  const LiveRun* const run = live_.run();
  if (!run) return out;
  const MadePortals made = run->pushes().made;
  const BoneSnapshot& bones = sight_.shown().bones;
  for (std::size_t i = 0; i < scene_.portals.size(); ++i) {
    const Portal& portal = scene_.portals[i];
    if (portal.made == kNotMade) {
      out.push_back({i, portal.p_W, portal.nhat_W});
      continue;
    }
    const MadePortal* const hole = portal.made < made.size() ? &made[portal.made] : nullptr;
    if (!hole || !hole->open || hole->bone >= bones.count) continue;
    const Pose& X_WB = bones.bones[hole->bone].X_WB;
    out.push_back({i, X_WB * hole->p_B, -X_WB.rotate(hole->nhat_B)});
  }
  return out;
}

void HandsControl::bring_to(std::size_t way) {
  const std::vector<WayIn> ways = ways_in();
  if (way >= ways.size() || !live_.run()->by_mouse()) return;
  const WayIn& to = ways[way];
  const Tool* const held = tool_at(sight_.shown().tool.instrument);
  live_.run()->bring(before_portal(held ? *held : Tool{}, to.p_W, to.inwards_W, kBefore_m));
  aimed_ = to;
}

// A shaft that goes through a portal cannot be turned at will.
void HandsControl::stand_upright() {
  const ToolState& tool = sight_.shown().tool;
  LiveRun& run = *live_.run();
  if (!run.by_mouse()) return;
  if (tool.portal < scene_.portals.size())
    return host_.note(ToastKind::kInfo, "The shaft is in a portal, which gives its direction.");
  const auto nearest = tip_.nearest(sight_.shown(), sight_.view());
  if (!nearest) return host_.note(ToastKind::kInfo, "No surface is near the tip.");
  run.bring(upright_on(run.hand(run.active()).X_WD_wanted, nearest->p_W, nearest->distance_m < 0));
}

// The one that the shaft is in, else the one that the hand was brought to and is still near.
std::optional<Vec3> HandsControl::portal_near() const {
  const std::vector<Portal>& portals = scene_.portals;
  const ToolState& tool = sight_.shown().tool;
  if (tool.portal < portals.size())
    return portals[tool.portal].made == kNotMade ? portals[tool.portal].p_W : tool.p_portal_W;
  if (!aimed_ || (tool.X_WP.p - aimed_->p_W).norm() > kPortalReach_m) return {};
  return aimed_->p_W;
}

bool HandsControl::nudge_rested(SceneInput& input) {
  constexpr double kNotch_m = 0.001, kTurn_rad_per_s = 0.9;
  LiveRun* const run = live_.run();
  if (!run || run->hands() < 2 || !ImGui::GetIO().KeyAlt) return false;
  const std::size_t other = (run->active() + 1) % run->hands();
  const double angle = kTurn_rad_per_s * input.dt_s;
  const bool turns = input.roll != 0 || input.pitch != 0 || input.yaw != 0;
  if (turns || input.wheel != 0)
    run->nudge(other, kNotch_m * input.wheel, angle * input.roll, angle * input.pitch,
               angle * input.yaw, sight_.view().camera.q_WC);
  input.wheel = input.roll = input.pitch = input.yaw = 0;
  return true;
}

// The first button is the tip's; those after it page the tray, and so does a visit to the inkwell.
// A button that is the clutch does not.
void HandsControl::poll_buttons() {
  const std::uint32_t now = sight_.shown().tool.buttons;
  const std::uint32_t pressed = now & ~std::exchange(buttons_before_, now);
  if (!live_.run()->by_real_device()) return;
  const int clutch = live_.run()->mapping_settings().clutch_button;
  const auto is_pressed = [&](int button) {
    return button != clutch && ((pressed >> button) & 1u) != 0;
  };
  HandsRequests requests;
  if (is_pressed(1)) requests.step = 1;
  if (is_pressed(2)) requests.step = -1;
  if (is_pressed(3)) requests.next_size = true;
  if (inkwell_.ended(now)) requests.step = 1;
  exchange(requests);
}

std::vector<HandRow> HandsControl::rows() const {
  const LiveRun& run = *live_.run();
  std::vector<HandRow> rows;
  for (std::size_t i = 0; i < run.hands(); ++i) {
    const LiveHand& hand = run.hand(i);
    HandRow row;
    row.name = capital(hand.name);
    const bool ticks = hand.snapshot.tool.tick > 0;
    row.instrument = live_.tray().title(ticks ? hand.snapshot.tool.instrument : hand.instrument);
    row.runs = ticks && hand.snapshot.tool.power > 0;
    const std::uint32_t portal = hand.snapshot.tool.portal;
    if (ticks && portal < scene_.portals.size()) row.portal = scene_.portals[portal].title;
    row.active = i == run.active();
    row.rests = run.rests(i);
    const auto& driven = live_.tray().run().driven;
    const std::uint32_t held = ticks ? hand.snapshot.tool.instrument : hand.instrument;
    if (held < driven.size())
      row.key_does = driven[held].jaws ? "shut (hold)" : driven[held].power ? "run (hold)" : "";
    rows.push_back(std::move(row));
  }
  return rows;
}

HandsModel HandsControl::model(bool can_add, const std::vector<std::string>& used) {
  HandsModel model;
  model.tip = tip_model();
  model.names_on = names_on_;
  if (names_on_) model.names = name_tags();
  const LiveRun* const run = live_.run();
  if (!run) return model;
  model.rows = rows();
  const std::vector<WayIn> ways = ways_in();
  for (const WayIn& way : ways) {
    model.portals.push_back(scene_.portals[way.portal].title);
    if (aimed_ && way.portal == aimed_->portal) model.next_portal = model.portals.size();
  }
  model.next_portal = free_way(ways, model.next_portal);
  model.can_bring = run->by_mouse();
  model.can_add = can_add && run->hands() == 1 && !run->recording();
  model.restore_points = 1;
  if (tray_open_) model.tray = tray_model(used);
  return model;
}

// The first from `from` on, round, that no other hand works through or stands before; `from` where
// each has one.
std::size_t HandsControl::free_way(std::span<const WayIn> ways, std::size_t from) const {
  if (ways.empty()) return 0;
  const std::vector<ToolState> others = live_.run()->others();
  const auto is_free = [&](const WayIn& way) {
    const Vec3 before_W = way.p_W - kBefore_m * way.inwards_W;
    return std::none_of(others.begin(), others.end(), [&](const ToolState& tool) {
      const Tool* const held = tool_at(tool.instrument);
      const Vec3 there_W = held ? tool.X_WP * shaft_beside_tip(*held) : tool.X_WP.p;
      return tool.portal == way.portal || (there_W - before_W).norm() < kStandsThere_m;
    });
  };
  for (std::size_t n = 0; n < ways.size(); ++n)
    if (is_free(ways[(from + n) % ways.size()])) return (from + n) % ways.size();
  return from % ways.size();
}

TrayModel HandsControl::tray_model(const std::vector<std::string>& used) const {
  TrayModel tray;
  tray.open = true;
  tray.search = search_;
  tray.items = live_.tray().items();
  for (const std::string& name : used)
    for (TrayItem& item : tray.items)
      item.used = item.used || live_.tray().find(name) == item.place;
  std::stable_partition(tray.items.begin(), tray.items.end(),
                        [](const TrayItem& item) { return item.used; });
  tray.held = sight_.shown().tool.instrument;
  tray.sheet = pictures_.texture();
  tray.sheet_columns = TrayPictures::kColumns;
  tray.sheet_rows = pictures_.rows();
  return tray;
}

TipModel HandsControl::tip_model() {
  TipModel model;
  const ToolState& tool = sight_.shown().tool;
  tip_.feel(live_.run() ? live_.run()->softs() : nullptr);
  const auto nearest = tip_.nearest(sight_.shown(), sight_.view());
  if (!nearest || (live_.run() && tool.tick == 0)) return model;
  model.known = true;
  model.distance_mm = 1e3 * nearest->distance_m;
  if (live_.run())
    if (const auto deep = tip_.depth_m(sight_.shown(), live_.run()->active()))
      model.depth_mm = 1e3 * *deep;
  model.bone = nearest->bone;
  model.soft = nearest->soft;
  const auto tip = sight_.on_screen(tool.X_WP.p), bone = sight_.on_screen(nearest->p_W);
  const bool near = nearest->distance_m > 0 && nearest->distance_m < kNearEnough_m;
  if (!tip || !bone || !near || !sight_.view().show_proxy) return model;
  model.drawn = true;
  model.x0 = static_cast<float>(tip->x());
  model.y0 = static_cast<float>(tip->y());
  model.x1 = static_cast<float>(bone->x());
  model.y1 = static_cast<float>(bone->y());
  return model;
}

std::vector<NameTag> HandsControl::name_tags() const {
  std::vector<NameTag> tags;
  const std::vector<BoneAppearance>& looks = sight_.view().bones;
  const BoneSnapshot& bones = sight_.shown().bones;
  if (is_covered(*scene_.the_case, sight_.view())) return tags;
  for (std::size_t i = 0; i < scene_.bone_middles_B.size() && i < bones.count; ++i) {
    if (i < looks.size() && !looks[i].visible) continue;
    const auto at = sight_.on_screen(bones.bones[i].X_WB * scene_.bone_middles_B[i]);
    if (at)
      tags.push_back({BoneId{static_cast<std::uint32_t>(i)}, static_cast<float>(at->x()),
                      static_cast<float>(at->y())});
  }
  return tags;
}

}  // namespace osteon
