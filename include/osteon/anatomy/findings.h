#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// How far a finding goes, or of which kind it is.
struct FindingGrade {
  std::string name;     ///< "3"
  std::string meaning;  ///< what there is to see
};

/// Something that is wrong with an anatomy: a fracture, a torn ligament, bare bone.
struct AnatomyFinding {
  std::string name;  ///< "geissler"
  std::string meaning;
  std::string source;  ///< where its figures come from
  std::vector<FindingGrade> grades;
};

/// A finding of a grade, as asked for.
struct FindingChoice {
  std::string finding, grade;
};

/// The findings of a table (assets/anatomy/*_findings.toml; docs/anatomy-description.md).
Result<std::vector<AnatomyFinding>> list_findings(const std::filesystem::path& table);

}  // namespace osteon
