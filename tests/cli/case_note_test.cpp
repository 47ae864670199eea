// Notes on a case: written, listed, removed, carried along, and refused where they are none.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "block_case.h"

namespace osteon::testing_cli {
namespace {

class CaseNote : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  }
  Ran note(const std::string& arguments) const {
    return run_osteon("case note " + file("case") + " " + arguments);
  }
  nlohmann::json listed(const std::string& name) const {
    const Ran ran = run_osteon("case info " + file(name) + " --json");
    return ran.exit_code == 0 ? nlohmann::json::parse(ran.output)["notes"] : nlohmann::json();
  }
};

TEST_F(CaseNote, IsWrittenListedAndRemoved) {
  ASSERT_EQ(note("--at 1,-2,30 --text 'Come in \"here\"'").exit_code, 0);
  const Ran second = note("--on block --at 0,0,20 --text 'The top' --out " + file("noted"));
  ASSERT_EQ(second.exit_code, 0) << second.output;
  const nlohmann::json own = listed("case"), both = listed("noted");
  ASSERT_EQ(own.size(), 1u);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0]["text"], "Come in \"here\"");
  EXPECT_EQ(both[0]["bone"], "");
  EXPECT_NEAR(both[0]["at_mm"][1].get<double>(), -2, 1e-9);
  EXPECT_EQ(both[1]["bone"], "block");
  EXPECT_NEAR(both[1]["at_mm"][2].get<double>(), 20, 1e-9);
  const Ran info = run_osteon("case info " + file("noted"));
  EXPECT_NE(info.output.find("note 2 (block, at 0.0 0.0 20.0 mm): The top"), std::string::npos)
      << info.output;
  ASSERT_EQ(run_osteon("case note " + file("noted") + " --remove 1").exit_code, 0);
  ASSERT_EQ(listed("noted").size(), 1u);
  EXPECT_EQ(listed("noted")[0]["text"], "The top");
  EXPECT_EQ(note("--remove 2").exit_code, 2);
  EXPECT_EQ(listed("case").size(), 1u);
}

TEST_F(CaseNote, WithoutAPlaceIsOnTheBonesMiddle) {
  ASSERT_EQ(note("--on block --text middle").exit_code, 0);
  const nlohmann::json notes = listed("case");
  ASSERT_EQ(notes.size(), 1u);
  for (const nlohmann::json& mm : notes[0]["at_mm"]) EXPECT_NEAR(mm.get<double>(), 0, 1e-6);
}

TEST_F(CaseNote, BadInputIsRefusedAndChangesNothing) {
  const auto refused = [&](const std::string& arguments, const std::string& word) {
    const Ran ran = note(arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments;
    EXPECT_NE(ran.output.find(word), std::string::npos) << arguments << ": " << ran.output;
  };
  refused("--text a", "--on");
  refused("--on block", "--text");
  refused("--on lunate --text a", "no bone 'lunate'");
  refused("--at 1,2 --text a", "--at");
  refused("--at 1,2,nan --text a", "--at");
  refused("--at 0,0,9000 --text a", "2 m");
  refused("--on block --text ' '", "has no text");
  refused("--remove 1 --text a", "--remove");
  refused("--on block --text a --out " + file("meshes"), "meshes");
  EXPECT_FALSE(fs::exists(dir_ / "case/notes.toml"));
  EXPECT_EQ(run_osteon("case note builtin:wrist --on lunate --text a").exit_code, 2);
  std::ofstream(dir_ / "case/notes.toml") << "format = 1\n[[notes]]\ntext = \"a\"\n";
  EXPECT_EQ(run_osteon("case info " + file("case")).exit_code, 2);
  const Ran check = run_osteon("case check " + file("case"));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.output.find("notes.toml:2"), std::string::npos) << check.output;
}

}  // namespace
}  // namespace osteon::testing_cli
