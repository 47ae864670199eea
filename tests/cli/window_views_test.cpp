// The window's views under a virtual display, of a replay in which a scope looks into a box.
#include <stb/stb_image.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "../media/read_film.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

bool can_show() {
  return std::getenv("OSTEON_LONG") != nullptr &&
         std::system("command -v Xvfb > /dev/null 2>&1") == 0;
}

struct ViewShot {
  int width = 0, height = 0;
  std::unique_ptr<stbi_uc, void (*)(void*)> rgb{nullptr, stbi_image_free};
  int light(int x, int y) const {
    const stbi_uc* p = rgb.get() + 3 * (static_cast<std::ptrdiff_t>(y) * width + x);
    return (p[0] + p[1] + p[2]) / 3;
  }
};

class WindowViews : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    if (!can_show()) GTEST_SKIP() << "takes long: set OSTEON_LONG=1; needs Xvfb";
    recording_ = file("run.osr");
    const Ran ran = run_osteon("run fast_periscoping --no-store --record " + recording_);
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  int window(const std::string& options) const {
    const std::string command =
        "XDG_CONFIG_HOME=" + dir_.string() + " XDG_DATA_HOME=" + dir_.string() +
        " " OSTEON_SOURCE_DIR "/tools/with-display 1000x700 " OSTEON_EXECUTABLE
        " window --size 800x600 --replay " +
        recording_ + " --at 1 --frames 16 " + options;
    return std::system(command.c_str());
  }
  ViewShot shot(const std::string& options) const {
    EXPECT_EQ(window("--screenshot " + file("w.png") + " " + options), 0);
    ViewShot picture;
    int channels = 0;
    picture.rgb.reset(
        stbi_load(file("w.png").c_str(), &picture.width, &picture.height, &channels, 3));
    return picture;
  }
  std::string recording_;
};

TEST_F(WindowViews, TheScopesRoundPictureStandsBetweenTheCards) {
  const ViewShot scope = shot("--layout scope");
  ASSERT_TRUE(scope.rgb);
  // Between the left card (152 + 8 wide) and the right one (200 + 8): black around, lit within.
  const int middle_x = (160 + 592) / 2, middle_y = (40 + 548) / 2;
  EXPECT_LT(scope.light(176, 56), 20);
  EXPECT_LT(scope.light(580, 536), 20);
  int lit = 0;
  for (int y = -60; y <= 60; y += 4)
    for (int x = -60; x <= 60; x += 4) lit += scope.light(middle_x + x, middle_y + y) > 40 ? 1 : 0;
  EXPECT_GT(lit, 480) << "of 961";
}

TEST_F(WindowViews, TheSecondWindowAndTheFilmGoBesideIt) {
  ASSERT_EQ(window("--layout layout --observer scope --film " + file("w.webm")), 0);
  const ReadFilm film = read_film(file("w.webm"));
  EXPECT_EQ(film.picture_codec, "vp9");
  EXPECT_EQ(film.width, 800);
  EXPECT_EQ(film.height, 600);
  EXPECT_GE(film.pictures.size(), 1u);
}

bool is_missing(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) != 0;
}

// Writes where the observer's window is, once it is at the wanted place. The second screen begins
// at 1280. Without a window manager the keyboard is given to a window by hand.
constexpr const char* kTwoScreens = R"sh(
"$OSTEON" window --replay run.osr --size 800x600 --observer scope > out.txt 2>&1 &
window=$!
second="^Osteon, observer's window\$"
place() { xdotool search --name "$second" getwindowgeometry --shell 2> /dev/null | tr '\n' ' '; }
until_place() {
  for i in $(seq 300); do
    now=$(place); case "$now" in *"$1"*) echo "$2 $now"; return;; esac
    sleep 0.2
  done
  echo "not $2: $now"
}
until_place "X=1280 Y=0 WIDTH=1024 HEIGHT=768" beside
xrandr --output DUMMY1 --off
until_place "X=40 Y=40" back
xdotool search --name "$second" windowsize 700 500
until_place "WIDTH=700 HEIGHT=500" resized
xdotool search --name "$second" windowunmap; sleep 0.3
xdotool search --name "$second" windowmap
until_place "WIDTH=700 HEIGHT=500" mapped
xdotool search --name "Osteon\$" windowfocus; sleep 0.2
for i in $(seq 50); do xdotool key ctrl+q; sleep 0.2; kill -0 $window 2> /dev/null || break; done
wait $window; echo "ended $?"
)sh";

// The window saves what the scope shows, as often as it is asked.
constexpr const char* kStills = R"sh(
"$OSTEON" window --replay run.osr --size 800x600 --layout scope > out.txt 2>&1 &
window=$!
for i in $(seq 300); do
  xdotool key c; sleep 0.3
  [ "$(ls osteon/pictures 2> /dev/null | wc -l)" -ge 2 ] && break
done
for i in $(seq 50); do xdotool key ctrl+q; sleep 0.2; kill -0 $window 2> /dev/null || break; done
wait $window; echo "ended $?"
)sh";

class Stills : public CliTest {};

TEST_F(Stills, TheKeySavesTheScopesPictureUnderANameWithoutAPatient) {
  for (const char* program : {"Xvfb", "xdotool"})
    if (is_missing(program)) GTEST_SKIP() << program << " is not installed";
  const Ran ran = run_osteon("run fast_periscoping --no-store --record " + file("run.osr"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  std::ofstream(file("play.sh")) << kStills;
  const std::string command = "cd " + dir_.string() + " && XDG_CONFIG_HOME=" + dir_.string() +
                              " XDG_DATA_HOME=" + dir_.string() +
                              " OSTEON=" OSTEON_EXECUTABLE " " OSTEON_SOURCE_DIR
                              "/tools/with-display 800x600 bash play.sh > told.txt 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  int stills = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dir_ / "osteon" / "pictures")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(name.rfind("scope-2", 0), 0u) << name;
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> rgb(
        stbi_load(entry.path().c_str(), &width, &height, &channels, 3), stbi_image_free);
    ASSERT_TRUE(rgb) << name;
    ASSERT_EQ(width, 1080);
    ASSERT_EQ(height, 1080);
    // Round: black corners, a lit middle.
    EXPECT_EQ(rgb.get()[0], 0);
    EXPECT_GT(rgb.get()[3 * (1080 * 540 + 540)], 20);
    ++stills;
  }
  EXPECT_GE(stills, 2);
}

class TwoScreens : public CliTest {
 protected:
  void SetUp() override {
    for (const char* program : {"/usr/lib/xorg/Xorg", "xrandr", "xdotool"})
      if (is_missing(program)) GTEST_SKIP() << program << " is not installed";
    CliTest::SetUp();
    const Ran ran =
        run_osteon("run fast_periscoping --no-store --record " + (dir_ / "run.osr").string());
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
};

TEST_F(TwoScreens, TheObserversWindowFillsTheSecondAndComesBackWhenThatIsUnplugged) {
  std::ofstream(file("play.sh")) << kTwoScreens;
  const std::string command =
      "cd " + dir_.string() + " && XDG_CONFIG_HOME=" + dir_.string() +
      " XDG_DATA_HOME=" + dir_.string() +
      " OSTEON=" OSTEON_EXECUTABLE " " OSTEON_SOURCE_DIR
      "/tools/with-two-screens 1280x800 1024x768 bash play.sh > told.txt 2>&1";
  const int status = std::system(command.c_str());
  std::ifstream told(file("told.txt"));
  const std::string text{std::istreambuf_iterator<char>(told), {}};
  constexpr int kNoDisplay = 3;  // of tools/with-two-screens
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoDisplay) GTEST_SKIP() << text;
  EXPECT_EQ(status, 0) << text;
  for (const char* line : {"\nback ", "\nresized ", "\nmapped ", "\nended 0\n"})
    EXPECT_NE(("\n" + text).find(line), std::string::npos) << line << text;
  EXPECT_EQ(text.find("beside "), 0u) << text;
}

}  // namespace
}  // namespace osteon::testing_cli
