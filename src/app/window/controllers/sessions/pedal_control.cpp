#include "window/controllers/sessions/pedal_control.h"

#include "window/controllers/sessions/pedal_poll.h"
#include "window/ui_model.h"

namespace osteon {
namespace {

std::string driven_by(const PedalMap& pedals, const char* name) {
  const auto pedal = pedals.find(name);
  return pedal == pedals.end() ? "none" : describe(pedal->second);
}

}  // namespace

HandWishes PedalControl::poll() {
  const PedalReadings readings = read_pedals(host_.window->handle());
  learn(readings);
  pedals_.update(readings);
  HandWishes wishes;
  wishes.has_dead_man = pedals_.has(kDeadManPedal);
  wishes.dead_man_held = pedals_.held(kDeadManPedal);
  wishes.clutch = pedals_.held(kClutchPedal);
  return wishes;
}

void PedalControl::learn(const PedalReadings& now) {
  if (learning_.empty()) return;
  const auto moved = moved_input(learning_from_, now);
  if (!moved) return;
  host_.settings.pedals[learning_] = *moved;
  begin();
  learning_.clear();
}

void PedalControl::apply(const UiRequests& requests) {
  if (requests.learn_pedal) {
    learning_ = *requests.learn_pedal;
    learning_from_ = read_pedals(host_.window->handle());
  }
  if (requests.forget_pedal) {
    host_.settings.pedals.erase(*requests.forget_pedal);
    begin();
  }
}

void PedalControl::describe(HandModel& hand) const {
  hand.has_dead_man = hand.info.has_dead_man || pedals_.has(kDeadManPedal);
  hand.learning_pedal = learning_;
  const PedalMap& pedals = host_.settings.pedals;
  hand.mapping.dead_man = driven_by(pedals, kDeadManPedal);
  hand.mapping.clutch = driven_by(pedals, kClutchPedal);
  hand.mapping.power = driven_by(pedals, kPowerPedal);
}

}  // namespace osteon
