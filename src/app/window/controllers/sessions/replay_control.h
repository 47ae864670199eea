#pragma once

#include <optional>
#include <vector>

#include "runs/replays/replay_player.h"
#include "window/controllers/views/scene_sight.h"
#include "window/jobs/load_job.h"

namespace osteon {

struct UiModel;

/// A recording on show.
class ReplayControl {
 public:
  ReplayControl(WindowHost& host, SceneSight& sight) : host_(host), sight_(sight) {}

  /// Null: none is on show.
  const LoadedReplay* replay() const { return replay_ ? &*replay_ : nullptr; }
  bool on() const { return replay_.has_value(); }
  void begin(LoadedReplay replay);
  void end();
  /// Once a picture.
  void advance(double dt_s);
  /// True: the user closes it.
  bool apply(const UiRequests& requests);

  /// Tools of the hands after the first, now.
  std::vector<ToolState> others() const;
  /// Bones as they were carved up to now; null: nothing was.
  CarvedPicture* carved();
  /// What gives way in it, null where nothing does, and what presses that now.
  std::shared_ptr<const SoftSetup> softs() const { return replay_ ? replay_->softs : nullptr; }
  SoftPushes pushes() const;
  void describe(UiModel& model) const;

 private:
  WindowHost& host_;
  SceneSight& sight_;
  std::optional<LoadedReplay> replay_;
  ReplayPlayer player_{0};
  std::vector<float> force_;
  std::optional<CarvedPicture> carved_;
  std::size_t carved_place_ = 0;  ///< of its cuts, that `carved_` shows
};

}  // namespace osteon
