#include "osteon/procedure/sound_part_watch.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// A snapshot tells of a tip every other step, and keeps what it has left for a while.
constexpr std::uint64_t kStillIn = 4;

}  // namespace

bool SoundPartWatch::is_sound(SubjectKind of, std::uint32_t soft) const {
  if (of != SubjectKind::kSoftPart || soft >= case_->softs.size()) return false;
  const std::string& kind = case_->softs[soft].kind;
  return kind == "ligament" || kind == "meniscus";
}

// What is missing from the snapshot has lost nothing, or has it back.
void SoundPartWatch::tell_losses(std::uint64_t tick, const BoneSnapshot& bones,
                                 std::vector<Event>& out) {
  if (bones.softs.loss_count == 0 && lost_.empty()) return;
  std::map<std::uint32_t, double> now;
  for (std::uint32_t i = 0; i < std::min<std::size_t>(bones.softs.loss_count, kMaxSoftLosses);
       ++i) {
    const SoftLoss& loss = bones.softs.losses[i];
    if (!is_sound(SubjectKind::kSoftPart, loss.soft)) continue;
    const double lost = std::floor(std::max(loss.mm3, loss.percent));
    const auto told = lost_.find(loss.soft);
    const double before = told == lost_.end() ? 0 : told->second;
    now[loss.soft] = lost;
    if (!(lost > before)) continue;
    Event event;
    event.tick = tick;
    event.kind = kSoundPartLost;
    event.subject_kind = SubjectKind::kSoftPart;
    event.subject = loss.soft;
    event.values = {loss.mm3, loss.percent, before};
    out.push_back(event);
  }
  lost_ = std::move(now);
}

void SoundPartWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                         std::vector<Event>& out) {
  if (!tools.empty()) tell_losses(tools[0]->tick, bones, out);
  for (std::size_t h = 0; h < tools.size() && h < bones.inside.size(); ++h) {
    const ToolState& tool = *tools[h];
    const bool clears = tool.instrument < clears_.size() && clears_[tool.instrument] != 0;
    if (!clears || !(tool.power > 0)) continue;
    for (const Inside& inside : bones.inside[h]) {
      if (!is_sound(inside.kind, inside.subject) || bones.step > inside.last_step + kStillIn)
        continue;
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
