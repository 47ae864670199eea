// What a session is told of ligaments and menisci.
#include <algorithm>
#include <cmath>

#include "osteon/physics/band_strands.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "skin/skin_world.h"
#include "soft/soft_grips.h"
#include "soft/soft_touch.h"
#include "soft/solid_presses.h"

namespace osteon {

void SoftWorld::tell_touches(const Hand& hand, std::uint64_t step) {
  for (std::size_t b = 0; b < setup_->bands.size(); ++b) {
    const TouchNews news =
        follow_touch(state_.hands[hand.index].touches[b],
                     {is_felt(b), hand.force_n[b], hand.deep_m[b]}, limit_n_, step, step_s_);
    if (news.begins) tell(hand, kSoftBegin, b, {readouts_[b].tension_n, 0, 0});
    if (news.over) tell(hand, kSoftOver, b, {hand.force_n[b], limit_n_, 0});
    if (news.ends) tell(hand, kSoftEnd, b, {news.since_s, news.peak_n, news.deepest_mm});
  }
}

void SoftWorld::tell(const Hand& hand, EventKind kind, std::size_t band,
                     std::array<double, 3> values) {
  const Vec3 p_W = !hand.tool               ? Vec3(0.5 * (spans_[band].a_W + spans_[band].b_W))
                   : hand.force_n[band] > 0 ? hand.p_W[band]
                                            : hand.tool->X_WP.p;
  Event event;
  event.kind = kind;
  if (hand.tool || kind == kSoftEnd) event.hand = static_cast<std::uint8_t>(hand.index);
  event.subject = setup_->bands[band].soft;
  event.values = values;
  tell(event, p_W);
}

void SoftWorld::tell(Event event, const Vec3& p_W) {
  if (event.subject_kind == SubjectKind::kNothing) event.subject_kind = SubjectKind::kSoftPart;
  event.p_W = is_finite(p_W) ? p_W : Vec3(Vec3::Zero());
  if (events_.size() < events_.capacity()) events_.push_back(event);
}

void SoftWorld::tell_solid_touches(const SolidHand& solid_hand, const Hand& hand,
                                   std::uint64_t step) {
  for (std::size_t s = 0; s < setup_->solids.size(); ++s) {
    const double force_n = solid_hand.force_n[s];
    const TouchNews news = follow_touch(state_.solid_hands[hand.index].touches[s],
                                        {!state_.solid_lost[s], force_n, solid_hand.deep_m[s]},
                                        limit_n_, step, step_s_);
    const Vec3 p_W = force_n > 0 ? solid_hand.p_W[s] : hand.tool ? hand.tool->X_WP.p : Vec3::Zero();
    Event event;
    event.hand = static_cast<std::uint8_t>(hand.index);
    event.subject = setup_->solids[s].soft;
    const auto say = [&](bool is_so, EventKind kind, const std::array<double, 3>& values) {
      event.kind = kind;
      event.values = values;
      if (is_so) tell(event, p_W);
    };
    say(news.begins, kSoftBegin, {});
    say(news.over, kSoftOver, {force_n, limit_n_, 0});
    say(news.ends, kSoftEnd, {news.since_s, news.peak_n, news.deepest_mm});
  }
}

void SoftWorld::show_loads(SoftPushes& out) const {
  const auto add = [&](const SoftLoad& load) {
    const auto pushes = [](double force_n) { return force_n > 0; };
    if (out.load_count == out.loads.size()) return;
    if (load.left < 1 || std::any_of(load.force_n.begin(), load.force_n.end(), pushes))
      out.loads[out.load_count++] = load;
  };
  for (std::size_t b = 0; b < setup_->bands.size(); ++b)
    if (is_felt(b))
      add({setup_->bands[b].soft, readouts_[b].force_n, readouts_[b].tension_n,
           strands_left(state_.bands[b].gone)});
  for (std::size_t s = 0; s < setup_->solids.size(); ++s)
    add({setup_->solids[s].soft, solid_readouts_[s].force_n});
  for (std::size_t k = 0; skins_ && k < setup_->skins.size(); ++k)
    add({setup_->skins[k].soft, skins_->readout(k).force_n});
}

void SoftWorld::tell_grip(const Hand& hand, const GripNews& news) {
  const bool solid = news.hold.of == SoftHold::Of::kSolid;
  if (news.hold.of == SoftHold::Of::kNothing) return;
  Event event;
  event.hand = static_cast<std::uint8_t>(hand.index);
  event.subject = solid ? setup_->solids[news.hold.part].soft : setup_->bands[news.hold.part].soft;
  const auto say = [&](bool is_so, EventKind kind, const std::array<double, 3>& values) {
    event.kind = kind;
    event.values = values;
    if (is_so) tell(event, news.p_W);
  };
  say(news.held, kSoftHeld, {news.holds_n, 0, 0});
  say(news.freed, kSoftFreed, {news.since_s, news.peak_n, news.pulled_mm});
  say(news.slipped, kSoftSlipped, {news.force_n, news.holds_n, news.pulled_mm});
}

}  // namespace osteon
