#pragma once

#include <array>
#include <span>
#include <vector>

#include "osteon/media/sound_synth.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"
#include "runs/hands/instrument_voice.h"

namespace osteon {

/// The sound of a scene while it goes on, from the hands' tools as each picture shows them and the
/// events between. What `RecordedSound` makes tick by tick is made here picture by picture.
class SceneSound {
 public:
  /// Of another run or replay: by place in its tray. Nothing of the one before sounds on.
  void begin(std::vector<VoiceDrive> voices);

  /// What the hands do now. A hand that was elsewhere before (a jump in time, an undo) knocks on
  /// nothing.
  void see(std::span<const ToolState> tools);
  /// What happened since. Contacts and exchanges are seen, not heard.
  void hear(const Event& event);
  /// The next samples.
  void render(std::span<float> out) { synth_.render(out); }

 private:
  struct Hand {
    bool known = false, touches = false;
    HeardCut cut;
    std::uint32_t instrument = 0, epoch = 0;
    double time_s = 0;
  };
  std::vector<VoiceDrive> voices_;
  std::array<Hand, kMaxHands> hands_{};
  SoundSynth synth_;
};

}  // namespace osteon
