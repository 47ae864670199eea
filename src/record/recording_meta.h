#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "database.h"
#include "osteon/record/recording.h"

namespace osteon {

inline constexpr const char* kUseAnother = "The file is damaged: use another copy of it";

/// The table `meta`.
using RecordingMeta = std::map<std::string, std::string, std::less<>>;

/// Makes the tables of this format in an empty database.
Result<void> make_tables(Database& database);
/// Whether it is a recording of this format, with its tables to the letter.
Result<void> check_format(Database& database);
Result<RecordingMeta> read_meta(Database& database);
Result<RecordingHeader> header_of(const RecordingMeta& meta, const std::string& name);

Result<std::string> meta_text(const RecordingMeta& meta, const char* key, const std::string& name);
Result<std::uint64_t> meta_number(const RecordingMeta& meta, const char* key, int base,
                                  const std::string& name);

/// Stores what `value` holds, or the first error.
template <class T>
void take(Result<T> value, T& into, Result<void>& done) {
  if (!done) return;
  if (value)
    into = std::move(*value);
  else
    done = tl::unexpected(value.error());
}

}  // namespace osteon
