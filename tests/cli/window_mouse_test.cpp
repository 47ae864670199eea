// Two hands by one mouse, with real key and wheel events on a display of its own: a scope in one
// portal, a probe in others, the lunate touched, hands and instrument changed, and a step undone.
#include <gtest/gtest.h>

#include <fstream>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

bool no_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) != 0;
}

// G brings the hand before the next portal, M takes it, the wheel goes in (4) and out (5).
constexpr const char* kScript = R"sh(
"$OSTEON" window --case 'builtin:wrist#hull' --size 800x600 \
  --device mouse:left=wrist_arthroscope_2_7 --device mouse:right=wrist_hook_probe \
  --record run.osr > out.txt 2>&1 &
window=$!
for i in $(seq 600); do [ -f run.osr ] && break; sleep 0.2; done
sleep 1
k() { for key in "$@"; do xdotool key "$key"; sleep 0.3; done; sleep 0.4; }
wheel() { for i in $(seq "$2"); do xdotool click "$1"; sleep 0.03; done; sleep 0.5; }
xdotool mousemove 400 300
k g g m; wheel 4 12; k m
k x g g g m; wheel 4 20; wheel 5 20; k m
k g m; wheel 4 20; k m
k k Next; k u
xdotool key ctrl+q
wait $window
)sh";

// The briefing is begun by Enter; M takes the probe, J ends the attempt, which is judged then.
constexpr const char* kExercise = R"sh(
"$OSTEON" window --case 'builtin:wrist#hull' --exercise touch_bones --size 800x600 > out.txt 2>&1 &
window=$!
sleep 1
for i in $(seq 600); do
  ls osteon/recordings/touch_bones*.osr > found 2> /dev/null && break
  xdotool key Return; sleep 0.3
done
xdotool mousemove 400 300
xdotool key m; sleep 0.3
for i in $(seq 15); do xdotool click 4; sleep 0.03; done
sleep 0.5
xdotool key m j
for i in $(seq 300); do
  "$OSTEON" results list --json > list.json; grep -q touch_bones list.json && break; sleep 0.2
done
xdotool key ctrl+q
wait $window
)sh";

class WindowByMouse : public CliTest {
 protected:
  int play(const char* script) const {
    std::ofstream(file("play.sh")) << script;
    return std::system(("cd " + dir_.string() + " && XDG_CONFIG_HOME=" + dir_.string() +
                        " XDG_DATA_HOME=" + dir_.string() +
                        " OSTEON=" OSTEON_EXECUTABLE " " OSTEON_SOURCE_DIR
                        "/tools/with-display 800x600 bash play.sh")
                           .c_str());
  }
};

TEST_F(WindowByMouse, AnExerciseIsBegunPlayedEndedJudgedAndKept) {
  for (const char* program : {"Xvfb", "xdotool"})
    if (no_program(program)) GTEST_SKIP() << program << " is not installed";
  ASSERT_EQ(play(kExercise), 0);
  std::ifstream list(file("list.json"));
  const std::string kept{std::istreambuf_iterator<char>(list), {}};
  EXPECT_NE(kept.find("\"scenario\": \"touch_bones\""), std::string::npos) << kept;
  EXPECT_NE(kept.find("\"verdict\": \"not_passed\""), std::string::npos) << kept;
  std::ifstream found(file("found"));
  std::string recording;
  ASSERT_TRUE(std::getline(found, recording));
  const Ran debrief = run_osteon("debrief " + file(recording) + " --out " + file("pages.pdf"));
  EXPECT_EQ(debrief.exit_code, 0) << debrief.output;
  EXPECT_NE(debrief.output.find("not_passed"), std::string::npos) << debrief.output;
}

TEST_F(WindowByMouse, AScopeAndAProbeAreLedThroughPortalsAndTheLunateIsTouched) {
  for (const char* program : {"Xvfb", "xdotool"})
    if (no_program(program)) GTEST_SKIP() << program << " is not installed";
  ASSERT_EQ(play(kScript), 0);
  const Ran told = run_osteon("record info " + file("run.osr") + " --events");
  ASSERT_EQ(told.exit_code, 0) << told.output;
  const auto tells = [&](const std::string& what) {
    return told.output.find(what) != std::string::npos;
  };
  EXPECT_TRUE(tells("left  portal_entered")) << told.output;
  EXPECT_TRUE(tells("right  portal_entered"));
  EXPECT_TRUE(tells("right  contact_begin  bone lunate"));
  EXPECT_TRUE(tells("right  instrument_taken"));
  EXPECT_TRUE(tells("mark  restore point 1"));
  EXPECT_TRUE(tells("restored  restore point 1"));
}

}  // namespace
}  // namespace osteon::testing_cli
