#include "exercises/portal_choice.h"

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "exercises/skin_order.h"
#include "osteon/procedure/judge.h"

namespace osteon {

Result<std::string> with_made_portals(const std::string& case_spec, const ReportedPortals& made,
                                      const std::string& where) {
  const std::string patient = patient_of(case_spec);
  if (made.patient != patient)
    return fail("its portals are those of " + made.patient + ", not of " + patient, where,
                "Make them in the same patient and side: run acl_puncture with the same --seed");
  auto choice = parse_felt_choice(case_spec);
  if (!choice) return tl::unexpected(choice.error());
  choice->begins.clear();  // nothing is made in the knee as it would begin
  const auto the_case = open_case(case_spec, {}, CaseParts::kAll);
  if (!the_case) return tl::unexpected(the_case.error());
  for (const auto& [name, portal] : made.portals) {
    const auto mark = find_landmark(**the_case, name);
    const auto frame = mark ? portal_frame(**the_case, *mark) : std::nullopt;
    if (!frame) return fail("the case has no portal '" + name + "'", case_spec);
    const auto in_world = [&](const Vec3& v) {
      return Vec3(v.x() * frame->in_W + v.y() * frame->up_W + v.z() * frame->middle_W);
    };
    choice->portals[name] = {frame->p_W + in_world(portal.off_F), in_world(portal.shaft_F)};
  }
  return to_text(*choice);
}

void leave_out_what_case_has(Scenario& scenario, const std::string& case_spec) {
  const auto choice = parse_felt_choice(case_spec);
  if (choice && !choice->portals.empty()) leave_out_puncture_stages(scenario);
}

}  // namespace osteon
