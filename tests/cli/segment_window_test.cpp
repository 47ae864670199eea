// The real segmentation window on a virtual scan, driven by the pointer and the keyboard.
#include <stb/stb_image.h>

#include <array>
#include <fstream>
#include <iterator>
#include <memory>

#include "osteon/mesh/measure.h"
#include "osteon/scene/case_io.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

/// A bone of 24 x 18 x 20 mm, in the middle of the scan.
void save_block(const fs::path& folder) {
  BoneDef bone;
  bone.name = "block";
  const Vec3 half(0.012, 0.009, 0.010);
  for (int corner = 0; corner < 8; ++corner)
    bone.mesh.vertices.emplace_back(corner & 1 ? half.x() : -half.x(),
                                    corner & 2 ? half.y() : -half.y(),
                                    corner & 4 ? half.z() : -half.z());
  bone.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  CaseDef def;
  def.name = "block";
  def.bones.push_back(std::move(bone));
  ASSERT_TRUE(save_case(def, folder));
}

class SegmentWindow : public CliTest {
 protected:
  void SetUp() override {
    for (const char* tool : {"Xvfb", "xdotool"})
      if (std::system(("command -v " + std::string(tool) + " > /dev/null 2>&1").c_str()) != 0)
        GTEST_SKIP() << tool << " is not installed (Debian: xvfb, xdotool)";
    CliTest::SetUp();
    save_block(dir_ / "truth");
    const Ran scanned = run_osteon("scan " + file("truth") +
                                   " --spacing 1 --slice 1 --cortical 20 --out " + file("scan"));
    ASSERT_EQ(scanned.exit_code, 0) << scanned.output;
  }

  /// Starts the window on a display of its own, waits until it has drawn the scan, lets `steps`
  /// play the user, and waits for its end. Returns its exit code.
  int play(const std::string& steps) {
    std::ofstream(file("play.sh"))
        << "export XDG_CONFIG_HOME=" << dir_.string() << " XDG_DATA_HOME=" << dir_.string() << "\n"
        << OSTEON_EXECUTABLE << " segment " << file("scan") << " --out " << file("case")
        << " --size 1280x720 > " << file("out.txt")
        << " 2>&1 &\nprogram=$!\n"
        // The title says what the window is at.
        << "until_title() {\n  for try in $(seq 600); do\n    xdotool search --name \"^$1 - "
           "Osteon\" > /dev/null && return\n    sleep 0.1\n  done\n}\nuntil_title scan\n"
        << steps << "\nfor try in $(seq 300); do kill -0 $program 2>/dev/null || break\n"
        << "  sleep 0.1\ndone\nkill $program 2>/dev/null\nwait $program\n";
    const std::string command = std::string(OSTEON_SOURCE_DIR) +
                                "/tools/with-display 1280x720 bash " + file("play.sh") +
                                " > /dev/null 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string output() {
    std::ifstream in(file("out.txt"));
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
};

// The panes lie between 208 and 1056 across; the axial one shows the scan's middle in its own.
TEST_F(SegmentWindow, AClickGrowsABoneAndItIsSavedAsACase) {
  const int exit_code = play(
      "xdotool key g\nsleep 0.3\nxdotool mousemove 420 210\nsleep 0.3\nxdotool click 1\n"
      "until_title 'scan\\*'\nxdotool key ctrl+s\nuntil_title scan\nxdotool key ctrl+q");
  EXPECT_EQ(exit_code, 0) << output();
  const auto def = load_case(file("case"));
  ASSERT_TRUE(def) << def.error().message() << output();
  ASSERT_EQ(def->bones.size(), 1u);
  EXPECT_TRUE(topology(def->bones[0].mesh).closed());
  const double truth_m3 = 0.024 * 0.018 * 0.020;
  EXPECT_NEAR(volume(def->bones[0].mesh) / truth_m3, 1, 0.08);
}

TEST_F(SegmentWindow, WhatIsNotSavedIsAskedAboutAndCanBeLetGo) {
  const int exit_code = play(
      "xdotool key n\nuntil_title 'scan\\*'\nxdotool key ctrl+q\nsleep 1\nkill -0 $program && "
      "touch " +
      file("asks") + "\nxdotool mousemove 640 387\nsleep 0.3\nxdotool click 1");
  EXPECT_TRUE(fs::exists(file("asks"))) << "it ended without a question";
  EXPECT_EQ(exit_code, 0) << output();
  EXPECT_FALSE(fs::exists(file("case")));
}

struct Shot {
  int width = 0, height = 0;
  std::unique_ptr<unsigned char, void (*)(void*)> rgb{nullptr, stbi_image_free};
  std::array<int, 3> at(int x, int y) const {
    const unsigned char* p = rgb.get() + 3 * (static_cast<std::ptrdiff_t>(y) * width + x);
    return {p[0], p[1], p[2]};
  }
};

// Bone, tinted by the threshold's preview, in the middle of each slice; the scan's rim beyond it;
// the cards in their own ground.
TEST_F(SegmentWindow, ShowsTheScanAtTheUsualSizeAndOnALargeDisplay) {
  for (const int scale : {1, 2}) {
    const std::string size = std::to_string(1280 * scale) + "x" + std::to_string(720 * scale);
    const std::string command =
        std::string(OSTEON_SOURCE_DIR) + "/tools/with-display " + size + " " + OSTEON_EXECUTABLE +
        " segment " + file("scan") + " --size " + size + " --ui-scale " + std::to_string(scale) +
        " --frames 2 --screenshot " + file("shot.png") + " > " + file("out.txt") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << output();
    Shot shot;
    int channels = 0;
    shot.rgb.reset(stbi_load(file("shot.png").c_str(), &shot.width, &shot.height, &channels, 3));
    ASSERT_TRUE(shot.rgb);
    ASSERT_EQ(shot.width, 1280 * scale);
    for (const auto& [x, y] : {std::pair{425, 205}, {425, 545}, {850, 545}}) {
      const auto bone = shot.at(x * scale, y * scale);
      EXPECT_GT(bone[2], 150) << x << " " << y;
      EXPECT_GT(bone[2], bone[0] + 20) << "the threshold's tint";
    }
    const auto air = shot.at(640 * scale, 700 * scale);
    EXPECT_LT(air[0] + air[1] + air[2], 60);
    for (const int x : {3, 1277}) {
      const auto card = shot.at(x * scale, 400 * scale);
      EXPECT_NEAR(card[0], 0x1c, 2);
      EXPECT_NEAR(card[2], 0x25, 2);
    }
  }
}

TEST_F(SegmentWindow, AScanThatCannotBeReadIsSaidInWords) {
  std::ofstream(file("broken.nrrd")) << "NRRD0004\n";
  const std::string command = std::string(OSTEON_SOURCE_DIR) + "/tools/with-display 640x480 " +
                              OSTEON_EXECUTABLE + " segment " + file("broken.nrrd") +
                              " --frames 2 > " + file("out.txt") + " 2>&1";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(output().find("broken.nrrd"), std::string::npos) << output();
}

}  // namespace
}  // namespace osteon::testing_cli
