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

/// Attempts in one SQLite file, which many programs may write at once: each write is one
/// transaction that waits for the others up to `wait_s`. A kill loses nothing that `add` has
/// returned from.
class ResultStore {
 public:
  /// Opens or makes the file and its folder. Fails on a file that is no such store, one of a newer
  /// format, and where it cannot be written.
  static Result<ResultStore> open(const std::filesystem::path& file, double wait_s = 20);
  ~ResultStore();
  ResultStore(ResultStore&&) noexcept;
  ResultStore& operator=(ResultStore&&) noexcept;

  /// True: it was added; false: it was there already, the same. Fails when another attempt has its
  /// id, and when the disk is full or the file stays locked: then nothing of it is in the file.
  Result<bool> add(const AttemptRow& row);
  /// In the order in which they were added, whatever the clock said.
  Result<std::vector<AttemptRow>> list(const AttemptFilter& filter = {}) const;
  Result<std::optional<AttemptRow>> find(const std::string& id) const;
  /// Removes all of a learner, overwriting what was on the disk. How many attempts it were.
  Result<int> forget(const std::string& learner);

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
Result<KeptAttempt> keep_attempt(const AttemptRow& row, const std::filesystem::path& store,
                                 const std::filesystem::path& waiting, double wait_s = 20);
/// Puts every attempt that waits into the store. How many it were; one that cannot be read stays
/// where it is and is named in the error.
Result<int> take_waiting(ResultStore& store, const std::filesystem::path& waiting);

}  // namespace osteon
