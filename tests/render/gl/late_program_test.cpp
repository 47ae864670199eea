// Programs that are compiled when a picture first needs them.
#include <gtest/gtest.h>

#include <filesystem>

#include "../gl_fixture.h"
#include "gl/gl_objects.h"
#include "osteon/render/scope_renderer.h"

namespace osteon {
namespace {

const std::filesystem::path kShaders = std::filesystem::path(OSTEON_SOURCE_DIR) / "shaders";

class LatePrograms : public GlTest {};

TEST_F(LatePrograms, AreCompiledWhenTheyAreAskedForAndOnce) {
  const LateProgram late(kShaders, "screen", "softer", "#define TAPS 4\n");
  EXPECT_TRUE(late.check());
  EXPECT_FALSE(late.ready());
  const Program* const first = late.get();
  ASSERT_NE(first, nullptr);
  EXPECT_TRUE(late.ready());
  EXPECT_EQ(late.get(), first);
}

TEST_F(LatePrograms, ThatDoNotCompileAreNone) {
  const LateProgram broken(kShaders, "screen", "softer", "#define TAPS no number\n");
  EXPECT_TRUE(broken.check());
  EXPECT_EQ(broken.get(), nullptr);
  EXPECT_TRUE(broken.ready()) << "it is not tried again";
  const LateProgram missing(kShaders, "screen", "no_such_shader");
  ASSERT_FALSE(missing.check());
  EXPECT_NE(missing.check().error().message().find("no_such_shader.frag"), std::string::npos);
  EXPECT_EQ(missing.get(), nullptr);
}

// Though no picture has asked for it yet.
TEST_F(LatePrograms, AScopeSaysThatAShaderOfItsCoversIsMissing) {
  const std::filesystem::path data = std::filesystem::path(testing::TempDir()) / "late_programs";
  std::filesystem::remove_all(data);
  std::filesystem::create_directories(data);
  std::filesystem::copy(kShaders, data / "shaders", std::filesystem::copy_options::recursive);
  EXPECT_TRUE(ScopeRenderer::create({}, data, PreparedCase{}));
  for (const char* file : {"scope_water.frag", "water_bit.frag", "softer.frag"}) {
    std::filesystem::rename(data / "shaders" / file, data / file);
    const auto made = ScopeRenderer::create({}, data, PreparedCase{});
    ASSERT_FALSE(made) << file;
    EXPECT_NE(made.error().message().find(file), std::string::npos);
    std::filesystem::rename(data / file, data / "shaders" / file);
  }
  std::filesystem::remove_all(data);
}

}  // namespace
}  // namespace osteon
