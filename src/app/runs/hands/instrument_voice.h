#pragma once

#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/media/sound_synth.h"
#include "osteon/scene/event.h"
#include "osteon/scene/instrument.h"

namespace osteon {

/// What an instrument sounds like under power, by its numbers; kNone: nothing.
VoiceKind voice_of(const Instrument& instrument);

/// What each place of a tray sounds like at full power.
Result<std::vector<VoiceDrive>> voices_of(const std::vector<std::string>& tray);

/// What events say of a hand's cutting: whether bone goes, and how its instrument chatters.
struct HeardCut {
  bool cutting = false;
  double judder = 0, judder_hz = 0;  ///< as VoiceDrive
  void hear(const Event& event);
};

/// The voice as it is driven: by its power, the force on the hand, and what it cuts.
VoiceDrive driven(const VoiceDrive& voice, double power, double force_n, const HeardCut& cut);

/// How loud metal meets bone when the hand comes at that speed, m/s; 0 to 1.
double knock_strength(double speed_m_s);

/// What is heard of an event; a contact's knock and an exchange aside: nothing for most.
std::optional<CueKind> cue_of(const Event& event);

}  // namespace osteon
