#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "runs/replays/replay_track.h"
#include "ui/side_job.h"
#include "window/jobs/load_job.h"

namespace osteon {

/// What lies between two stored states of a recording.
struct ReplayStretch {
  std::array<std::uint64_t, kMaxHands> after{};  ///< ticks of each hand up to here are not its own
  std::array<std::uint64_t, kMaxHands> last{};   ///< nor those past here
  double begin_s = 0, end_s = 0;                 ///< of the first hand
};

/// What a stretch gave when it was repeated.
struct RepeatedStretch {
  std::vector<ReplayTrack> tracks;  ///< of each hand
  bool identical = true;
  std::uint64_t first_different_tick = 0;
  std::uint64_t ticks = 0;  ///< of the first hand
};

/// A long recording repeated stretch by stretch, each from the stored state that it begins with:
/// the one that the user looks at first, the others after it, beside the window. Only for
/// recordings without what must be followed from the start (carved bone, soft parts).
class ReplayFilling {
 public:
  /// `how` has the recording's tray. Null: the recording has too few stored states to gain by it.
  static Result<std::shared_ptr<ReplayFilling>> plan(const std::filesystem::path& file,
                                                     std::shared_ptr<const Case> the_case,
                                                     const ReplayOptions& how);
  /// The whole length, of the first hand.
  double duration_s() const { return stretches_.back().end_s; }
  /// Repeats the stretch about that time now, if that is not done, and adds it.
  Result<void> fill_at(double time_s, LoadedReplay& into, const Progress& progress);
  /// At each picture: adds what is ready, and begins the stretch about `time_s` or, once that is
  /// there, the next one that is missing. The error of a stretch that cannot be repeated ends it.
  Result<void> poll(double time_s, LoadedReplay& into);
  /// Returns when the stretch under way can be added.
  void wait() const {
    if (job_) job_->wait();
  }
  bool whole() const { return filled_ == stretches_.size(); }
  double share() const {
    return static_cast<double>(filled_) / static_cast<double>(stretches_.size());
  }

 private:
  ReplayFilling() = default;
  std::size_t index_at(double time_s) const;
  SideJob<RepeatedStretch>::Work work_for(std::size_t index) const;
  void add(std::size_t index, const RepeatedStretch& repeated, LoadedReplay& into);

  std::filesystem::path file_;
  std::shared_ptr<const Case> case_;
  ReplayOptions how_;
  std::size_t hands_ = 1;
  std::vector<ReplayStretch> stretches_;
  std::vector<bool> done_;
  std::size_t filled_ = 0;
  std::size_t under_way_ = 0;  ///< of the job
  bool over_ = false;          ///< one failed
  std::unique_ptr<SideJob<RepeatedStretch>> job_;
};

}  // namespace osteon
