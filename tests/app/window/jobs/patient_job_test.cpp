#include "window/jobs/window_jobs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "osteon/base/file.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

using PatientJob = SideJob<SavedPatient>;

class PatientJobTest : public ::testing::Test {
 protected:
  ~PatientJobTest() override { fs::remove_all(folder); }
  fs::path folder = fs::temp_directory_path() / ("osteon_patient_" + std::to_string(::getpid()));
};

TEST_F(PatientJobTest, WhatThereIsNotIsSaidAndNothingIsLeft) {
  PatientJob job(save_patient({.anatomy = "hip"}, folder / "hip"));
  job.wait();
  const auto saved = job.take();
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().message().find("hip"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "hip"));
}

TEST_F(PatientJobTest, AFolderThatHoldsSomethingIsKept) {
  fs::create_directories(folder);
  ASSERT_TRUE(write_file_atomic(folder / "notes", "mine"));
  PatientJob job(save_patient({}, folder));
  job.wait();
  EXPECT_FALSE(job.take());
  EXPECT_EQ(read_file(folder / "notes", 100).value_or(""), "mine");
}

TEST_F(PatientJobTest, OneThatIsStoppedLeavesNothing) {
  PatientJob job(save_patient({.seed = 7}, folder / "wrist"));
  job.cancel();
  job.wait();
  EXPECT_FALSE(job.take());
  EXPECT_FALSE(fs::exists(folder / "wrist"));
}

TEST_F(PatientJobTest, ThePatientIsAsOrderedAndItsFolderSaysHowToMakeItAgain) {
  const PatientOrder order{.seed = 7,
                           .set = {{"radial_inclination_deg", 18.1}},
                           .findings = {{"geissler", "3"}},
                           .side = "left"};
  PatientJob job(save_patient(order, folder / "wrist"));
  job.wait();
  const auto saved = job.take();
  ASSERT_TRUE(saved) << saved.error().message();
  EXPECT_EQ(saved->folder, folder / "wrist");
  const auto def = load_case(folder / "wrist");
  ASSERT_TRUE(def) << def.error().message();
  EXPECT_EQ(def->side, "left");
  ASSERT_EQ(def->findings.size(), 1u);
  EXPECT_EQ(def->findings[0].name, "geissler");
  const std::string toml = read_file(folder / "wrist/case.toml", 1 << 20).value_or("");
  EXPECT_TRUE(
      toml.starts_with("# Made by: osteon anatomy make wrist --seed 7 "
                       "--set radial_inclination_deg=18.1 --finding geissler=3 "
                       "--side left\n"))
      << toml.substr(0, 200);
  EXPECT_NE(toml.find("# radial_inclination_deg = 18.1\n"), std::string::npos);
}

}  // namespace
}  // namespace osteon
