#include "ui/toasts.h"

#include <gtest/gtest.h>

#include <string>

namespace osteon {
namespace {

TEST(Toasts, TheSameWordsAreShownOnceAndFewAtATime) {
  Toasts toasts;
  toasts.add(ToastKind::kInfo, "Saved", 0);
  toasts.add(ToastKind::kInfo, "Saved", 1);
  EXPECT_EQ(toasts.shown().size(), 1u);
  for (int i = 0; i < 9; ++i) toasts.add(ToastKind::kWarning, std::to_string(i), 2);
  EXPECT_EQ(toasts.shown().size(), Toasts::kMaxToasts);
  EXPECT_EQ(toasts.shown().back().text, "8");
}

TEST(Toasts, MessagesGoByThemselvesErrorsStay) {
  Toasts toasts;
  toasts.add(ToastKind::kInfo, "Saved", 0);
  toasts.add(ToastKind::kError, "The disk is full", 0);
  toasts.age(3600);
  ASSERT_EQ(toasts.shown().size(), 1u);
  EXPECT_EQ(toasts.shown()[0].kind, ToastKind::kError);
  toasts.dismiss(toasts.shown()[0].id);
  EXPECT_TRUE(toasts.shown().empty());
}

}  // namespace
}  // namespace osteon
