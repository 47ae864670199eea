#include "exercises/exam_order.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "cases/open_case.h"
#include "loops/realtime.h"
#include "runs/reports/acl_report.h"

namespace osteon {
namespace {

bool is_same_graft(const KneeGraft& a, const KneeGraft& b) {
  return a.from_W == b.from_W && a.to_W == b.to_W && a.diameter_m == b.diameter_m &&
         a.tension_n == b.tension_n && a.flexion_deg == b.flexion_deg &&
         a.fixation_n_per_m == b.fixation_n_per_m && a.slack_m == b.slack_m && a.held == b.held;
}

}  // namespace

bool asks_for_exam(const ScenarioPlan& plan) {
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.rule.kind == "knee_examined") return true;
  return false;
}

ExamOrder::ExamOrder(const Case& the_case, std::string case_spec, bool in_background)
    : case_(&the_case), in_background_(in_background) {
  work_.spec = std::move(case_spec);
}

Result<KneeGiveTable> ExamOrder::table_of(Work& work) {
  const auto ligaments = shipped_ligaments();
  if (!ligaments) return tl::unexpected(ligaments.error());
  if (!work.whole) {
    auto grown = open_case_def(work.spec);
    if (!grown) return tl::unexpected(grown.error());
    work.whole = std::make_shared<const CaseDef>(std::move(*grown));
  }
  if (!work.intact) {
    KneeChanges healed;
    healed.heal = true;
    auto intact = give_of_knee(*work.whole, *ligaments, healed);
    if (!intact) return intact;
    work.intact = *intact;
  }
  KneeChanges changes;
  changes.graft = work.graft;
  auto table = give_of_knee(*work.whole, *ligaments, changes);
  if (table) set_other_knee(*table, *work.intact);
  return table;
}

ExamOrder::Work ExamOrder::computed(Work work) {
  auto table = table_of(work);
  work.problem = table ? std::nullopt : std::optional<Error>(table.error());
  work.table = table ? std::optional(*table) : std::nullopt;
  return work;
}

void ExamOrder::compute(const std::optional<KneeGraft>& fixed) {
  if (job_.valid()) return;
  work_.graft = fixed;
  if (in_background_) {
    job_ = std::async(std::launch::async, [work = work_]() mutable {
      take_late_turns();
      return computed(std::move(work));
    });
    return;
  }
  work_ = computed(std::move(work_));
  keep();
}

// Numbers of what was computed; empty where it could not be.
void ExamOrder::keep() {
  std::vector<double> numbers;
  const BoneId tibia = case_->find("tibia"), fibula = case_->find("fibula");
  if (work_.table && tibia.valid()) {
    work_.table->tibia = tibia.index;
    work_.table->fibula = fibula.valid() ? fibula.index : tibia.index;
    numbers = give_numbers(*work_.table);
  }
  if (work_.graft) held_by_ = work_.graft;
  const std::uint64_t digest = give_digest(numbers);
  (work_.graft ? held_ : found_) = Told{std::move(numbers), digest};
}

void ExamOrder::see(const std::optional<KneeGraft>& fixed, const BoneSnapshot& bones) {
  if (job_.valid() && job_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    work_ = job_.get();
    keep();
  }
  teller_.look(bones.time_s);
  if (teller_.telling() || is_loaded(bones.exam)) return;
  if (fixed && held_ && !(held_by_ && is_same_graft(*held_by_, *fixed))) held_.reset();
  const auto& told = fixed ? held_ : found_;
  if (!told) return compute(fixed);
  if (told->numbers.empty() || bones.exam.digest == told->digest) return;
  if (bones.exam.told > 0 && teller_.under_way(bones.time_s)) return;
  teller_.tell(told->numbers, bones.time_s);
}

}  // namespace osteon
