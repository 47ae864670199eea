#include "osteon/results/store.h"

#include <utility>

#include "backend.h"

namespace osteon {

struct ResultStore::Impl {
  std::unique_ptr<ResultBackend> kept_by;
};

bool is_results_server(const std::string& where) {
  return where.starts_with("postgresql://") || where.starts_with("postgres://");
}

std::string without_password(const std::string& where) {
  const std::size_t at = where.rfind('@'), begin = where.find("://");
  if (at == std::string::npos || begin == std::string::npos || at < begin) return where;
  const std::size_t colon = where.find(':', begin + 3);
  if (colon == std::string::npos || colon > at) return where;
  return where.substr(0, colon) + where.substr(at);
}

ResultStore::ResultStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResultStore::~ResultStore() = default;
ResultStore::ResultStore(ResultStore&&) noexcept = default;
ResultStore& ResultStore::operator=(ResultStore&&) noexcept = default;

Result<ResultStore> ResultStore::open(const std::string& where, double wait_s) {
  auto backend =
      is_results_server(where) ? open_postgres(where, wait_s) : open_sqlite(where, wait_s);
  if (!backend) return tl::unexpected(backend.error());
  auto impl = std::make_unique<Impl>();
  impl->kept_by = std::move(*backend);
  return ResultStore(std::move(impl));
}

Result<bool> ResultStore::add(const AttemptRow& row) { return impl_->kept_by->add(row); }
Result<std::vector<AttemptRow>> ResultStore::list(const AttemptFilter& filter) const {
  return impl_->kept_by->list(filter);
}
Result<std::optional<AttemptRow>> ResultStore::find(const std::string& id) const {
  return impl_->kept_by->find(id);
}
Result<int> ResultStore::forget(const std::string& learner) {
  return impl_->kept_by->forget(learner);
}
Result<void> ResultStore::mark(const Sending& sending) { return impl_->kept_by->mark(sending); }
Result<std::vector<Sending>> ResultStore::sendings(const std::string& endpoint) const {
  return impl_->kept_by->sendings(endpoint);
}

}  // namespace osteon
