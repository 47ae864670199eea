#include "ui/label.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Label, OfNothingIsNothing) {
  EXPECT_EQ(label_of(""), "");
  EXPECT_EQ(label_of("_"), " ");
}

TEST(Label, BeginsWithACapitalAndHasSpaces) {
  EXPECT_EQ(label_of("scaphoid"), "Scaphoid");
  EXPECT_EQ(label_of("metacarpal_1"), "Metacarpal 1");
}

TEST(Label, AbbreviationsAreCapitalsButNoPartsOfWords) {
  EXPECT_EQ(label_of("tfcc_tear"), "TFCC tear");
  EXPECT_EQ(label_of("torn_acl"), "Torn ACL");
  EXPECT_EQ(label_of("portal_am"), "Portal AM");
  EXPECT_EQ(label_of("aclinic"), "Aclinic");
}

}  // namespace
}  // namespace osteon
