#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "osteon/base/result.h"
#include "osteon/record/recording.h"
#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/session/session.h"
#include "runs/cut_history.h"
#include "runs/replay_track.h"
#include "runs/run_events.h"
#include "ui/load_progress.h"

namespace osteon {

/// What to open: a case, or a recording with the case that it was made on.
struct LoadOrder {
  std::string case_spec;             ///< as open_case takes it; not used for a recording
  std::filesystem::path recording;   ///< empty: the case alone
  std::shared_ptr<const Case> open;  ///< a case that is open already, used again when it is the one
  std::vector<std::string> instruments = {};  ///< in the tray whatever the case's region is
};

struct LoadedReplay {
  std::filesystem::path file;
  RecordingHeader header;
  ReplayTrack track;                            ///< of the first hand
  std::vector<ReplayTrack> more;                ///< of the others
  std::vector<std::string> hands;               ///< names, where there are several
  std::vector<std::string> instruments;         ///< names by their place in the tray
  Tray tray;                                    ///< what the hands held
  std::shared_ptr<const CarvingSetup> carving;  ///< what they removed bone with; null: nothing
  CutHistory cuts;
  RunEvents events;
  bool complete = true;  ///< false: the recording ended with a kill
  bool identical = true;
  std::uint64_t first_different_tick = 0;
  std::uint64_t ticks = 0;
};

struct Loaded {
  std::shared_ptr<const Case> the_case;
  std::string case_source;
  std::optional<PreparedCase> prepared;  ///< none: `open` was used again
  ProbePath demo;                        ///< empty when none could be made
  /// For a live run with the case's tray; null: nothing can be carved.
  std::shared_ptr<const CarvingSetup> carving;
  std::string carving_problem;  ///< why nothing can, though a bone is felt as a field; empty: none
  std::optional<LoadedReplay> replay;
};

/// Opens something on a thread of its own, so that the window stays alive.
class LoadJob {
 public:
  explicit LoadJob(LoadOrder order);
  /// Cancels and waits for the thread.
  ~LoadJob();
  LoadJob(const LoadJob&) = delete;
  LoadJob& operator=(const LoadJob&) = delete;

  LoadProgress progress() const;
  bool done() const { return done_.load(std::memory_order_acquire); }
  void cancel() { cancelled_.store(true); }
  /// Once, after `done`.
  Result<Loaded> take();

 private:
  struct Cancelled {};
  Result<Loaded> run();
  Result<void> load_the_recording(Loaded& loaded, Recording& recording);
  Result<void> load_the_case(Loaded& loaded, const std::string& spec, std::uint64_t wanted_hash);
  void prepare_carving(Loaded& loaded);
  Result<void> repeat(Loaded& loaded, const Recording& recording);
  /// Reports where the work is; leaves it by an exception when it was cancelled.
  void say(const char* what, double fraction);
  void set_progress(const char* what, double fraction);

  LoadOrder order_;
  mutable std::mutex mutex_;
  LoadProgress progress_;
  std::int64_t start_ns_ = 0;
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> done_{false};
  Result<Loaded> result_;
  std::thread thread_;
};

}  // namespace osteon
