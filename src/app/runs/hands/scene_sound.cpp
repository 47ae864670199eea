#include "runs/hands/scene_sound.h"

#include <algorithm>
#include <cmath>

namespace osteon {

void SceneSound::begin(std::vector<VoiceDrive> voices) {
  voices_ = std::move(voices);
  hands_ = {};
  for (std::size_t h = 0; h < kMaxVoices; ++h) synth_.drive(h, {});
}

void SceneSound::see(std::span<const ToolState> tools) {
  constexpr double kLeap_s = 0.5;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    if (h >= tools.size() || tools[h].tick == 0) {
      hand.known = false;
      synth_.drive(h, {});
      continue;
    }
    const ToolState& tool = tools[h];
    const double passed_s = tool.time_s - hand.time_s;
    const bool follows =
        hand.known && tool.epoch == hand.epoch && passed_s >= 0 && passed_s < kLeap_s;
    const bool touches = tool.contact_count > 0;
    if (follows && touches && !hand.touches)
      synth_.cue(CueKind::kKnock, knock_strength(tool.v_W.norm()));
    if (follows && tool.instrument != hand.instrument) synth_.cue(CueKind::kExchange);
    const bool goes_on = follows && tool.instrument == hand.instrument;
    const HeardCut cut = goes_on ? hand.cut : HeardCut{};
    hand = {true, touches, cut, tool.instrument, tool.epoch, tool.time_s};
    // A replay that stands still is silent.
    const bool goes = follows && passed_s > 0;
    VoiceDrive drive;
    if (goes && tool.instrument < voices_.size() && std::isfinite(tool.power))
      drive = driven(voices_[tool.instrument], tool.power, tool.force_W.norm(), cut);
    synth_.drive(h, drive);
  }
}

void SceneSound::hear(const Event& event) {
  if (const auto cue = cue_of(event)) synth_.cue(*cue);
  if (event.hand < hands_.size()) hands_[event.hand].cut.hear(event);
}

}  // namespace osteon
