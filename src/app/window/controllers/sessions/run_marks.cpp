#include "window/controllers/sessions/run_marks.h"

#include <string>

namespace osteon {

void RunMarks::clear() {
  marks_.clear();
  told_ = 0;
}

void RunMarks::update() {
  const LoadedReplay* const replay = replay_.replay();
  const LiveRun* const live = live_.run();
  const RunEvents* events = replay ? &replay->events : live ? &live->events() : nullptr;
  if (!events || !scene_.the_case) return;
  if (events->events().size() < told_ || told_case_ != scene_.the_case.get()) clear();
  told_case_ = scene_.the_case.get();
  if (events->events().size() == told_) return;
  const std::vector<std::string> titles = replay ? replay->instruments : live_.tray().titles();
  std::vector<std::string> portals, hands;
  for (const Portal& portal : replay ? replay->portals : scene_.portals)
    portals.push_back("portal " + portal.title);
  if (replay && replay->hands.size() > 1) hands = replay->hands;
  if (!replay && live->hands() > 1)
    for (std::size_t i = 0; i < live->hands(); ++i) hands.push_back(live->hand(i).name);
  for (; told_ < events->events().size(); ++told_) {
    const RunEvent& run_event = events->events()[told_];
    const EventKind kind = run_event.event.kind;
    marks_.push_back({run_event.time_s,
                      describe_event(run_event.event, *scene_.the_case, titles, portals, hands),
                      kind == EventKind::kFault || kind == EventKind::kForceOver});
  }
}

}  // namespace osteon
