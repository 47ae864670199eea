#include <sqlite3.h>

#include <filesystem>
#include <utility>

#include "backend.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr int kStoreId = 0x4f535252;  // "OSRR"
constexpr int kStoreFormat = 1;
constexpr const char* kSchema =
    "CREATE TABLE IF NOT EXISTS attempts("
    "seq INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL UNIQUE, learner TEXT NOT NULL,"
    "scenario TEXT NOT NULL, scenario_version INTEGER NOT NULL, standard_version INTEGER NOT NULL,"
    "verdict TEXT NOT NULL, score REAL, score_lo REAL, score_hi REAL, ended_ms INTEGER NOT NULL,"
    "duration_s REAL NOT NULL, case_name TEXT NOT NULL, state_hash TEXT NOT NULL,"
    "report TEXT NOT NULL);"
    "CREATE INDEX IF NOT EXISTS attempts_learner ON attempts(learner, scenario);";
// Beside the attempts, so that a file of an older program gains it too.
constexpr const char* kSendings =
    "CREATE TABLE IF NOT EXISTS sendings(id TEXT NOT NULL, endpoint TEXT NOT NULL,"
    "refusal TEXT NOT NULL, PRIMARY KEY(id, endpoint));";
constexpr const char* kColumns =
    "id, learner, scenario, scenario_version, standard_version, verdict, score, score_lo, "
    "score_hi, ended_ms, duration_s, case_name, state_hash, report";

Error store_error(sqlite3* db, const fs::path& file) {
  const int code = db ? sqlite3_errcode(db) : SQLITE_NOMEM;
  Error error{std::string("the results cannot be used (") + sqlite3_errstr(code) + ")",
              file.string(), ""};
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED)
    error = {"another program has locked the results", file.string(),
             "Close it or try again; nothing was changed"};
  if (code == SQLITE_FULL)
    error = {"the disk is full", file.string(), "Free some space; nothing was changed"};
  if (code == SQLITE_READONLY || code == SQLITE_CANTOPEN || code == SQLITE_PERM)
    error = {"the results cannot be written", file.string(), "Check the folder's permissions"};
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
    error = {"is not a results file, or is damaged", file.string(),
             "Move it away; a new one will be made"};
  return error;
}

// A prepared statement that ends with its scope.
class ResultStatement {
 public:
  ResultStatement(sqlite3* db, const std::string& sql) {
    sqlite3_prepare_v2(db, sql.c_str(), -1, &handle_, nullptr);
  }
  ResultStatement(const ResultStatement&) = delete;
  ResultStatement& operator=(const ResultStatement&) = delete;
  ~ResultStatement() { sqlite3_finalize(handle_); }
  bool ready() const { return handle_ != nullptr; }
  int step() { return handle_ ? sqlite3_step(handle_) : SQLITE_ERROR; }
  void bind(int i, const std::string& text) {
    sqlite3_bind_text(handle_, i, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void bind(int i, std::int64_t value) { sqlite3_bind_int64(handle_, i, value); }
  void bind(int i, double value) { sqlite3_bind_double(handle_, i, value); }
  void bind(int i, const std::optional<double>& value) {
    if (value) bind(i, *value);
  }
  std::string text(int i) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, i));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_, i));
    return bytes ? std::string(bytes, size) : std::string();
  }
  std::int64_t whole(int i) const { return sqlite3_column_int64(handle_, i); }
  double number(int i) const { return sqlite3_column_double(handle_, i); }
  std::optional<double> number_or_none(int i) const {
    if (sqlite3_column_type(handle_, i) == SQLITE_NULL) return std::nullopt;
    return number(i);
  }

 private:
  sqlite3_stmt* handle_ = nullptr;
};

AttemptRow row_of(const ResultStatement& s) {
  AttemptRow row;
  row.id = s.text(0);
  row.learner = s.text(1);
  row.scenario = s.text(2);
  row.scenario_version = static_cast<int>(s.whole(3));
  row.standard_version = static_cast<int>(s.whole(4));
  row.verdict = s.text(5);
  row.score = s.number_or_none(6);
  row.score_lo = s.number_or_none(7);
  row.score_hi = s.number_or_none(8);
  row.ended_ms = s.whole(9);
  row.duration_s = s.number(10);
  row.case_name = s.text(11);
  row.state_hash = s.text(12);
  row.report_json = s.text(13);
  return row;
}

void bind_row(ResultStatement& s, const AttemptRow& row) {
  s.bind(1, row.id);
  s.bind(2, row.learner);
  s.bind(3, row.scenario);
  s.bind(4, static_cast<std::int64_t>(row.scenario_version));
  s.bind(5, static_cast<std::int64_t>(row.standard_version));
  s.bind(6, row.verdict);
  s.bind(7, row.score);
  s.bind(8, row.score_lo);
  s.bind(9, row.score_hi);
  s.bind(10, row.ended_ms);
  s.bind(11, row.duration_s);
  s.bind(12, row.case_name);
  s.bind(13, row.state_hash);
  s.bind(14, row.report_json);
}

class SqliteStore final : public ResultBackend {
 public:
  ~SqliteStore() override { sqlite3_close(db); }
  Result<bool> add(const AttemptRow& row) override;
  Result<std::vector<AttemptRow>> list(const AttemptFilter& filter) override;
  Result<std::optional<AttemptRow>> find(const std::string& id) override;
  Result<int> forget(const std::string& learner) override;
  Result<void> mark(const Sending& sending) override;
  Result<std::vector<Sending>> sendings(const std::string& endpoint) override;

  sqlite3* db = nullptr;
  fs::path file;

  Result<void> run(const char* sql) const {
    if (sqlite3_exec(db, sql, nullptr, nullptr, nullptr) == SQLITE_OK) return {};
    return tl::unexpected(store_error(db, file));
  }
  Result<std::int64_t> pragma(const char* name) const {
    ResultStatement s(db, std::string("PRAGMA ") + name);
    if (s.step() != SQLITE_ROW) return tl::unexpected(store_error(db, file));
    return s.whole(0);
  }
  // Runs `work` as one transaction: all of it or nothing.
  template <class Work>
  auto transaction(Work work) const -> decltype(work()) {
    if (auto begun = run("BEGIN IMMEDIATE"); !begun) return tl::unexpected(begun.error());
    auto done = work();
    if (done)
      if (auto ended = run("COMMIT"); !ended) done = tl::unexpected(ended.error());
    if (!done) sqlite3_exec(db, "ROLLBACK", nullptr, nullptr, nullptr);
    return done;
  }
  Result<void> make() const {
    if (auto ok = run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA secure_delete=ON");
        !ok)
      return ok;
    const auto version = pragma("user_version");
    if (!version) return tl::unexpected(version.error());
    const auto id = pragma("application_id");
    if (!id) return tl::unexpected(id.error());
    if (*version > kStoreFormat || (*version != 0 && *id != kStoreId))
      return fail("belongs to another program or a newer Osteon", file.string(),
                  "Use another results file");
    if (*version == kStoreFormat) return run(kSendings);
    return transaction([&]() -> Result<void> {
      const std::string marks = "PRAGMA application_id=" + std::to_string(kStoreId) +
                                "; PRAGMA user_version=" + std::to_string(kStoreFormat) + ";";
      return run((kSchema + std::string(kSendings) + marks).c_str());
    });
  }
};

}  // namespace

Result<std::unique_ptr<ResultBackend>> open_sqlite(const std::string& where, double wait_s) {
  const fs::path file = where;
  std::error_code ec;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ec);
  auto store = std::make_unique<SqliteStore>();
  store->file = file;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_FULLMUTEX;
  if (sqlite3_open_v2(file.c_str(), &store->db, flags, nullptr) != SQLITE_OK)
    return tl::unexpected(store_error(store->db, file));
  sqlite3_busy_timeout(store->db, static_cast<int>(wait_s * 1000));
  if (auto made = store->make(); !made) return tl::unexpected(made.error());
  return std::unique_ptr<ResultBackend>(std::move(store));
}

Result<bool> SqliteStore::add(const AttemptRow& row) {
  return transaction([&]() -> Result<bool> {
    const auto there = find(row.id);
    if (!there) return tl::unexpected(there.error());
    if (*there) {
      if (**there == row) return false;
      return fail("another attempt has the id " + row.id, file.string(),
                  "An attempt is written once and never changed");
    }
    ResultStatement insert(db, std::string("INSERT INTO attempts(") + kColumns +
                                   ") VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
    if (!insert.ready()) return tl::unexpected(store_error(db, file));
    bind_row(insert, row);
    if (insert.step() != SQLITE_DONE) return tl::unexpected(store_error(db, file));
    return true;
  });
}

Result<std::vector<AttemptRow>> SqliteStore::list(const AttemptFilter& filter) {
  ResultStatement s(db, std::string("SELECT ") + kColumns +
                            " FROM attempts WHERE (?1='' OR learner=?1) AND "
                            "(?2='' OR scenario=?2) ORDER BY seq");
  if (!s.ready()) return tl::unexpected(store_error(db, file));
  s.bind(1, filter.learner);
  s.bind(2, filter.scenario);
  std::vector<AttemptRow> rows;
  int code = 0;
  while ((code = s.step()) == SQLITE_ROW) rows.push_back(row_of(s));
  if (code != SQLITE_DONE) return tl::unexpected(store_error(db, file));
  return rows;
}

Result<std::optional<AttemptRow>> SqliteStore::find(const std::string& id) {
  ResultStatement s(db, std::string("SELECT ") + kColumns + " FROM attempts WHERE id=?");
  if (!s.ready()) return tl::unexpected(store_error(db, file));
  s.bind(1, id);
  const int code = s.step();
  if (code == SQLITE_ROW) return std::optional<AttemptRow>(row_of(s));
  if (code != SQLITE_DONE) return tl::unexpected(store_error(db, file));
  return std::optional<AttemptRow>{};
}

Result<int> SqliteStore::forget(const std::string& learner) {
  const auto gone = transaction([&]() -> Result<int> {
    ResultStatement s(db, "DELETE FROM attempts WHERE learner=?");
    if (!s.ready()) return tl::unexpected(store_error(db, file));
    s.bind(1, learner);
    ResultStatement marks(db,
                          "DELETE FROM sendings WHERE id IN (SELECT id FROM attempts WHERE "
                          "learner=?)");
    if (!marks.ready()) return tl::unexpected(store_error(db, file));
    marks.bind(1, learner);
    if (marks.step() != SQLITE_DONE || s.step() != SQLITE_DONE)
      return tl::unexpected(store_error(db, file));
    return sqlite3_changes(db);
  });
  // What the log still holds of the deleted rows goes with it.
  if (gone) sqlite3_wal_checkpoint_v2(db, nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  return gone;
}

Result<void> SqliteStore::mark(const Sending& sending) {
  ResultStatement s(db,
                    "INSERT INTO sendings(id, endpoint, refusal) VALUES(?,?,?) ON CONFLICT(id, "
                    "endpoint) DO UPDATE SET refusal=excluded.refusal");
  if (!s.ready()) return tl::unexpected(store_error(db, file));
  s.bind(1, sending.id);
  s.bind(2, sending.endpoint);
  s.bind(3, sending.refusal);
  if (s.step() != SQLITE_DONE) return tl::unexpected(store_error(db, file));
  return {};
}

Result<std::vector<Sending>> SqliteStore::sendings(const std::string& endpoint) {
  ResultStatement s(db, "SELECT id, endpoint, refusal FROM sendings WHERE endpoint=? ORDER BY id");
  if (!s.ready()) return tl::unexpected(store_error(db, file));
  s.bind(1, endpoint);
  std::vector<Sending> all;
  int code = 0;
  while ((code = s.step()) == SQLITE_ROW) all.push_back({s.text(0), s.text(1), s.text(2)});
  if (code != SQLITE_DONE) return tl::unexpected(store_error(db, file));
  return all;
}

}  // namespace osteon
