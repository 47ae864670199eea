#pragma once

#include <cstdint>

#include "osteon/record/recording.h"

namespace osteon {

/// Changes when the tables or the fields of a chunk change.
inline constexpr std::int64_t kFormatVersion = 2;
/// "OSTN" in the database's header: says whose file it is before anything else is read.
inline constexpr std::int64_t kApplicationId = 0x4f53544e;

/// Four hours at 1 kHz: bounds what a loader must hold.
inline constexpr std::uint64_t kMaxTicks = 4ull * 3600 * 1000;

inline constexpr const char* kMetaSchema =
    "CREATE TABLE meta(key TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID";
inline constexpr const char* kTicksSchema =
    "CREATE TABLE ticks(hand INTEGER NOT NULL, first INTEGER NOT NULL, last INTEGER NOT NULL, "
    "count INTEGER NOT NULL, data BLOB NOT NULL, checksum INTEGER NOT NULL, "
    "PRIMARY KEY(hand, first)) WITHOUT ROWID";
inline constexpr const char* kStepsSchema =
    "CREATE TABLE steps(first INTEGER PRIMARY KEY, last INTEGER NOT NULL, count INTEGER NOT NULL, "
    "data BLOB NOT NULL, checksum INTEGER NOT NULL)";
inline constexpr const char* kEventsSchema =
    "CREATE TABLE events(first INTEGER PRIMARY KEY, last INTEGER NOT NULL, count INTEGER NOT NULL, "
    "data BLOB NOT NULL, checksum INTEGER NOT NULL)";
inline constexpr const char* kStatesSchema =
    "CREATE TABLE states(step INTEGER PRIMARY KEY, tick_1 INTEGER NOT NULL, tick_2 INTEGER NOT "
    "NULL, tick_3 INTEGER NOT NULL, tick_4 INTEGER NOT NULL, data BLOB NOT NULL, checksum INTEGER "
    "NOT NULL)";

/// A stored state is no larger than this, unpacked.
inline constexpr std::size_t kMaxStateBytes = std::size_t{1} << 30;

/// Keys of `meta`; the last four are written by finish().
namespace meta_key {
inline constexpr const char* kCaseName = "case_name";
inline constexpr const char* kCaseSource = "case_source";
inline constexpr const char* kCaseHash = "case_hash";  ///< 16 hexadecimal digits
inline constexpr const char* kSeed = "seed";           ///< decimal
inline constexpr const char* kSettings = "settings_json";
inline constexpr const char* kVersion = "osteon_version";
inline constexpr const char* kCasePath = "case_path";        ///< absolute, or empty
inline constexpr const char* kHands = "hands";               ///< decimal
inline constexpr const char* kTrayHash = "tray_hash";        ///< 16 hexadecimal digits
inline constexpr const char* kPortalsHash = "portals_hash";  ///< 16 hexadecimal digits
inline constexpr const char* kNames = "names_json";
inline constexpr const char* kChecksum = "checksum";  ///< of the above; 16 hexadecimal digits
inline constexpr const char* kComplete = "complete";  ///< "1"
inline constexpr const char* kTicks = "ticks";    ///< decimal; of the hands, a blank between two
inline constexpr const char* kEvents = "events";  ///< decimal
inline constexpr const char* kSteps = "steps";    ///< decimal
}  // namespace meta_key

/// Over every field of a header.
std::uint64_t header_checksum(const RecordingHeader& header);

}  // namespace osteon
