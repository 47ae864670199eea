#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/results/attempt_row.h"

namespace osteon {

struct AttemptFilter {
  std::string learner = {};   ///< empty: all
  std::string scenario = {};  ///< empty: all
};

/// What a learning record store said of an attempt's statement.
struct Sending {
  std::string id;             ///< the attempt's
  std::string endpoint = {};  ///< the record store's URL
  std::string refusal = {};   ///< empty: it has the statement; else why it will not take it
  bool operator==(const Sending&) const = default;
};

/// Whether a place of results is a PostgreSQL server ("postgresql://USER@HOST/DATABASE") and not a
/// file.
bool is_results_server(const std::string& where);
/// The place as it may be shown.
std::string without_password(const std::string& where);

/// Attempts in one SQLite file or on a PostgreSQL server, which many programs may write at once:
/// each write is one transaction that waits for the others up to `wait_s`. A kill loses nothing
/// that `add` has returned from.
class ResultStore {
 public:
  /// Opens or makes the file and its folder, or the tables in the server's database. Fails on what
  /// is no such store or of a newer format, where it cannot be written, and where the server does
  /// not answer; no message holds a password.
  static Result<ResultStore> open(const std::string& where, double wait_s = 20);
  ~ResultStore();
  ResultStore(ResultStore&&) noexcept;
  ResultStore& operator=(ResultStore&&) noexcept;

  /// True: it was added; false: it was there already, the same. Fails when another attempt has its
  /// id, and when the disk is full or the file stays locked: then nothing of it is in the file.
  Result<bool> add(const AttemptRow& row);
  /// In the order in which they were added, whatever the clock said.
  Result<std::vector<AttemptRow>> list(const AttemptFilter& filter = {}) const;
  Result<std::optional<AttemptRow>> find(const std::string& id) const;
  /// Removes all of a learner, overwriting what was on the disk (a server's own log and backups
  /// are its keeper's). How many attempts it were.
  Result<int> forget(const std::string& learner);
  /// Keeps what a record store said of an attempt; a later word replaces it.
  Result<void> mark(const Sending& sending);
  Result<std::vector<Sending>> sendings(const std::string& endpoint) const;

 private:
  struct Impl;
  explicit ResultStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Keeps an attempt even when the store cannot take it now: writes it as a file into `waiting`
/// first, then into the store, then removes the file. Fails only when neither could be written;
/// the message says where the attempt is when it waits.
struct KeptAttempt {
  bool in_store = false;
  std::optional<Error> why_waiting;
};
Result<KeptAttempt> keep_attempt(const AttemptRow& row, const std::string& store,
                                 const std::filesystem::path& waiting, double wait_s = 20);
/// Puts every attempt that waits into the store. How many it were; one that cannot be read stays
/// where it is and is named in the error.
Result<int> take_waiting(ResultStore& store, const std::filesystem::path& waiting);

}  // namespace osteon
