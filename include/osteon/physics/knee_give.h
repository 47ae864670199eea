#pragma once

#include "osteon/base/result.h"
#include "osteon/physics/knee_laxity.h"
#include "osteon/scene/knee_exam.h"

namespace osteon {

/// How a case's knee, changed as said, gives under the tests "lachman" and "pivot" of the table, by
/// the mechanics of test_laxity at every bend of the result. Its bones are not set, and nothing is
/// known of the other knee. Fails as make_knee does, where a test is missing, and where the knee
/// comes to no balance.
Result<KneeGiveTable> give_of_knee(const CaseDef& def, const LigamentTable& table,
                                   const KneeChanges& changes = {});

/// What the intact knee does under the same loads becomes known.
void set_other_knee(KneeGiveTable& table, const KneeGiveTable& intact);

}  // namespace osteon
