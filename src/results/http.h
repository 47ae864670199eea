#pragma once

#include <memory>
#include <optional>
#include <string>

#include "osteon/base/result.h"
#include "osteon/results/lrs.h"

namespace osteon {

struct HttpAnswer {
  long status = 0;
  std::string body;
  std::optional<long> retry_after_s;
};

/// Requests to one record store over one connection. An error is one of the way there: no network,
/// a certificate that is not trusted, a time that ran out.
class LrsHttp {
 public:
  static Result<LrsHttp> to(const Lrs& lrs);
  LrsHttp(LrsHttp&&) noexcept;
  ~LrsHttp();
  Result<HttpAnswer> post(const std::string& path, const std::string& json);
  Result<HttpAnswer> get(const std::string& path);

 private:
  struct Impl;
  explicit LrsHttp(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
