#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "exercises/number_teller.h"
#include "osteon/physics/knee_give.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/command.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Whether a scenario has the knee examined by hand.
bool asks_for_exam(const ScenarioPlan& plan);

/// Tells a session how its knee gives under the tests by hand, by commands that are recorded: as it
/// was found, and anew once a graft is fixed in it. Each is computed once. After a restore point
/// the session knows again what it knew then. The case must outlive it.
class ExamOrder {
 public:
  /// `case_spec`: grows the knee before anything was drilled. `in_background`: computes on another
  /// thread, for who may not wait.
  ExamOrder(const Case& the_case, std::string case_spec, bool in_background);
  /// `fixed`: what holds the knee; none: nothing does. Not while hands load the knee.
  void see(const std::optional<KneeGraft>& fixed, const BoneSnapshot& bones);
  /// The next command for the physics; none: there is nothing to say. One a physics step.
  std::optional<Command> take() { return teller_.take(); }
  /// Why the knee cannot be examined.
  const std::optional<Error>& problem() const { return work_.problem; }

 private:
  /// What is computed, and what stays for the next time.
  struct Work {
    std::string spec;
    std::shared_ptr<const CaseDef> whole;  ///< null: to be grown
    std::optional<KneeGiveTable> intact;   ///< none: to be computed
    std::optional<KneeGraft> graft;
    std::optional<KneeGiveTable> table;
    std::optional<Error> problem;
  };
  static Work computed(Work work);
  static Result<KneeGiveTable> table_of(Work& work);
  void compute(const std::optional<KneeGraft>& fixed);
  void keep();

  const Case* case_;
  bool in_background_;
  Work work_;
  std::future<Work> job_;
  /// What is told of one knee, with its digest: it is compared at each step.
  struct Told {
    std::vector<double> numbers;
    std::uint64_t digest = 0;
  };
  std::optional<Told> found_;  ///< of the knee as it was found
  std::optional<Told> held_;   ///< and with the graft that is fixed
  std::optional<KneeGraft> held_by_;
  NumberTeller teller_{CommandKind::kKneeOrder, CommandKind::kKneeNumber};
};

}  // namespace osteon
