#include "osteon/media/sound_synth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/media/film_writer.h"

namespace osteon {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kQuiet = 1e-5;  // below this a sound has ended
constexpr std::size_t kPartials = 6;

/// What a kind of instrument sounds like. All levels are of full scale.
struct Timbre {
  double gear = 0;                           ///< turns of the motor for one of what turns
  std::array<double, kPartials> partials{};  ///< of the motor's tone
  double tone = 0;                           ///< level of the motor
  double noise = 0;                          ///< of gears and air when it turns freely
  double bite = 0;                           ///< of what it works on, at full load
  double flutes = 2;                         ///< edges: how often it bites in one turn
  double sag = 0.15;                         ///< share of the speed that full load takes
  double pass = 0.2;                         ///< of the noise's low pass, 0 dull to 1 sharp
  double swing_hz = 0;                       ///< turns to and fro so often
};

// By VoiceKind. Motors of hand pieces turn at some 20 000 a minute: a drill at 1200 sounds at
// 360 Hz through its gear, a reamer at 350 at 280 Hz.
constexpr std::array<Timbre, 7> kTimbres = {{
    {},
    {18, {1, 0.55, 0.32, 0.22, 0.10, 0.08}, 0.16, 0.012, 0.20, 2, 0.18, 0.35, 0},
    {48, {1, 0.70, 0.45, 0.20, 0.15, 0.05}, 0.15, 0.015, 0.30, 4, 0.25, 0.18, 0},
    {1, {1, 0.30, 0.18, 0.06, 0.04, 0.02}, 0.10, 0.020, 0.16, 2, 0.10, 0.70, 0},
    {4, {1, 0.45, 0.35, 0.15, 0.10, 0.06}, 0.12, 0.030, 0.14, 2, 0.12, 0.30, 1.5},
    {0, {}, 0, 0.11, 0.05, 0, 0, 0.12, 0},
    {0, {1, 0, 0.45, 0, 0.20, 0}, 0.09, 0.010, 0.22, 0, 0, 0.80, 0},
}};
constexpr double kCauteryHz = 620;

const Timbre& timbre_of(VoiceKind kind) { return kTimbres[static_cast<std::size_t>(kind)]; }

double share(double value) { return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0; }

/// What a value keeps of itself in one sample when it falls to 1/e in `s`.
double kept(double s) { return std::exp(-1 / (s * kSoundHz)); }

const double kSpin = kept(0.07), kYield = kept(0.02);

/// What is loud bends towards 1 and is never cut.
double rounded_off(double level) {
  constexpr double kStraight = 0.6;
  const double over = std::abs(level) - kStraight;
  if (over <= 0) return level;
  return std::copysign(kStraight + (1 - kStraight) * std::tanh(over / (1 - kStraight)), level);
}

double whole(double& turns) {
  turns -= std::floor(turns);
  return turns;
}

}  // namespace

double voice_hz(VoiceKind kind, double full_rpm, double power) {
  if (kind == VoiceKind::kCautery) return power > 0 ? kCauteryHz : 0;
  return share(power) * timbre_of(kind).gear * full_rpm / 60;
}

SoundSynth::SoundSynth(std::uint64_t seed) {
  for (std::size_t v = 0; v < kMaxVoices; ++v) voices_[v].random = Random(seed + 1000 * v);
}

void SoundSynth::drive(std::size_t voice, const VoiceDrive& drive) {
  if (voice >= kMaxVoices) return;
  VoiceDrive now = drive;
  now.power = share(now.power);
  now.load = share(now.load);
  now.full_rpm = std::isfinite(now.full_rpm) ? std::clamp(now.full_rpm, 0.0, 1e5) : 0;
  now.judder = share(now.judder);
  now.judder_hz = std::isfinite(now.judder_hz) ? std::clamp(now.judder_hz, 0.0, 400.0) : 0;
  // A motor that is let go still turns; another instrument begins at rest.
  if (now.kind == VoiceKind::kNone) now.kind = voices_[voice].now.kind, now.power = now.load = 0;
  if (now.kind != voices_[voice].now.kind) voices_[voice].speed = voices_[voice].load = 0;
  if (now.full_rpm == 0) now.full_rpm = voices_[voice].now.full_rpm;
  voices_[voice].now = now;
}

void SoundSynth::add_ring(double at_s, double hz, double level, double decay_s, double for_s) {
  Ring ring;
  ring.hz = hz;
  ring.level = level;
  ring.decay = kept(decay_s);
  ring.wait = static_cast<int>(std::lround(at_s * kSoundHz));
  ring.left = static_cast<int>(std::lround(for_s * kSoundHz));
  rings_.push_back(ring);
}

void SoundSynth::cue(CueKind kind, double strength) {
  const double s = share(strength);
  switch (kind) {
    case CueKind::kBeep:
      return add_ring(0, 1000, 0.18 * s, 1.0, 0.12);
    case CueKind::kExchange:
      add_ring(0, 2900, 0.12 * s, 0.012, 0.1);
      add_ring(0, 4730, 0.06 * s, 0.008, 0.1);
      add_ring(0.07, 2500, 0.14 * s, 0.016, 0.12);
      return add_ring(0.07, 5210, 0.05 * s, 0.009, 0.1);
    case CueKind::kAlarm:
      add_ring(0, 880, 0.16 * s, 1.0, 0.1);
      return add_ring(0.14, 880, 0.16 * s, 1.0, 0.1);
    case CueKind::kFault:
      add_ring(0, 520, 0.2 * s, 1.0, 0.18);
      add_ring(0.22, 415, 0.2 * s, 1.0, 0.18);
      return add_ring(0.44, 330, 0.2 * s, 1.0, 0.3);
    case CueKind::kKnock:
      add_ring(0, 410, 0.22 * s, 0.010, 0.1);
      add_ring(0, 1130, 0.12 * s, 0.006, 0.1);
      return add_ring(0, 2870, 0.06 * s, 0.003, 0.1);
    case CueKind::kThrough:
      add_ring(0, 170, 0.30 * s, 0.025, 0.2);
      return add_ring(0, 690, 0.12 * s, 0.010, 0.1);
  }
}

// A source, and what roughens it: the motor's partials follow its speed, which sags under load; the
// edges bite at their own pace through noise; at high load they chatter, by bursts of random
// strength that last some bites.
double SoundSynth::next(Voice& v) const {
  const Timbre& t = timbre_of(v.now.kind);
  const double aim = v.now.power * (1 - t.sag * v.load);
  v.speed = aim + (v.speed - aim) * kSpin;
  v.load = v.now.load + (v.load - v.now.load) * kYield;
  if (v.speed < kQuiet && v.now.power <= 0) {
    v.speed = v.load = v.low = v.band = 0;
    return 0;
  }
  const double hz = t.gear > 0 ? t.gear * v.now.full_rpm / 60 * v.speed : kCauteryHz;
  v.phase += hz / kSoundHz;
  whole(v.phase);
  double tone = 0;
  for (std::size_t k = 0; k < kPartials; ++k)
    if (t.partials[k] > 0 && static_cast<double>(k + 1) * hz < 0.45 * kSoundHz)
      tone += t.partials[k] * std::sin(kTurn * static_cast<double>(k + 1) * v.phase);
  const double white = v.random.uniform(-1, 1);
  v.low += t.pass * (white - v.low);
  v.band += 0.02 * (v.low - v.band);
  const double hiss = v.low - v.band;
  if (--v.rough_left <= 0) {
    const double bites_per_s = std::max(20.0, t.flutes * v.now.full_rpm / 60 * v.speed);
    v.rough_left = static_cast<int>(kSoundHz / std::min(bites_per_s, 400.0));
    v.rough_to = v.random.uniform(1 - 0.9 * v.load, 1 + 0.9 * v.load);
  }
  v.rough += 0.01 * (v.rough_to - v.rough);
  v.flute += t.flutes * v.now.full_rpm / 60 * v.speed / kSoundHz;
  const double edge = t.flutes > 0 ? 0.5 + 0.5 * std::sin(kTurn * whole(v.flute)) : 1;
  v.swing += t.swing_hz / kSoundHz;
  const double swing = t.swing_hz > 0 ? 0.75 + 0.25 * std::sin(kTurn * whole(v.swing)) : 1;
  v.judder += v.now.judder_hz / kSoundHz;
  // Thrown back it is nearly free, come back it bites twice as hard.
  const double thrown = 1 + share(v.now.judder) * std::sin(kTurn * whole(v.judder));
  const double level = std::sqrt(std::max(v.speed, 0.0));
  const double working = t.bite * v.load * v.rough * edge * hiss * thrown;
  return level * swing * thrown *
         (t.tone * (0.6 + 0.4 * v.rough * v.load + 0.4 * v.load) * tone + 3 * t.noise * hiss +
          3 * working);
}

double SoundSynth::next(Ring& ring) const {
  if (ring.wait > 0) {
    --ring.wait;
    return 0;
  }
  // Over 2 ms at its end a ring fades, so that it does not click.
  constexpr int kFade = kSoundHz / 500;
  const double fade = std::min(1.0, static_cast<double>(--ring.left) / kFade);
  const double value = fade * ring.level * std::sin(kTurn * ring.phase);
  ring.phase += ring.hz / kSoundHz;
  whole(ring.phase);
  ring.level *= ring.decay;
  return value;
}

void SoundSynth::render(std::span<float> out) {
  for (float& sample : out) {
    double sum = 0;
    for (Voice& voice : voices_)
      if (voice.now.kind != VoiceKind::kNone) sum += next(voice);
    for (Ring& ring : rings_) sum += next(ring);
    std::erase_if(rings_, [](const Ring& ring) { return ring.left <= 0; });
    sample = static_cast<float>(rounded_off(sum));
  }
}

}  // namespace osteon
