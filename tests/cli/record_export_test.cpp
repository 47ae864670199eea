// A run of two hands in tables that other programs read: HDF5 by its own library, beside the CSV
// tables and the recording itself.
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "block_case.h"
#include "osteon/record/recording.h"
#include "osteon/scene/event.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

// An open HDF5 file.
class H5 {
 public:
  explicit H5(const std::string& name)
      : file_(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~H5() { H5Fclose(file_); }
  bool ok() const { return file_ >= 0; }

  std::vector<hsize_t> shape(const std::string& name) const {
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (data < 0) return {};
    const hid_t space = H5Dget_space(data);
    std::vector<hsize_t> out(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, out.data(), nullptr);
    H5Sclose(space);
    H5Dclose(data);
    return out;
  }
  std::vector<double> numbers(const std::string& name) const {
    std::vector<double> out(count(name));
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data());
    H5Dclose(data);
    return out;
  }
  std::vector<std::string> texts(const std::string& name) const {
    std::vector<char*> raw(count(name));
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(data);
    H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data());
    std::vector<std::string> out(raw.begin(), raw.end());
    const hid_t space = H5Dget_space(data);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(data);
    return out;
  }
  std::string attribute(const std::string& object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) return "none";
    const hid_t type = H5Aget_type(attribute);
    char* text = nullptr;
    H5Aread(attribute, type, &text);
    std::string out = text ? text : "";
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    return out;
  }

 private:
  std::size_t count(const std::string& name) const {
    std::size_t all = 1;
    for (const hsize_t n : shape(name)) all *= n;
    return all;
  }
  hid_t file_;
};

using Table = std::map<std::string, std::vector<std::string>>;

Table read_csv(const std::string& name) {
  std::ifstream in(name);
  std::string line, cell;
  std::vector<std::string> header;
  std::getline(in, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) header.push_back(cell);
  Table table;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    for (const std::string& column : header) {
      cell.clear();
      std::getline(cells, cell, ',');
      table[column].push_back(cell);
    }
  }
  return table;
}

// The columns of a CSV table that are the rows of one HDF5 dataset.
struct Twin {
  const char* dataset;
  const char* unit;
  std::vector<const char*> columns;
};

const std::vector<Twin>& twins() {
  static const std::vector<Twin> all = {
      {"tick", "", {"tick"}},
      {"time", "s", {"time_s"}},
      {"hand_position", "m", {"hand_x_m", "hand_y_m", "hand_z_m"}},
      {"hand_rotation_wxyz", "1", {"hand_qw", "hand_qx", "hand_qy", "hand_qz"}},
      {"hand_velocity", "m/s", {"hand_vx_m_per_s", "hand_vy_m_per_s", "hand_vz_m_per_s"}},
      {"buttons", "", {"buttons"}},
      {"proxy_position", "m", {"proxy_x_m", "proxy_y_m", "proxy_z_m"}},
      {"force", "N", {"force_x_n", "force_y_n", "force_z_n"}},
      {"status", "", {"status"}},
      {"command", "", {"command"}},
      {"command_value", "", {"command_value"}},
      {"bone_step", "", {"bone_step"}}};
  return all;
}

// Two hands press on a block from above, side by side; the left takes another instrument.
class RecordExport : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  }
  void write_path(const std::string& name, double x_mm, const char* second, double seconds) {
    std::ofstream path(file(name));
    path << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n";
    const char* const first = "hook_probe";
    for (int i = 0; i <= seconds; ++i)
      path << 0.9 * i << ',' << x_mm << ",0," << (i % 2 == 0 ? 24 : 19) << ",1,0,0,0,0,"
           << (i % 4 < 2 ? first : second) << ",0,0,0\n";
  }
  void record(const std::string& name, double seconds) {
    write_path("left.csv", -8, "wrist_hook_probe", seconds);
    write_path("right.csv", 8, "hook_probe", seconds);
    const Ran ran =
        run_osteon("simulate --case " + file("case") + " --hand left=" + file("left.csv") +
                   " --hand right=" + file("right.csv") + " --record " + file(name));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
};

TEST_F(RecordExport, Hdf5AndCsvHoldTheTicksOfBothHandsWithUnits) {
  record("run.osr", 4);
  const Ran ran = run_osteon("record export " + file("run.osr") + " --csv " + file("out") +
                             " --hdf5 " + file("run.h5"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const H5 h5(file("run.h5"));
  ASSERT_TRUE(h5.ok());
  EXPECT_EQ(h5.attribute("/", "complete"), "yes");
  EXPECT_EQ(h5.attribute("/", "case"), "case");
  const auto recording = load_recording(file("run.osr"));
  ASSERT_TRUE(recording) << recording.error().message();
  for (std::size_t h = 0; h < 2; ++h) {
    const std::string hand = h == 0 ? "left" : "right";
    const Table csv = read_csv(file("out/ticks_" + hand + ".csv"));
    const std::vector<TickRecord>& ticks = recording->ticks_of(h);
    ASSERT_EQ(csv.at("tick").size(), ticks.size());
    for (const Twin& twin : twins()) {
      const std::string name = "/hands/" + hand + "/" + twin.dataset;
      SCOPED_TRACE(name);
      EXPECT_EQ(h5.attribute(name, "unit"), twin.unit);
      const std::vector<double> numbers = h5.numbers(name);
      const std::size_t width = twin.columns.size();
      ASSERT_EQ(numbers.size(), ticks.size() * width);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        ASSERT_EQ(numbers[i], std::stod(csv.at(twin.columns[i % width])[i / width])) << i;
    }
    EXPECT_EQ(h5.attribute("/hands/" + hand + "/hand_angular_velocity", "unit"), "rad/s");
    const std::vector<double> force = h5.numbers("/hands/" + hand + "/force");
    double peak = 0;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      for (int k = 0; k < 3; ++k) ASSERT_EQ(force[3 * i + k], ticks[i].force_W[k]) << i;
      peak = std::max(peak, ticks[i].force_W.norm());
    }
    EXPECT_GT(peak, 0.5);
  }
}

TEST_F(RecordExport, Hdf5AndCsvHoldTheEventsByName) {
  record("run.osr", 4);
  const Ran ran = run_osteon("record export " + file("run.osr") + " --csv " + file("out") +
                             " --hdf5 " + file("run.h5"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const H5 h5(file("run.h5"));
  const auto recording = load_recording(file("run.osr"));
  ASSERT_TRUE(recording);
  const std::vector<Event>& events = recording->events;
  ASSERT_GT(events.size(), 5u);
  const Table csv = read_csv(file("out/events.csv"));
  EXPECT_EQ(csv.at("kind"), h5.texts("/events/kind"));
  EXPECT_EQ(csv.at("hand"), h5.texts("/events/hand"));
  EXPECT_EQ(csv.at("subject_kind"), h5.texts("/events/subject_kind"));
  EXPECT_EQ(csv.at("subject"), h5.texts("/events/subject"));
  EXPECT_EQ(h5.attribute("/events/position", "unit"), "m");
  EXPECT_EQ(h5.attribute("/events/time", "unit"), "s");
  const std::vector<double> times = h5.numbers("/events/time");
  const std::vector<double> places = h5.numbers("/events/position");
  const std::vector<double> values = h5.numbers("/events/values");
  const std::vector<std::string> are = h5.texts("/events/values_are");
  std::map<std::string, int> kinds;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const EventKindRow* row = find_event_kind(events[i].kind);
    ASSERT_TRUE(row);
    ++kinds[csv.at("hand")[i] + " " + std::string(row->name)];
    EXPECT_EQ(csv.at("kind")[i], row->name);
    EXPECT_NEAR(times[i], 1e-3 * static_cast<double>(events[i].tick), 1e-12);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(places[3 * i + k], events[i].p_W[static_cast<Eigen::Index>(k)]);
      EXPECT_EQ(values[3 * i + k], events[i].values[k]);
      EXPECT_EQ(are[3 * i + k], row->value_names[k]);
    }
  }
  EXPECT_GT(kinds["left instrument_taken"], 0);
  EXPECT_EQ(kinds["right instrument_taken"], 0);
  for (const char* hand : {"left ", "right "}) {
    EXPECT_GE(kinds[hand + std::string("contact_begin")], 2);
    EXPECT_GE(kinds[hand + std::string("contact_end")], 1);
  }
}

// Peak memory of a command, kB; 0: it failed.
long peak_kb(const std::string& arguments) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string command =
        "exec " + std::string(OSTEON_EXECUTABLE) + " " + arguments + " >/dev/null 2>&1";
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? used.ru_maxrss : 0;
}

// A recording ten times as long, of 80 MB in memory, takes no more of it; and at most 60 kB a
// second and hand.
TEST_F(RecordExport, MemoryDoesNotGrowWithTheLength) {
  record("short.osr", 20);
  record("long.osr", 200);
  EXPECT_LT(static_cast<double>(fs::file_size(file("long.osr"))) / (0.9 * 200) / 2, 60e3);
  const auto of = [&](const std::string& before, const std::string& after = "") {
    SCOPED_TRACE(before);
    const auto to = [&](const char* name) { return after.empty() ? "" : after + file(name); };
    const long little = peak_kb(before + file("short.osr") + to("short.out"));
    const long much = peak_kb(before + file("long.osr") + to("long.out"));
    EXPECT_GT(little, 0);
    EXPECT_GT(much, 0);
    EXPECT_LT(much,
              little + 24'000);  // HDF5's own table of blocks grows to 16 MB, whatever the file
    fs::remove_all(file("short.out"));
    fs::remove_all(file("long.out"));
  };
  of("replay ");
  of("record info --events ");
  of("record export ", " --csv ");
  of("record export ", " --hdf5 ");
}

}  // namespace
}  // namespace osteon::testing_cli
