// The moment about each hand's grip, by repeating a recording.
#include <array>
#include <cstdio>
#include <fstream>
#include <vector>

#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/record_export.h"
#include "commands/record_names.h"
#include "runs/recorded_case.h"
#include "runs/torque_report.h"
#include "runs/tray.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// One table a hand; a name may hold anything.
std::vector<fs::path> torque_tables(const RecordingHeader& header, const fs::path& folder) {
  std::vector<fs::path> files;
  for (std::string name : hand_names(header)) {
    for (char& c : name)
      if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
    files.push_back(folder / ("torque_" + name + ".csv"));
  }
  return files;
}

// Numbers that read back as they were, in every locale.
std::string torque_row(const ToolState& tool, const Vec3& moment_W) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%llu;%.17g;%.17g;%.17g;%.17g\n",
                static_cast<unsigned long long>(tool.tick), tool.time_s, moment_W.x(), moment_W.y(),
                moment_W.z());
  std::string row = text.data();
  for (char& c : row) {
    if (c == ',') c = '.';
    if (c == ';') c = ',';
  }
  return row;
}

Result<void> write_torques(RecordingReader& recording, const std::shared_ptr<const Case>& the_case,
                           const std::vector<fs::path>& files) {
  ReplayOptions how;
  if (auto ready = take_instruments(recording.header(), *the_case, how); !ready) return ready;
  const auto settings = parse_settings(recording.header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  auto portals = open_portals(*the_case, *settings);
  if (!portals) return tl::unexpected(portals.error());
  const TorqueWatch torque(how.tray, std::move(*portals), files.size());
  std::vector<std::ofstream> tables;
  for (const fs::path& file : files) {
    tables.emplace_back(file, std::ios::binary);
    tables.back() << "tick,time_s,torque_x_nm,torque_y_nm,torque_z_nm\n";
  }
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot&,
                    std::span<const Event>) {
    tables[hand] << torque_row(tool, torque.moment_W(tool));
  };
  const auto outcome = replay(recording, the_case, how);
  if (!outcome) return tl::unexpected(outcome.error());
  if (!outcome->identical)
    return fail("the repeated run differs from the recording", "record export --torque",
                "Use the version of Osteon that made the recording");
  for (std::ofstream& table : tables) {
    table.close();
    if (!table)
      return fail("a table cannot be written", files.front().parent_path().string(),
                  "Give a folder where you may write, with room");
  }
  return {};
}

}  // namespace

Result<void> export_torque(const fs::path& recording, const std::string& case_spec,
                           const fs::path& folder) {
  auto reader = RecordingReader::open(recording);
  if (!reader) return tl::unexpected(reader.error());
  const auto spec = recorded_case_spec(recording, case_spec, reader->header());
  if (!spec) return tl::unexpected(spec.error());
  auto the_case = open_and_show_progress(*spec, CaseParts::kFelt);
  if (!the_case) return tl::unexpected(the_case.error());
  const std::vector<fs::path> files = torque_tables(reader->header(), folder);
  const auto done = write_torques(*reader, *the_case, files);
  std::error_code ignored;
  if (!done)
    for (const fs::path& file : files) fs::remove(file, ignored);
  return done;
}

}  // namespace osteon
