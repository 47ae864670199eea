// A recording as one HDF5 file. Layout: see docs/file-formats.md.
#include <system_error>

#include "commands/recordings/hdf5_table.h"
#include "commands/recordings/record_export.h"
#include "commands/recordings/record_names.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The rows of one column until they are written together.
template <class T>
class Rows {
 public:
  Rows(hid_t group, const char* name, hid_t type, std::size_t width, const char* unit)
      : column_(group, name, type, width, unit) {}
  void add(const T& value) { rows_.push_back(value); }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) rows_.push_back(v[i]);
  }
  void add(const Quat& q) {
    for (const double part : {q.w(), q.x(), q.y(), q.z()}) rows_.push_back(part);
  }
  bool flush() {
    const bool done = column_.append(std::span<const T>(rows_));
    rows_.clear();
    return done;
  }
  bool close() { return column_.close(); }

 private:
  Hdf5Column column_;
  std::vector<T> rows_;
};

using Numbers = Rows<double>;
using Counts = Rows<std::uint64_t>;
using Texts = Rows<std::string>;

Numbers numbers(hid_t group, const char* name, std::size_t width, const char* unit) {
  return {group, name, H5T_IEEE_F64LE, width, unit};
}
Counts counts(hid_t group, const char* name) { return {group, name, H5T_STD_U64LE, 1, ""}; }

// All of several: each is asked, whatever the others said.
template <class Ask, class... Columns>
bool every(const Ask& ask, Columns&... columns) {
  bool all = true;
  ((all = ask(columns) && all), ...);
  return all;
}

class TickTable {
 public:
  TickTable(hid_t group, double tick_s) : group_(group), tick_s_(tick_s) {}
  void add(const TickRecord& r) {
    tick_.add(r.tick);
    time_.add(static_cast<double>(r.tick) * tick_s_);
    hand_p_.add(r.input.X_WD.p);
    hand_q_.add(r.input.X_WD.q);
    hand_v_.add(r.input.v_W);
    hand_w_.add(r.input.w_W);
    buttons_.add(r.input.buttons);
    proxy_.add(r.p_WP);
    force_.add(r.force_W);
    status_.add(r.status);
    command_.add(static_cast<std::uint64_t>(r.command.kind));
    value_.add(r.command.value);
    step_.add(r.bone_step);
  }
  bool flush() {
    return for_all([](auto& column) { return column.flush(); });
  }
  bool close() {
    return for_all([](auto& column) { return column.close(); });
  }

 private:
  template <class Ask>
  bool for_all(const Ask& ask) {
    return every(ask, tick_, time_, hand_p_, hand_q_, hand_v_, hand_w_, buttons_, proxy_, force_,
                 status_, command_, value_, step_);
  }

  hid_t group_;
  double tick_s_;
  Counts tick_ = counts(group_, "tick");
  Numbers time_ = numbers(group_, "time", 1, "s");
  Numbers hand_p_ = numbers(group_, "hand_position", 3, "m");
  Numbers hand_q_ = numbers(group_, "hand_rotation_wxyz", 4, "1");
  Numbers hand_v_ = numbers(group_, "hand_velocity", 3, "m/s");
  Numbers hand_w_ = numbers(group_, "hand_angular_velocity", 3, "rad/s");
  Counts buttons_ = counts(group_, "buttons");
  Numbers proxy_ = numbers(group_, "proxy_position", 3, "m");
  Numbers force_ = numbers(group_, "force", 3, "N");
  Counts status_ = counts(group_, "status");
  Counts command_ = counts(group_, "command");
  Numbers value_ = numbers(group_, "command_value", 1, "");
  Counts step_ = counts(group_, "bone_step");
};

class EventTable {
 public:
  EventTable(hid_t group, const RecordNames& names, double tick_s)
      : group_(group), names_(names), tick_s_(tick_s) {}
  void add(const Event& e) {
    const EventKindRow* row = find_event_kind(e.kind);
    tick_.add(e.tick);
    time_.add(static_cast<double>(e.tick) * tick_s_);
    hand_.add(names_.hand(e.hand));
    kind_.add(row ? std::string(row->name) : std::to_string(static_cast<int>(e.kind)));
    subject_kind_.add(RecordNames::subject_kind(e));
    subject_.add(names_.subject(e));
    position_.add(e.p_W);
    for (std::size_t i = 0; i < e.values.size(); ++i) {
      values_.add(e.values[i]);
      values_are_.add(row ? std::string(row->value_names[i]) : std::string());
    }
  }
  bool flush() {
    return for_all([](auto& column) { return column.flush(); });
  }
  bool close() {
    return for_all([](auto& column) { return column.close(); });
  }

 private:
  template <class Ask>
  bool for_all(const Ask& ask) {
    return every(ask, tick_, time_, hand_, kind_, subject_kind_, subject_, position_, values_,
                 values_are_);
  }
  Texts texts(const char* name, std::size_t width = 1) const {
    return {group_, name, text_type_.id(), width, ""};
  }

  hid_t group_;
  const RecordNames& names_;
  double tick_s_;
  Hdf5Handle text_type_ = hdf5_text_type();
  Counts tick_ = counts(group_, "tick");
  Numbers time_ = numbers(group_, "time", 1, "s");
  Texts hand_ = texts("hand");
  Texts kind_ = texts("kind");
  Texts subject_kind_ = texts("subject_kind");
  Texts subject_ = texts("subject");
  Numbers position_ = numbers(group_, "position", 3, "m");
  Numbers values_ = numbers(group_, "values", 3, "as values_are says");
  Texts values_are_ = texts("values_are", 3);
};

tl::unexpected<Error> not_written(const fs::path& file) {
  return fail("the file cannot be written", file.string(),
              "Give a name in a writable folder with enough free space");
}

// Some records at a time, however long the recording.
template <class Read, class Table>
Result<void> fill(Table& table, const Read& read, const fs::path& file) {
  for (std::uint64_t next = 1;;) {
    const auto some = read(next);
    if (!some) return tl::unexpected(some.error());
    if (some->empty()) break;
    next += some->size();
    for (const auto& record : *some) table.add(record);
    if (!table.flush()) return not_written(file);
  }
  return table.close() ? Result<void>() : not_written(file);
}

Hdf5Handle make_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
}

bool describe_file(hid_t file, const RecordingReader& recording, double tick_s) {
  const RecordingHeader& header = recording.header();
  return set_hdf5_attribute(file, "case", header.case_name) &&
         set_hdf5_attribute(file, "case_source", header.case_source) &&
         set_hdf5_attribute(file, "osteon_version", header.osteon_version) &&
         set_hdf5_attribute(file, "settings", header.settings_json) &&
         set_hdf5_attribute(file, "frame", "World: as the case's files") &&
         set_hdf5_attribute(file, "complete", recording.complete() ? "yes" : "no") &&
         set_hdf5_attribute(file, "tick_s", tick_s);
}

Result<void> write_hands(RecordingReader& recording, hid_t file, const RecordNames& names,
                         double tick_s, const fs::path& name) {
  const Hdf5Handle hands = make_group(file, "hands");
  if (!hands.ok()) return not_written(name);
  for (std::size_t h = 0; h < recording.header().hands; ++h) {
    const Hdf5Handle group = make_group(hands.id(), hdf5_group_name(names.hand(h)));
    if (!group.ok()) return not_written(name);
    TickTable table(group.id(), tick_s);
    const auto done = fill(
        table, [&](std::uint64_t first) { return recording.read_ticks(h, first); }, name);
    if (!done) return done;
  }
  return {};
}

Result<void> write_events(RecordingReader& recording, hid_t file, const RecordNames& names,
                          double tick_s, const fs::path& name) {
  const Hdf5Handle group = make_group(file, "events");
  if (!group.ok()) return not_written(name);
  EventTable table(group.id(), names, tick_s);
  return fill(
      table, [&](std::uint64_t first) { return recording.read_events(first); }, name);
}

Result<void> write_file(RecordingReader& recording, const fs::path& part, const fs::path& name) {
  Hdf5Handle file(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  if (!file.ok()) return not_written(name);
  const RecordNames names(recording.header());
  const double tick_s = recorded_tick_s(recording.header());
  if (!describe_file(file.id(), recording, tick_s)) return not_written(name);
  if (auto done = write_hands(recording, file.id(), names, tick_s, name); !done) return done;
  if (auto done = write_events(recording, file.id(), names, tick_s, name); !done) return done;
  return file.close() ? Result<void>() : not_written(name);
}

}  // namespace

std::string hdf5_group_name(std::string hand) {
  for (char& c : hand)
    if (c == '/' || c == '.') c = '_';
  return hand;
}

Result<void> export_hdf5(RecordingReader& recording, const fs::path& file,
                         const std::function<Result<void>(const fs::path&)>& more) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its own words are for programmers
  fs::path part = file;
  part += ".part";
  std::error_code error;
  auto done = write_file(recording, part, file);
  if (done && more) done = more(part);
  if (done) fs::rename(part, file, error);
  if (error) done = not_written(file);
  if (!done) fs::remove(part, error);
  return done;
}

}  // namespace osteon
