#include <nlohmann/json.hpp>

#include "hex.h"
#include "osteon/procedure/report.h"

namespace osteon {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson bone_json(const BoneReport& bone) {
  return {{"first_contact_s", bone.first_contact_s},
          {"contact_time_s", bone.contact_time_s},
          {"peak_force_n", bone.peak_force_n},
          {"mean_force_n", bone.mean_force_n},
          {"deepest_mm", bone.deepest_mm}};
}

}  // namespace

std::string to_json(const Report& report) {
  OrderedJson bones = OrderedJson::object();
  for (const BoneReport& bone : report.bones) bones[bone.name] = bone_json(bone);
  const OrderedJson json = {{"case", report.case_name},
                            {"case_hash", hex16(report.case_hash)},
                            {"duration_s", report.duration_s},
                            {"ticks", report.ticks},
                            {"bones", bones},
                            {"path_length_mm", report.path_length_mm},
                            {"smoothness_sparc", report.smoothness_sparc},
                            {"state_hash", hex16(report.state_hash)},
                            {"tick_us",
                             {{"p50", report.tick_p50_us},
                              {"p99", report.tick_p99_us},
                              {"p999", report.tick_p999_us},
                              {"max", report.tick_max_us}}},
                            {"missed_ticks", report.missed_ticks},
                            {"realtime_factor", report.realtime_factor}};
  // A name from a foreign file may not be UTF-8: show what can be shown.
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace osteon
