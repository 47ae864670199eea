// Varied anatomy through the command line alone.
#include "osteon/base/file.h"
#include "osteon/scene/case_io.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class Anatomy : public CliTest {
 protected:
  std::string text_of(const std::string& name) { return read_file(file(name)).value_or(""); }
  // Expects the files of one folder in the other, byte by byte; how many there are.
  std::size_t same_files(const std::string& one, const std::string& other) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(file(one))) {
      const std::string name = entry.path().filename().string();
      EXPECT_EQ(text_of(one + "/" + name), text_of(other + "/" + name)) << name;
      ++files;
    }
    return files;
  }
};

TEST_F(Anatomy, ListSaysMeanDeviationRangeAndSource) {
  const Ran ran = run_osteon("anatomy list wrist");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  for (const char* word : {"radial_inclination_deg", "3.8", "32", "400 films", "mean", "sd",
                           "numbers that shape each bone", "scaphoid                59"})
    EXPECT_NE(ran.output.find(word), std::string::npos) << word << " in\n" << ran.output;
}

TEST_F(Anatomy, AKneeIsMadeAgainByItsSeedAndChecksSound) {
  for (const char* name : {"a", "b"}) {
    const Ran ran =
        run_osteon("anatomy make knee --seed 7 --set notch_width_mm=18 --out " + file(name));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  const std::size_t files = same_files("a", "b");
  EXPECT_EQ(files, 4u + 16u + 1u) << "four bones, sixteen soft parts and case.toml";
  EXPECT_NE(text_of("a/case.toml").find("# notch_width_mm = 18\n"), std::string::npos);
  const auto def = load_case(file("a"));
  ASSERT_TRUE(def) << def.error().message();
  EXPECT_EQ(check_case(*def), std::vector<std::string>{});
}

// Bent and stretched again it is the same knee, to the byte; its bones stay what they are.
TEST_F(Anatomy, ASavedKneeIsBentAndStretchedAgain) {
  ASSERT_EQ(run_osteon("anatomy make knee --set notch_width_mm=19 --side left --out " + file("a"))
                .exit_code,
            0);
  const Ran bent = run_osteon("case pose " + file("a") + " --flexion 75 --out " + file("bent"));
  ASSERT_EQ(bent.exit_code, 0) << bent.output;
  for (const char* bone : {"femur.stl", "tibia.stl", "patella.stl"})
    EXPECT_EQ(text_of(std::string("a/") + bone), text_of(std::string("bent/") + bone)) << bone;
  const auto def = load_case(file("bent"));
  ASSERT_TRUE(def) << def.error().message();
  EXPECT_EQ(check_case(*def), std::vector<std::string>{});
  ASSERT_EQ(def->joints.size(), 1u);
  EXPECT_EQ(def->joints[0].at_deg, 75);
  EXPECT_NEAR(def->bones[1].X_WB.q.angularDistance(Quat::Identity()), 1.33, 0.05);
  const Ran back = run_osteon("case pose " + file("bent") + " --flexion 0 --out " + file("back"));
  ASSERT_EQ(back.exit_code, 0) << back.output;
  for (const char* part : {"acl.stl", "skin.stl", "medial_meniscus.stl", "tibia.stl"})
    EXPECT_EQ(text_of(std::string("a/") + part), text_of(std::string("back/") + part)) << part;
  EXPECT_NE(text_of("a/acl.stl"), text_of("bent/acl.stl"));
}

TEST_F(Anatomy, WhatCannotBeBentIsRefused) {
  for (const std::string bad : {"builtin:wrist --flexion 20", "builtin:knee --flexion 190"}) {
    const Ran ran = run_osteon("case pose " + bad + " --out " + file("never"));
    EXPECT_EQ(ran.exit_code, 2) << ran.output;
    EXPECT_FALSE(fs::exists(file("never")));
  }
}

TEST_F(Anatomy, ListSaysFindingsAndTheirGrades) {
  const Ran ran = run_osteon("anatomy list knee");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  for (const char* word : {"acl_tear", "midsubstance", "meniscal_tear", "cartilage_lesion"})
    EXPECT_NE(ran.output.find(word), std::string::npos) << word << " in\n" << ran.output;
}

TEST_F(Anatomy, ACaseWithFindingsSaysSoAndChecksSound) {
  const Ran made = run_osteon(
      "anatomy make wrist --finding scaphoid_fracture=nonunion --finding tfcc_tear=1A --out " +
      file("ill"));
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_NE(text_of("ill/case.toml")
                .find("make wrist --finding scaphoid_fracture=nonunion --finding tfcc_tear=1A\n"),
            std::string::npos);
  const auto def = load_case(file("ill"));
  ASSERT_TRUE(def) << def.error().message();
  EXPECT_EQ(check_case(*def), std::vector<std::string>{});
  EXPECT_EQ(def->bones.size(), 16u);
  ASSERT_EQ(def->findings.size(), 2u);
  EXPECT_EQ(def->findings[0].name, "scaphoid_fracture");
  EXPECT_EQ(def->findings[0].grade, "nonunion");
  EXPECT_NE(def->findings[1].meaning.find("central"), std::string::npos);
  const Ran info = run_osteon("case info " + file("ill") + "#hull");
  EXPECT_EQ(info.exit_code, 0) << info.output;
  EXPECT_NE(info.output.find("finding scaphoid_fracture=nonunion: "), std::string::npos)
      << info.output;
  EXPECT_NE(info.output.find("scaphoid_proximal"), std::string::npos) << info.output;
}

TEST_F(Anatomy, BadRequestsExitWithTwoAndWriteNothing) {
  for (const char* bad :
       {"wrist --set radial_inclination_deg=80", "wrist --set nose_mm=1", "wrist --set nonsense",
        "wrist --set volar_tilt_deg=", "wrist --set volar_tilt_deg=9x", "wrist --side upper",
        "wrist --seed x", "elbow", "wrist --finding geissler", "wrist --finding geissler=9",
        "wrist --finding gout=1", "wrist --finding geissler=2 --finding geissler=3"}) {
    const Ran ran = run_osteon("anatomy make " + std::string(bad) + " --out " + file("never"));
    EXPECT_EQ(ran.exit_code, 2) << bad << ": " << ran.output;
    EXPECT_FALSE(fs::exists(file("never"))) << bad;
  }
}

TEST_F(Anatomy, TheSameSeedGivesTheSameBytesAndACaseThatChecksSound) {
  const std::string make = "anatomy make wrist --seed 7 --set radial_inclination_deg=18 --out ";
  for (const char* name : {"a", "b"}) {
    const Ran ran = run_osteon(make + file(name));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  const std::size_t files = same_files("a", "b");
  EXPECT_EQ(files, 15u + 39u + 1u) << "fifteen bones, 39 soft parts and case.toml";
  const std::string text = text_of("a/case.toml");
  EXPECT_NE(text.find("--seed 7 --set radial_inclination_deg=18"), std::string::npos);
  EXPECT_NE(text.find("# radial_inclination_deg = 18\n"), std::string::npos);
  const auto def = load_case(file("a"));
  ASSERT_TRUE(def) << def.error().message();
  EXPECT_EQ(check_case(*def), std::vector<std::string>{});
  EXPECT_EQ(def->bones.size(), 15u);
  EXPECT_EQ(run_osteon(make + file("a")).exit_code, 2) << "a folder that holds files stays";
}

}  // namespace
}  // namespace osteon::testing_cli
