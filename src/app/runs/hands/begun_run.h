#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "loops/record_feed.h"
#include "osteon/base/result.h"
#include "osteon/session/session.h"
#include "runs/hands/live_run.h"
#include "runs/pictures/carved_picture.h"

namespace osteon {

/// A live run whose begin was done by another one, which was recorded: its session, its recording
/// and its picture, as far as they have come.
struct BegunRun {
  SessionSettings settings;
  std::unique_ptr<Session> session;
  std::unique_ptr<RecordFeed> feed;
  std::unique_ptr<CarvedPicture> carved;
  std::vector<ToolState> tools;  ///< by hand, after their last ticks
  std::filesystem::path file;    ///< what it is recorded to
};

/// What such a begin is made of.
struct BegunOrder {
  std::filesystem::path begin;  ///< the recording that is repeated
  std::filesystem::path file;   ///< what the run is recorded to
  std::shared_ptr<const Case> the_case;
  std::string case_source;
  RunTray tray;  ///< has the same instruments, and maybe more
  /// Where an instrument of the recording's tray stands in that one; none: it is not there.
  std::function<std::optional<std::uint32_t>(const std::string&)> place;
  /// Before the first tick: the picture of carved bones follows what is repeated.
  std::function<void(const CarvedPicture&)> at_begin;
  /// Sees every hand's tool once all have done a tick, and the bones that it consumed. False: that
  /// is enough.
  std::function<bool(std::span<const ToolState* const>, const BoneSnapshot&)> on_tick;
};

/// Repeats a recording's begin in a session with the tray of a live run, and records it anew. Fails
/// when the recording cannot be read or is of another patient, other soft parts or other
/// instruments, when the new file cannot be written, and when the recording ends before there is
/// enough; then no file is left.
Result<BegunRun> begin_run(const BegunOrder& order);

}  // namespace osteon
