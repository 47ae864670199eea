#include "osteon/base/log.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Log, WritesTheLineToStandardErrorAndObeysTheLevel) {
  testing::internal::CaptureStderr();
  log(LogLevel::kInfo, "brace { } is not a format");
  set_log_level(LogLevel::kError);
  log(LogLevel::kWarning, "dropped");
  set_log_level(LogLevel::kInfo);
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("brace { } is not a format"), std::string::npos);
  EXPECT_EQ(text.find("dropped"), std::string::npos);
}

}  // namespace
}  // namespace osteon
