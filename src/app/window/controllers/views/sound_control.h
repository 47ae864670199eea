#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "osteon/media/sound_output.h"
#include "runs/hands/scene_sound.h"
#include "runs/pictures/film_view.h"
#include "runs/reports/run_events.h"
#include "window/controllers/views/film_control.h"
#include "window/controllers/window_host.h"
#include "window/views_model.h"

namespace osteon {

/// What the window sounds like: for the loudspeaker at the volume that the user sets, and for a
/// film of the window as loud as it is.
class SoundControl {
 public:
  SoundControl(WindowHost& host, FilmControl& film) : host_(host), film_(film) {}

  /// What is on show now. `run`: tells one run or replay from the next.
  struct Scene {
    std::pair<std::uint64_t, std::uint64_t> run;
    const std::vector<std::string>* tray = nullptr;  ///< null: nothing is on show
    const RunEvents* events = nullptr;
    bool replay = false;  ///< all its events are known: those of the time passed are heard
  };
  /// Once a picture, before the film takes it.
  void update(const Scene& scene, const FilmMoment& moment);
  void apply(const ViewsRequests& requests);
  SoundModel model() const;
  void drop();

 private:
  void begin_scene(const Scene& scene);
  void hear_events(const Scene& scene, double time_s);
  void open_output();

  WindowHost& host_;
  FilmControl& film_;
  SceneSound sound_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> run_;
  std::size_t heard_ = 0;   ///< of a run's events
  double heard_to_s_ = 0;   ///< of a replay
  double made_to_s_ = -1;   ///< of the window's time; below 0: nothing was made
  std::uint64_t made_ = 0;  ///< samples since `made_from_s_`
  double made_from_s_ = 0;
  std::vector<float> samples_;
  std::future<Result<SoundOutput>> opening_;
  std::optional<SoundOutput> output_;
  std::string problem_;  ///< why nothing is heard; empty: nothing is wrong
  bool tried_ = false;
};

}  // namespace osteon
