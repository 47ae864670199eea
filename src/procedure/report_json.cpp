#include <nlohmann/json.hpp>

#include "hex.h"
#include "osteon/procedure/hand_reports.h"

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

OrderedJson bones_json(const Report& report) {
  OrderedJson bones = OrderedJson::object();
  for (const BoneReport& bone : report.bones) bones[bone.name] = bone_json(bone);
  return bones;
}

OrderedJson portals_json(const Report& report) {
  OrderedJson portals = OrderedJson::object();
  for (const PortalReport& portal : report.portals)
    portals[portal.name] = {{"time_s", portal.time_s}, {"times_entered", portal.times_entered}};
  return portals;
}

// What belongs to the run, before and after what belongs to a hand.
OrderedJson head_json(const Report& report) {
  return {{"case", report.case_name},
          {"case_hash", hex16(report.case_hash)},
          {"duration_s", report.duration_s},
          {"ticks", report.ticks}};
}

OrderedJson times_json(double p50, double p99, double p999, double max) {
  return {{"p50", p50}, {"p99", p99}, {"p999", p999}, {"max", max}};
}

void add_tail(const Report& report, OrderedJson& json) {
  json["state_hash"] = hex16(report.state_hash);
  json["tick_us"] =
      times_json(report.tick_p50_us, report.tick_p99_us, report.tick_p999_us, report.tick_max_us);
  if (report.step_max_us > 0)
    json["step_us"] =
        times_json(report.step_p50_us, report.step_p99_us, report.step_p999_us, report.step_max_us);
  json["missed_ticks"] = report.missed_ticks;
  json["realtime_factor"] = report.realtime_factor;
}

void add_hand(const Report& report, OrderedJson& json) {
  json["bones"] = bones_json(report);
  if (!report.portals.empty()) json["portals"] = portals_json(report);
  if (!report.events.empty()) json["events"] = report.events;
  json["path_length_mm"] = report.path_length_mm;
  json["smoothness_sparc"] = report.smoothness_sparc;
}

// A name from a foreign file may not be UTF-8: show what can be shown.
std::string json_text(const OrderedJson& json) {
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const Report& report) {
  OrderedJson json = head_json(report);
  add_hand(report, json);
  add_tail(report, json);
  return json_text(json);
}

std::string to_json(std::span<const Report> reports, std::span<const std::string> names) {
  OrderedJson json = head_json(reports.front());
  OrderedJson hands = OrderedJson::object();
  for (std::size_t h = 0; h < reports.size(); ++h) add_hand(reports[h], hands[names[h]]);
  json["hands"] = hands;
  add_tail(reports.front(), json);
  return json_text(json);
}

std::string to_json(std::span<const Report> reports, std::span<const std::string> names,
                    const Outcome& outcome) {
  std::string text = to_json(reports.front(), outcome);
  if (reports.size() < 2) return text;
  OrderedJson json = OrderedJson::parse(text);
  for (std::size_t h = 0; h < reports.size(); ++h) add_hand(reports[h], json["hands"][names[h]]);
  return json_text(json);
}

}  // namespace osteon
