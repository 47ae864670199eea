#include "commands/support/force_order.h"

#if defined(__unix__) || defined(__APPLE__)
#include <poll.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <sstream>

namespace osteon {
namespace {

constexpr std::size_t kLongestLine = 4096;

std::string what_there_is(std::span<const std::string> names) {
  std::string hands;
  for (std::size_t i = 0; i < names.size(); ++i)
    hands += (i > 0 ? ", " : "") + (names[i].empty() ? std::to_string(i + 1) : names[i]);
  return "Type on or off, alone or with a hand: " + hands;
}

}  // namespace

Result<ForceOrder> parse_force_order(std::string_view line, std::span<const std::string> names) {
  std::istringstream in{std::string(line)};
  std::string wish, hand, more;
  in >> wish >> hand >> more;
  if ((wish != "on" && wish != "off") || !more.empty())
    return fail("this is not a command", std::string(line), what_there_is(names));
  ForceOrder order{wish == "on", std::nullopt};
  if (hand.empty()) return order;
  for (std::size_t i = 0; i < names.size() && !order.hand; ++i)
    if (hand == names[i] || hand == std::to_string(i + 1)) order.hand = i;
  if (!order.hand) return fail("there is no such hand", hand, what_there_is(names));
  return order;
}

// A line that does not end is cut: it is no order in any case.
std::optional<std::string> InputLines::next() {
  while (waiting_.find('\n') == std::string::npos && waiting_.size() < kLongestLine)
    if (!read_some()) break;
  const std::size_t end = waiting_.find('\n');
  if (end == std::string::npos && !(ended_ && !waiting_.empty()) && waiting_.size() < kLongestLine)
    return std::nullopt;
  std::string line = waiting_.substr(0, end);
  waiting_.erase(0, end == std::string::npos ? end : end + 1);
  return line;
}

#if defined(__unix__) || defined(__APPLE__)
bool InputLines::read_some() {
  const bool elsewhere = ::isatty(STDIN_FILENO) == 1 && ::tcgetpgrp(STDIN_FILENO) != ::getpgrp();
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (ended_ || elsewhere || ::poll(&input, 1, 0) <= 0) return false;
  char block[256];
  const ssize_t got = ::read(STDIN_FILENO, block, sizeof block);
  if (got > 0)
    waiting_.append(block, static_cast<std::size_t>(got));
  else
    ended_ = true;
  return got > 0;
}
#else
bool InputLines::read_some() {
  ended_ = true;
  return false;
}
#endif

}  // namespace osteon
