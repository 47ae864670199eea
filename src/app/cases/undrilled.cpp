#include "cases/undrilled.h"

#include <array>
#include <string_view>

namespace osteon {

std::string source_before_drilling(const std::string& source) {
  constexpr std::array<std::string_view, 3> kDrilling{
      ":acl_tunnels=", ":old_socket=", ":old_tunnel="};
  std::string left = source;
  for (const std::string_view word : kDrilling)
    for (auto at = left.find(word); at != std::string::npos; at = left.find(word)) {
      const auto end = left.find_first_of(":#", at + 1);
      left.erase(at, end == std::string::npos ? end : end - at);
    }
  return left;
}

}  // namespace osteon
