#include "osteon/media/sound_output.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace osteon {
namespace {

TEST(SoundOutput, WithoutTheLibraryItNamesThePackage) {
  const auto none = SoundOutput::open("libosteon_no_such_library.so");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("libopenal1"), std::string::npos);
  const auto other = SoundOutput::open("libm.so.6");
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message().find("not OpenAL"), std::string::npos);
}

// OpenAL Soft's device that plays to nobody, at the speed of a real one.
class SoundDevice : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!::dlopen("libopenal.so.1", RTLD_NOW)) GTEST_SKIP() << "libopenal1 is not installed";
    ::setenv("ALSOFT_DRIVERS", "null", 1);
  }
};

TEST_F(SoundDevice, TakesWhatItCanAndWaitsForNothing) {
  auto output = SoundOutput::open();
  ASSERT_TRUE(output) << output.error().message();
  EXPECT_FALSE(output->lost());
  EXPECT_EQ(output->waiting(), 0u);
  output->set_volume(0.5);
  std::vector<float> tone(4800);
  for (std::size_t i = 0; i < tone.size(); ++i)
    tone[i] = static_cast<float>(std::sin(0.05 * static_cast<double>(i)));
  output->play(tone);
  EXPECT_GT(output->waiting(), 0u);
  // Ten seconds at once: the device cannot have played them.
  for (int i = 0; i < 100; ++i) output->play(tone);
  EXPECT_LE(output->waiting(), SoundOutput::most_waiting());
}

TEST_F(SoundDevice, SamplesAndVolumesThatAreNoneDoNoHarm) {
  auto output = SoundOutput::open();
  ASSERT_TRUE(output) << output.error().message();
  const float none = std::numeric_limits<float>::quiet_NaN();
  output->set_volume(std::nan(""));
  output->set_volume(-3);
  output->play(std::vector<float>(2000, none));
  output->play(std::vector<float>(2000, 1e30f));
  output->play({});
  EXPECT_LE(output->waiting(), SoundOutput::most_waiting());
}

TEST_F(SoundDevice, IsGivenBack) {
  for (int i = 0; i < 3; ++i) {
    auto output = SoundOutput::open();
    ASSERT_TRUE(output) << output.error().message();
    output->play(std::vector<float>(5000, 0.1f));
  }
}

}  // namespace
}  // namespace osteon
