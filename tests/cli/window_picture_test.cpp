// Opens the real window under a virtual display and looks at what it shows; stb (which ImGui needs
// too) reads the pictures.
#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Picture {
  int width = 0, height = 0;
  std::unique_ptr<stbi_uc, void (*)(void*)> rgb{nullptr, stbi_image_free};
  std::array<int, 3> at(int x, int y) const {
    const stbi_uc* p = rgb.get() + 3 * (static_cast<std::ptrdiff_t>(y) * width + x);
    return {p[0], p[1], p[2]};
  }
};

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class Window : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("osteon-window-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Settings and recordings of the machine's user stay out of it.
  std::string program() const {
    return "env XDG_CONFIG_HOME=" + folder_.string() + " XDG_DATA_HOME=" + folder_.string() + " ";
  }

  Picture shoot(int width, int height, const std::string& options) const {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    const std::string file = (folder_ / "window.png").string();
    Picture picture;
    const int exit_code = run(program() + OSTEON_SOURCE_DIR "/tools/with-display " + size +
                              " " OSTEON_EXECUTABLE " window --size " + size +
                              " --frames 2 --screenshot " + file + " " + options);
    EXPECT_EQ(exit_code, 0);
    int channels = 0;
    picture.rgb.reset(stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3));
    return picture;
  }

  fs::path folder_;
};

int brightness(const std::array<int, 3>& c) { return (c[0] + c[1] + c[2]) / 3; }

// Bone in the middle, quiet ground around it, panels at the sides.
void expect_a_finished_picture(const Picture& p, int width, int height) {
  ASSERT_TRUE(p.rgb);
  ASSERT_EQ(p.width, width);
  ASSERT_EQ(p.height, height);
  int bright = 0, looked = 0;
  std::set<std::array<int, 3>> tones;
  for (int y = height / 10; y < height * 9 / 10; y += 2)
    for (int x = width / 4; x < width * 3 / 4; x += 2) {
      ++looked;
      bright += brightness(p.at(x, y)) > 90 ? 1 : 0;
      tones.insert(p.at(x, y));
    }
  EXPECT_GT(bright, looked / 10) << "hardly any bone to be seen";
  EXPECT_LT(bright, looked * 8 / 10) << "no ground to be seen";
  EXPECT_GT(tones.size(), 200u) << "the bone has no form";
  // The cards, by their ground: one step above the picture's.
  const std::array<int, 3> left = p.at(13, 200), right = p.at(width - 13, 60);
  for (const auto& card : {left, right}) {
    EXPECT_NEAR(card[0], 0x1c, 4);
    EXPECT_NEAR(card[1], 0x20, 4);
    EXPECT_NEAR(card[2], 0x25, 4);
  }
}

bool no_virtual_display() { return run("command -v Xvfb > /dev/null 2>&1") != 0; }

TEST_F(Window, ShowsTheWristAtTheUsualSize) {
  if (no_virtual_display()) GTEST_SKIP() << "Xvfb is not installed (Debian: xvfb)";
  expect_a_finished_picture(shoot(1280, 720, ""), 1280, 720);
}

TEST_F(Window, ShowsTheWristOnALargeDisplay) {
  if (no_virtual_display()) GTEST_SKIP() << "Xvfb is not installed (Debian: xvfb)";
  expect_a_finished_picture(shoot(2560, 1440, "--ui-scale 2"), 2560, 1440);
}

// Of a block that no cache knows: first its hull is felt, then its piece.
TEST_F(Window, ACaseIsShownAtOnceAndItsPiecesFollow) {
  if (no_virtual_display()) GTEST_SKIP() << "Xvfb is not installed (Debian: xvfb)";
  fs::create_directories(folder_ / "meshes");
  std::ofstream(folder_ / "meshes/block.obj")
      << "v -20 -20 -20\nv 20 -20 -20\nv -20 20 -20\nv 20 20 -20\n"
         "v -20 -20 20\nv 20 -20 20\nv -20 20 20\nv 20 20 20\n"
         "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
         "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
  const std::string folder = folder_.string(), log = folder + "/log";
  ASSERT_EQ(run(OSTEON_EXECUTABLE " import mesh " + folder + "/meshes --unit mm --out " + folder +
                "/case > " + log),
            0);
  fs::remove(folder_ / "case/pieces.bin");
  const std::string open = program() + "XDG_CACHE_HOME=" + folder +
                           " " OSTEON_SOURCE_DIR "/tools/with-display 640x480 " OSTEON_EXECUTABLE
                           " window --size 640x480 --at-once --frames 1 --case " +
                           folder + "/case > " + log;
  ASSERT_EQ(run(open), 0);
  EXPECT_EQ(run("grep -q 'felt as hulls; cut into pieces after' " + log), 0);
  EXPECT_TRUE(fs::exists(folder_ / "case/pieces.bin"));
  // The second time the pieces are there from the start.
  ASSERT_EQ(run(open), 0);
  EXPECT_EQ(run("grep -q 'first picture of the bones after' " + log), 0);
  EXPECT_NE(run("grep -q 'felt as hulls' " + log), 0);
}

TEST_F(Window, SaysInWordsWhenThereIsNoDisplay) {
  const std::string log = (folder_ / "log").string();
  EXPECT_EQ(run("env -u DISPLAY -u WAYLAND_DISPLAY " OSTEON_EXECUTABLE " window 2> " + log), 2);
  EXPECT_EQ(run("grep -q 'no window can be opened' " + log), 0);
}

TEST_F(Window, SaysInWordsWhenTheCaseIsNotThere) {
  if (no_virtual_display()) GTEST_SKIP() << "Xvfb is not installed (Debian: xvfb)";
  const std::string log = (folder_ / "log").string();
  EXPECT_EQ(run(program() +
                OSTEON_SOURCE_DIR "/tools/with-display 640x480 " OSTEON_EXECUTABLE
                                  " window --frames 2 --case /nowhere/at/all 2> " +
                log),
            2);
  EXPECT_EQ(run("grep -q nowhere " + log), 0);
}

}  // namespace
