// X-ray pictures in the window, with real keys and clicks on a display of its own.
#include <stb/stb_image.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

// The panels folded away, the desk fills the right side of the window: AP and Lateral in its second
// row, the earlier of two pictures at the right. F12 saves what the window shows.
constexpr const char* kExamination = R"sh(
"$OSTEON" window --case 'builtin:wrist#hull' --size 800x600 --layout fluoro \
  --record run.osr > out.txt 2>&1 &
window=$!
for i in $(seq 600); do [ -f run.osr ] && break; sleep 0.2; done
sleep 1
click() { xdotool mousemove $1 $2; sleep 0.5; xdotool click 1; sleep 0.5; xdotool mousemove 300 300; }
shoot() { xdotool key b; sleep 4; }
snap() { xdotool key F12; sleep 1.5; }
xdotool mousemove 300 300 key Tab
shoot; snap
click 755 50; shoot; snap
click 755 300; snap
click 712 225; snap
for i in $(seq 50); do xdotool key ctrl+q; sleep 0.2; kill -0 $window 2> /dev/null || break; done
wait $window; echo "ended $?"
)sh";

bool there_is(const char* program) {
  return std::system((std::string("command -v ") + program + " > /dev/null 2>&1").c_str()) == 0;
}

/// The lower half of the picture, where no note lies: a byte a pixel.
std::vector<int> lower_half(const std::string& file) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> grey(
      stbi_load(file.c_str(), &width, &height, &channels, 1), stbi_image_free);
  std::vector<int> pixels;
  if (!grey || width != 800 || height != 600) return pixels;
  for (int y = 330; y < 580; ++y)
    for (int x = 30; x < 580; ++x)
      pixels.push_back(grey.get()[static_cast<std::ptrdiff_t>(y) * width + x]);
  return pixels;
}

double mean_apart(const std::vector<int>& a, const std::vector<int>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) sum += std::abs(a[k] - b[k]);
  return sum / static_cast<double>(std::max<std::size_t>(a.size(), 1));
}

class WindowXray : public CliTest {};

TEST_F(WindowXray, AnEarlierPictureComesBackAndANewExaminationHasNone) {
  for (const char* program : {"Xvfb", "xdotool"})
    if (!there_is(program)) GTEST_SKIP() << program << " is not installed";
  std::ofstream(file("play.sh")) << kExamination;
  const std::string command = "cd " + dir_.string() + " && XDG_CONFIG_HOME=" + dir_.string() +
                              " XDG_DATA_HOME=" + dir_.string() +
                              " OSTEON=" OSTEON_EXECUTABLE " " OSTEON_SOURCE_DIR
                              "/tools/with-display 800x600 bash play.sh > told.txt 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(dir_ / "osteon" / "pictures"))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  ASSERT_EQ(files.size(), 4u);
  const auto front = lower_half(files[0]), side = lower_half(files[1]);
  const auto front_again = lower_half(files[2]), none = lower_half(files[3]);
  ASSERT_FALSE(front.empty());
  EXPECT_GT(mean_apart(front, side), 8) << "of 255";
  EXPECT_EQ(front, front_again);
  EXPECT_EQ(none, std::vector<int>(none.size(), 0));
}

}  // namespace
}  // namespace osteon::testing_cli
