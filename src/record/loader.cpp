#include <charconv>
#include <map>

#include "causality.h"
#include "chunk.h"
#include "database.h"
#include "format.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

constexpr const char* kUseAnother = "The file is damaged: use another copy of it";

Result<std::int64_t> pragma(Database& database, const char* sql) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  const auto row = statement->next();
  if (!row) return tl::unexpected(row.error());
  return *row ? statement->integer(0) : 0;
}

Result<void> check_kind(Database& database) {
  const auto id = pragma(database, "PRAGMA application_id");
  if (!id) return tl::unexpected(id.error());
  const auto version = pragma(database, "PRAGMA user_version");
  if (!version) return tl::unexpected(version.error());
  if (*id != kApplicationId)
    return fail("this is not a recording of Osteon, or one that was stopped before it began",
                database.name(), "Choose an .osr file");
  if (*version != kFormatVersion)
    return fail("the recording has format " + std::to_string(*version) + "; this Osteon reads " +
                    std::to_string(kFormatVersion),
                database.name(), "Open it with the version of Osteon that made it");
  return {};
}

// Our own three tables to the letter: a view, a trigger or a virtual table has no place here.
Result<void> check_schema(Database& database) {
  auto statement = database.prepare("SELECT sql FROM sqlite_schema ORDER BY name");
  if (!statement) return tl::unexpected(statement.error());
  for (const char* expected : {kMetaSchema, kStepsSchema, kTicksSchema}) {
    const auto row = statement->next();
    if (!row) return tl::unexpected(row.error());
    if (!*row || statement->bytes(0) != expected)
      return fail("the recording's tables are not those of its format", database.name(),
                  kUseAnother);
  }
  const auto more = statement->next();
  if (!more) return tl::unexpected(more.error());
  if (*more)
    return fail("the recording holds more tables than its format", database.name(), kUseAnother);
  return {};
}

using Meta = std::map<std::string, std::string, std::less<>>;

Result<Meta> read_meta(Database& database) {
  auto statement = database.prepare("SELECT key, value FROM meta");
  if (!statement) return tl::unexpected(statement.error());
  Meta meta;
  for (;;) {
    const auto row = statement->next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return meta;
    if (!statement->is_text(0) || !statement->is_text(1) || meta.size() >= 64)
      return fail("the header is damaged", database.name(), kUseAnother);
    const std::string key(statement->bytes(0));
    meta[key] = std::string(statement->bytes(1));
  }
}

Result<std::string> text(const Meta& meta, const char* key, const std::string& name) {
  const auto found = meta.find(key);
  if (found == meta.end())
    return fail(std::string("the header lacks '") + key + "'", name, kUseAnother);
  return found->second;
}

Result<std::uint64_t> number(const Meta& meta, const char* key, int base, const std::string& name) {
  const auto digits = text(meta, key, name);
  if (!digits) return tl::unexpected(digits.error());
  std::uint64_t value = 0;
  const char* end = digits->data() + digits->size();
  const auto parsed = std::from_chars(digits->data(), end, value, base);
  if (parsed.ec != std::errc{} || parsed.ptr != end)
    return fail(std::string("the header's '") + key + "' is not a number", name, kUseAnother);
  return value;
}

// Stores what `value` holds, or the first error.
template <class T>
void take(Result<T> value, T& into, Result<void>& done) {
  if (!done) return;
  if (value)
    into = std::move(*value);
  else
    done = tl::unexpected(value.error());
}

Result<RecordingHeader> header_of(const Meta& meta, const std::string& name) {
  RecordingHeader header;
  Result<void> done;
  take(text(meta, meta_key::kCaseName, name), header.case_name, done);
  take(text(meta, meta_key::kCaseSource, name), header.case_source, done);
  take(number(meta, meta_key::kCaseHash, 16, name), header.case_hash, done);
  take(number(meta, meta_key::kSeed, 10, name), header.seed, done);
  take(text(meta, meta_key::kSettings, name), header.settings_json, done);
  take(text(meta, meta_key::kVersion, name), header.osteon_version, done);
  std::uint64_t checksum = 0;
  take(number(meta, meta_key::kChecksum, 16, name), checksum, done);
  if (!done) return tl::unexpected(done.error());
  if (checksum != header_checksum(header))
    return fail("the header is damaged: its checksum is wrong", name, kUseAnother);
  return header;
}

// Reads the row that `statement` stands on; it must follow what `records` holds already.
template <class Record>
Result<void> read_chunk(const Statement& row, std::vector<Record>& records) {
  for (const int column : {0, 1, 2, 4})
    if (!row.is_integer(column)) return fail("a number is missing");
  if (!row.is_blob(3)) return fail("the data are missing");
  const std::uint64_t expected = records.size() + 1;
  const auto first = static_cast<std::uint64_t>(row.integer(0));
  const auto last = static_cast<std::uint64_t>(row.integer(1));
  const auto count = static_cast<std::uint64_t>(row.integer(2));
  if (first != expected)
    return fail("it begins at " + std::to_string(row.integer(0)) + ", but " +
                std::to_string(expected) + " is due");
  if (count == 0 || count > kChunkRecords || last != first + count - 1)
    return fail("its count of records is wrong");
  if (last > kMaxTicks) return fail("a recording holds at most four hours");
  const std::string_view frame = row.bytes(3);
  if (chunk_checksum(frame, first, count) != static_cast<std::uint64_t>(row.integer(4)))
    return fail("its checksum is wrong");
  return decode_chunk(frame, first, count, records);
}

template <class Record>
Result<void> read_chunks(Database& database, const char* kind, std::vector<Record>& records) {
  const std::string sql =
      std::string("SELECT first, last, count, data, checksum FROM ") + kind + " ORDER BY first";
  auto statement = database.prepare(sql.c_str());
  if (!statement) return tl::unexpected(statement.error());
  for (;;) {
    const auto row = statement->next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    const std::size_t due = records.size() + 1;
    if (const auto done = read_chunk(*statement, records); !done)
      return fail("the chunk of " + std::string(kind) + " from " + std::to_string(due) +
                      " is damaged: " + done.error().what,
                  database.name(), kUseAnother);
  }
}

// A finished recording knows how much it must hold; another one ends where its writer was stopped.
Result<void> check_end(const Meta& meta, const std::string& name, Recording& recording) {
  recording.complete = meta.count(meta_key::kComplete) > 0;
  if (!recording.complete) {
    trim_to_saved(recording);
    return {};
  }
  std::uint64_t ticks = 0, steps = 0;
  Result<void> done;
  take(number(meta, meta_key::kTicks, 10, name), ticks, done);
  take(number(meta, meta_key::kSteps, 10, name), steps, done);
  if (done && (ticks != recording.ticks.size() || steps != recording.steps.size()))
    return fail("the recording should hold " + std::to_string(ticks) + " ticks and " +
                    std::to_string(steps) + " steps, but holds " +
                    std::to_string(recording.ticks.size()) + " and " +
                    std::to_string(recording.steps.size()),
                name, kUseAnother);
  return done;
}

Result<Recording> load(Database& database) {
  if (const auto done = check_kind(database); !done) return tl::unexpected(done.error());
  if (const auto done = check_schema(database); !done) return tl::unexpected(done.error());
  const auto meta = read_meta(database);
  if (!meta) return tl::unexpected(meta.error());
  Recording recording;
  Result<void> done;
  take(header_of(*meta, database.name()), recording.header, done);
  if (done) done = read_chunks(database, "ticks", recording.ticks);
  if (done) done = read_chunks(database, "steps", recording.steps);
  if (done) done = check_end(*meta, database.name(), recording);
  if (done) {
    done = check_consumption(recording);
    if (!done) done.error().where = database.name();
  }
  if (!done) return tl::unexpected(done.error());
  return recording;
}

}  // namespace

Result<Recording> load_recording(const std::filesystem::path& file) {
  auto database = Database::open(file);
  if (!database) return tl::unexpected(database.error());
  return load(*database);
}

Result<Recording> load_recording_from_memory(std::span<const std::byte> image) {
  auto database = Database::open_memory(image);
  if (!database) return tl::unexpected(database.error());
  return load(*database);
}

}  // namespace osteon
