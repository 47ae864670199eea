#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/command.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What a haptic tick consumed, and what it gave. Written to disk field by field, little-endian;
/// every bit survives, those of a NaN too.
struct TickRecord {
  std::uint64_t tick = 0;
  ToolInput input;
  std::uint64_t bone_step = 0;  ///< physics step whose snapshot the tick consumed
  Command command;              ///< applied at this tick's edge
  Vec3 force_W = Vec3::Zero();  ///< result, for reading without replay
  Vec3 p_WP = Vec3::Zero();     ///< result
  std::uint32_t status = 0;
  std::uint64_t state_hash = 0;  ///< after the tick, every kHashInterval ticks; else 0
};
inline constexpr std::uint64_t kHashInterval = 100;

/// Physics step `step` consumed the tool's state of haptic tick `tool_tick` (0: none yet).
struct StepRecord {
  std::uint64_t step = 0;
  std::uint64_t tool_tick = 0;
  Command command;  ///< applied at this step's edge
};

/// What a replay must know beside the inputs.
struct RecordingHeader {
  std::string case_name;
  std::string case_source;  ///< "builtin:wrist" or the folder it was loaded from
  std::uint64_t case_hash = 0;
  std::uint64_t seed = 0;
  std::string settings_json;  ///< session settings, as the session wrote them
  std::string osteon_version;
};

/// Appends a session to one SQLite file (write-ahead log); samples go in zstd chunks of 0.25 s,
/// each a transaction. After a kill the file opens with all but at most the last 0.5 s. Ticks and
/// steps are numbered from 1 without a gap; add a step before the ticks that consumed it. Holds at
/// most four hours. One thread.
class RecordingWriter {
 public:
  /// Refuses to overwrite an existing file.
  static Result<RecordingWriter> create(const std::filesystem::path& file,
                                        const RecordingHeader& header);
  ~RecordingWriter();
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;

  /// Fails (once and for all) when the disk is full or the file has gone; what was saved stays.
  Result<void> add(const TickRecord& record);
  Result<void> add(const StepRecord& record);
  /// Writes what is pending and marks the recording as complete.
  Result<void> finish();

 private:
  struct Impl;
  explicit RecordingWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A recording in memory. `complete` is false after a kill.
struct Recording {
  RecordingHeader header;
  std::vector<TickRecord> ticks;  ///< consecutive from 1
  std::vector<StepRecord> steps;  ///< consecutive from 1
  bool complete = false;
};

/// Checks that a recording can be repeated in one thread: ticks and steps are numbered from 1
/// without a gap, what each consumed exists and never goes backwards, and no tick consumed a step
/// that itself consumed that tick or a later one. The error names the tick or step.
Result<void> check_consumption(const Recording& recording);

/// Reads and checks a recording: not a database, another format's version, a damaged chunk, a gap
/// or an index out of range are errors that say what is wrong and where. Inputs that are not finite
/// are data, not errors: a device may have sent them. A recording that was cut short loses its last
/// ticks when they consumed a physics step that was not saved. Recovers what a killed writer left
/// in the log beside the file (which tidies that log away); where it may not write there, it reads
/// a copy in the temporary folder.
Result<Recording> load_recording(const std::filesystem::path& file);

/// The same from the bytes of a file that has no log beside it.
Result<Recording> load_recording_from_memory(std::span<const std::byte> image);

}  // namespace osteon
