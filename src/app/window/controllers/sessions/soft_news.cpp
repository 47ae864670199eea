#include "window/controllers/sessions/soft_news.h"

#include "osteon/scene/soft_events.h"
#include "ui/label.h"
#include "ui/ui_widgets.h"

namespace osteon {

std::string soft_news_of(const Event& event, const Case& the_case) {
  if (event.subject_kind != SubjectKind::kSoftPart || event.subject >= the_case.softs.size())
    return {};
  const SoftPart& soft = the_case.softs[event.subject];
  const std::string name = label_of(soft.name);
  const auto force = [](double force_n) { return " " + ui::number(force_n, 0) + " N"; };
  if (event.kind == kSoftTorn && event.hand == kNoHand) return name + " has torn";
  if (event.kind == kSoftTorn) return name + " has torn, pulled with" + force(event.values[1]);
  if (event.kind == kSoftCut && soft.kind == "ligament") return name + " is cut in two";
  if (event.kind == kSoftSlipped)
    return name + " was pulled off the jaws, with" + force(event.values[0]);
  return {};
}

void SoftNews::update() {
  const LiveRun* const live = live_.run();
  if (!live || !scene_.the_case) return;
  const auto events = live->events().events();
  if (events.size() < told_) told_ = 0;
  for (; told_ < events.size(); ++told_) {
    const std::string news = soft_news_of(events[told_].event, *scene_.the_case);
    if (!news.empty()) host_.note(ToastKind::kInfo, news);
  }
}

}  // namespace osteon
