#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <string>

namespace osteon::testing_cli {

/// A port of this computer at which a record store would be: who connects is kept waiting until
/// `take_request` looks at what was sent.
class LrsThatWaits {
 public:
  LrsThatWaits() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), size);
    ::listen(listener_, 4);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ::ntohs(address.sin_port);
    const timeval longest{60, 0};
    ::setsockopt(listener_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
  }
  ~LrsThatWaits() { ::close(listener_); }
  LrsThatWaits(const LrsThatWaits&) = delete;
  LrsThatWaits& operator=(const LrsThatWaits&) = delete;

  std::string endpoint() const { return "http://127.0.0.1:" + std::to_string(port_) + "/xapi"; }
  /// The first request, to the end of its body, refused; returns once who sent it has left. Empty:
  /// nobody came within a minute.
  std::string take_request() const {
    const int peer = ::accept(listener_, nullptr, nullptr);
    if (peer < 0) return {};
    const timeval longest{10, 0};
    ::setsockopt(peer, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    std::string text;
    char some[4096];
    while (!is_whole(text)) {
      const ssize_t n = ::recv(peer, some, sizeof some, 0);
      if (n <= 0) break;
      text.append(some, static_cast<std::size_t>(n));
    }
    const std::string answer = "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n";
    (void)!::send(peer, answer.data(), answer.size(), MSG_NOSIGNAL);
    while (::recv(peer, some, sizeof some, 0) > 0) {
    }
    ::close(peer);
    return text;
  }

 private:
  static bool is_whole(const std::string& text) {
    const std::size_t body = text.find("\r\n\r\n");
    const std::size_t length = text.find("Content-Length: ");
    if (body == std::string::npos || length == std::string::npos) return false;
    return text.size() >= body + 4 + std::stoul(text.substr(length + 16));
  }

  int listener_, port_ = 0;
};

}  // namespace osteon::testing_cli
