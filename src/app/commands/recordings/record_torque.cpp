// The moment about each hand's grip, by repeating a recording.
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <vector>

#include "cases/open_case.h"
#include "commands/recordings/hdf5_table.h"
#include "commands/recordings/record_export.h"
#include "commands/recordings/record_names.h"
#include "commands/support/cli_support.h"
#include "runs/hands/tray.h"
#include "runs/replays/recorded_case.h"
#include "runs/reports/torque_report.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// One table a hand; a name may hold anything.
std::vector<fs::path> torque_tables(const RecordingHeader& header, const fs::path& folder) {
  std::vector<fs::path> files;
  for (std::string name : hand_names(header)) {
    for (char& c : name)
      if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
    fs::path file = folder / ("torque_" + name + ".csv");
    if (std::find(files.begin(), files.end(), file) != files.end())
      file = folder / ("torque_" + name + "_" + std::to_string(files.size() + 1) + ".csv");
    files.push_back(std::move(file));
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

using SeeTorque =
    std::function<void(std::size_t hand, const ToolState& tool, const TorqueWatch& torque)>;

// Repeats the run and tells every tick.
Result<void> repeat_for_torque(const fs::path& file, const std::string& case_spec,
                               const SeeTorque& see) {
  auto reader = RecordingReader::open(file);
  if (!reader) return tl::unexpected(reader.error());
  const auto spec = recorded_case_spec(file, case_spec, reader->header());
  if (!spec) return tl::unexpected(spec.error());
  auto the_case = open_and_show_progress(*spec, CaseParts::kFelt);
  if (!the_case) return tl::unexpected(the_case.error());
  ReplayOptions how;
  if (auto ready = take_instruments(reader->header(), **the_case, how); !ready) return ready;
  const auto settings = parse_settings(reader->header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  auto portals = open_portals(**the_case, *settings);
  if (!portals) return tl::unexpected(portals.error());
  const TorqueWatch torque(how.tray, std::move(*portals), reader->header().hands);
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot&,
                    std::span<const Event>) { see(hand, tool, torque); };
  const auto outcome = replay(*reader, *the_case, how);
  if (!outcome) return tl::unexpected(outcome.error());
  if (!outcome->identical)
    return fail("the repeated run differs from the recording", file.string(),
                "Use the version of Osteon that made the recording");
  return {};
}

Result<void> write_torques(const fs::path& recording, const std::string& case_spec,
                           const std::vector<fs::path>& files) {
  std::vector<std::ofstream> tables;
  for (const fs::path& file : files) {
    tables.emplace_back(file, std::ios::binary);
    tables.back() << "tick,time_s,torque_x_nm,torque_y_nm,torque_z_nm\n";
  }
  const auto repeated =
      repeat_for_torque(recording, case_spec,
                        [&](std::size_t hand, const ToolState& tool, const TorqueWatch& torque) {
                          tables[hand] << torque_row(tool, torque.moment_W(tool));
                        });
  if (!repeated) return repeated;
  for (std::ofstream& table : tables) {
    table.close();
    if (!table)
      return fail("a table cannot be written", files.front().parent_path().string(),
                  "Give a writable folder with enough free space");
  }
  return {};
}

// A hand's torques, some rows at a time.
class TorqueColumn {
 public:
  explicit TorqueColumn(hid_t group) : column_(group, "torque", H5T_IEEE_F64LE, 3, "N m") {}
  void add(const Vec3& moment_W) {
    for (int i = 0; i < 3; ++i) rows_.push_back(moment_W[i]);
    if (rows_.size() >= kRows) flush();
  }
  bool close() {
    flush();
    return column_.close() && ok_;
  }

 private:
  static constexpr std::size_t kRows = 3 * 4096;
  void flush() {
    ok_ = column_.append(std::span<const double>(rows_)) && ok_;
    rows_.clear();
  }
  Hdf5Column column_;
  std::vector<double> rows_;
  bool ok_ = true;
};

}  // namespace

Result<void> export_torque(const fs::path& recording, const std::string& case_spec,
                           const fs::path& folder) {
  auto reader = RecordingReader::open(recording);
  if (!reader) return tl::unexpected(reader.error());
  const std::vector<fs::path> files = torque_tables(reader->header(), folder);
  const auto done = write_torques(recording, case_spec, files);
  std::error_code ignored;
  if (!done)
    for (const fs::path& file : files) fs::remove(file, ignored);
  return done;
}

Result<void> add_torque_to_hdf5(const fs::path& recording, const std::string& case_spec,
                                const fs::path& file) {
  auto reader = RecordingReader::open(recording);
  if (!reader) return tl::unexpected(reader.error());
  const auto not_written = [&] {
    return fail("the torques cannot be written", file.string(),
                "Give a name in a writable folder with enough free space");
  };
  Hdf5Handle open(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  if (!open.ok()) return not_written();
  std::vector<TorqueColumn> columns;
  for (const std::string& name : hand_names(reader->header())) {
    const std::string path = "/hands/" + hdf5_group_name(name);
    const Hdf5Handle group(H5Gopen2(open.id(), path.c_str(), H5P_DEFAULT), H5Gclose);
    if (!group.ok()) return not_written();
    columns.emplace_back(group.id());
  }
  const auto repeated =
      repeat_for_torque(recording, case_spec,
                        [&](std::size_t hand, const ToolState& tool, const TorqueWatch& torque) {
                          columns[hand].add(torque.moment_W(tool));
                        });
  if (!repeated) return repeated;
  bool written = true;
  for (TorqueColumn& column : columns) written = column.close() && written;
  if (!written || !open.close()) return not_written();
  return {};
}

Result<std::vector<TorqueReport>> torque_reports(const fs::path& recording,
                                                 const std::string& case_spec) {
  std::optional<TorqueWatch> tally;
  const auto repeated =
      repeat_for_torque(recording, case_spec,
                        [&](std::size_t hand, const ToolState& tool, const TorqueWatch& torque) {
                          if (!tally) tally = torque;
                          tally->see(hand, tool);
                        });
  if (!repeated) return tl::unexpected(repeated.error());
  return tally ? tally->finish() : std::vector<TorqueReport>();
}

}  // namespace osteon
