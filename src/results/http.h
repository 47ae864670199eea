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

/// Whether what is sent there can be read by nobody on the way: https, or this computer.
bool is_private_way(const std::string& url);
/// As it stands in the query of an address (RFC 3986, 2.1).
std::string percent_encoded(const std::string& text);

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
