#include "osteon/procedure/course.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(CourseFile, WhatIsNoCourseIsNamedWithItsLine) {
  const auto fault = [](const std::string& text) {
    const auto course = parse_course(text, "course.toml");
    return course ? std::string("none") : course.error().message();
  };
  for (const char* text :
       {"", "format = 1", "format = 1\nexercises = []", "format = 2\nexercises = [\"a\"]",
        "format = 1\nexercises = \"a\"", "format = 1\nexercises = [\"\"]",
        "format = 1\nexercises = [\":3\"]", "format = 1\nexercises = [\"a:\"]",
        "format = 1\nexercises = [\"a:x\"]", "format = 1\nexercises = [\"a:-1\"]",
        "format = 1\nexercises = [\"a\"]\nother = 1", "format = "})
    EXPECT_NE(fault(text).find("course.toml"), std::string::npos) << text << ": " << fault(text);
  const std::string seed = fault("format = 1\n\nexercises = [\"a:x\"]");
  EXPECT_NE(seed.find("course.toml:3"), std::string::npos) << seed;
  EXPECT_NE(seed.find("a:x"), std::string::npos) << seed;
  EXPECT_FALSE(load_course("/nowhere/course.toml"));
}

TEST(CourseFile, HoldsExercisesInTheirOrderAndTheirPatients) {
  const auto course = parse_course(
      "format = 1\ntitle = \"Week 3\"\nexercises = [\"touch_bones\", \"fast_maze:7\"]", "c.toml");
  ASSERT_TRUE(course) << course.error().message();
  EXPECT_EQ(course->title, "Week 3");
  ASSERT_EQ(course->units.size(), 2u);
  EXPECT_EQ(course->units[0].exercise, "touch_bones");
  EXPECT_FALSE(course->units[0].seed);
  EXPECT_EQ(course->units[1].exercise, "fast_maze");
  EXPECT_EQ(course->units[1].seed, 7u);
}

}  // namespace
}  // namespace osteon
