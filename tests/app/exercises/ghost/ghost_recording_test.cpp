#include "exercises/ghost/ghost_recording.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "cases/open_case.h"
#include "commands/teaching/scenario_run.h"
#include "exercises/ghost/ghost_file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class GhostRecording : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_ghost_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
    const char* cache = std::getenv("XDG_CACHE_HOME");
    had_cache_ = cache != nullptr;
    cache_ = cache ? cache : "";
    ::setenv("XDG_CACHE_HOME", (dir_ / "cache").c_str(), 1);
    want("fast_telescoping");
  }
  void want(const std::string& exercise) {
    const auto scenario = open_scenario(exercise);
    ASSERT_TRUE(scenario) << scenario.error().message();
    wanted_.scenario = *scenario;
    wanted_.case_spec = case_spec_of(*scenario, "", std::nullopt);
    const auto the_case = open_case(wanted_.case_spec, {}, CaseParts::kFelt);
    ASSERT_TRUE(the_case) << the_case.error().message();
    wanted_.case_hash = (*the_case)->hash;
  }
  void TearDown() override {
    if (had_cache_)
      ::setenv("XDG_CACHE_HOME", cache_.c_str(), 1);
    else
      ::unsetenv("XDG_CACHE_HOME");
    fs::remove_all(dir_);
  }
  void record(const fs::path& file, const std::string& surgeon,
              const std::string& to_stage = "") const {
    ScenarioRun run;
    run.scenario = wanted_.scenario;
    run.case_spec = wanted_.case_spec;
    run.skill = *parse_skill(wanted_.scenario, surgeon);
    run.record_to = file;
    run.to_stage = to_stage;
    const auto done = run_scenario(run);
    ASSERT_TRUE(done) << done.error().message();
  }
  // Stands for this program: leaves a recording where it is told to, and counts.
  fs::path program(const fs::path& recording) const {
    const fs::path script = dir_ / "program";
    std::ofstream(script) << "#!/bin/sh\nfor last; do :; done\necho \"$@\" >> '" << dir_.string()
                          << "/runs'\ncp '" << recording.string() << "' \"$last\"\n";
    fs::permissions(script, fs::perms::owner_all);
    return script;
  }
  std::string asked() const {
    std::ifstream in(dir_ / "runs");
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t runs() const {
    std::ifstream in(dir_ / "runs");
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);) ++count;
    return count;
  }
  static bool go_on() { return true; }

  fs::path dir_;
  std::string cache_;
  bool had_cache_ = false;
  GhostWanted wanted_;
};

TEST_F(GhostRecording, ShowsTheWayAndTheExpertIsRecordedOnce) {
  const fs::path file = dir_ / "expert.osr";
  record(file, "expert");
  std::vector<GhostTrack> parts;
  const auto track =
      ghost_of_recording(file, wanted_, [&](GhostTrack part) { parts.push_back(std::move(part)); });
  ASSERT_TRUE(track) << track.error().message();
  ASSERT_EQ(parts.size(), track->stretches.size()) << "each step is shown as soon as it is known";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ASSERT_EQ(parts[i].stretches.size(), i + 1);
    EXPECT_EQ(parts[i].stretches.back().to, track->stretches[i].to);
    EXPECT_GT(parts[i].hands.front().size(), parts[i].stretches.back().to);
    EXPECT_EQ(parts[i].tray, track->tray);
  }
  EXPECT_EQ(track->hands.size(), wanted_.scenario.hands.size());
  EXPECT_EQ(track->stretches.back().stage, wanted_.scenario.stages.size() - 1);
  EXPECT_GE(track->stretches.size(), wanted_.scenario.stages.size());
  ASSERT_FALSE(track->tray.empty());
  EXPECT_NE(track->tray.front().find("arthroscope"), std::string::npos) << track->tray.front();
  const auto first = ghost_at(*track, 0, 0, 0.5);
  ASSERT_TRUE(first);
  EXPECT_LT(first->X_WT.p.norm(), 0.3);

  GhostWanted other = wanted_;
  ++other.case_hash;
  const auto stranger = ghost_of_recording(file, other);
  ASSERT_FALSE(stranger);
  EXPECT_NE(stranger.error().message().find("another patient"), std::string::npos);
  other = wanted_;
  other.scenario.name = "touch_bones";
  const auto work = ghost_of_recording(file, other);
  ASSERT_FALSE(work);
  EXPECT_NE(work.error().message().find("'fast_telescoping', not of 'touch_bones'"),
            std::string::npos)
      << work.error().message();
  EXPECT_FALSE(ghost_of_recording(dir_ / "none.osr", wanted_));

  const fs::path script = program(file);
  for (int time = 0; time < 2; ++time) {
    std::size_t repeated = 0;
    const auto made =
        ghost_of_expert(wanted_, go_on, script, [&](const GhostTrack&) { ++repeated; });
    ASSERT_TRUE(made) << made.error().message();
    EXPECT_EQ(made->stretches.size(), track->stretches.size());
    EXPECT_EQ(made->hands.front().size(), track->hands.front().size());
    EXPECT_EQ(repeated > 0, time == 0) << "its way is kept, too";
  }
  EXPECT_EQ(runs(), 1u) << "the second time it was kept";
  std::ofstream(expert_recording(wanted_)) << "damaged";
  EXPECT_TRUE(ghost_of_expert(wanted_, go_on, script));
  EXPECT_EQ(runs(), 2u);
  for (const auto& entry : fs::directory_iterator(expert_recording(wanted_).parent_path()))
    EXPECT_EQ(entry.path().string().rfind(expert_recording(wanted_).string(), 0), 0u);
  const fs::path way = expert_recording(wanted_).string() + ".way";
  ASSERT_TRUE(fs::exists(way));
  std::ofstream(way) << "damaged";
  EXPECT_TRUE(ghost_of_expert(wanted_, go_on, script)) << "repeated once more";
  EXPECT_EQ(runs(), 2u);
}

TEST_F(GhostRecording, WhoPlaysCanKeepHisWayHimself) {
  ScenarioRun run;
  run.scenario = wanted_.scenario;
  run.case_spec = wanted_.case_spec;
  run.skill = *parse_skill(wanted_.scenario, "expert");
  run.record_to = dir_ / "expert.osr";
  const auto without = run_scenario(run);
  ASSERT_TRUE(without) << without.error().message();
  EXPECT_FALSE(without->way);
  fs::remove(*run.record_to);
  run.keeps_way = true;
  const auto done = run_scenario(run);
  ASSERT_TRUE(done) << done.error().message();
  ASSERT_TRUE(done->way);
  const auto repeated = ghost_of_recording(*run.record_to, wanted_);
  ASSERT_TRUE(repeated) << repeated.error().message();
  EXPECT_EQ(to_bytes(*done->way, 1), to_bytes(*repeated, 1)) << "bit by bit";
}

// Who practises an early stage does not wait for the whole exercise.
TEST_F(GhostRecording, APartIsPlayedNoFartherThanItGoes) {
  want("touch_bones");
  GhostWanted part = wanted_;
  part.to_stage = wanted_.scenario.stages.front().name;
  const fs::path file = dir_ / "part.osr";
  record(file, "expert", part.to_stage);
  const auto way = ghost_of_expert(part, go_on, program(file));
  ASSERT_TRUE(way) << way.error().message();
  EXPECT_EQ(way->stretches.back().stage, 0u);
  EXPECT_NE(asked().find("--to-stage " + part.to_stage), std::string::npos) << asked();
  EXPECT_NE(asked().find("--way "), std::string::npos) << asked();
  EXPECT_EQ(kept_expert(part), expert_recording(part));
  EXPECT_NE(expert_recording(part), expert_recording(wanted_)) << "it is no whole one";
  EXPECT_FALSE(fs::exists(expert_recording(wanted_)));
  record(expert_recording(wanted_), "expert");
  EXPECT_EQ(kept_expert(part), expert_recording(wanted_)) << "which serves a part as well";
  const auto whole = ghost_of_expert(part, go_on, "/nowhere/osteon");
  ASSERT_TRUE(whole) << whole.error().message();
  EXPECT_GT(whole->stretches.size(), way->stretches.size());
}

TEST_F(GhostRecording, WhoDoesNotPassIsNoExample) {
  const fs::path file = dir_ / "bad.osr";
  record(file, "bad:" + wanted_.scenario.errors.front().name);
  const auto made = ghost_of_expert(wanted_, go_on, program(file));
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message().find("does not pass"), std::string::npos)
      << made.error().message();
}

TEST_F(GhostRecording, AProgramThatFailsOrIsStoppedIsNoGhost) {
  const auto failed = ghost_of_expert(wanted_, go_on, "/nowhere/osteon");
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message().find("could not perform"), std::string::npos);
  const fs::path script = dir_ / "sleeper";
  std::ofstream(script) << "#!/bin/sh\nexec sleep 60\n";
  fs::permissions(script, fs::perms::owner_all);
  int asked = 0;
  EXPECT_FALSE(ghost_of_expert(
      wanted_, [&] { return ++asked < 3; }, script));
  EXPECT_EQ(asked, 3);
  EXPECT_FALSE(fs::exists(expert_recording(wanted_)));
}

}  // namespace
}  // namespace osteon
