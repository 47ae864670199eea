#include "osteon/results/cmi5_course.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

Cmi5Course two_units() {
  return {"https://school.example/osteon",
          "Wrist & knee",
          "First <steps>",
          "7",
          {{"touch_bones", "Touch the \"bones\"", "One by one", 0.8},
           {"wrist_tour", "Tour", "All of it", 0.755}}};
}

TEST(Cmi5CourseXml, RefusesWhatNoSystemCouldImport) {
  Cmi5Course course = two_units();
  for (const char* id : {"", "osteon", ":x", "https:", "https://a b", "https://a\"b", "x:<a>"}) {
    course.id = id;
    EXPECT_FALSE(cmi5_course_xml(course)) << id;
  }
  course = two_units();
  course.units.clear();
  EXPECT_FALSE(cmi5_course_xml(course));
  course = two_units();
  course.title.clear();
  EXPECT_FALSE(cmi5_course_xml(course));
  course = two_units();
  course.units[0].mastery = std::nan("");
  EXPECT_FALSE(cmi5_course_xml(course));
}

TEST(Cmi5CourseXml, SaysEachUnitInTheSchemasOrder) {
  const auto xml = cmi5_course_xml(two_units());
  ASSERT_TRUE(xml) << xml.error().message();
  std::size_t at = 0;
  for (const char* next : {"<?xml",
                           "<courseStructure xmlns=\"https://w3id.org/xapi/profiles/cmi5/v1/",
                           "<course id=\"https://school.example/osteon\">",
                           "<title>",
                           "Wrist &amp; knee",
                           "<description>",
                           "First &lt;steps&gt;",
                           "</course>",
                           "<au id=\"https://school.example/osteon/touch_bones\"",
                           "moveOn=\"Passed\"",
                           "masteryScore=\"0.800\"",
                           "<title>",
                           "&quot;bones&quot;",
                           "<description>",
                           "<url>osteon://launch/touch_bones?seed=7</url>",
                           "</au>",
                           "masteryScore=\"0.755\"",
                           "<url>osteon://launch/wrist_tour?seed=7</url>",
                           "</au>",
                           "</courseStructure>"}) {
    at = xml->find(next, at);
    ASSERT_NE(at, std::string::npos) << next;
  }
}

TEST(Cmi5CourseXml, KeepsScoresWithinTheirRange) {
  Cmi5Course course = two_units();
  course.seed.clear();
  course.units[0].mastery = 3;
  course.units[1].mastery = -1;
  const auto xml = cmi5_course_xml(course);
  ASSERT_TRUE(xml);
  EXPECT_NE(xml->find("masteryScore=\"1.000\""), std::string::npos);
  EXPECT_NE(xml->find("masteryScore=\"0.000\""), std::string::npos);
  EXPECT_EQ(xml->find("seed"), std::string::npos);
  course.units[0].mastery.reset();
  course.units[1].mastery.reset();
  EXPECT_EQ(cmi5_course_xml(course)->find("masteryScore"), std::string::npos);
}

}  // namespace
}  // namespace osteon
