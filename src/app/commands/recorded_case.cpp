#include "commands/recorded_case.h"

#include <system_error>

#include "commands/cli_support.h"
#include "osteon/scene/portal.h"
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
  return fail("the case of the recording ('" + source + "') is not found, nor is it beside it",
              recording.string(), "Name it with --case");
}

CaseParts parts_of(const RecordingHeader& header) {
  const auto settings = parse_settings(header.settings_json);
  return settings && !settings->soft.empty() ? CaseParts::kAll : CaseParts::kFelt;
}

namespace {

bool has_its_portals(const Case& the_case, const RecordingHeader& header) {
  const auto settings = parse_settings(header.settings_json);
  if (header.portals_hash == 0 || !settings) return true;  // not known: the replay tells
  const auto portals = open_portals(the_case, *settings);
  return portals && hash_of(*portals) == header.portals_hash;
}

}  // namespace

Result<std::shared_ptr<const Case>> open_recorded_case(const std::string& spec,
                                                       const RecordingHeader& header,
                                                       std::shared_ptr<const Case> drawn) {
  if (drawn && has_its_portals(*drawn, header)) return drawn;
  auto needed = open_and_show_progress(spec, parts_of(header));
  if (!needed || drawn || has_its_portals(**needed, header)) return needed;
  auto whole = open_and_show_progress(spec, CaseParts::kAll);
  return whole && has_its_portals(**whole, header) ? whole : needed;
}

}  // namespace osteon
