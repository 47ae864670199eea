#include "runs/replays/recorded_sound.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "osteon/media/film_writer.h"
#include "osteon/session/session.h"

namespace osteon {
namespace {

constexpr std::uint64_t kWarm = kSoundHz / 2;  // samples that are made before a part begins
Result<std::vector<Event>> events_of(RecordingReader& recording) {
  std::vector<Event> events;
  while (true) {
    auto some = recording.read_events(events.size() + 1);
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) break;
    events.insert(events.end(), some->begin(), some->end());
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.tick < b.tick; });
  return events;
}

}  // namespace

Result<RecordedSound> RecordedSound::create(RecordingReader& recording, double from_s) {
  const auto settings = parse_settings(recording.header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  RecordedSound sound;
  sound.recording_ = &recording;
  sound.tick_s_ = settings->haptic.tick_s;
  auto voices = voices_of(settings->tray);
  if (!voices) return tl::unexpected(voices.error());
  sound.voices_ = std::move(*voices);
  auto events = events_of(recording);
  if (!events) return tl::unexpected(events.error());
  sound.events_ = std::move(*events);
  sound.hands_.resize(std::min<std::size_t>(settings->hands.size(), kMaxHands));
  for (std::size_t h = 0; h < sound.hands_.size(); ++h)
    sound.hands_[h].instrument = settings->hands[h].instrument;
  const auto wanted = static_cast<std::uint64_t>(std::llround(std::max(from_s, 0.0) * kSoundHz));
  sound.sample_ = wanted - std::min<std::uint64_t>(wanted, kWarm);
  sound.tick_ = static_cast<std::uint64_t>(
      static_cast<double>(sound.sample_) / kSoundHz / sound.tick_s_ + 1e-6);
  sound.take_events(sound.tick_, false);
  // Motors turn at their speed and what began a little before still sounds.
  std::vector<float> before(static_cast<std::size_t>(wanted - sound.sample_));
  if (auto ok = sound.render(before); !ok) return tl::unexpected(ok.error());
  return sound;
}

void RecordedSound::hear(const Event& event) {
  const std::size_t h = event.hand;
  switch (event.kind) {
    case EventKind::kContactBegin: {
      double speed = 0;
      if (h < hands_.size())
        if (const auto tick = tick_of(h, event.tick); tick && *tick)
          speed = (*tick)->input.v_W.norm();
      return synth_.cue(CueKind::kKnock, knock_strength(speed));
    }
    case EventKind::kInstrumentTaken:
      return synth_.cue(CueKind::kExchange);
    default:
      break;
  }
  if (const auto cue = cue_of(event)) synth_.cue(*cue);
}

// What hands hold and drive follows from the events up to a tick; those before the begin are not
// heard.
void RecordedSound::take_events(std::uint64_t until_tick, bool aloud) {
  for (; next_event_ < events_.size() && events_[next_event_].tick <= until_tick; ++next_event_) {
    const Event& event = events_[next_event_];
    if (aloud) hear(event);
    if (event.kind == EventKind::kMark && event.subject < kMaxMarks)
      for (std::size_t k = 0; k < hands_.size(); ++k)
        marks_[event.subject][k] = {hands_[k].instrument, hands_[k].power};
    if (event.kind == EventKind::kRestored && event.subject < kMaxMarks)
      for (std::size_t k = 0; k < hands_.size(); ++k) {
        std::tie(hands_[k].instrument, hands_[k].power) = marks_[event.subject][k];
        hands_[k].cut = {};
      }
    if (event.hand >= hands_.size()) continue;
    Hand& hand = hands_[event.hand];
    if (event.kind == EventKind::kInstrumentTaken) {
      hand = {event.subject, 0, {}, std::move(hand.ticks)};
    } else if (event.kind == EventKind::kPowered) {
      hand.power = event.values[0];
    } else {
      hand.cut.hear(event);
    }
  }
}

Result<const TickRecord*> RecordedSound::tick_of(std::size_t hand, std::uint64_t tick) {
  std::vector<TickRecord>& ticks = hands_[hand].ticks;
  if (tick < 1 || tick > recording_->ticks(hand)) return nullptr;
  if (ticks.empty() || tick < ticks.front().tick || tick > ticks.back().tick) {
    auto some = recording_->read_ticks(hand, tick);
    if (!some) return tl::unexpected(some.error());
    ticks = std::move(*some);
  }
  // A piece may begin before the tick that was asked for.
  const auto found = std::find_if(ticks.begin(), ticks.end(),
                                  [tick](const TickRecord& t) { return t.tick == tick; });
  return found == ticks.end() ? nullptr : &*found;
}

Result<void> RecordedSound::enter_tick(std::uint64_t tick) {
  tick_ = tick;
  take_events(tick, true);
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const auto record = tick_of(h, tick);
    if (!record) return tl::unexpected(record.error());
    VoiceDrive drive;
    const Hand& hand = hands_[h];
    if (*record && hand.instrument < voices_.size())
      drive = driven(voices_[hand.instrument], hand.power, (*record)->force_W.norm(), hand.cut);
    synth_.drive(h, drive);
  }
  return {};
}

Result<void> RecordedSound::render(std::span<float> out) {
  while (!out.empty()) {
    // Tick n sounds from (n - 1) ticks after the begin on.
    const double at_tick = static_cast<double>(sample_) / kSoundHz / tick_s_;
    const auto now = static_cast<std::uint64_t>(at_tick + 1e-6) + 1;
    if (now != tick_)
      if (auto ok = enter_tick(now); !ok) return ok;
    const double end = std::ceil(static_cast<double>(now) * tick_s_ * kSoundHz - 1e-3);
    const double left = std::max(1.0, end - static_cast<double>(sample_));
    const auto count = std::min<std::size_t>(out.size(), static_cast<std::size_t>(left));
    synth_.render(out.first(count));
    sample_ += count;
    out = out.subspan(count);
  }
  return {};
}

}  // namespace osteon
