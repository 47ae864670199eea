#include "runs/reports/run_events.h"

#include "osteon/device/haptic_device.h"

namespace osteon {
namespace {

bool is_for_timeline(EventKind kind) {
  switch (kind) {
    case EventKind::kNone:
    case EventKind::kContactBegin:
    case EventKind::kContactEnd:
    case EventKind::kForceUnder:
    case EventKind::kImpact:
    case EventKind::kScratch:
      return false;
    default:
      return true;
  }
}

std::string at(std::span<const std::string> names, std::uint32_t i) {
  return i < names.size() ? names[i] : std::to_string(i);
}

std::string subject_of(const Event& event, const Case& the_case,
                       std::span<const std::string> instruments,
                       std::span<const std::string> portals, std::span<const std::string> hands) {
  const std::uint32_t i = event.subject;
  switch (event.subject_kind) {
    case SubjectKind::kBone:
      return i < the_case.bones.size() ? the_case.bones[i].name : std::to_string(i);
    case SubjectKind::kSoftPart:
      return i < the_case.softs.size() ? the_case.softs[i].name : std::to_string(i);
    case SubjectKind::kInstrument:
      return at(instruments, i);
    case SubjectKind::kPortal:
      return at(portals, i);
    case SubjectKind::kHand:
      return at(hands, i);
    case SubjectKind::kMark:
      return std::to_string(i + 1);
    case SubjectKind::kDevice:
      return describe(static_cast<ForceOff>(i));
    default:
      return {};
  }
}

}  // namespace

// A shaft at the very edge of a hole enters and leaves it many times a second: told once.
bool RunEvents::repeats(const Event& event, double time_s) const {
  constexpr double kApart_s = 0.25;
  if (event.subject_kind != SubjectKind::kPortal) return false;
  for (auto it = events_.rbegin(); it != events_.rend() && time_s - it->time_s < kApart_s; ++it)
    if (it->event.hand == event.hand && it->event.subject_kind == SubjectKind::kPortal &&
        it->event.subject == event.subject)
      return true;
  return false;
}

void RunEvents::add(const Event& event, double tick_s) {
  if (!is_for_timeline(event.kind) || events_.size() >= kMostKept) return;
  if (repeats(event, static_cast<double>(event.tick) * tick_s)) return;
  events_.push_back({static_cast<double>(event.tick) * tick_s, event});
}

std::string describe_event(const Event& event, const Case& the_case,
                           std::span<const std::string> instruments,
                           std::span<const std::string> portals,
                           std::span<const std::string> hands) {
  std::string text;
  if (event.hand < hands.size() && !hands[event.hand].empty()) text = hands[event.hand] + ": ";
  const EventKindRow* row = find_event_kind(event.kind);
  text += row ? std::string(row->text) : "event " + std::to_string(static_cast<int>(event.kind));
  const std::string subject = subject_of(event, the_case, instruments, portals, hands);
  return subject.empty() ? text : text + " " + subject;
}

}  // namespace osteon
