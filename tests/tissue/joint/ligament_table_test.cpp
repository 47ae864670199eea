#include "osteon/tissue/ligament_table.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace osteon {
namespace {

class FeltTable : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            ("osteon_felt_" + std::to_string(::getpid()) + ".toml");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  Result<LigamentTable> read(const std::string& text) const {
    std::ofstream(file_) << text;
    return load_felt_table(file_);
  }
  std::filesystem::path file_;
};

const std::string kRow =
    "[[ligament]]\nname = \"a\"\npart = \"p\"\nover = \"scaphoid\"\nfailure_n = 118\n"
    "[[ligament.bundle]]\nname = \"all\"\nstiffness_n = 164\nstrain = 0.03\n";

TEST_F(FeltTable, ReadsWhatIsFeltAlone) {
  const auto table = read(
      "toe_strain = 0.02\n[disc]\npart = \"d\"\nyoung_kpa = 370\ntension_kpa = 950\n"
      "[[torn]]\nfinding = \"f\"\nligament = \"a\"\nleft = 0.5\nstrain = -0.1\n" +
      kRow);
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_EQ(table->toe_strain, 0.02);
  EXPECT_EQ(table->disc.young_pa, 370e3);
  EXPECT_EQ(table->disc.tension_pa, 950e3);
  ASSERT_EQ(table->ligaments.size(), 1u);
  EXPECT_EQ(table->ligaments[0].over_bone, "scaphoid");
  EXPECT_EQ(table->ligaments[0].failure_n, 118);
  EXPECT_EQ(table->ligaments[0].bundles[0].stiffness_n, 164);
  EXPECT_EQ(table->torn[0].strain.value_or(0), -0.1);
}

TEST_F(FeltTable, WhatIsMissingOrUnknownIsNamed) {
  for (const auto& [text, named] : std::vector<std::pair<std::string, std::string>>{
           {kRow, "toe_strain"},
           {"toe_strain = 0.02\nwidth_mm = 8\n" + kRow, "width_mm"},
           {"toe_strain = 0.02\n[[torn]]\nfinding = \"f\"\nligament = \"b\"\nleft = 1\n" + kRow,
            "names no ligament: 'b'"},
           {"toe_strain = 0.02\n[disc]\npart = \"d\"\n" + kRow, "young_kpa"}}) {
    const auto table = read(text);
    ASSERT_FALSE(table) << text;
    EXPECT_NE(table.error().message().find(named), std::string::npos) << table.error().message();
  }
}

}  // namespace
}  // namespace osteon
