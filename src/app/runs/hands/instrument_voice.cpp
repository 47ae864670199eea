#include "runs/hands/instrument_voice.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/carve_events.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

constexpr double kFullLoad_n = 15;       // a hand that presses so hard loads a motor fully
constexpr double kCuttingLoad = 0.3;     // the least while bone goes
constexpr double kFullKnock_m_s = 0.15;  // of the hand when metal meets bone
constexpr double kFullJudder_mm = 0.2;
constexpr double kSlow_rpm = 500, kFast_rpm = 20000;

}  // namespace

VoiceKind voice_of(const Instrument& instrument) {
  if (!instrument.power) return VoiceKind::kNone;
  const PowerDef& power = *instrument.power;
  if (power.kind == "current") return VoiceKind::kCautery;
  if (power.kind == "suction") return VoiceKind::kSuction;
  if (power.kind != "motor") return VoiceKind::kNone;
  if (instrument.can(InstrumentFunction::kSuck)) return VoiceKind::kShaver;
  if (power.most >= kFast_rpm) return VoiceKind::kBurr;
  return power.most < kSlow_rpm ? VoiceKind::kReamer : VoiceKind::kDrill;
}

Result<std::vector<VoiceDrive>> voices_of(const std::vector<std::string>& tray) {
  std::vector<VoiceDrive> voices(tray.size());
  if (tray.empty()) return voices;
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (std::size_t k = 0; k < tray.size(); ++k) {
    const auto name = parse_tool_name(tray[k]);
    const Instrument* instrument = name ? find_instrument(*instruments, name->name) : nullptr;
    if (!instrument) continue;
    voices[k].kind = voice_of(*instrument);
    if (instrument->power && instrument->power->unit == "rpm")
      voices[k].full_rpm = instrument->power->most;
  }
  return voices;
}

void HeardCut::hear(const Event& event) {
  if (event.kind == kCutBegin) cutting = true;
  if (event.kind == kCutEnd) *this = {};
  if (event.kind == kChatter)
    judder = event.values[0] / kFullJudder_mm, judder_hz = event.values[1];
  if (event.kind == kChatterEnd) judder = judder_hz = 0;
}

VoiceDrive driven(const VoiceDrive& voice, double power, double force_n, const HeardCut& cut) {
  VoiceDrive drive = voice;
  drive.power = power;
  drive.load = std::max(force_n / kFullLoad_n, cut.cutting ? kCuttingLoad : 0.0);
  drive.judder = cut.judder;
  drive.judder_hz = cut.judder_hz;
  return drive;
}

double knock_strength(double speed_m_s) {
  return std::isfinite(speed_m_s) ? std::clamp(speed_m_s / kFullKnock_m_s, 0.05, 1.0) : 0.05;
}

// Codes of pictures: a shot of the fluoroscope.
std::optional<CueKind> cue_of(const Event& event) {
  const auto code = static_cast<int>(event.kind);
  if (event.kind == EventKind::kForceOver) return CueKind::kAlarm;
  if (event.kind == EventKind::kFault) return CueKind::kFault;
  if (event.kind == kBreached) return CueKind::kThrough;
  if (code >= 300 && code < 310) return CueKind::kBeep;
  return std::nullopt;
}

}  // namespace osteon
