#include "commands/support/text_table.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(TextTable, HeaderAlone) { EXPECT_EQ(TextTable({"a", "b"}).text(), "a  b\n----\n"); }

TEST(TextTable, AlignsNumbersRightAndTextLeft) {
  TextTable table({"bone", "mm"});
  table.add({"Wirbelkörper", "1.5"});
  table.add({"x", "-"});
  EXPECT_EQ(table.text(),
            "bone           mm\n"
            "-----------------\n"
            "Wirbelkörper  1.5\n"
            "x               -\n");
}

TEST(TextTable, FixedDigits) {
  EXPECT_EQ(fixed(1.005, 1), "1.0");
  EXPECT_EQ(fixed(-12, 0), "-12");
}

}  // namespace
}  // namespace osteon
