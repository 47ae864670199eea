#include "window/controllers/views/sound_control.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "osteon/media/film_writer.h"
#include "runs/hands/instrument_voice.h"

namespace osteon {
namespace {

constexpr double kLongest_s = 0.25;  // of a picture: a window that stood still does not catch up

std::span<const ToolState> tools_in(const FilmMoment& moment) {
  return {moment.tools.data(), moment.hands};
}

}  // namespace

// A device of a sound server may take its time to open.
void SoundControl::open_output() {
  const bool wanted = host_.settings.sound_volume > 0 && host_.order.sound;
  if (wanted && !tried_) {
    tried_ = true;
    opening_ = std::async(std::launch::async, [] { return SoundOutput::open(); });
  }
  if (opening_.valid() && opening_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    auto opened = opening_.get();
    if (opened)
      output_.emplace(std::move(*opened));
    else
      problem_ = opened.error().message();
    if (output_) output_->set_volume(host_.settings.sound_volume);
  }
  if (output_ && output_->lost()) {
    output_.reset();
    problem_ = "The sound device was disconnected.";
  }
}

void SoundControl::begin_scene(const Scene& scene) {
  run_ = scene.run;
  auto voices = voices_of(*scene.tray);
  sound_.begin(voices ? std::move(*voices) : std::vector<VoiceDrive>());
  heard_ = scene.events ? scene.events->events().size() : 0;
  heard_to_s_ = -1;
}

void SoundControl::hear_events(const Scene& scene, double time_s) {
  if (!scene.events) return;
  const auto events = scene.events->events();
  if (scene.replay) {
    const bool follows = heard_to_s_ >= 0 && time_s >= heard_to_s_ && time_s - heard_to_s_ < 0.5;
    for (const RunEvent& event : events)
      if (follows && event.time_s > heard_to_s_ && event.time_s <= time_s) sound_.hear(event.event);
    heard_to_s_ = time_s;
    return;
  }
  if (heard_ > events.size()) heard_ = 0;
  for (; heard_ < events.size(); ++heard_) sound_.hear(events[heard_].event);
}

void SoundControl::update(const Scene& scene, const FilmMoment& moment) {
  open_output();
  const double now_s = host_.now_s;
  if (made_to_s_ < 0 || now_s - made_to_s_ > kLongest_s || now_s < made_to_s_) {
    made_from_s_ = std::max(now_s - kLongest_s / 10, 0.0);
    made_ = 0;
  }
  made_to_s_ = now_s;
  if (scene.tray && run_ != scene.run) begin_scene(scene);
  if (scene.tray) {
    hear_events(scene, moment.time_s);
    sound_.see(tools_in(moment));
  } else {
    sound_.see({});
  }
  const auto wanted = static_cast<std::uint64_t>(std::max(0.0, now_s - made_from_s_) * kSoundHz);
  samples_.resize(static_cast<std::size_t>(wanted - std::min(wanted, made_)));
  made_ = wanted;
  sound_.render(samples_);
  film_.hear(samples_);
  if (output_) output_->play(samples_);
}

void SoundControl::apply(const ViewsRequests& requests) {
  if (!requests.sound_volume) return;
  host_.settings.sound_volume = std::clamp(*requests.sound_volume, 0.0, 1.0);
  if (output_) output_->set_volume(host_.settings.sound_volume);
}

SoundModel SoundControl::model() const { return {host_.settings.sound_volume, problem_}; }

void SoundControl::drop() {
  if (opening_.valid()) opening_.wait();
  output_.reset();
}

}  // namespace osteon
