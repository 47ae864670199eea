#include "knee_half.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteon {
namespace {

// Hands pull so fast (own default): the full load in half a second.
constexpr double kLoad_per_s = 2;

void take_hold(KneeTest test, double share, KneeExamState& exam) {
  if (!exam.on || !(share >= 0 && std::isfinite(share))) return;
  exam.wanted = {};
  exam.wanted[static_cast<std::size_t>(test)] = std::min(share, 1.0);
}

}  // namespace

KneeHalf::KneeHalf(std::shared_ptr<const Case> the_case, double step_s)
    : case_(std::move(the_case)), step_s_(step_s) {
  numbers_.reserve(kKneeGiveNumbers);
}

bool KneeHalf::obey(const Command& command, KneeExamState& exam) {
  switch (command.kind) {
    case CommandKind::kKneeOrder:
      exam = {};
      numbers_.clear();
      table_.reset();
      kept_.reset();
      return true;
    case CommandKind::kKneeNumber:
      if (numbers_.size() >= kKneeGiveNumbers) return true;
      numbers_.push_back(command.value);
      kept_.reset();
      exam.told = static_cast<std::uint32_t>(numbers_.size());
      exam.digest = give_digest(exam.digest, command.value);
      if (numbers_.size() < kKneeGiveNumbers) return true;
      read();
      exam.on = table_.has_value();
      if (!table_) return true;
      exam.knee = table_->knee;
      exam.front_n = table_->front_n;
      exam.valgus_nm = table_->valgus_nm;
      exam.internal_nm = table_->internal_nm;
      return true;
    case CommandKind::kLachman:
      if (exam.on) take_hold(KneeTest::kLachman, command.value / exam.front_n, exam);
      return true;
    case CommandKind::kPivot:
      take_hold(KneeTest::kPivot, command.value, exam);
      return true;
    default:
      return false;
  }
}

void KneeHalf::step(const BendState& bend, KneeExamState& exam) const {
  if (!exam.on || !table_) return;
  if (bend.wanted_deg > KneeGiveTable::kMost_deg) exam.wanted = {};
  const bool may = bend.now_deg <= KneeGiveTable::kMost_deg;
  const double most = kLoad_per_s * step_s_;
  exam.give = {};
  for (std::size_t i = 0; i < kKneeTests; ++i) {
    const double wanted = may ? exam.wanted[i] : 0;
    exam.now[i] += std::clamp(wanted - exam.now[i], -most, most);
    const auto give = give_at(*table_, static_cast<KneeTest>(i), bend.now_deg, exam.now[i]);
    if (give) exam.give = sum_of(exam.give, *give);
  }
}

Pose KneeHalf::pose_in_fixed(const CaseJoint& joint, const CaseJoint::Moved& moved, double bend_deg,
                             const KneeGive& give) const {
  const Pose bent = pose_at(moved.X_FB, bend_deg);
  if (!table_) return bent;
  if (moved.bone.index != table_->tibia && moved.bone.index != table_->fibula) return bent;
  for (const CaseJoint::Moved& with : joint.bones)
    if (with.bone.index == table_->tibia)
      return given_pose(give, pose_at(with.X_FB, bend_deg) * table_->middle_T, bent);
  return bent;
}

void KneeHalf::read() { table_ = give_of_numbers(*case_, numbers_); }

ToldKnee KneeHalf::told() const {
  if (!kept_ && !numbers_.empty()) kept_ = std::make_shared<const std::vector<double>>(numbers_);
  return kept_;
}

bool KneeHalf::fits(const KneeExamState& exam, const ToldKnee& told) const {
  for (const auto* shares : {&exam.wanted, &exam.now})
    for (const double share : *shares)
      if (!(share >= 0 && share <= 1)) return false;
  if (!told) return !exam.on && exam.told == 0;
  const bool whole = told->size() == kKneeGiveNumbers && give_of_numbers(*case_, *told);
  return exam.told == told->size() && exam.told <= kKneeGiveNumbers && exam.on == whole &&
         exam.digest == give_digest(*told);
}

void KneeHalf::restore(const ToldKnee& told) {
  if (told == kept_ && (told || numbers_.empty())) return;
  numbers_.clear();
  if (told) numbers_.assign(told->begin(), told->end());
  kept_ = told;
  read();
}

}  // namespace osteon
