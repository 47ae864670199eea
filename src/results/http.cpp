#include "http.h"

#include <curl/curl.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "patient_http.h"

namespace osteon {
namespace {

constexpr std::size_t kLargestAnswer = 4u << 20;

std::size_t take_body(char* bytes, std::size_t, std::size_t count, void* into) {
  auto& body = *static_cast<std::string*>(into);
  if (body.size() + count > kLargestAnswer) return 0;
  body.append(bytes, count);
  return count;
}

struct HeaderList {
  curl_slist* list = nullptr;
  ~HeaderList() { curl_slist_free_all(list); }
  void add(const std::string& line) { list = curl_slist_append(list, line.c_str()); }
};

// An address on this computer: a password need not be hidden on the way.
bool is_here(const std::string& endpoint) {
  for (const char* host : {"http://127.0.0.1", "http://localhost", "http://[::1]"})
    if (endpoint.starts_with(host)) {
      // Up to the path: after "localhost:80@" another host follows.
      std::string_view port = std::string_view(endpoint).substr(std::string_view(host).size());
      port = port.substr(0, port.find_first_of("/?#"));
      if (port.empty() || (port[0] == ':' && port.find_first_not_of("0123456789", 1) == port.npos))
        return true;
    }
  return false;
}

Error way_error(CURLcode code, const Lrs& lrs, const char* detail) {
  const std::string why = *detail ? detail : curl_easy_strerror(code);
  if (code == CURLE_PEER_FAILED_VERIFICATION || code == CURLE_SSL_CACERT_BADFILE)
    return {"the record store's certificate is not trusted (" + why + ")", lrs.endpoint,
            "Give its certificate authority with --certificates FILE"};
  if (code == CURLE_OPERATION_TIMEDOUT)
    return {"the record store did not answer in time", lrs.endpoint,
            "Nothing is lost: send again later"};
  return {"the record store cannot be reached (" + why + ")", lrs.endpoint,
          "Nothing is lost: send again later"};
}

}  // namespace

std::string first_words(const std::string& body) {
  std::string text = body.substr(0, 160);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  return text;
}

bool is_private_way(const std::string& url) { return url.starts_with("https://") || is_here(url); }

std::string percent_encoded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
                       (byte >= 'a' && byte <= 'z') || c == '-' || c == '.' || c == '_' || c == '~';
    if (plain)
      out += c;
    else
      (out += '%', out += "0123456789ABCDEF"[byte >> 4], out += "0123456789ABCDEF"[byte & 15]);
  }
  return out;
}

struct LrsHttp::Impl {
  Lrs lrs;
  CURL* curl = nullptr;
  char detail[CURL_ERROR_SIZE] = {};
  ~Impl() { curl_easy_cleanup(curl); }

  void set_up(const std::string& path, HeaderList& headers, std::string& body) {
    curl_easy_reset(curl);
    curl_easy_setopt(curl, CURLOPT_URL, (lrs.endpoint + path).c_str());
    curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(curl, CURLOPT_NOPROXY, "localhost,127.0.0.1,::1");
    curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, detail);
    curl_easy_setopt(curl, CURLOPT_TIMEOUT_MS, lrs.timeout_ms);
    curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT_MS, lrs.timeout_ms);
    curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, take_body);
    curl_easy_setopt(curl, CURLOPT_WRITEDATA, &body);
    if (!lrs.certificates.empty()) curl_easy_setopt(curl, CURLOPT_CAINFO, lrs.certificates.c_str());
    if (!lrs.user.empty()) {
      curl_easy_setopt(curl, CURLOPT_HTTPAUTH, CURLAUTH_BASIC);
      curl_easy_setopt(curl, CURLOPT_USERNAME, lrs.user.c_str());
      curl_easy_setopt(curl, CURLOPT_PASSWORD, lrs.password.c_str());
    }
    if (!lrs.authorization.empty()) headers.add("Authorization: " + lrs.authorization);
    headers.add("X-Experience-API-Version: 1.0.3");
    headers.add("Content-Type: application/json");
    headers.add("Expect:");  // no pause before a body is sent
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers.list);
  }
  Result<HttpAnswer> perform(const std::string& path, const std::string* json) {
    HeaderList headers;
    HttpAnswer answer;
    detail[0] = '\0';
    set_up(path, headers, answer.body);
    if (json) {
      curl_easy_setopt(curl, CURLOPT_POST, 1L);
      curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(json->size()));
      curl_easy_setopt(curl, CURLOPT_POSTFIELDS, json->data());
    }
    const CURLcode code = curl_easy_perform(curl);
    if (code != CURLE_OK) return tl::unexpected(way_error(code, lrs, detail));
    curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &answer.status);
    curl_off_t after = 0;
    if (curl_easy_getinfo(curl, CURLINFO_RETRY_AFTER, &after) == CURLE_OK && after > 0)
      answer.retry_after_s = static_cast<long>(after);
    return answer;
  }
};

LrsHttp::LrsHttp(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LrsHttp::LrsHttp(LrsHttp&&) noexcept = default;
LrsHttp::~LrsHttp() = default;

Result<LrsHttp> LrsHttp::to(const Lrs& lrs) {
  const bool open_way = lrs.endpoint.starts_with("http://");
  if (!open_way && !lrs.endpoint.starts_with("https://"))
    return fail("'" + lrs.endpoint + "' is not the address of a record store", "--to",
                "Give it as https://HOST/PATH");
  const bool secret = !lrs.user.empty() || !lrs.authorization.empty();
  if (open_way && secret && !is_here(lrs.endpoint))
    return fail("the password would be sent unencrypted", lrs.endpoint, "Use https://");
  static const CURLcode started = curl_global_init(CURL_GLOBAL_DEFAULT);
  auto impl = std::make_unique<Impl>();
  impl->lrs = lrs;
  while (impl->lrs.endpoint.ends_with('/')) impl->lrs.endpoint.pop_back();
  impl->curl = started == CURLE_OK ? curl_easy_init() : nullptr;
  if (!impl->curl) return fail("libcurl could not be started", lrs.endpoint, "");
  return LrsHttp(std::move(impl));
}

Result<HttpAnswer> LrsHttp::post(const std::string& path, const std::string& json) {
  return impl_->perform(path, &json);
}
Result<HttpAnswer> LrsHttp::get(const std::string& path) { return impl_->perform(path, nullptr); }

}  // namespace osteon
