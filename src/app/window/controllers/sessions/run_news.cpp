#include "window/controllers/sessions/run_news.h"

#include "osteon/mesh/measure.h"
#include "osteon/scene/carve_events.h"
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
  // What a torn one has left is pierced and shaved: it was in two before.
  if (event.kind == kSoftCut && soft.kind == "ligament" && connected_parts(soft.mesh_W).size() < 2)
    return name + " is cut in two";
  if (event.kind == kSoftSlipped)
    return name + " was pulled off the jaws, with" + force(event.values[0]);
  return {};
}

std::string guide_news_of(const Event& event, const Case& the_case) {
  if (event.subject_kind != SubjectKind::kBone || event.subject >= the_case.bones.size()) return {};
  const std::string name = label_of(the_case.bones[event.subject].name);
  if (event.kind == kAimed) return name + ": the aimer is fixed. Its sleeve leads a pin.";
  if (event.kind == kPinLeft)
    return name + ": the pin stays, " + ui::number(event.values[0], 0) +
           " mm deep. It leads a drill that is hollow.";
  if (event.kind == kSkives)
    return name + ": the drill slides off. Stand it steeper, or lead it by a pin or an aimer.";
  return {};
}

// A drill that slides off does so many times a second.
std::string RunNews::news_of(const RunEvent& happened) {
  constexpr double kSlidAgain_s = 10;
  const Case& the_case = *scene_.the_case;
  if (happened.event.kind == kSkives) {
    if (happened.time_s < slid_at_s_) slid_at_s_ = -100;  // of another run
    if (happened.time_s - slid_at_s_ < kSlidAgain_s) return {};
    slid_at_s_ = happened.time_s;
  }
  const std::string of_softs = soft_news_of(happened.event, the_case);
  return of_softs.empty() ? guide_news_of(happened.event, the_case) : of_softs;
}

void RunNews::update() {
  const LiveRun* const live = live_.run();
  if (!live || !scene_.the_case) return;
  const auto events = live->events().events();
  if (events.size() < told_) told_ = 0;
  for (; told_ < events.size(); ++told_) {
    const std::string news = news_of(events[told_]);
    if (!news.empty()) host_.note(ToastKind::kInfo, news);
  }
}

}  // namespace osteon
