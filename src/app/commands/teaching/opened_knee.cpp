#include "commands/teaching/opened_knee.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "exercises/skin_order.h"
#include "osteon/surgeon/puncture_surgeon.h"

namespace osteon {
namespace {

constexpr double kBendAfter_s = 0.3, kBent_deg_per_s = 90, kAnswered_s = 0.5;

bool has_goal_of_kind(const std::vector<PlannedRule>& goals, std::string_view kind) {
  return std::any_of(goals.begin(), goals.end(),
                     [&](const PlannedRule& goal) { return goal.rule.kind == kind; });
}

bool wants_portals(const ScenarioPlan& plan) {
  return std::any_of(plan.goals.begin(), plan.goals.end(),
                     [](const auto& goals) { return has_goal_of_kind(goals, "portal_made"); });
}

bool errs_with_portals(const Skill& skill) {
  const auto faults = puncture_faults();
  return skill.name.starts_with("bad:") &&
         std::find(faults.begin(), faults.end(), skill.name.substr(4)) != faults.end();
}

}  // namespace

std::vector<std::string> marks_before_bending(const ScenarioPlan& plan, std::string_view kind) {
  std::vector<std::string> marks;
  const auto bent = stage_bent_after_portals(plan);
  for (std::size_t s = bent.value_or(0); s-- > 0;) {
    if (has_goal_of_kind(plan.goals[s], "portal_made")) break;
    for (const PlannedRule& goal : plan.goals[s])
      if (goal.rule.kind == kind)
        marks.insert(marks.end(), goal.rule.marks.begin(), goal.rule.marks.end());
  }
  return marks;
}

Result<std::optional<OpenedKnee>> plan_opening(const ScenarioPlan& plan, const Case& the_case,
                                               const Skill& skill, AclTools& tools) {
  if (!wants_portals(plan)) return std::optional<OpenedKnee>();
  OpenedKnee out;
  // What the reconstruction calls so is done with a drill.
  out.erred = errs_with_portals(skill) && skill.name != "bad:plunged";
  Skill at_skin = skill;
  if (!out.erred && at_skin.name.starts_with("bad:")) at_skin.name = "expert";
  auto ways = plan_puncture(
      the_case, tools.scope, tools.optics, at_skin,
      {tools.probe, true, marks_before_bending(plan, "seen"), marks_before_bending(plan, "felt")});
  if (!ways) return tl::unexpected(ways.error());
  out.unreachable = std::move(ways->unseen);
  out.unreachable.insert(out.unreachable.end(), ways->unfelt.begin(), ways->unfelt.end());
  out.scope = std::move(ways->scope);
  out.worker = std::move(ways->worker);
  out.end_s = std::max(out.scope.duration_s(), out.worker.duration_s());
  if (out.erred) return std::optional(std::move(out));
  if (!the_case.joints.empty() && the_case.joints.front().begin_deg) {
    const CaseJoint& joint = the_case.joints.front();
    out.orders.push_back({out.end_s + kBendAfter_s, {CommandKind::kBend, joint.at_deg}});
    out.end_s +=
        kBendAfter_s + kAnswered_s + std::abs(joint.at_deg - *joint.begin_deg) / kBent_deg_per_s;
  }
  tools.begin_s = out.end_s;
  tools.al_W = ways->al_W;
  tools.am_W = ways->am_W;
  return std::optional(std::move(out));
}

ProbePath joined(ProbePath first, const ProbePath& then) {
  const double end_s = first.duration_s();
  for (const PathSample& sample : then.samples)
    if (sample.time_s > end_s) first.samples.push_back(sample);
  return first;
}

}  // namespace osteon
