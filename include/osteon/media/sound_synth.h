#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/random.h"

namespace osteon {

/// What an instrument sounds like while it has power.
enum class VoiceKind : std::uint8_t {
  kNone,
  kDrill,    ///< also pins that are driven
  kReamer,   ///< slow and rough
  kBurr,     ///< fast and thin
  kShaver,   ///< turns to and fro, and sucks
  kSuction,  ///< hiss and gurgle
  kCautery   ///< tone and sizzle
};

/// Sounds that happen once.
enum class CueKind : std::uint8_t {
  kBeep,      ///< the fluoroscope's, for a shot
  kExchange,  ///< an instrument is taken
  kAlarm,     ///< the force is over its limit
  kFault,     ///< the device's force was taken off
  kKnock,     ///< metal meets bone
  kThrough    ///< a drill comes out of bone
};

/// How a voice is driven now.
struct VoiceDrive {
  VoiceKind kind = VoiceKind::kNone;
  double power = 0;       ///< 0 to 1
  double load = 0;        ///< 0: turns freely, 1: as hard as it can work
  double full_rpm = 600;  ///< turns a minute at full power, of what turns
  double judder = 0;      ///< 0 to 1: how hard it is thrown back by each tooth
  double judder_hz = 0;   ///< how often
};

/// The tone of a motor that turns freely: the lowest partial that it gives, Hz. What turns slowly
/// is driven through a gear, and the motor is heard. 0 for what does not turn.
double voice_hz(VoiceKind kind, double full_rpm, double power);

inline constexpr std::size_t kMaxVoices = 4;

/// Makes the sound of instruments and events, piece by piece: a function of what it was told and
/// of the seed, so the same calls give the same samples. Exactly silent when nothing sounds.
class SoundSynth {
 public:
  explicit SoundSynth(std::uint64_t seed = 1);

  /// From the next sample on. A voice past kMaxVoices is ignored.
  void drive(std::size_t voice, const VoiceDrive& drive);
  /// Begins at the next sample. `strength` 0 to 1.
  void cue(CueKind kind, double strength = 1);
  /// The next samples, -1 to 1, kSoundHz.
  void render(std::span<float> out);

 private:
  struct Voice {
    VoiceDrive now;
    double speed = 0, load = 0;              ///< follow power and load with their own delays
    double phase = 0, flute = 0, swing = 0;  ///< turns of the motor, of the edges, to and fro
    double judder = 0;                       ///< likewise, of the teeth that are thrown back
    double low = 0, band = 0, rough = 1, rough_to = 1;
    int rough_left = 0;
    Random random{1};
  };
  /// A decaying partial.
  struct Ring {
    double hz = 0, phase = 0, level = 0, decay = 1;
    int wait = 0, left = 0;  ///< samples until it begins, and that it lasts
  };
  double next(Voice& voice) const;
  double next(Ring& ring) const;
  void add_ring(double at_s, double hz, double level, double decay_s, double for_s);

  std::array<Voice, kMaxVoices> voices_;
  std::vector<Ring> rings_;
};

}  // namespace osteon
