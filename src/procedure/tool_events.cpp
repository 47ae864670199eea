#include "osteon/procedure/tool_events.h"

#include <algorithm>

namespace osteon {

ToolEvents::ToolEvents(std::size_t bones, ToolEventLimits limits, std::uint8_t hand, double tick_s)
    : limits_(std::move(limits)),
      hand_(hand),
      tick_s_(tick_s),
      touches_(bones),
      forces_(bones),
      normals_(bones),
      depths_(bones),
      places_(bones),
      touched_(bones) {
  for (Touch& touch : touches_) {
    touch.over.assign(limits_.force_n.size(), 0);
    touch.over_peak_n.assign(limits_.force_n.size(), 0);
  }
}

Event ToolEvents::event(EventKind kind, std::size_t bone, std::array<double, 3> values) const {
  Event made;
  made.tick = tick_;
  made.kind = kind;
  made.hand = hand_;
  made.subject_kind = SubjectKind::kBone;
  made.subject = static_cast<std::uint32_t>(bone);
  made.p_W = touches_[bone].p_W;
  made.values = values;
  return made;
}

double ToolEvents::seconds_since(std::uint64_t tick) const {
  return static_cast<double>(tick_ - tick) * tick_s_;
}

// Sums the tick's contacts by bone: a bone may be touched in several places.
void ToolEvents::gather(const ToolState& tool) {
  std::fill(touched_.begin(), touched_.end(), 0);
  std::fill(forces_.begin(), forces_.end(), Vec3::Zero());
  std::fill(depths_.begin(), depths_.end(), 0);
  for (std::uint32_t i = 0; i < tool.contact_count; ++i) {
    const Contact& contact = tool.contacts[i];
    const std::uint32_t bone = contact.bone.index;
    if (bone >= touches_.size() || !is_finite(contact.force_on_tool_W)) continue;
    touched_[bone] = 1;
    forces_[bone] += contact.force_on_tool_W;
    normals_[bone] = contact.nhat_BT_W;
    places_[bone] = contact.p_W;
    depths_[bone] = std::max(depths_[bone], contact.depth_m);
  }
}

void ToolEvents::begin_touch(std::size_t bone, double speed_m_s, std::vector<Event>& out) {
  Touch& touch = touches_[bone];
  touch.begun = tick_;
  touch.peak_n = touch.deepest_m = 0;
  out.push_back(event(EventKind::kContactBegin, bone, {touch.force_n, 0, 0}));
  out.push_back(event(EventKind::kImpact, bone, {speed_m_s * 1000, 0, 0}));
}

void ToolEvents::end_slide(std::size_t bone, std::vector<Event>& out) {
  Touch& touch = touches_[bone];
  if (touch.sliding && touch.slid_m * 1000 >= limits_.slide_mm)
    out.push_back(event(EventKind::kScratch, bone,
                        {touch.slid_m * 1000, touch.slide_peak_n, seconds_since(touch.sliding)}));
  touch.sliding = 0;
}

void ToolEvents::end_touch(std::size_t bone, std::vector<Event>& out) {
  Touch& touch = touches_[bone];
  touch.force_n = 0;
  watch_force(bone, out);
  end_slide(bone, out);
  out.push_back(event(EventKind::kContactEnd, bone,
                      {seconds_since(touch.begun), touch.peak_n, touch.deepest_m * 1000}));
  touch.begun = 0;
}

void ToolEvents::watch_force(std::size_t bone, std::vector<Event>& out) {
  Touch& touch = touches_[bone];
  for (std::size_t k = 0; k < limits_.force_n.size(); ++k) {
    const double limit = limits_.force_n[k];
    const bool over = touch.force_n > limit;
    if (over && !touch.over[k]) {
      touch.over[k] = tick_;
      touch.over_peak_n[k] = 0;
      out.push_back(event(EventKind::kForceOver, bone, {touch.force_n, limit, 0}));
    }
    touch.over_peak_n[k] = std::max(touch.over_peak_n[k], touch.force_n);
    if (!over && touch.over[k]) {
      out.push_back(event(EventKind::kForceUnder, bone,
                          {touch.over_peak_n[k], limit, seconds_since(touch.over[k])}));
      touch.over[k] = 0;
    }
  }
}

// A slide is how far the place of contact gets from where the force first was above the limit: a
// tremor on the spot is none.
void ToolEvents::watch_slide(std::size_t bone, std::vector<Event>& out) {
  Touch& touch = touches_[bone];
  if (touch.force_n <= limits_.slide_force_n) return end_slide(bone, out);
  if (!touch.sliding) {
    touch.sliding = tick_;
    touch.slide_from_W = touch.p_W;
    touch.slid_m = touch.slide_peak_n = 0;
  }
  touch.slid_m = std::max(touch.slid_m, (touch.p_W - touch.slide_from_W).norm());
  touch.slide_peak_n = std::max(touch.slide_peak_n, touch.force_n);
}

void ToolEvents::add(const ToolState& tool, std::vector<Event>& out) {
  tick_ = tool.tick;
  gather(tool);
  const Vec3 v_W = seen_ ? Vec3((tool.X_WD.p - last_hand_W_) / tick_s_) : Vec3(Vec3::Zero());
  for (std::size_t bone = 0; bone < touches_.size(); ++bone) {
    Touch& touch = touches_[bone];
    if (!touched_[bone]) {
      if (touch.begun) end_touch(bone, out);
      continue;
    }
    touch.force_n = forces_[bone].norm();
    touch.p_W = places_[bone];
    if (!touch.begun) begin_touch(bone, std::max(0.0, -v_W.dot(normals_[bone])), out);
    touch.peak_n = std::max(touch.peak_n, touch.force_n);
    touch.deepest_m = std::max(touch.deepest_m, depths_[bone]);
    watch_force(bone, out);
    watch_slide(bone, out);
  }
  if (is_finite(tool.X_WD)) last_hand_W_ = tool.X_WD.p;
  seen_ = true;
}

void ToolEvents::finish(std::vector<Event>& out) {
  for (std::size_t bone = 0; bone < touches_.size(); ++bone)
    if (touches_[bone].begun) end_touch(bone, out);
}

}  // namespace osteon
