// What `osteon window --soft NAMES` makes of the names, and what it says of wrong ones.
#include <gtest/gtest.h>

#include "session/soft_solid_fixtures.h"
#include "window/jobs/load_job.h"

namespace osteon {
namespace {

TEST(SoftPartsAsked, AWrongNameIsRefusedAndNothingIsSoft) {
  const Case& the_case = *testing::meniscus_run().the_case;
  for (const char* name : {"medial_meniscuss", "acl", ""}) {
    const PreparedSofts made = prepare_softs(the_case, InstrumentTray(), {"medial_meniscus", name});
    EXPECT_NE(made.problem.find(std::string("'") + name + "'"), std::string::npos) << made.problem;
    EXPECT_NE(made.problem.find("--soft"), std::string::npos) << made.problem;
    EXPECT_EQ(made.softs.setup, nullptr);
  }
}

TEST(SoftPartsAsked, ThoseThatTheCaseHasAreMade) {
  const Case& the_case = *testing::meniscus_run().the_case;
  const PreparedSofts made = prepare_softs(the_case, InstrumentTray(), {"menisci"});
  EXPECT_TRUE(made.problem.empty()) << made.problem;
  ASSERT_NE(made.softs.setup, nullptr);
  ASSERT_EQ(made.softs.setup->solids.size(), 1u);
  EXPECT_EQ(made.softs.setup->solids[0].name, "medial_meniscus");
  EXPECT_GT(made.softs.setup->friction.solid.resting, made.softs.setup->friction.solid.sliding);
  EXPECT_GT(made.softs.setup->friction.solid.sliding, 0);
  const PreparedSofts none = prepare_softs(the_case, InstrumentTray(), {});
  EXPECT_TRUE(none.problem.empty());
  EXPECT_EQ(none.softs.setup, nullptr);
}

}  // namespace
}  // namespace osteon
