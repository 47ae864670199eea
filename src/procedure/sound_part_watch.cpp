#include "osteon/procedure/sound_part_watch.h"

namespace osteon {
namespace {

// A snapshot tells of a tip every other step, and keeps what it has left for a while.
constexpr std::uint64_t kStillIn = 4;

}  // namespace

bool SoundPartWatch::is_sound(const Inside& inside) const {
  if (inside.kind != SubjectKind::kSoftPart || inside.subject >= case_->softs.size()) return false;
  const std::string& kind = case_->softs[inside.subject].kind;
  return kind == "ligament" || kind == "meniscus";
}

void SoundPartWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                         std::vector<Event>& out) {
  for (std::size_t h = 0; h < tools.size() && h < bones.inside.size(); ++h) {
    const ToolState& tool = *tools[h];
    const bool clears = tool.instrument < clears_.size() && clears_[tool.instrument] != 0;
    if (!clears || !(tool.power > 0)) continue;
    for (const Inside& inside : bones.inside[h]) {
      if (!is_sound(inside) || bones.step > inside.last_step + kStillIn) continue;
      Visit& visit = visits_[{h, inside.subject}];
      if (visit.first_step != inside.first_step) visit = {inside.first_step, 0};
      if (++visit.ticks % kTellSoundPart != 0) continue;
      Event event;
      event.tick = tool.tick;
      event.kind = kSoundPartCleared;
      event.subject_kind = SubjectKind::kSoftPart;
      event.subject = inside.subject;
      event.hand = static_cast<std::uint8_t>(h);
      event.p_W = tool.X_WP.p;
      event.values = {static_cast<double>(visit.ticks) * tick_s_, 1e3 * inside.deepest_m, 0};
      out.push_back(event);
    }
  }
}

}  // namespace osteon
