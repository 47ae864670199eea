#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/media/sound_synth.h"
#include "osteon/record/recording.h"
#include "osteon/scene/instrument.h"
#include "runs/hands/instrument_voice.h"

namespace osteon {

/// The sound of a recording, from its events and the forces of its hands alone: nothing is
/// repeated. The same recording gives the same samples.
class RecordedSound {
 public:
  /// Begins `from_s` after the recording's begin: what has power then sounds at once. `recording`
  /// must outlive it.
  static Result<RecordedSound> create(RecordingReader& recording, double from_s);

  /// The next samples; silence after the recording's end.
  Result<void> render(std::span<float> out);

 private:
  struct Hand {
    std::uint32_t instrument = 0;
    double power = 0;
    HeardCut cut;
    std::vector<TickRecord> ticks;  ///< a piece of the recording
  };
  using Held = std::array<std::pair<std::uint32_t, double>, kMaxHands>;

  RecordedSound() = default;
  void hear(const Event& event);
  Result<const TickRecord*> tick_of(std::size_t hand, std::uint64_t tick);
  Result<void> enter_tick(std::uint64_t tick);
  void take_events(std::uint64_t until_tick, bool aloud);

  RecordingReader* recording_ = nullptr;
  double tick_s_ = 0.001;
  std::vector<VoiceDrive> voices_;  ///< by place in the tray
  std::vector<Event> events_;       ///< in the order of their ticks
  std::size_t next_event_ = 0;
  std::vector<Hand> hands_;
  std::array<Held, kMaxMarks> marks_{};
  SoundSynth synth_;
  std::uint64_t tick_ = 0;    ///< the one that sounds now
  std::uint64_t sample_ = 0;  ///< of the recording, the next one
};

}  // namespace osteon
