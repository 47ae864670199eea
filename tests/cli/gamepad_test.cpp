// The real window with a gamepad that the kernel's event interface shows and umockdev plays: GLFW
// finds it, knows its axes, and the probe moves by it.
#include <cstdint>
#include <cstring>
#include <fstream>
#include <initializer_list>

#include "block_case.h"
#include "osteon/record/recording.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

constexpr const char* kNode = "/dev/input/event5";
constexpr int kFull = 32767;

std::string hex(const void* data, std::size_t size) {
  std::string out;
  for (std::size_t i = 0; i < size; ++i) {
    char two[3];
    std::snprintf(two, sizeof two, "%02X", static_cast<const std::uint8_t*>(data)[i]);
    out += two;
  }
  return out;
}

std::string bits(std::initializer_list<int> set, std::size_t bytes) {
  std::vector<std::uint8_t> out(bytes);
  for (const int bit : set) out[static_cast<std::size_t>(bit / 8)] |= std::uint8_t(1 << (bit % 8));
  return hex(out.data(), out.size());
}

/// What the kernel answers of a pad of this type (linux/input.h: the bits of event types, keys and
/// axes, each axis with value, least, most, fuzz, flat and resolution); one axis held at a value.
struct HeldAxis {
  int axis = 0, value = 0;
};
constexpr int kStickX = 0, kStickY = 1, kRightStickX = 3;

std::string answers(HeldAxis held) {
  const std::uint16_t id[] = {3, 0x045e, 0x028e, 0x0114};
  const char name[256] = "Microsoft X-Box 360 pad";
  std::string out = std::string("@DEV ") + kNode + "\nEVIOCGVERSION 0 01000100\n";
  out += "EVIOCGID 0 " + hex(id, sizeof id) + "\n";
  out += "EVIOCGNAME " + std::to_string(std::strlen(name) + 1) + " " + hex(name, sizeof name);
  out += "\nEVIOCGBIT(0) 4 " + bits({0, 1, 3}, 4);
  out += "\nEVIOCGBIT(1) 96 " +
         bits({0x130, 0x131, 0x133, 0x134, 0x136, 0x137, 0x13a, 0x13b, 0x13c, 0x13d, 0x13e}, 96);
  out += "\nEVIOCGBIT(3) 8 " + bits({0, 1, 2, 3, 4, 5, 0x10, 0x11}, 8) + "\n";
  for (const int axis : {0, 1, 2, 3, 4, 5, 0x10, 0x11}) {
    const bool trigger = axis == 2 || axis == 5, hat = axis >= 0x10;
    const std::int32_t most = trigger ? 255 : hat ? 1 : kFull;
    const std::int32_t values[] = {
        axis == held.axis ? held.value : 0, trigger ? 0 : -most, most, 16, 128, 0};
    out += "EVIOCGABS(" + std::to_string(axis) + ") 0 " + hex(values, sizeof values) + "\n";
  }
  return out;
}

class GamepadWindow : public CliTest {
 protected:
  void SetUp() override {
    if (std::system("command -v Xvfb umockdev-run > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "Xvfb or umockdev-run is not installed (Debian: xvfb, umockdev)";
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  }

  /// What the hands did while the window drew some pictures with this axis held.
  Recording run_window(HeldAxis held, const std::string& devices, bool plugged_in = true) {
    std::ofstream(file("pad.umockdev"))
        << "P: /devices/pci0/usb1/1-1/input/input5\nE: SUBSYSTEM=input\n\n"
           "P: /devices/pci0/usb1/1-1/input/input5/event5\nN: input/event5\n"
           "E: SUBSYSTEM=input\nE: DEVNAME=/dev/input/event5\n";
    std::ofstream(file("pad.ioctl")) << answers(held);
    std::ofstream(file("pad.events")) << "E: 600.0 0000 0000 0\n";  // the node answers; none comes
    const std::string pad = std::string(" -d ") + file("pad.umockdev") + " -i " + kNode + "=" +
                            file("pad.ioctl") + " -e " + kNode + "=" + file("pad.events");
    const std::string recording = file("run.osr");
    fs::remove(recording);
    const std::string command =
        "XDG_CONFIG_HOME=" + dir_.string() + " XDG_DATA_HOME=" + dir_.string() + " " +
        OSTEON_SOURCE_DIR + "/tools/with-display 640x480 umockdev-run" + (plugged_in ? pad : "") +
        " -- " + OSTEON_EXECUTABLE + " window " + devices + " --size 640x480 --at 0.5 --frames 2" +
        " --case " + file("case") + " --record " + recording + " > " + file("log") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_log();
    auto run = load_recording(recording);
    if (!run || run->ticks.empty()) {
      ADD_FAILURE() << (run ? "no tick was recorded" : run.error().message());
      return {};
    }
    return std::move(*run);
  }
  /// How far the one hand, which the gamepad moves, went along World's axes.
  Vec3 way_of_hand(int stick_x, bool plugged_in = true) {
    const Recording run = run_window({kStickX, stick_x}, "--device gamepad", plugged_in);
    if (run.ticks.empty()) return Vec3::Zero();
    return run.ticks.back().input.X_WD.p - run.ticks.front().input.X_WD.p;
  }
  std::string read_log() const {
    std::ifstream in(file("log"));
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(GamepadWindow, NoneIsPluggedIn) { EXPECT_LT(way_of_hand(0, false).norm(), 1e-9); }

TEST_F(GamepadWindow, TheStickMovesTheHandItsWay) {
  EXPECT_LT(way_of_hand(0).norm(), 1e-9);
  const Vec3 right_W = way_of_hand(kFull);
  const Vec3 left_W = way_of_hand(-kFull);
  EXPECT_GT(right_W.norm(), 0.005);
  EXPECT_GT(left_W.norm(), 0.005);
  EXPECT_LT(right_W.normalized().dot(left_W.normalized()), -0.999);
}

// The mouse has the left hand; the right one rests, and the sticks are its own.
TEST_F(GamepadWindow, TheSticksMoveTheRestingHandAlone) {
  const std::string two =
      "--device mouse:left=wrist_arthroscope_2_7 --device mouse:right=wrist_hook_probe";
  for (const HeldAxis held : {HeldAxis{kStickY, -kFull}, HeldAxis{kRightStickX, kFull}}) {
    const Recording run = run_window(held, two);
    ASSERT_EQ(run.hands(), 2u);
    Pose first[2], last[2];
    for (std::size_t hand = 0; hand < 2; ++hand) {
      ASSERT_FALSE(run.ticks_of(hand).empty());
      first[hand] = run.ticks_of(hand).front().input.X_WD;
      last[hand] = run.ticks_of(hand).back().input.X_WD;
    }
    EXPECT_EQ(last[0].p, first[0].p);
    EXPECT_EQ(last[0].q.coeffs(), first[0].q.coeffs());
    const Vec3 way_W = last[1].p - first[1].p;
    if (held.axis == kStickY) {
      EXPECT_GT(way_W.norm(), 0.002);
      // The shaft runs from the tip along +z: in is against it.
      EXPECT_LT(way_W.normalized().dot(first[1].q * Vec3::UnitZ()), -0.999);
      EXPECT_LT(last[1].q.angularDistance(first[1].q), 1e-9);
    } else {
      EXPECT_LT(way_W.norm(), 1e-9);  // it tilts about its tip
      EXPECT_GT(last[1].q.angularDistance(first[1].q), 0.1);
    }
  }
}

}  // namespace
}  // namespace osteon::testing_cli
