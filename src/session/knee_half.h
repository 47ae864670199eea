#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "osteon/scene/command.h"
#include "osteon/scene/knee_exam.h"
#include "osteon/session/session_state.h"

namespace osteon {

/// A knee that is examined by hand in a session: what was told of how it gives, and where its
/// lower leg stands under the loads. What changes from step to step is in KneeExamState.
class KneeHalf {
 public:
  KneeHalf(std::shared_ptr<const Case> the_case, double step_s);

  /// False: the command is about something else. Allocates with a table's last number alone.
  bool obey(const Command& command, KneeExamState& exam);
  /// One step: the loads go to where they are wanted, and the knee gives. One that is bent more
  /// than the table says is not loaded, and one that is to be bent so far is let go.
  void step(const BendState& bend, KneeExamState& exam) const;
  /// Pose of a moved bone of the joint in the one that stays.
  Pose pose_in_fixed(const CaseJoint& joint, const CaseJoint::Moved& moved, double bend_deg,
                     const KneeGive& give) const;

  ToldKnee told() const;
  /// Whether a state can have been left by this knee.
  bool fits(const KneeExamState& exam, const ToldKnee& told) const;
  /// `told` fits.
  void restore(const ToldKnee& told);

 private:
  void read();

  std::shared_ptr<const Case> case_;
  double step_s_;
  std::vector<double> numbers_;
  std::optional<KneeGiveTable> table_;
  mutable ToldKnee kept_;  ///< of what was told; null: it has changed since
};

}  // namespace osteon
