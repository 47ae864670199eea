#include "database.h"

#include <sqlite3.h>

#include <cstdio>
#include <cstring>
#include <random>

#include "salvage.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The encoding that SQLite wants. Absolute, so that no name is taken for ":memory:" or a URI.
std::string utf8_of(const fs::path& path) {
  const std::u8string text = fs::absolute(path).u8string();
  return std::string(text.begin(), text.end());
}

// What to tell a user for the result codes that a user can do something about.
Error explain(int code, const char* detail, const std::string& name) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return {"the disk is full", name, "Free some space; what was saved until now can be opened"};
    case SQLITE_IOERR:
      return {std::string("the file cannot be read or written (") + detail + ")", name,
              "Check the disk and its free space"};
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return {std::string("the file is damaged or not a recording (") + detail + ")", name,
              "Use another copy of it"};
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_READONLY:
      return {std::string("the file cannot be opened (") + detail + ")", name,
              "Check that it exists and that you may read it"};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {"another program uses the file", name, "Close it there and try again"};
    default:
      return {std::string("the database refused (") + detail + ")", name, "Use another copy of it"};
  }
}

}  // namespace

tl::unexpected<Error> database_error(sqlite3* db, const std::string& name) {
  return tl::unexpected(explain(sqlite3_extended_errcode(db), sqlite3_errmsg(db), name));
}

// --- Statement ---

void Statement::Finalize::operator()(sqlite3_stmt* stmt) const { sqlite3_finalize(stmt); }

void Statement::bind(int index, std::int64_t value) {
  sqlite3_bind_int64(stmt_.get(), index, value);
}

// A view of nothing may have no address, which SQLite takes for NULL.
static const char* address_of(std::string_view bytes) { return bytes.empty() ? "" : bytes.data(); }

void Statement::bind_text(int index, std::string_view text) {
  sqlite3_bind_text64(stmt_.get(), index, address_of(text), text.size(), SQLITE_TRANSIENT,
                      SQLITE_UTF8);
}

void Statement::bind_blob(int index, std::string_view bytes) {
  sqlite3_bind_blob64(stmt_.get(), index, address_of(bytes), bytes.size(), SQLITE_TRANSIENT);
}

Result<bool> Statement::next() {
  const int code = sqlite3_step(stmt_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  sqlite3* db = sqlite3_db_handle(stmt_.get());
  const char* name = sqlite3_db_filename(db, "main");
  return database_error(db, name ? name : "");
}

Result<void> Statement::run() {
  const auto row = next();
  sqlite3_reset(stmt_.get());
  if (!row) return tl::unexpected(row.error());
  return {};
}

void Statement::reset() { sqlite3_reset(stmt_.get()); }

bool Statement::is_integer(int column) const {
  return sqlite3_column_type(stmt_.get(), column) == SQLITE_INTEGER;
}
bool Statement::is_text(int column) const {
  return sqlite3_column_type(stmt_.get(), column) == SQLITE_TEXT;
}
bool Statement::is_blob(int column) const {
  return sqlite3_column_type(stmt_.get(), column) == SQLITE_BLOB;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(stmt_.get(), column);
}

std::string_view Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(stmt_.get(), column);
  const int size = sqlite3_column_bytes(stmt_.get(), column);
  return data ? std::string_view(static_cast<const char*>(data), static_cast<std::size_t>(size))
              : std::string_view();
}

// --- Database ---

/// The database and its log in a folder of their own, removed at the end.
class Database::TempCopy {
 public:
  ~TempCopy() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }

  static Result<std::unique_ptr<TempCopy>> make(const fs::path& file) {
    auto copy = std::make_unique<TempCopy>();
    std::error_code error;
    const fs::path temp = fs::temp_directory_path(error);
    // A name by chance, until one is new: create_directory tells.
    std::random_device chance;
    for (int i = 0; !error && i < 100 && copy->folder_.empty(); ++i) {
      const fs::path folder = temp / ("osteon-" + std::to_string(chance()));
      if (fs::create_directory(folder, error)) copy->folder_ = folder;
    }
    const fs::path log = file.string() + "-wal";
    if (!error) fs::copy_file(file, copy->file(), error);
    if (!error && fs::exists(log)) fs::copy_file(log, copy->file().string() + "-wal", error);
    if (error || copy->folder_.empty())
      return fail(
          "the recording cannot be copied to the temporary folder (" + error.message() + ")",
          file.string(),
          "Free some space there, or copy it, with its -wal file, to a folder of your own");
    // A copy of a write-protected file would be write-protected too.
    for (const auto& entry : fs::directory_iterator(copy->folder_, error))
      fs::permissions(entry.path(), fs::perms::owner_read | fs::perms::owner_write, error);
    return copy;
  }

  fs::path file() const { return folder_ / "recording.osr"; }
  fs::path salvaged() const { return folder_ / "salvaged.osr"; }

 private:
  fs::path folder_;
};

void Database::Close::operator()(sqlite3* db) const { sqlite3_close_v2(db); }

Database::Database() = default;
Database::~Database() = default;
Database::Database(Database&&) noexcept = default;

Database& Database::operator=(Database&& other) noexcept {
  db_ = std::move(other.db_);  // closed first: it uses the others
  name_ = std::move(other.name_);
  copy_ = std::move(other.copy_);
  image_ = std::move(other.image_);
  return *this;
}

Result<Database> Database::create(const fs::path& file) {
  // "x": fails when the file exists, without a moment between the look and the making.
  std::FILE* made = std::fopen(file.string().c_str(), "wbx");
  if (!made)
    return fail(std::string("the recording cannot be made (") + std::strerror(errno) + ")",
                file.string(), "Give the name of a new file in a writable folder");
  std::fclose(made);
  return open_at(file, file.string());
}

Result<Database> Database::reopen(const fs::path& file) { return open_at(file, file.string()); }

Result<Database> Database::open_at(const fs::path& file, const std::string& name) {
  Database database;
  database.name_ = name;
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(utf8_of(file).c_str(), &db,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  database.db_.reset(db);
  if (code != SQLITE_OK) return database_error(db, name);
  if (const auto done = database.harden(); !done) return tl::unexpected(done.error());
  return database;
}

// A recording may come from anyone: nothing in its schema is trusted.
Result<void> Database::harden() {
  sqlite3* db = db_.get();
  sqlite3_extended_result_codes(db, 1);
  sqlite3_busy_timeout(db, 2000);
  sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(db, SQLITE_LIMIT_LENGTH, 16 << 20);
  return run("PRAGMA cell_size_check=ON; PRAGMA mmap_size=0;");
}

// The log of a killed writer cannot be recovered without writing beside it.
bool Database::needs_copy() {
  const int code =
      sqlite3_exec(db_.get(), "SELECT count(*) FROM sqlite_schema", nullptr, nullptr, nullptr) &
      0xff;
  return code == SQLITE_CANTOPEN || code == SQLITE_READONLY;
}

Result<Database> Database::open(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    return fs::is_directory(file, error)
               ? fail("is a folder", file.string(), "Give the name of a file in it")
               : fail("there is no such file", file.string(), "Check the name");
  if (is_cut_short(file)) return open_cut(file);
  auto database = open_at(file, file.string());
  if (database && !database->needs_copy()) return database;
  if (database) return open_copy(file);
  return database;
}

Result<Database> Database::open_copy(const fs::path& file) {
  auto copy = TempCopy::make(file);
  if (!copy) return tl::unexpected(copy.error());
  auto database = open_at((*copy)->file(), file.string());
  if (database) database->copy_ = std::move(*copy);
  return database;
}

Result<Database> Database::open_cut(const fs::path& file) {
  auto copy = TempCopy::make(file);
  if (!copy) return tl::unexpected(copy.error());
  if (auto done = salvage((*copy)->file(), (*copy)->salvaged()); !done) {
    done.error().where = file.string();
    return tl::unexpected(done.error());
  }
  auto database = open_at((*copy)->salvaged(), file.string());
  if (database) database->copy_ = std::move(*copy);
  return database;
}

Result<Database> Database::open_memory(std::span<const std::byte> image) {
  constexpr std::size_t kHeader = 100, kWriteVersion = 18, kReadVersion = 19;
  Database database;
  database.name_ = "recording in memory";
  if (image.size() < kHeader) return fail("too short for a recording", database.name_);
  database.image_.assign(reinterpret_cast<const char*>(image.data()), image.size());
  // A database in memory has no log: mark it as one that uses a rollback journal.
  database.image_[kWriteVersion] = database.image_[kReadVersion] = 1;
  sqlite3* db = nullptr;
  int code = sqlite3_open_v2(":memory:", &db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  database.db_.reset(db);
  const auto size = static_cast<sqlite3_int64>(database.image_.size());
  if (code == SQLITE_OK)
    code = sqlite3_deserialize(db, "main", reinterpret_cast<unsigned char*>(database.image_.data()),
                               size, size, SQLITE_DESERIALIZE_READONLY);
  if (code != SQLITE_OK) return database_error(db, database.name_);
  if (const auto done = database.harden(); !done) return tl::unexpected(done.error());
  return database;
}

Result<void> Database::run(const char* sql) {
  if (sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK)
    return database_error(db_.get(), name_);
  return {};
}

Result<Statement> Database::prepare(const char* sql) {
  sqlite3_stmt* stmt = nullptr;
  if (sqlite3_prepare_v2(db_.get(), sql, -1, &stmt, nullptr) != SQLITE_OK)
    return database_error(db_.get(), name_);
  return Statement(stmt);
}

bool Database::has_moved() {
  int moved = 0;
  sqlite3_file_control(db_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  return moved != 0;
}

}  // namespace osteon
