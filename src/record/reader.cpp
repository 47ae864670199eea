#include <array>
#include <charconv>
#include <optional>

#include "chunk.h"
#include "database.h"
#include "format.h"
#include "osteon/record/recording.h"
#include "recording_meta.h"

namespace osteon {
namespace {

// Of a table's chunks, in its rows: where each kind's numbers stand.
constexpr const char* kTicksFrom =
    "SELECT first, last, count, data, checksum FROM ticks WHERE hand = ? AND first <= ? ORDER BY "
    "first DESC LIMIT 1";
constexpr const char* kStepsFrom =
    "SELECT first, last, count, data, checksum FROM steps WHERE first <= ? ORDER BY first DESC "
    "LIMIT 1";
constexpr const char* kEventsFrom =
    "SELECT first, last, count, data, checksum FROM events WHERE first <= ? ORDER BY first DESC "
    "LIMIT 1";

// Reads the row that `row` stands on. Numbers that cannot be are caught before they are used.
template <class Record>
Result<void> read_chunk(const Statement& row, std::vector<Record>& records) {
  for (const int column : {0, 1, 2, 4})
    if (!row.is_integer(column)) return fail("a number is missing");
  if (!row.is_blob(3)) return fail("the data are missing");
  const auto first = static_cast<std::uint64_t>(row.integer(0));
  const auto last = static_cast<std::uint64_t>(row.integer(1));
  const auto count = static_cast<std::uint64_t>(row.integer(2));
  if (count == 0 || count > kChunkRecords || first == 0 || last != first + count - 1)
    return fail("its count of records is wrong");
  if (last > kMaxTicks) return fail("a recording holds at most four hours");
  const std::string_view frame = row.bytes(3);
  if (chunk_checksum(frame, first, count) != static_cast<std::uint64_t>(row.integer(4)))
    return fail("its checksum is wrong");
  return decode_chunk(frame, first, count, records);
}

}  // namespace

struct RecordingReader::Impl {
  explicit Impl(Database&& d) : database(std::move(d)) {}

  Database database;
  RecordingHeader header;
  bool complete = false;
  std::array<std::uint64_t, kMaxHands> ticks{};
  std::uint64_t steps = 0, events = 0, bytes = 0;
  std::optional<Statement> ticks_from, steps_from, events_from;

  Result<void> open();
  Result<std::uint64_t> whole_number(const std::string& sql);
  Result<std::uint64_t> count_of(const char* table, const std::string& where, const char* kind);
  Result<void> count_all();
  Result<void> check_end(const RecordingMeta& meta);
  template <class Record>
  Result<std::vector<Record>> chunk_with(Statement& statement, std::uint64_t first,
                                         std::uint64_t end, const char* kind);
};

Result<std::uint64_t> RecordingReader::Impl::whole_number(const std::string& sql) {
  auto statement = database.prepare(sql.c_str());
  if (!statement) return tl::unexpected(statement.error());
  const auto row = statement->next();
  if (!row) return tl::unexpected(row.error());
  return *row && statement->is_integer(0) ? static_cast<std::uint64_t>(statement->integer(0)) : 0;
}

// A gap shows in the sum of the counts; where it is, reading would say.
Result<std::uint64_t> RecordingReader::Impl::count_of(const char* table, const std::string& where,
                                                      const char* kind) {
  const auto last = whole_number("SELECT max(last) FROM " + std::string(table) + where);
  if (!last) return tl::unexpected(last.error());
  if (*last > kMaxTicks)
    return fail("a recording holds at most four hours", database.name(), kUseAnother);
  // Each chunk must begin where the one before ends.
  auto statement = database.prepare(
      ("SELECT first, last, count FROM " + std::string(table) + where + " ORDER BY first").c_str());
  if (!statement) return tl::unexpected(statement.error());
  std::int64_t due = 1;
  for (;;) {
    const auto row = statement->next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return static_cast<std::uint64_t>(due - 1);
    bool sound = true;
    for (const int column : {0, 1, 2}) sound = sound && statement->is_integer(column);
    const std::int64_t count = sound ? statement->integer(2) : 0;
    if (count < 1 || count > static_cast<std::int64_t>(kChunkRecords) ||
        statement->integer(0) != due || statement->integer(1) != due + count - 1)
      return fail(
          "the chunk of " + std::string(kind) + " from " + std::to_string(due) +
              " is damaged: it is missing, begins elsewhere, or its count of records is wrong",
          database.name(), kUseAnother);
    due = statement->integer(1) + 1;
  }
}

Result<void> RecordingReader::Impl::count_all() {
  Result<void> done;
  for (std::uint32_t h = 0; h < kMaxHands; ++h)
    take(count_of("ticks", " WHERE hand = " + std::to_string(h), "ticks"), ticks[h], done);
  take(count_of("steps", "", "steps"), steps, done);
  take(count_of("events", "", "events"), events, done);
  std::uint64_t strange = 0;
  take(whole_number("SELECT count(*) FROM ticks WHERE hand < 0 OR hand >= " +
                    std::to_string(header.hands)),
       strange, done);
  if (done && strange > 0)
    return fail("the recording holds ticks of a hand that it does not have", database.name(),
                kUseAnother);
  for (const char* table : {"ticks", "steps", "events", "states"}) {
    std::uint64_t size = 0;
    take(whole_number("SELECT sum(length(data)) FROM " + std::string(table)), size, done);
    bytes += size;
  }
  return done;
}

// A finished recording knows how much it must hold.
Result<void> RecordingReader::Impl::check_end(const RecordingMeta& meta) {
  complete = meta.count(meta_key::kComplete) > 0;
  if (!complete) return {};
  std::string held;
  for (std::uint32_t h = 0; h < header.hands; ++h)
    held += (h > 0 ? " " : "") + std::to_string(ticks[h]);
  const std::string parts[][2] = {{meta_key::kTicks, held},
                                  {meta_key::kSteps, std::to_string(steps)},
                                  {meta_key::kEvents, std::to_string(events)}};
  for (const auto& [key, count] : parts) {
    const auto due = meta_text(meta, key.c_str(), database.name());
    if (!due) return tl::unexpected(due.error());
    if (*due != count)
      return fail("the recording should hold " + *due + " " + key + ", but holds " + count,
                  database.name(), kUseAnother);
  }
  return {};
}

Result<void> RecordingReader::Impl::open() {
  if (auto done = check_format(database); !done) return done;
  const auto meta = read_meta(database);
  if (!meta) return tl::unexpected(meta.error());
  auto read = header_of(*meta, database.name());
  if (!read) return tl::unexpected(read.error());
  header = std::move(*read);
  if (auto done = count_all(); !done) return done;
  if (auto done = check_end(*meta); !done) return done;
  Result<void> done;
  const auto prepare = [&](const char* sql, std::optional<Statement>& into) {
    auto statement = database.prepare(sql);
    if (statement)
      into.emplace(std::move(*statement));
    else if (done)
      done = tl::unexpected(statement.error());
  };
  prepare(kTicksFrom, ticks_from);
  prepare(kStepsFrom, steps_from);
  prepare(kEventsFrom, events_from);
  return done;
}

// The records from `first` to the end of the chunk that holds it.
template <class Record>
Result<std::vector<Record>> RecordingReader::Impl::chunk_with(Statement& statement,
                                                              std::uint64_t first,
                                                              std::uint64_t end, const char* kind) {
  std::vector<Record> records;
  if (first == 0 || first > end) return records;
  const auto row = statement.next();
  if (!row) return tl::unexpected(row.error());
  Result<void> read = *row ? read_chunk(statement, records) : Result<void>(fail("it is missing"));
  const std::uint64_t begin = *row ? static_cast<std::uint64_t>(statement.integer(0)) : first;
  statement.reset();
  if (read && first - begin >= records.size()) read = fail("it ends too early");
  if (!read)
    return fail("the chunk of " + std::string(kind) + " from " + std::to_string(begin) +
                    " is damaged: " + read.error().what,
                database.name(), kUseAnother);
  records.erase(records.begin(), records.begin() + static_cast<std::ptrdiff_t>(first - begin));
  return records;
}

RecordingReader::RecordingReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingReader::~RecordingReader() = default;
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;

Result<RecordingReader> RecordingReader::open(const std::filesystem::path& file) {
  auto database = Database::open(file);
  if (!database) return tl::unexpected(database.error());
  auto impl = std::make_unique<Impl>(std::move(*database));
  if (const auto done = impl->open(); !done) return tl::unexpected(done.error());
  return RecordingReader(std::move(impl));
}

Result<RecordingReader> RecordingReader::open_memory(std::span<const std::byte> image) {
  auto database = Database::open_memory(image);
  if (!database) return tl::unexpected(database.error());
  auto impl = std::make_unique<Impl>(std::move(*database));
  if (const auto done = impl->open(); !done) return tl::unexpected(done.error());
  return RecordingReader(std::move(impl));
}

const RecordingHeader& RecordingReader::header() const { return impl_->header; }
bool RecordingReader::complete() const { return impl_->complete; }
std::uint64_t RecordingReader::ticks(std::size_t hand) const {
  return hand < kMaxHands ? impl_->ticks[hand] : 0;
}
std::uint64_t RecordingReader::steps() const { return impl_->steps; }
std::uint64_t RecordingReader::events() const { return impl_->events; }
std::uint64_t RecordingReader::bytes() const { return impl_->bytes; }

Result<std::vector<TickRecord>> RecordingReader::read_ticks(std::size_t hand, std::uint64_t first) {
  Statement& statement = *impl_->ticks_from;
  statement.bind(1, static_cast<std::int64_t>(hand));
  statement.bind(2, static_cast<std::int64_t>(first));
  return impl_->chunk_with<TickRecord>(statement, first, ticks(hand), "ticks");
}

Result<std::vector<StepRecord>> RecordingReader::read_steps(std::uint64_t first) {
  impl_->steps_from->bind(1, static_cast<std::int64_t>(first));
  return impl_->chunk_with<StepRecord>(*impl_->steps_from, first, steps(), "steps");
}

Result<std::vector<Event>> RecordingReader::read_events(std::uint64_t first) {
  impl_->events_from->bind(1, static_cast<std::int64_t>(first));
  return impl_->chunk_with<Event>(*impl_->events_from, first, events(), "events");
}

Result<std::vector<StoredState>> RecordingReader::states() {
  auto statement = impl_->database.prepare(
      "SELECT step, tick_1, tick_2, tick_3, tick_4 FROM states ORDER BY "
      "step");
  if (!statement) return tl::unexpected(statement.error());
  std::vector<StoredState> states;
  for (;;) {
    const auto row = statement->next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return states;
    StoredState state;
    state.step = static_cast<std::uint64_t>(statement->integer(0));
    for (int h = 0; h < static_cast<int>(kMaxHands); ++h)
      state.ticks[static_cast<std::size_t>(h)] =
          static_cast<std::uint64_t>(statement->integer(1 + h));
    states.push_back(std::move(state));
  }
}

Result<std::string> RecordingReader::read_state(std::uint64_t step) {
  auto statement = impl_->database.prepare("SELECT data, checksum FROM states WHERE step = ?");
  if (!statement) return tl::unexpected(statement.error());
  statement->bind(1, static_cast<std::int64_t>(step));
  const auto row = statement->next();
  if (!row) return tl::unexpected(row.error());
  const auto damaged = [&](const std::string& why) {
    return fail("the stored state of step " + std::to_string(step) + " is damaged: " + why,
                impl_->database.name(), kUseAnother);
  };
  if (!*row || !statement->is_blob(0) || !statement->is_integer(1)) return damaged("it is missing");
  const std::string_view frame = statement->bytes(0);
  if (chunk_checksum(frame, step, 1) != static_cast<std::uint64_t>(statement->integer(1)))
    return damaged("its checksum is wrong");
  auto bytes = unpack_bytes(frame, kMaxStateBytes);
  if (!bytes) return damaged(bytes.error().what);
  return bytes;
}

}  // namespace osteon
