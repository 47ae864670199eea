// Two hands by one mouse, with real key and wheel events on a display of its own: a scope in one
// portal, a probe in others, the lunate touched, hands and instrument changed, and a step undone.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

bool no_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) != 0;
}

// G brings the hand before the next portal (3-4, 4-5, 6R, MCR, MCU) that no other hand is in, M
// takes it, the wheel goes in (4) and out (5). The dorsal rim of the radius lies straight under
// 4-5: the probe goes in a little farther distal and ulnar, and swings about the portal on to the
// lunate. It is withdrawn and put into MCU.
constexpr const char* kScript = R"sh(
"$OSTEON" window --case builtin:wrist --size 800x600 \
  --device mouse:left=wrist_arthroscope_1_9 --device mouse:right=wrist_hook_probe \
  --record run.osr > out.txt 2>&1 &
window=$!
for i in $(seq 600); do [ -f run.osr ] && break; sleep 0.2; done
sleep 1
k() { for key in "$@"; do xdotool key "$key"; sleep 0.3; done; sleep 0.4; }
wheel() { for i in $(seq "$2"); do xdotool click "$1"; sleep 0.03; done; sleep 0.5; }
move() { for i in $(seq "$3"); do xdotool mousemove_relative -- "$1" "$2"; sleep 0.03; done; sleep 0.5; }
xdotool mousemove 400 300
k g m; move 0 -1 8; wheel 4 12; k m
k x g m; move 0 -1 10; move 1 0 2; wheel 4 9; wheel 4 6; wheel 5 22; k m
k g g g m; move 0 1 6; wheel 4 16; k m
k k Next; k u
xdotool key ctrl+q
wait $window
)sh";

// The window is told no size. The briefing is begun by Enter; M takes the probe, J, pressed twice,
// ends the attempt, which is judged then.
constexpr const char* kExercise = R"sh(
"$OSTEON" window --case 'builtin:wrist#hull' --exercise touch_bones > out.txt 2>&1 &
window=$!
sleep 1
for i in $(seq 600); do
  ls osteon/recordings/touch_bones*.osr > found 2> /dev/null && break
  xdotool key Return; sleep 0.3
done
xdotool search --name Osteon getwindowgeometry > size.txt
xdotool mousemove 400 300
xdotool key m; sleep 0.3
for i in $(seq 15); do xdotool click 4; sleep 0.03; done
sleep 0.5
xdotool key m j; sleep 0.5; xdotool key j
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
  std::string text_of(const char* name) const {
    std::ifstream in(file(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(WindowByMouse, AnExerciseIsBegunPlayedEndedJudgedAndKept) {
  for (const char* program : {"Xvfb", "xdotool"})
    if (no_program(program)) GTEST_SKIP() << program << " is not installed";
  ASSERT_EQ(play(kExercise), 0);
  EXPECT_NE(text_of("size.txt").find("Geometry: 800x600"), std::string::npos)
      << "no larger than the screen: " << text_of("size.txt");
  const std::string kept = text_of("list.json");
  EXPECT_NE(kept.find("\"scenario\": \"touch_bones\""), std::string::npos) << kept;
  EXPECT_NE(kept.find("\"verdict\": \"not_passed\""), std::string::npos) << kept;
  std::ifstream found(file("found"));
  std::string recording;
  ASSERT_TRUE(std::getline(found, recording));
  const Ran debrief = run_osteon("debrief " + file(recording) + " --out " + file("pages.pdf"));
  EXPECT_EQ(debrief.exit_code, 0) << debrief.output;
  EXPECT_NE(debrief.output.find("not_passed"), std::string::npos) << debrief.output;
}

// What happened, in order.
std::vector<nlohmann::json> events_of(const std::string& recording) {
  const Ran told = run_osteon("record info " + recording + " --events --json");
  EXPECT_EQ(told.exit_code, 0) << told.output;
  std::vector<nlohmann::json> events;
  std::istringstream lines(told.output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('{')) events.push_back(nlohmann::json::parse(line));
  return events;
}

TEST_F(WindowByMouse, AScopeAndAProbeAreLedThroughPortalsAndTheLunateIsTouched) {
  for (const char* program : {"Xvfb", "xdotool"})
    if (no_program(program)) GTEST_SKIP() << program << " is not installed";
  ASSERT_EQ(play(kScript), 0);
  std::string all, scope_in, probe_in, probe_is_in;
  bool begun = false;
  double lunate_n = 0;
  int taken = 0, marks = 0, restored = 0;
  for (const nlohmann::json& event : events_of(file("run.osr"))) {
    all += event.dump() + "\n";
    const bool right = event["hand"] == "right";
    const std::string kind = event["kind"], subject = event.value("subject", "");
    if (kind == "portal_entered") (right ? probe_in : scope_in) += subject + " ";
    if (right && kind == "portal_entered") probe_is_in = subject;
    if (right && kind == "portal_left") probe_is_in.clear();
    const bool on_lunate = right && subject == "lunate" && probe_is_in == "portal_4_5";
    begun = begun || (on_lunate && kind == "contact_begin");
    if (on_lunate && kind == "contact_end")
      lunate_n = std::max(lunate_n, event["peak_force_n"].get<double>());
    taken += kind == "instrument_taken" && right ? 1 : 0;
    marks += kind == "mark" && subject == "1" ? 1 : 0;
    restored += kind == "restored" && subject == "1" ? 1 : 0;
  }
  EXPECT_EQ(scope_in, "portal_3_4 ") << "and stays there over undo\n" << all;
  EXPECT_TRUE(probe_in.starts_with("portal_4_5 portal_mcu ")) << all;
  EXPECT_TRUE(begun) << "through 4-5\n" << all;
  EXPECT_GT(lunate_n, 0.2) << all;
  EXPECT_EQ(taken, 2) << "another one, and by undo the first again\n" << all;
  EXPECT_EQ(marks, 1) << all;
  EXPECT_EQ(restored, 1) << all;
}

}  // namespace
}  // namespace osteon::testing_cli
