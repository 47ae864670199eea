// What the window tells of soft parts and of what leads drills as it happens.
#include "window/controllers/sessions/run_news.h"

#include <gtest/gtest.h>

#include "osteon/scene/carve_events.h"
#include "osteon/scene/soft_events.h"
#include "session/drilling.h"
#include "session/soft_fixtures.h"
#include "session/soft_solid_fixtures.h"

namespace osteon {
namespace {

Event soft_event(EventKind kind, std::array<double, 3> values = {}) {
  Event event;
  event.kind = kind;
  event.subject_kind = SubjectKind::kSoftPart;
  event.subject = 0;
  event.hand = 0;
  event.values = values;
  return event;
}

TEST(SoftNews, SaysWhatIsInTwoAndAtWhichForce) {
  const auto the_case = testing::band_case();
  ASSERT_TRUE(the_case);
  EXPECT_EQ(soft_news_of(soft_event(kSoftTorn, {24.4, 20, 0}), *the_case),
            "ACL has torn, pulled with 20 N");
  Event by_bones = soft_event(kSoftTorn, {24.4, 0, 0});
  by_bones.hand = kNoHand;
  EXPECT_EQ(soft_news_of(by_bones, *the_case), "ACL has torn");
  EXPECT_EQ(soft_news_of(soft_event(kSoftCut, {8, 60, 0}), *the_case), "ACL is cut in two");
  EXPECT_EQ(soft_news_of(soft_event(kSoftSlipped, {10.2, 10, 4}), *the_case),
            "ACL was pulled off the jaws, with 10 N");
}

// Not each touch, nor the start of a stroke into a meniscus, nor what is no soft part of the case.
TEST(SoftNews, SaysNothingElse) {
  const auto ligament = testing::band_case();
  for (const EventKind kind : {kSoftBegin, kSoftEnd, kSoftStrandsCut})
    EXPECT_EQ(soft_news_of(soft_event(kind), *ligament), "");
  EXPECT_EQ(soft_news_of(soft_event(kSoftCut), *testing::meniscus_run().the_case), "");
  Event event = soft_event(kSoftTorn);
  event.subject = 9;
  EXPECT_EQ(soft_news_of(event, *ligament), "");
  event.subject = 0;
  event.subject_kind = SubjectKind::kBone;
  EXPECT_EQ(soft_news_of(event, *ligament), "");
}

// A pin or a shaver that goes through a stump cuts nothing in two.
TEST(SoftNews, OfATornLigamentNothingIsCutInTwo) {
  const auto whole = testing::band_case();
  ASSERT_TRUE(whole);
  Case torn = *whole;
  TriMesh& mesh = torn.softs[0].mesh_W;
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto triangles = mesh.triangles;
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.vertices.push_back(mesh.vertices[v] + Vec3(1, 0, 0));
  for (auto triangle : triangles) {
    for (auto& v : triangle) v += count;
    mesh.triangles.push_back(triangle);
  }
  EXPECT_EQ(soft_news_of(soft_event(kSoftCut, {0.5, 0, 12}), torn), "");
}

TEST(GuideNews, SaysWhatLeadsADrillAndWhatSlidesOff) {
  const auto the_case = testing::drilled_block();
  const auto news = [&](EventKind kind, std::array<double, 3> values = {}) {
    Event event = soft_event(kind, values);
    event.subject_kind = SubjectKind::kBone;
    return guide_news_of(event, *the_case);
  };
  EXPECT_EQ(news(kAimed), "Block: the aimer is fixed. Its sleeve leads a pin.");
  EXPECT_EQ(news(kPinLeft, {33.8, 2.4, 0}),
            "Block: the pin stays, 34 mm deep. It leads a drill that is hollow.");
  EXPECT_NE(news(kSkives, {70, 8, 0}).find("slides off"), std::string::npos);
  EXPECT_EQ(news(kPinTaken), "");
  EXPECT_EQ(guide_news_of(soft_event(kAimed), *the_case), "") << "of a soft part";
}

}  // namespace
}  // namespace osteon
