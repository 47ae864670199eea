// Any bytes as a probe path: an error or a path that keeps its promises.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/scene/path.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto path = osteon::parse_path({reinterpret_cast<const char*>(data), size}, "path.csv");
  if (!path) return 0;
  double last = -HUGE_VAL;
  for (const osteon::PathSample& sample : path->samples) {
    osteon::demand(sample.time_s > last, "the time does not increase");
    osteon::demand(osteon::is_finite(sample.X_WD), "a pose is not finite");
    last = sample.time_s;
  }
  const double first = path->samples.front().time_s;
  for (int i = -1; i <= 9; ++i) {
    const osteon::PathSample at = path->at(first + i / 8.0 * path->duration_s());
    osteon::demand(osteon::is_finite(at.X_WD), "a pose between samples is not finite");
  }
  return 0;
}
