#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "describe/shape.h"
#include "osteon/anatomy/findings.h"

namespace osteon {

/// Takes a part, in World, from a bone or a soft part.
struct CutStep {
  std::string of;    ///< what it is taken from
  std::string bone;  ///< that the place moves with
  Part part;
  double coarsest_cell = 0;  ///< metres; 0: as it is
  std::size_t pieces = 1;    ///< that are kept of a soft part
};

/// Makes a band or a layer thinner.
struct ThinStep {
  std::string of;
  double share = 1;  ///< of the thickness that is left
};

/// Moves finished bones with their cartilage: turned about a place that is bound to the first of
/// them, then shifted.
struct MoveStep {
  std::vector<std::string> bones;
  Mat3 R_W = Mat3::Identity();
  Vec3 shift_W = Vec3::Zero();
  Vec3 pivot_W = Vec3::Zero();
};

/// Makes bones of their own of what the cuts leave of one.
struct SplitStep {
  struct Into {
    std::string name;
    Vec3 near_W = Vec3::Zero();
  };
  std::string bone;
  std::vector<Into> into;
};

/// A named place that the anatomy has with the finding alone.
struct MarkStep {
  std::string name;
  std::string bone;  ///< that it moves with
  Vec3 p_W = Vec3::Zero();
};

struct FindingSteps {
  std::vector<CutStep> cuts;
  std::vector<ThinStep> thins;
  std::vector<MoveStep> moves;
  std::vector<SplitStep> splits;
  std::vector<MarkStep> marks;
};

struct FindingRule {
  AnatomyFinding finding;
  std::vector<FindingSteps> steps;  ///< one a grade
};

struct FindingTable {
  std::string file;
  std::vector<FindingRule> rules;
};

/// Strict, as all descriptions: errors name file, finding, grade and key.
Result<FindingTable> parse_findings(std::string_view text, const std::string& file);
Result<FindingTable> load_findings(const std::filesystem::path& file);

}  // namespace osteon
