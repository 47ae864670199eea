#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "chunk.h"
#include "database.h"
#include "format.h"
#include "new_file.h"
#include "osteon/record/recording.h"
#include "recording_meta.h"

namespace osteon {
namespace {

std::string hex(std::uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

Result<void> put_meta(Database& database, const char* key, const std::string& value) {
  auto statement = database.prepare("INSERT INTO meta(key, value) VALUES(?, ?)");
  if (!statement) return tl::unexpected(statement.error());
  statement->bind_text(1, key);
  statement->bind_text(2, value);
  return statement->run();
}

Result<void> put_header(Database& database, const RecordingHeader& header) {
  const std::pair<const char*, std::string> rows[] = {
      {meta_key::kCaseName, header.case_name},
      {meta_key::kCaseSource, header.case_source},
      {meta_key::kCaseHash, hex(header.case_hash)},
      {meta_key::kSeed, std::to_string(header.seed)},
      {meta_key::kSettings, header.settings_json},
      {meta_key::kVersion, header.osteon_version},
      {meta_key::kCasePath, header.case_path},
      {meta_key::kHands, std::to_string(header.hands)},
      {meta_key::kTrayHash, hex(header.tray_hash)},
      {meta_key::kPortalsHash, hex(header.portals_hash)},
      {meta_key::kNames, header.names_json},
      {meta_key::kChecksum, hex(header_checksum(header))}};
  for (const auto& [key, value] : rows)
    if (const auto done = put_meta(database, key, value); !done) return done;
  return {};
}

// A chunk fills whole pages of the file: of small ones less is left empty. Any version reads them.
Result<void> write_header(Database& database, const RecordingHeader& header) {
  if (const auto done = database.run("PRAGMA page_size=1024; PRAGMA journal_mode=WAL; BEGIN;");
      !done)
    return done;
  if (const auto done = make_tables(database); !done) return done;
  if (const auto done = put_header(database, header); !done) return done;
  return database.run("COMMIT");
}

// A whole recording of nothing. Made under another name: a kill before the header is on the disk
// leaves no recording rather than a broken one.
Result<void> make_file(const std::filesystem::path& file, const RecordingHeader& header) {
  const std::filesystem::path part = unfinished_name(file);
  std::error_code ignored;
  std::filesystem::remove(part, ignored);  // of a program that was killed in this very moment
  Result<void> done;
  {
    auto database = Database::create(part);
    if (!database) return tl::unexpected(database.error());
    done = write_header(*database, header);
  }
  if (!done) std::filesystem::remove(part, ignored);
  return done ? name_new_file(file) : done;
}

}  // namespace

struct RecordingWriter::Impl {
  explicit Impl(Database&& d) : database(std::move(d)) {}

  Database database;
  std::optional<Statement> insert_ticks, insert_steps, insert_events, insert_state;
  std::uint32_t hands = 1;
  std::array<std::vector<TickRecord>, kMaxHands> ticks;  // pending
  std::vector<StepRecord> steps;                         // pending
  std::vector<Event> events;                             // pending
  std::vector<StoredState> states;                       // pending
  std::array<std::uint64_t, kMaxHands> next_tick{1, 1, 1, 1};
  std::uint64_t next_step = 1, next_event = 1, next_state = 0;
  std::optional<Error> failure;  // the first; nothing is written after it
  bool finished = false;

  Result<void> open_log();
  Result<void> prepare();
  Result<void> keep_failure(Result<void> result);
  Result<void> check_next(std::uint64_t number, std::uint64_t expected, const char* kind);
  Result<void> flush();
  Result<void> flush_pending();
  Result<void> close_log();
  /// `hand`: of ticks; below 0: the table has no such column.
  template <class Record>
  Result<void> put_chunks(Statement& insert, std::vector<Record>& pending, std::uint64_t next,
                          int hand = -1);
  Result<void> put_state(const StoredState& state);
  Result<void> usable();
  void forget_pending();
  std::string tick_counts() const;
};

Result<void> RecordingWriter::Impl::open_log() {
  // NORMAL: a kill loses nothing that was committed; a power cut may lose the newest chunks but
  // never the file.
  if (const auto done = database.run("PRAGMA synchronous=NORMAL;"); !done) return done;
  return prepare();
}

Result<void> RecordingWriter::Impl::prepare() {
  const std::pair<const char*, std::optional<Statement>*> inserts[] = {
      {"INSERT INTO ticks VALUES(?, ?, ?, ?, ?, ?)", &insert_ticks},
      {"INSERT INTO steps VALUES(?, ?, ?, ?, ?)", &insert_steps},
      {"INSERT INTO events VALUES(?, ?, ?, ?, ?)", &insert_events},
      {"INSERT INTO states VALUES(?, ?, ?, ?, ?, ?, ?)", &insert_state}};
  for (const auto& [sql, into] : inserts) {
    auto statement = database.prepare(sql);
    if (!statement) return tl::unexpected(statement.error());
    into->emplace(std::move(*statement));
  }
  for (auto& pending : ticks) pending.reserve(kChunkRecords);
  steps.reserve(kChunkRecords);
  return {};
}

Result<void> RecordingWriter::Impl::keep_failure(Result<void> result) {
  if (!result && !failure) failure = result.error();
  return result;
}

Result<void> RecordingWriter::Impl::usable() {
  if (failure) return tl::unexpected(*failure);
  if (finished) return keep_failure(fail("the recording is already finished", database.name()));
  return {};
}

Result<void> RecordingWriter::Impl::check_next(std::uint64_t number, std::uint64_t expected,
                                               const char* kind) {
  if (const auto open = usable(); !open) return open;
  if (number > kMaxTicks)
    return keep_failure(fail("a recording holds at most four hours", database.name(),
                             "Finish it and start another"));
  if (number != expected)
    return keep_failure(fail(std::string(kind) + " " + std::to_string(number) + " came where " +
                                 std::to_string(expected) + " was due",
                             database.name(), "This is a fault of Osteon: please report it"));
  return {};
}

// All pending records of a kind, as chunks. `next` is the number after the last of them.
template <class Record>
Result<void> RecordingWriter::Impl::put_chunks(Statement& insert, std::vector<Record>& pending,
                                               std::uint64_t next, int hand) {
  const int offset = hand < 0 ? 0 : 1;
  for (std::size_t at = 0; at < pending.size(); at += kChunkRecords) {
    const std::size_t count = std::min(kChunkRecords, pending.size() - at);
    const std::uint64_t first = next - pending.size() + at;
    const std::string frame = encode_chunk(std::span<const Record>(pending).subspan(at, count));
    if (hand >= 0) insert.bind(1, hand);
    insert.bind(offset + 1, static_cast<std::int64_t>(first));
    insert.bind(offset + 2, static_cast<std::int64_t>(first + count - 1));
    insert.bind(offset + 3, static_cast<std::int64_t>(count));
    insert.bind_blob(offset + 4, frame);
    insert.bind(offset + 5, static_cast<std::int64_t>(chunk_checksum(frame, first, count)));
    if (const auto done = insert.run(); !done) return done;
  }
  return {};
}

Result<void> RecordingWriter::Impl::put_state(const StoredState& state) {
  const std::string frame = pack_bytes(state.bytes);
  insert_state->bind(1, static_cast<std::int64_t>(state.step));
  for (int h = 0; h < static_cast<int>(kMaxHands); ++h)
    insert_state->bind(2 + h, static_cast<std::int64_t>(state.ticks[static_cast<std::size_t>(h)]));
  insert_state->bind_blob(6, frame);
  insert_state->bind(7, static_cast<std::int64_t>(chunk_checksum(frame, state.step, 1)));
  return insert_state->run();
}

// Ticks and steps together, so that what a tick consumed is saved with it.
Result<void> RecordingWriter::Impl::flush_pending() {
  if (database.has_moved())
    return fail("the recording's file has been moved or deleted", database.name(),
                "Start a new recording");
  if (const auto done = database.run("BEGIN IMMEDIATE"); !done) return done;
  for (std::uint32_t h = 0; h < hands; ++h)
    if (const auto done = put_chunks(*insert_ticks, ticks[h], next_tick[h], static_cast<int>(h));
        !done)
      return done;
  if (const auto done = put_chunks(*insert_steps, steps, next_step); !done) return done;
  if (const auto done = put_chunks(*insert_events, events, next_event); !done) return done;
  for (const StoredState& state : states)
    if (const auto done = put_state(state); !done) return done;
  return {};
}

Result<void> RecordingWriter::Impl::flush() {
  Result<void> done = flush_pending();
  if (done) done = database.run("COMMIT");
  if (!done) {
    (void)database.run("ROLLBACK");  // fails when SQLite has rolled back by itself
    return keep_failure(std::move(done));
  }
  forget_pending();
  return {};
}

void RecordingWriter::Impl::forget_pending() {
  for (auto& pending : ticks) pending.clear();
  steps.clear();
  events.clear();
  states.clear();
}

// One plain file that opens anywhere, a write-protected folder too.
Result<void> RecordingWriter::Impl::close_log() {
  for (auto* insert : {&insert_ticks, &insert_steps, &insert_events, &insert_state})
    insert->reset();
  return database.run("PRAGMA journal_mode=DELETE");
}

RecordingWriter::RecordingWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;

// Without finish (an error elsewhere) what is pending is still worth keeping.
RecordingWriter::~RecordingWriter() {
  if (impl_ && !impl_->finished && !impl_->failure) (void)impl_->flush();
}

Result<RecordingWriter> RecordingWriter::create(const std::filesystem::path& file,
                                                const RecordingHeader& header) {
  if (const auto made = make_file(file, header); !made) return tl::unexpected(made.error());
  auto database = Database::reopen(file);
  if (!database) return tl::unexpected(database.error());
  auto impl = std::make_unique<Impl>(std::move(*database));
  impl->hands = header.hands;
  if (const auto done = impl->open_log(); !done) {
    impl->failure = done.error();
    return tl::unexpected(done.error());
  }
  return RecordingWriter(std::move(impl));
}

Result<void> RecordingWriter::add(const TickRecord& record, std::size_t hand) {
  Impl& w = *impl_;
  if (hand >= w.hands)
    return w.keep_failure(fail("a tick of a hand that the recording does not have",
                               w.database.name(), "This is a fault of Osteon: please report it"));
  if (const auto due = w.check_next(record.tick, w.next_tick[hand], "tick"); !due) return due;
  ++w.next_tick[hand];
  w.ticks[hand].push_back(record);
  return w.ticks[hand].size() < kChunkRecords ? Result<void>{} : w.flush();
}

Result<void> RecordingWriter::add(const StepRecord& record) {
  Impl& w = *impl_;
  if (const auto due = w.check_next(record.step, w.next_step, "step"); !due) return due;
  ++w.next_step;
  w.steps.push_back(record);
  return w.steps.size() < kChunkRecords ? Result<void>{} : w.flush();
}

Result<void> RecordingWriter::add(const Event& event) {
  Impl& w = *impl_;
  if (const auto open = w.usable(); !open) return open;
  if (w.next_event > kMaxTicks) return {};  // no one reads so many
  ++w.next_event;
  w.events.push_back(event);
  return {};
}

Result<void> RecordingWriter::add(const StoredState& state) {
  Impl& w = *impl_;
  if (const auto open = w.usable(); !open) return open;
  if (state.step < w.next_state) return {};
  w.next_state = state.step + 1;
  w.states.push_back(state);
  return {};
}

std::string RecordingWriter::Impl::tick_counts() const {
  std::string text;
  for (std::uint32_t h = 0; h < hands; ++h)
    text += (h > 0 ? " " : "") + std::to_string(next_tick[h] - 1);
  return text;
}

Result<void> RecordingWriter::finish() {
  Impl& w = *impl_;
  if (w.failure) return tl::unexpected(*w.failure);
  if (w.finished) return {};
  Result<void> done = w.flush_pending();
  const std::pair<const char*, std::string> rows[] = {
      {meta_key::kComplete, "1"},
      {meta_key::kTicks, w.tick_counts()},
      {meta_key::kSteps, std::to_string(w.next_step - 1)},
      {meta_key::kEvents, std::to_string(w.next_event - 1)}};
  for (const auto& [key, value] : rows)
    if (done) done = put_meta(w.database, key, value);
  if (done) done = w.database.run("COMMIT");
  if (done) done = w.close_log();
  if (!done) return w.keep_failure(std::move(done));
  w.finished = true;
  w.forget_pending();
  return {};
}

}  // namespace osteon
