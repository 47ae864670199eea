#include "commands/support/cli_support.h"

#include <cstdio>

#include "commands/support/progress_line.h"
#include "osteon/base/file.h"

namespace osteon {

int report_error(const Error& error) {
  std::fprintf(stderr, "osteon: %s\n", error.message().c_str());
  return kExitBad;
}

Result<std::shared_ptr<const Case>> open_and_show_progress(const std::string& spec,
                                                           CaseParts parts) {
  ProgressLine line;
  return open_case(spec, line.stopping(), parts);
}

double metres_per_unit(const std::string& unit) {
  if (unit == "m") return 1.0;
  return unit == "cm" ? 0.01 : 0.001;
}

Result<void> save_report(const Report& report, const std::filesystem::path& file) {
  if (file.empty()) return {};
  return write_file_atomic(file, to_json(report));
}

}  // namespace osteon
