#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "osteon/procedure/knee_exam_watch.h"

namespace osteon {

/// docs/acl.md names the keys; lengths in mm. A test that was not done is null.
nlohmann::ordered_json to_json(const KneeExam& exam);
std::string to_text(const KneeExam& exam);

}  // namespace osteon
