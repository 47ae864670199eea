#include "commands/recordings/record_export.h"

#include <array>
#include <charconv>
#include <fstream>
#include <initializer_list>

#include "commands/recordings/record_names.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTickColumns =
    "tick,time_s,hand_x_m,hand_y_m,hand_z_m,hand_qw,hand_qx,hand_qy,hand_qz,hand_vx_m_per_s,"
    "hand_vy_m_per_s,hand_vz_m_per_s,buttons,proxy_x_m,proxy_y_m,proxy_z_m,force_x_n,force_y_n,"
    "force_z_n,status,command,command_value,bone_step\n";
constexpr const char* kEventColumns =
    "tick,time_s,hand,kind,subject_kind,subject,subject_index,x_m,y_m,z_m,value_1,value_2,value_3,"
    "value_1_is,"
    "value_2_is,value_3_is\n";

// Shortest text that reads back as the same number, in every locale.
void add(std::string& text, double value) {
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}
void add(std::string& text, std::initializer_list<double> values) {
  for (const double value : values) {
    text += ',';
    add(text, value);
  }
}

// A name may hold anything.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string row_of(const TickRecord& r, double tick_s) {
  std::string text = std::to_string(r.tick);
  add(text, {static_cast<double>(r.tick) * tick_s});
  const Pose& X = r.input.X_WD;
  add(text, {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()});
  add(text, {r.input.v_W.x(), r.input.v_W.y(), r.input.v_W.z()});
  text += ',' + std::to_string(r.input.buttons);
  add(text, {r.p_WP.x(), r.p_WP.y(), r.p_WP.z(), r.force_W.x(), r.force_W.y(), r.force_W.z()});
  text += ',' + std::to_string(r.status) + ',' +
          std::to_string(static_cast<std::uint32_t>(r.command.kind));
  add(text, {r.command.value});
  return text + ',' + std::to_string(r.bone_step) + '\n';
}

std::string row_of(const Event& e, const RecordNames& names, double tick_s) {
  const EventKindRow* kind = find_event_kind(e.kind);
  std::string text = std::to_string(e.tick);
  add(text, {static_cast<double>(e.tick) * tick_s});
  text += ',' + csv_field(names.hand(e.hand)) + ',' +
          (kind ? std::string(kind->name) : std::to_string(static_cast<int>(e.kind))) + ',' +
          RecordNames::subject_kind(e) + ',' + csv_field(names.subject(e)) + ',' +
          (e.subject == kNoSubject ? std::string() : std::to_string(e.subject));
  add(text, {e.p_W.x(), e.p_W.y(), e.p_W.z(), e.values[0], e.values[1], e.values[2]});
  for (std::size_t i = 0; i < e.values.size(); ++i)
    text += ',' + (kind ? std::string(kind->value_names[i]) : std::string());
  return text + '\n';
}

template <class Record, class Read, class Row>
Result<void> write_table(const fs::path& file, const char* columns, const Read& read,
                         const Row& row) {
  std::ofstream out(file, std::ios::binary);
  out << columns;
  for (std::uint64_t next = 1; out;) {
    const Result<std::vector<Record>> some = read(next);
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) break;
    next += some->size();
    for (const Record& record : *some) out << row(record);
  }
  out.close();
  if (!out)
    return fail("the table cannot be written", file.string(),
                "Give a writable folder with enough free space");
  return {};
}

// A hand's name may hold anything.
std::string file_name(const std::string& hand) {
  std::string name;
  for (const char c : hand) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += plain ? c : '_';
  }
  return "ticks_" + name + ".csv";
}

Result<void> write_all(RecordingReader& recording, const fs::path& folder) {
  const RecordingHeader& header = recording.header();
  const RecordNames names(header);
  const double dt = recorded_tick_s(header);
  for (std::size_t h = 0; h < header.hands; ++h) {
    const auto done = write_table<TickRecord>(
        folder / file_name(names.hand(h)), kTickColumns,
        [&](std::uint64_t first) { return recording.read_ticks(h, first); },
        [&](const TickRecord& r) { return row_of(r, dt); });
    if (!done) return done;
  }
  return write_table<Event>(
      folder / "events.csv", kEventColumns,
      [&](std::uint64_t first) { return recording.read_events(first); },
      [&](const Event& e) { return row_of(e, names, dt); });
}

}  // namespace

Result<void> export_csv(RecordingReader& recording, const fs::path& folder) {
  std::error_code error;
  const bool there = fs::exists(folder, error);
  if (there && !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    return fail("the folder is not empty", folder.string(), "Give a new or an empty one");
  fs::create_directories(folder, error);
  if (error)
    return fail("the folder cannot be made (" + error.message() + ")", folder.string(),
                "Give a writable folder");
  auto done = write_all(recording, folder);
  if (!done) {  // no half table stays
    for (const auto& entry : fs::directory_iterator(folder, error)) fs::remove(entry.path(), error);
  }
  return done;
}

}  // namespace osteon
