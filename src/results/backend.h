#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/results/store.h"

namespace osteon {

/// What keeps attempts: contracts as those of ResultStore.
class ResultBackend {
 public:
  virtual ~ResultBackend() = default;
  virtual Result<bool> add(const AttemptRow& row) = 0;
  virtual Result<std::vector<AttemptRow>> list(const AttemptFilter& filter) = 0;
  virtual Result<std::optional<AttemptRow>> find(const std::string& id) = 0;
  virtual Result<int> forget(const std::string& learner) = 0;
  virtual Result<void> mark(const Sending& sending) = 0;
  virtual Result<std::vector<Sending>> sendings(const std::string& endpoint) = 0;
};

/// A SQLite file; makes it and its folder.
Result<std::unique_ptr<ResultBackend>> open_sqlite(const std::string& file, double wait_s);
/// A PostgreSQL server's database, "postgresql://...".
Result<std::unique_ptr<ResultBackend>> open_postgres(const std::string& url, double wait_s);

}  // namespace osteon
