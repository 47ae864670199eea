#include "finding/apply_findings.h"

#include <algorithm>
#include <utility>

namespace osteon {
namespace {

std::string names_and_grades(const FindingTable& table) {
  std::string text = "Findings:";
  for (const FindingRule& rule : table.rules) {
    text += (&rule == &table.rules[0] ? " " : ", ") + rule.finding.name + "=";
    for (const FindingGrade& grade : rule.finding.grades)
      text += (&grade == &rule.finding.grades[0] ? "" : "|") + grade.name;
  }
  return text;
}

/// Writes the steps of one grade into a description.
class StepWriter {
 public:
  explicit StepWriter(AnatomyDescription& anatomy) : anatomy_(anatomy) {}

  Result<void> write(const FindingSteps& steps) {
    if (auto ok = each(steps.cuts, &StepWriter::cut); !ok) return ok;
    if (auto ok = each(steps.thins, &StepWriter::thin); !ok) return ok;
    if (auto ok = each(steps.moves, &StepWriter::move); !ok) return ok;
    if (auto ok = each(steps.marks, &StepWriter::mark); !ok) return ok;
    return each(steps.splits, &StepWriter::split);
  }

 private:
  template <class Step>
  Result<void> each(const std::vector<Step>& steps, Result<void> (StepWriter::*act)(const Step&)) {
    for (const Step& step : steps)
      if (auto ok = (this->*act)(step); !ok) return ok;
    return {};
  }

  Result<std::size_t> bone_named(const std::string& name) const {
    for (std::size_t i = 0; i < anatomy_.bones.size(); ++i)
      if (anatomy_.bones[i].name == name) return i;
    return fail("names no bone of the description: '" + name + "'");
  }
  SoftDescription* soft_named(const std::string& name) {
    for (SoftDescription& soft : anatomy_.softs)
      if (soft.name == name) return &soft;
    return nullptr;
  }

  Result<void> cut(const CutStep& step) {
    const auto bone = bone_named(step.bone);
    if (!bone) return tl::unexpected(bone.error());
    const BoundPart part{*bone, step.part};
    if (const auto of = bone_named(step.of)) {
      BoneDescription& cut = anatomy_.bones[*of];
      cut.defects.push_back(part);
      if (step.coarsest_cell > 0) cut.coarsest_cell_m = step.coarsest_cell;
      return {};
    }
    SoftDescription* soft = soft_named(step.of);
    if (!soft) return fail("names no bone and no soft part: '" + step.of + "'");
    if (std::holds_alternative<SkinDescription>(soft->shape)) return fail("cannot cut the skin");
    soft->defects.push_back(part);
    soft->pieces = std::max(soft->pieces, step.pieces);
    if (step.coarsest_cell > 0) soft->cell = std::min(soft->cell, step.coarsest_cell);
    return {};
  }

  Result<void> thin(const ThinStep& step) {
    SoftDescription* soft = soft_named(step.of);
    if (!soft) return fail("names no soft part: '" + step.of + "'");
    if (auto* band = std::get_if<BandDescription>(&soft->shape)) {
      for (BandPoint& point : band->path) point.thickness *= step.share;
    } else if (auto* layer = std::get_if<LayerDescription>(&soft->shape)) {
      layer->thickness *= step.share;
    } else {
      return fail("has no thickness to reduce: '" + step.of + "'");
    }
    return {};
  }

  Result<void> move(const MoveStep& step) {
    Displacement moved;
    for (const std::string& name : step.bones) {
      const auto bone = bone_named(name);
      if (!bone) return tl::unexpected(bone.error());
      moved.bones.push_back(*bone);
    }
    moved.R_W = step.R_W;
    moved.shift_W = step.shift_W;
    moved.pivot = {moved.bones[0], step.pivot_W};
    anatomy_.displacements.push_back(std::move(moved));
    return {};
  }

  Result<void> split(const SplitStep& step) {
    const auto bone = bone_named(step.bone);
    if (!bone) return tl::unexpected(bone.error());
    BoneSplit split;
    split.bone = *bone;
    for (const SplitStep::Into& into : step.into) {
      if (bone_named(into.name) || soft_named(into.name))
        return fail("gives a fragment the name of another part: '" + into.name + "'");
      split.fragments.push_back({into.name, {*bone, into.near_W}});
    }
    anatomy_.splits.push_back(std::move(split));
    return {};
  }

  Result<void> mark(const MarkStep& step) {
    const auto bone = bone_named(step.bone);
    if (!bone) return tl::unexpected(bone.error());
    for (const LandmarkDescription& other : anatomy_.landmarks)
      if (other.name == step.name)
        return fail("names a landmark that already exists: '" + step.name + "'");
    LandmarkDescription landmark;
    landmark.name = step.name;
    landmark.p_W = step.p_W;
    landmark.bone = *bone;
    anatomy_.landmarks.push_back(std::move(landmark));
    return {};
  }

  AnatomyDescription& anatomy_;
};

}  // namespace

Result<std::vector<GeneratedFinding>> apply_findings(const FindingTable& table,
                                                     const std::vector<FindingChoice>& choices,
                                                     AnatomyDescription& anatomy) {
  std::vector<GeneratedFinding> applied;
  for (const FindingChoice& choice : choices) {
    const std::string where = "finding '" + choice.finding + "'";
    const auto rule = std::find_if(table.rules.begin(), table.rules.end(),
                                   [&](const auto& r) { return r.finding.name == choice.finding; });
    if (rule == table.rules.end()) return fail("is not known", where, names_and_grades(table));
    for (const GeneratedFinding& other : applied)
      if (other.name == choice.finding) return fail("is given twice", where);
    const auto& grades = rule->finding.grades;
    const auto grade = std::find_if(grades.begin(), grades.end(),
                                    [&](const FindingGrade& g) { return g.name == choice.grade; });
    if (grade == grades.end())
      return fail("has no grade '" + choice.grade + "'", where, names_and_grades(table));
    const auto& steps = rule->steps[static_cast<std::size_t>(grade - grades.begin())];
    if (auto ok = StepWriter(anatomy).write(steps); !ok)
      return fail(ok.error().what, table.file + ": " + where + ", grade '" + grade->name + "'");
    applied.push_back({choice.finding, grade->name, grade->meaning});
  }
  return applied;
}

}  // namespace osteon
