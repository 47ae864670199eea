// The moment about a hand's grip, from a run to tables that other programs read.
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "block_case.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

// A dataset of rows of three and its unit.
struct Column {
  std::vector<double> numbers;
  std::string unit;
};

Column read_column(const std::string& file, const char* name) {
  Column column;
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t data = H5Dopen2(opened, name, H5P_DEFAULT);
  if (data < 0) return column;
  const hid_t space = H5Dget_space(data);
  column.numbers.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.numbers.data());
  const hid_t unit = H5Aopen(data, "unit", H5P_DEFAULT);
  const hid_t type = H5Aget_type(unit);
  char* text = nullptr;
  if (H5Aread(unit, type, &text) >= 0 && text) column.unit = text;
  if (text) H5free_memory(text);
  H5Tclose(type);
  H5Aclose(unit);
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(opened);
  return column;
}

std::vector<double> read_csv_torques(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "tick,time_s,torque_x_nm,torque_y_nm,torque_z_nm");
  std::vector<double> numbers;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; std::getline(cells, cell, ','); ++i)
      if (i >= 2) numbers.push_back(std::stod(cell));
  }
  return numbers;
}

// A probe lies across the block, its tip beyond the edge, and is pressed down.
class RecordTorque : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_).exit_code, 0);
    std::ofstream path(file("press.csv"));
    path << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n";
    const char* turn = "0.70710678118654752,0,0.70710678118654752,0,0";
    path << "0,-40,0,35," << turn << ",hook_probe,0,0,0\n";
    path << "0.4,-40,0,20," << turn << ",,0,0,0\n";
    path << "0.8,-40,0,18," << turn << ",,0,0,0\n";
    path.close();
    const Ran ran = run_osteon("simulate --case " + file("case") + " --path " + file("press.csv") +
                               " --record " + file("run.osr") + " --report " + file("report.json"));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
};

TEST_F(RecordTorque, CsvHdf5InfoAndReportTellTheSame) {
  const Ran ran = run_osteon("record export " + file("run.osr") + " --torque --csv " + file("out") +
                             " --hdf5 " + file("run.h5"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  std::vector<std::string> tables;
  for (const auto& entry : fs::directory_iterator(file("out")))
    if (entry.path().filename().string().starts_with("torque_"))
      tables.push_back(entry.path().string());
  ASSERT_EQ(tables.size(), 1u);
  const std::vector<double> csv = read_csv_torques(tables[0]);
  const std::string hand = fs::path(tables[0]).stem().string().substr(7);
  const Column torque = read_column(file("run.h5"), ("/hands/" + hand + "/torque").c_str());
  EXPECT_EQ(torque.unit, "N m");
  EXPECT_EQ(torque.numbers, csv);
  EXPECT_EQ(read_column(file("run.h5"), ("/hands/" + hand + "/force").c_str()).numbers.size(),
            csv.size());
  double peak = 0;
  for (std::size_t i = 0; i + 2 < csv.size(); i += 3)
    peak = std::max(peak, std::hypot(csv[i], csv[i + 1], csv[i + 2]));
  EXPECT_GT(peak, 0.05);
  std::ifstream in(file("report.json"));
  EXPECT_NEAR(nlohmann::json::parse(in)["torque"]["peak_nm"].get<double>(), peak, 1e-12);
  const Ran told = run_osteon("record info --torque --json " + file("run.osr"));
  ASSERT_EQ(told.exit_code, 0) << told.output;
  const auto json = nlohmann::json::parse(told.output.substr(told.output.find('{')));
  EXPECT_NEAR(json["hands"][hand]["torque"]["peak_nm"].get<double>(), peak, 1e-12);
}

// The run cannot be repeated: no table and no half file.
TEST_F(RecordTorque, WithoutTheCaseNothingIsLeftBehind) {
  fs::remove_all(file("case"));
  const Ran ran =
      run_osteon("record export " + file("run.osr") + " --torque --hdf5 " + file("run.h5"));
  EXPECT_EQ(ran.exit_code, 2) << ran.output;
  EXPECT_FALSE(fs::exists(file("run.h5")));
  EXPECT_FALSE(fs::exists(file("run.h5.part")));
}

}  // namespace
}  // namespace osteon::testing_cli
