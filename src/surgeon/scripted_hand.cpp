#include "osteon/surgeon/scripted_hand.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace osteon {
namespace {

// As a tray names it.
std::string held_by(const PathSample& sample) {
  if (!(sample.size_mm > 0)) return sample.instrument;
  char size[32];
  std::snprintf(size, sizeof size, ":%g", sample.size_mm);
  return sample.instrument + size;
}

}  // namespace

ScriptedHand::ScriptedHand(HandPart part) : part_(std::move(part)), X_(start()) {
  if (!part_.path.samples.empty()) held_ = held_by(part_.path.samples.front());
}

Pose ScriptedHand::start() const {
  return part_.path.samples.empty() ? Pose{} : part_.path.samples.front().X_WD;
}

bool ScriptedHand::done() const {
  return time_s_ > part_.path.duration_s() && order_ >= part_.orders.size();
}

Command ScriptedHand::said() {
  const PathSample sample = part_.path.at(time_s_);
  if (const std::string name = held_by(sample); !name.empty() && name != held_) {
    held_ = name;
    drive_.took();
    const auto found = std::find(tray_.begin(), tray_.end(), held_);
    if (found != tray_.end())
      return {CommandKind::kTake, static_cast<double>(found - tray_.begin())};
  }
  if (const Command driven = drive_.next(sample); driven.kind != CommandKind::kNone) return driven;
  if (order_ >= part_.orders.size() || part_.orders[order_].at_s > time_s_) return {};
  return part_.orders[order_++].command;
}

Pose ScriptedHand::step(double dt_s) {
  next_ = {};
  if (done()) return X_;
  time_s_ += dt_s;
  X_ = part_.path.at(time_s_).X_WD;
  next_ = said();
  return X_;
}

}  // namespace osteon
