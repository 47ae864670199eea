#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/command.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What a haptic tick consumed, and what it gave. Written to disk field by field, little-endian;
/// every bit survives, those of a NaN too.
struct TickRecord {
  std::uint64_t tick = 0;
  ToolInput input;
  std::uint64_t bone_step = 0;  ///< physics step whose snapshot the tick consumed
  /// Ticks of the other hands whose tools the tick consumed; 0: none.
  std::array<std::uint64_t, kMaxHands> other_ticks{};
  Command command;              ///< applied at this tick's edge
  Vec3 force_W = Vec3::Zero();  ///< result, for reading without replay
  Vec3 p_WP = Vec3::Zero();     ///< result
  std::uint32_t status = 0;
  std::uint64_t state_hash = 0;  ///< after the tick, every kHashInterval ticks; else 0
};
inline constexpr std::uint64_t kHashInterval = 100;

/// Physics step `step` consumed each hand's tool as its haptic tick `tool_ticks[hand]` left it
/// (0: none yet, or no such hand).
struct StepRecord {
  std::uint64_t step = 0;
  std::array<std::uint64_t, kMaxHands> tool_ticks{};
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
  std::string case_path;           ///< where a case in a folder stood, absolute; empty: built in
  std::uint32_t hands = 1;         ///< at most kMaxHands
  std::uint64_t tray_hash = 0;     ///< over the instruments as they are felt; 0: not known
  std::uint64_t portals_hash = 0;  ///< over the open portals and their skin; 0: not known
  std::string names_json = "{}";   ///< what events speak of, by kind, as the session wrote it
};

/// A session's state in a recording: a replay may begin after it.
struct StoredState {
  std::array<std::uint64_t, kMaxHands> ticks{};  ///< of each hand, done by then
  std::uint64_t step = 0;                        ///< of physics, done by then
  std::string bytes;                             ///< as the session wrote it
};

/// Appends a session to one SQLite file (write-ahead log); samples go in zstd chunks of 0.25 s,
/// each a transaction. After a kill the file opens with all but at most the last 0.5 s. Each hand's
/// ticks and the steps are numbered from 1 without a gap; add a step before the ticks that consumed
/// it. Holds at most four hours. One thread.
class RecordingWriter {
 public:
  /// Refuses to overwrite an existing file.
  static Result<RecordingWriter> create(const std::filesystem::path& file,
                                        const RecordingHeader& header);
  ~RecordingWriter();
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;

  /// Fails (once and for all) when the disk is full or the file has gone; what was saved stays.
  Result<void> add(const TickRecord& record, std::size_t hand = 0);
  Result<void> add(const StepRecord& record);
  /// In any order.
  Result<void> add(const Event& event);
  Result<void> add(const StoredState& state);
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
  std::vector<TickRecord> ticks;                    ///< of the first hand; consecutive from 1
  std::vector<std::vector<TickRecord>> more_hands;  ///< ticks of the others
  std::vector<StepRecord> steps;                    ///< consecutive from 1
  std::vector<Event> events;
  std::vector<StoredState> states;  ///< in the order of their steps
  bool complete = false;

  std::size_t hands() const { return 1 + more_hands.size(); }
  const std::vector<TickRecord>& ticks_of(std::size_t hand) const {
    return hand == 0 ? ticks : more_hands[hand - 1];
  }
  std::vector<TickRecord>& ticks_of(std::size_t hand) {
    return hand == 0 ? ticks : more_hands[hand - 1];
  }
};

/// Checks what can be seen at once of whether a recording can be repeated in one thread: ticks and
/// steps are numbered from 1 without a gap, what each consumed exists and never goes backwards, and
/// no tick consumed a step that itself consumed that tick or a later one. The error names the tick
/// or step.
Result<void> check_consumption(const Recording& recording);

/// Reads a recording piece by piece: memory does not grow with its length. What `load_recording`
/// refuses is refused when its piece is read. Of a recording that was cut short the last ticks may
/// have consumed what was not saved.
class RecordingReader {
 public:
  static Result<RecordingReader> open(const std::filesystem::path& file);
  static Result<RecordingReader> open_memory(std::span<const std::byte> image);
  ~RecordingReader();
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;

  const RecordingHeader& header() const;
  bool complete() const;
  /// In the file, of ticks those of one hand.
  std::uint64_t ticks(std::size_t hand) const;
  std::uint64_t steps() const;
  std::uint64_t events() const;
  std::uint64_t bytes() const;  ///< of all chunks and states

  /// Some records from number `first` on, at least one; none at the end.
  Result<std::vector<TickRecord>> read_ticks(std::size_t hand, std::uint64_t first);
  Result<std::vector<StepRecord>> read_steps(std::uint64_t first);
  /// Some events from the `first`-th on (from 1), at least one; none at the end.
  Result<std::vector<Event>> read_events(std::uint64_t first);
  /// All stored states without their bytes, in the order of their steps.
  Result<std::vector<StoredState>> states();
  Result<std::string> read_state(std::uint64_t step);

 private:
  struct Impl;
  explicit RecordingReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads and checks a whole recording: not a database, another format's version, a damaged chunk, a
/// gap or an index out of range are errors that say what is wrong and where. Inputs that are not
/// finite are data, not errors: a device may have sent them. A recording that was cut short loses
/// its last ticks when they consumed what was not saved. Recovers what a killed writer left in the
/// log beside the file (which tidies that log away); where it may not write there, it reads a copy
/// in the temporary folder.
Result<Recording> load_recording(const std::filesystem::path& file);

/// The same from the bytes of a file that has no log beside it.
Result<Recording> load_recording_from_memory(std::span<const std::byte> image);

}  // namespace osteon
