#include "runs/replays/recorded_case.h"

#include <system_error>

#include "osteon/session/session.h"

namespace osteon {

namespace fs = std::filesystem;

Result<std::string> recorded_case_spec(const fs::path& recording, const std::string& asked,
                                       const RecordingHeader& header) {
  if (!asked.empty()) return asked;
  const std::string& source = header.case_source;
  const auto end_of_folder = source.find('#');
  const fs::path folder = source.substr(0, end_of_folder);
  const std::string choice =
      end_of_folder == std::string::npos ? std::string() : source.substr(end_of_folder);
  std::error_code ignored;
  if (source.rfind("builtin:", 0) == 0 || fs::exists(folder, ignored)) return source;
  if (!header.case_path.empty() && fs::exists(header.case_path, ignored))
    return header.case_path + choice;
  const fs::path beside = recording.parent_path() / folder.filename();
  if (fs::exists(beside, ignored)) return beside.string() + choice;
  return fail(
      "the case of the recording ('" + source + "') was not found there or beside the recording",
      recording.string(), "Name it with --case");
}

CaseParts parts_of(const RecordingHeader& header) {
  const auto settings = parse_settings(header.settings_json);
  const bool needed = settings && (!settings->soft.empty() || settings->soft_structures);
  return needed ? CaseParts::kAll : CaseParts::kFelt;
}

}  // namespace osteon
