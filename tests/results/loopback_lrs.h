#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace osteon::test {

struct LoopbackRequest {
  std::string method, path, headers, body;
};
struct LoopbackAnswer {
  int status = 200;
  std::string body = {}, headers = {};
  bool drop = false;   ///< the connection is closed without a word
  bool stall = false;  ///< nothing is said until the client goes
};

/// A record store on this computer: keeps statements by id, refuses what xAPI 1.0.3 refuses, and
/// does before that what `before` says of a request, by its number from 0.
class LoopbackLrs {
 public:
  using Before = std::function<std::optional<LoopbackAnswer>(const LoopbackRequest&, int)>;
  explicit LoopbackLrs(Before before = {}) : before_(std::move(before)) {
    listening_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listening_, 16);
    socklen_t size = sizeof address;
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~LoopbackLrs() { stop(); }
  void stop() {
    if (!thread_.joinable()) return;
    ::shutdown(listening_, SHUT_RDWR);
    thread_.join();
    ::close(listening_);
  }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/xapi"; }

  // Read after stop().
  std::map<std::string, nlohmann::json> statements;
  std::vector<std::string> faults;  ///< of statements that are no xAPI
  int requests = 0, taken_twice = 0;

 private:
  void serve() {
    for (int client; (client = ::accept(listening_, nullptr, nullptr)) >= 0; ::close(client))
      while (answer_one(client)) {
      }
  }
  bool answer_one(int client) {
    LoopbackRequest request;
    if (!read_request(client, request)) return false;
    const auto forced = before_ ? before_(request, requests) : std::nullopt;
    ++requests;
    LoopbackAnswer answer = forced ? *forced : take(request);
    if (forced && forced->status == 200 && !forced->stall && request.method == "POST" &&
        forced->headers == "taken: yes")
      answer.body = (take(request), forced->body);
    if (answer.drop) return false;
    if (answer.stall) {
      char byte;
      while (::read(client, &byte, 1) > 0) {
      }
      return false;
    }
    const std::string head = "HTTP/1.1 " + std::to_string(answer.status) + " X\r\n" +
                             (answer.headers.empty() ? "" : answer.headers + "\r\n") +
                             "Content-Length: " + std::to_string(answer.body.size()) + "\r\n\r\n";
    const std::string all = head + answer.body;
    return ::send(client, all.data(), all.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(all.size());
  }
  static bool read_request(int client, LoopbackRequest& request) {
    std::string text;
    std::size_t end = std::string::npos;
    char bytes[4096];
    while ((end = text.find("\r\n\r\n")) == std::string::npos) {
      const ssize_t n = ::read(client, bytes, sizeof bytes);
      if (n <= 0) return false;
      text.append(bytes, static_cast<std::size_t>(n));
    }
    request.headers = text.substr(0, end);
    const std::size_t space = text.find(' ');
    request.method = text.substr(0, space);
    request.path = text.substr(space + 1, text.find(' ', space + 1) - space - 1);
    const std::size_t length = text.find("Content-Length: ");
    const std::size_t size = length < end ? std::stoul(text.substr(length + 16)) : 0;
    request.body = text.substr(end + 4);
    while (request.body.size() < size) {
      const ssize_t n = ::read(client, bytes, sizeof bytes);
      if (n <= 0) return false;
      request.body.append(bytes, static_cast<std::size_t>(n));
    }
    return true;
  }

  LoopbackAnswer take(const LoopbackRequest& request) {
    using Json = nlohmann::json;
    if (request.headers.find("X-Experience-API-Version: 1.0.3") == std::string::npos)
      return {400, "no version"};
    if (request.method == "GET") {
      const auto it = statements.find(request.path.substr(request.path.rfind('=') + 1));
      if (it == statements.end()) return {404, "none"};
      return {200, it->second.dump()};
    }
    const Json list = Json::parse(request.body, nullptr, false);
    if (!list.is_array() || list.empty()) return {400, "no list"};
    Json ids = Json::array();
    for (const Json& one : list) {
      const std::string fault = fault_of(one);
      if (!fault.empty()) {
        faults.push_back(fault);
        return {400, fault};
      }
      const auto it = statements.find(one["id"]);
      if (it != statements.end() && it->second != one) return {409, "another has this id"};
      ids.push_back(one["id"]);
    }
    for (const Json& one : list)
      taken_twice += statements.emplace(one["id"].get<std::string>(), one).second ? 0 : 1;
    return {200, ids.dump()};
  }

  // What xAPI 1.0.3 (part two, 2.4) asks of a statement.
  static std::string fault_of(const nlohmann::json& s) {
    for (const char* key : {"id", "actor", "verb", "object", "timestamp", "version"})
      if (!s.contains(key)) return std::string("no ") + key;
    if (s["id"].get<std::string>().size() != 36) return "id is no UUID";
    const auto& account = s["actor"]["account"];
    if (!account.contains("homePage") || !account.contains("name")) return "actor without account";
    if (s["actor"].contains("name")) return "a person's name";
    if (s["verb"]["id"].get<std::string>().find("http") != 0) return "verb is no IRI";
    if (s["object"]["id"].get<std::string>().find(':') == std::string::npos)
      return "object is no IRI";
    if (s["result"].contains("score") && s["result"]["score"].contains("scaled") &&
        std::abs(s["result"]["score"]["scaled"].get<double>()) > 1)
      return "score is out of bounds";
    return "";
  }

  Before before_;
  int listening_ = -1;
  unsigned port_ = 0;
  std::thread thread_;
};

}  // namespace osteon::test
