#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace osteon {

/// One prepared statement. Rows are read while `next` gives true.
class Statement {
 public:
  explicit Statement(sqlite3_stmt* stmt) : stmt_(stmt) {}
  void bind(int index, std::int64_t value);
  void bind_text(int index, std::string_view text);
  void bind_blob(int index, std::string_view bytes);
  /// True while there is a row.
  Result<bool> next();
  /// Runs a statement that gives no rows and makes it ready for new values.
  Result<void> run();
  /// Ready for new values; the row is over.
  void reset();

  bool is_integer(int column) const;
  bool is_text(int column) const;
  bool is_blob(int column) const;
  std::int64_t integer(int column) const;
  /// Bytes of a text or a blob; valid until the next call.
  std::string_view bytes(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* stmt) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalize> stmt_;
};

/// An open SQLite database. Errors name the file.
class Database {
 public:
  /// Makes a file that must not exist yet.
  static Result<Database> create(const std::filesystem::path& file);
  /// Opens a file that `create` made, to go on writing.
  static Result<Database> reopen(const std::filesystem::path& file);
  /// Opens for reading. What a killed writer left in its log is recovered, which writes to the
  /// folder; where that is not allowed, a copy in the temporary folder is read instead. Of a file
  /// that was cut short, what its beginning still holds is read from such a copy (salvage.h).
  static Result<Database> open(const std::filesystem::path& file);
  /// Opens an image of a file (without its log).
  static Result<Database> open_memory(std::span<const std::byte> image);
  ~Database();
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;

  Result<void> run(const char* sql);
  Result<Statement> prepare(const char* sql);
  /// True when the file is no longer where it was made.
  bool has_moved();
  const std::string& name() const { return name_; }

 private:
  struct Close {
    void operator()(sqlite3* db) const;
  };
  class TempCopy;

  Database();
  static Result<Database> open_at(const std::filesystem::path& file, const std::string& name);
  static Result<Database> open_copy(const std::filesystem::path& file);
  static Result<Database> open_cut(const std::filesystem::path& file);
  Result<void> harden();
  bool needs_copy();

  std::string name_;
  std::unique_ptr<TempCopy> copy_;  // outlives the connection
  std::string image_;               // of open_memory; outlives the connection
  std::unique_ptr<sqlite3, Close> db_;
};

/// Text for a failed call on `db`.
tl::unexpected<Error> database_error(sqlite3* db, const std::string& name);

}  // namespace osteon
