#include "hand_half.h"

#include "haptic_command.h"
#include "osteon/base/check.h"
#include "osteon/base/hash.h"
#include "osteon/physics/bone_world.h"
#include "osteon/physics/structure_watch.h"
#include "osteon/scene/portal.h"

namespace osteon {
namespace {

bool is_share(double value) { return value >= 0 && value <= 1; }

void add_to(Hasher& hasher, const WatchState& watch) {
  hasher.add(watch.touched);
  for (std::size_t i = 0; i < watch.touches.size(); ++i) {
    if ((watch.touched >> i & 1u) == 0) continue;
    const Touch& touch = watch.touches[i];
    hasher.add(touch.first_tick);
    hasher.add(touch.last_tick);
    hasher.add(touch.peak_force_n);
    hasher.add(touch.deepest_m);
  }
  hasher.add(watch.over_since);
  hasher.add(watch.over_bone);
  for (std::size_t i = 0; i < watch.seen.size(); ++i) {
    if (watch.seen[i] == 0) continue;
    hasher.add(i);
    hasher.add(watch.seen[i]);
  }
  for (std::size_t i = 0; i < watch.inside.size(); ++i) {
    const Inside& one = watch.inside[i];
    if (one.kind == SubjectKind::kNothing) continue;
    hasher.add(i);
    hasher.add(static_cast<std::uint8_t>(one.kind));
    hasher.add(one.subject);
    hasher.add(one.first_step);
    hasher.add(one.last_step);
  }
}

void add_to(Hasher& hasher, std::span<const HandMark> marks) {
  for (const HandMark& mark : marks) {
    hasher.add(mark.set);
    if (!mark.set) continue;
    hasher.add(mark.instrument);
    hasher.add(mark.power);
    hasher.add(mark.jaw);
  }
}

}  // namespace

HandHalf::HandHalf(std::shared_ptr<const Case> the_case, const Tray& tray,
                   const std::vector<Portal>& portals, const SessionSettings& settings,
                   std::size_t hand)
    : hand_(hand),
      portal_count_(static_cast<std::uint32_t>(portals.size())),
      params_(settings.haptic),
      events_of_(static_cast<std::uint8_t>(hand), settings.haptic.tick_s, settings.force_limit_n),
      gaze_(*the_case),
      sights_(settings.sights),
      step_s_(settings.physics.step_s) {
  for (const auto& tool : tray) {
    loops_.emplace_back(the_case, tool, tray);
    loops_.back().set_portals(portals);
    loops_.back().set_hand(static_cast<std::uint32_t>(hand));
  }
  const std::uint32_t first = settings.hands[hand].instrument;
  demand(first < loops_.size(), "a hand holds an instrument that is not in the tray");
  held_ = first;
  loop().set_grip(held_, 0, 0);
}

FeltCuts& HandHalf::set_carving(const CarvingSetup& setup) {
  cuts_ = std::make_unique<FeltCuts>(setup);
  for (HapticLoop& loop : loops_) loop.set_cuts(cuts_->by_bone());
  return *cuts_;
}

FeltBands& HandHalf::set_bands(const std::vector<SoftBand>& bands, const SoftFriction& friction) {
  bands_ = std::make_unique<FeltBands>();
  for (HapticLoop& loop : loops_) loop.set_bands(&bands, &bands_->contacts(), friction);
  return *bands_;
}

const ToolState& HandHalf::tick(const ToolInput& input, const BoneSnapshot& bones,
                                const OtherTools& others, const Command& command) {
  events_.clear();
  before_ = tool_state();
  ++record_.tick;
  if (cuts_) cuts_->take_until(bones.step, record_.tick, events_);
  if (bands_) bands_->take_until(bones.step, record_.tick, events_);
  obey(command);
  const double age_s = age_.at(record_.tick, bones.step, params_.tick_s);
  OtherTools around = others;
  around[hand_] = {};
  const ToolState& tool = loop().tick(input, bones, age_s, params_, around);
  events_of_.see(tool, watch_, events_);
  tell_portals(before_.portal, tool.portal);
  if (sights_) tell_sights(bones);
  tell_structures(bones);
  keep_record(input, bones, around, command);
  return tool;
}

void HandHalf::keep_record(const ToolInput& input, const BoneSnapshot& bones,
                           const OtherTools& others, const Command& command) {
  const ToolState& tool = tool_state();
  record_.input = input;
  record_.bone_step = bones.step;
  for (std::size_t i = 0; i < kMaxHands; ++i) record_.other_ticks[i] = others[i].tick;
  record_.command = command;
  record_.force_W = tool.force_W;
  record_.p_WP = tool.X_WP.p;
  record_.status = tool.status;
  record_.state_hash = 0;
  if (record_.tick % kHashInterval != 0) return;
  Hasher hasher;
  hasher.add(hash());
  hasher.add(hash_of(bones));
  record_.state_hash = hasher.value();
}

void HandHalf::tell_portals(std::uint32_t before, std::uint32_t now) {
  if (before == now) return;
  if (before != kNoPortal) tell(EventKind::kPortalLeft, SubjectKind::kPortal, before);
  if (now != kNoPortal)
    tell(EventKind::kPortalEntered, SubjectKind::kPortal, now,
         loop().state().portal.tip_depth_m * 1e3);
}

// Twenty times a second. A bone that was in the middle a moment ago is not seen anew.
void HandHalf::tell_sights(const BoneSnapshot& bones) {
  constexpr std::uint64_t kEvery = 50, kAnew = 2000;  // ticks
  if ((record_.tick + kEvery / kMaxHands * hand_) % kEvery != 0) return;
  const std::optional<ToolOptics>& optics = tool().optics;
  const ToolState& state = tool_state();
  if (!optics || !is_finite(state.X_WP)) return;
  const ScopeView view = view_through({optics->angle_rad, optics->half_field_rad}, state.X_WP);
  const ScopeGaze::Seen seen = gaze_.middle_of(view, bones);
  if (seen.bone >= kMaxBones) return;
  std::uint64_t& last = watch_.seen[seen.bone];
  const bool anew = last == 0 || record_.tick - last > kAnew;
  last = record_.tick;
  if (!anew) return;
  events_.add({record_.tick,
               EventKind::kStructureSeen,
               static_cast<std::uint8_t>(hand_),
               SubjectKind::kBone,
               seen.bone,
               seen.p_W,
               {seen.distance_m * 1e3, 0, 0}});
}

// Physics finds out where the tip is; a list says the same until the next step.
void HandHalf::tell_structures(const BoneSnapshot& bones) {
  if (bones.inside[hand_] == watch_.inside) return;
  tell_changes(bones.inside[hand_], watch_.inside, [this](EventKind kind, const Inside& one) {
    Event event{record_.tick,        kind, static_cast<std::uint8_t>(hand_), one.kind, one.subject,
                tool_state().X_WP.p, {}};
    if (kind == EventKind::kStructureLeft)
      event.values = {static_cast<double>(one.last_step - one.first_step) * step_s_,
                      one.deepest_m * 1e3, 0};
    events_.add(event);
  });
}

void HandHalf::tell(EventKind kind, SubjectKind subject_kind, std::uint32_t subject, double value) {
  const Vec3& p_W = tool_state().X_WP.p;
  events_.add({record_.tick,
               kind,
               static_cast<std::uint8_t>(hand_),
               subject_kind,
               subject,
               p_W,
               {value, 0, 0}});
}

// A command whose value is out of range does nothing.
void HandHalf::obey(const Command& command) {
  apply_command(command, params_);
  const ToolState& tool = tool_state();
  const std::uint32_t mark = mark_of(command);
  if (command.kind == CommandKind::kTake && command.value >= 0 &&
      command.value < static_cast<double>(loops_.size())) {
    take(static_cast<std::uint32_t>(command.value), 0, 0, false);
  } else if (command.kind == CommandKind::kPower && is_share(command.value)) {
    loop().set_grip(held_, command.value, tool.jaw);
    tell(EventKind::kPowered, SubjectKind::kInstrument, held_, command.value);
  } else if (command.kind == CommandKind::kJaw && is_share(command.value)) {
    loop().set_grip(held_, tool.power, command.value);
  } else if (command.kind == CommandKind::kFault && command.value >= 0 && command.value < 256) {
    tell(EventKind::kFault, SubjectKind::kDevice, static_cast<std::uint32_t>(command.value));
  } else if (command.kind == CommandKind::kMark && mark < kMaxMarks) {
    marks_[mark] = {true, held_, tool.power, tool.jaw};
    if (hand_ == 0) tell(EventKind::kMark, SubjectKind::kMark, mark);
  } else if (command.kind == CommandKind::kRestore && mark < kMaxMarks) {
    go_back(mark);
  }
}

void HandHalf::take(std::uint32_t instrument, double power, double jaw, bool even_the_same) {
  const bool same = instrument == held_;
  if (same && !even_the_same) return;
  const ToolState last = tool_state();
  held_ = instrument;
  loop().begin_anew(last);
  loop().set_grip(held_, power, jaw);
  const double size_mm = instrument < sizes_mm_.size() ? sizes_mm_[instrument] : 0;
  if (!same) tell(EventKind::kInstrumentTaken, SubjectKind::kInstrument, instrument, size_mm);
}

// The device stays where it is, so contact begins anew there, with the bones as they were.
void HandHalf::go_back(std::uint32_t mark) {
  const HandMark& kept = marks_[mark];
  if (!kept.set) return;
  take(kept.instrument, kept.power, kept.jaw, true);
  loop().next_epoch();
  if (hand_ == 0) tell(EventKind::kRestored, SubjectKind::kMark, mark);
}

std::uint64_t HandHalf::hash() const {
  Hasher hasher;
  hasher.add(loop().state_hash());
  hasher.add(record_.tick);
  hasher.add(age_.step());
  hasher.add(age_.first_tick());
  hasher.add(params_.stiffness_n_per_m);
  hasher.add(params_.friction_scale);
  hasher.add(params_.force_on);
  hasher.add(params_.grab_n_per_m);
  add_to(hasher, watch_);
  add_to(hasher, marks_);
  return hasher.value();
}

void HandHalf::save(HandState& into) const {
  into.haptic = loop().state();
  into.params = params_;
  into.bone_step = age_.step();
  into.first_tick = age_.first_tick();
  into.before = before_;
  into.seen = into.haptic.others;
  into.watch = watch_;
  into.marks = marks_;
}

bool HandHalf::fits(const HandState& state) const {
  const std::uint32_t instrument = state.haptic.tool.instrument;
  if (instrument >= loops_.size()) return false;
  for (const HandMark& mark : state.marks)
    if (mark.set && mark.instrument >= loops_.size()) return false;
  for (const std::uint32_t portal :
       {state.haptic.portal.portal, state.haptic.portal.nearest, state.haptic.tool.portal})
    if (portal != kNoPortal && portal >= portal_count_) return false;
  const HapticState& like = loops_[instrument].state();
  return state.haptic.bone_count == like.bone_count &&
         state.haptic.pairs.size() == like.pairs.size();
}

void HandHalf::restore(const HandState& from) {
  demand(from.haptic.tool.instrument < loops_.size(),
         "a state can be restored only into a session with the same tray");
  held_ = from.haptic.tool.instrument;
  loop().restore(from.haptic);
  params_ = from.params;
  age_.restore(from.bone_step, from.first_tick);
  before_ = from.before;
  seen_ = from.seen;
  watch_ = from.watch;
  marks_ = from.marks;
  record_ = {};
  record_.tick = from.haptic.tool.tick;
  events_.clear();
}

}  // namespace osteon
