#include "osteon/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace osteon {

void demand(bool condition, const char* message) {
  if (condition) return;
  std::fprintf(stderr, "osteon: stopped to keep your data safe: %s\n", message);
  std::abort();
}

}  // namespace osteon
