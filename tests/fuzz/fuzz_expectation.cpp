// Any text is an expectation or an error.
#include <cstddef>
#include <cstdint>
#include <string>

#include "osteon/procedure/report.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  osteon::Report report;
  report.bones = {{"radius", 1, 1, 1, 1, 1}, {"lunate", -1, 0, 0, 0, 0}};
  (void)osteon::check_expectation(report, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
