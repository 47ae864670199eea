#include "recording_meta.h"

#include <charconv>

#include "format.h"

namespace osteon {
namespace {

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
                database.name(),
                "Open it with the version of Osteon that made it, or record the run again");
  return {};
}

// Our own five tables to the letter: a view, a trigger or a virtual table has no place here.
Result<void> check_schema(Database& database) {
  auto statement =
      database.prepare("SELECT sql FROM sqlite_schema WHERE sql NOT NULL ORDER BY name");
  if (!statement) return tl::unexpected(statement.error());
  for (const char* expected :
       {kEventsSchema, kMetaSchema, kStatesSchema, kStepsSchema, kTicksSchema}) {
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

}  // namespace

Result<void> check_format(Database& database) {
  if (auto done = check_kind(database); !done) return done;
  return check_schema(database);
}

Result<void> make_tables(Database& database) {
  const std::string marks = "PRAGMA application_id=" + std::to_string(kApplicationId) +
                            "; PRAGMA user_version=" + std::to_string(kFormatVersion) + ";";
  const std::string tables = std::string(kMetaSchema) + ";" + kTicksSchema + ";" + kStepsSchema +
                             ";" + kEventsSchema + ";" + kStatesSchema + ";";
  return database.run((marks + tables).c_str());
}

Result<RecordingMeta> read_meta(Database& database) {
  auto statement = database.prepare("SELECT key, value FROM meta");
  if (!statement) return tl::unexpected(statement.error());
  RecordingMeta meta;
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

Result<std::string> meta_text(const RecordingMeta& meta, const char* key, const std::string& name) {
  const auto found = meta.find(key);
  if (found == meta.end())
    return fail(std::string("the header lacks '") + key + "'", name, kUseAnother);
  return found->second;
}

Result<std::uint64_t> meta_number(const RecordingMeta& meta, const char* key, int base,
                                  const std::string& name) {
  const auto digits = meta_text(meta, key, name);
  if (!digits) return tl::unexpected(digits.error());
  std::uint64_t value = 0;
  const char* end = digits->data() + digits->size();
  const auto parsed = std::from_chars(digits->data(), end, value, base);
  if (parsed.ec != std::errc{} || parsed.ptr != end)
    return fail(std::string("the header's '") + key + "' is not a number", name, kUseAnother);
  return value;
}

static Result<std::uint32_t> hands_of(const RecordingMeta& meta, const std::string& name) {
  const auto hands = meta_number(meta, meta_key::kHands, 10, name);
  if (!hands) return tl::unexpected(hands.error());
  if (*hands < 1 || *hands > kMaxHands)
    return fail("the header's count of hands is impossible", name, kUseAnother);
  return static_cast<std::uint32_t>(*hands);
}

Result<RecordingHeader> header_of(const RecordingMeta& meta, const std::string& name) {
  RecordingHeader header;
  Result<void> done;
  take(meta_text(meta, meta_key::kCaseName, name), header.case_name, done);
  take(meta_text(meta, meta_key::kCaseSource, name), header.case_source, done);
  take(meta_number(meta, meta_key::kCaseHash, 16, name), header.case_hash, done);
  take(meta_number(meta, meta_key::kSeed, 10, name), header.seed, done);
  take(meta_text(meta, meta_key::kSettings, name), header.settings_json, done);
  take(meta_text(meta, meta_key::kVersion, name), header.osteon_version, done);
  take(meta_text(meta, meta_key::kCasePath, name), header.case_path, done);
  take(hands_of(meta, name), header.hands, done);
  take(meta_number(meta, meta_key::kTrayHash, 16, name), header.tray_hash, done);
  take(meta_number(meta, meta_key::kPortalsHash, 16, name), header.portals_hash, done);
  take(meta_text(meta, meta_key::kNames, name), header.names_json, done);
  std::uint64_t checksum = 0;
  take(meta_number(meta, meta_key::kChecksum, 16, name), checksum, done);
  if (!done) return tl::unexpected(done.error());
  if (checksum != header_checksum(header))
    return fail("the header is damaged: its checksum is wrong", name, kUseAnother);
  return header;
}

}  // namespace osteon
