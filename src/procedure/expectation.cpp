#include "expectation.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "hex.h"
#include "osteon/procedure/report.h"

namespace osteon {
namespace {

using Lines = std::vector<std::string>;

const BoneReport* find_bone(const Report& report, const std::string& name) {
  const auto same = [&](const BoneReport& bone) { return bone.name == name; };
  const auto found = std::find_if(report.bones.begin(), report.bones.end(), same);
  return found == report.bones.end() ? nullptr : &*found;
}

std::string text_of(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(digits, end);
}

std::string text_of(const ExpectedRange& range) {
  const ExpectedRange all;
  if (range.min == all.min) return "at most " + text_of(range.max);
  if (range.max == all.max) return "at least " + text_of(range.min);
  return text_of(range.min) + " to " + text_of(range.max);
}

// Not `<` and `>`: a value that is not a number is in no range.
void check_range(const std::string& what, double value, const ExpectedRange& range, Lines& lines) {
  if (!(value >= range.min && value <= range.max))
    lines.push_back(what + " is " + text_of(value) + ", expected " + text_of(range));
}

double value_of(const BoneReport& bone, const std::string& key) {
  if (key == "first_contact_s") return bone.first_contact_s;
  if (key == "contact_time_s") return bone.contact_time_s;
  if (key == "peak_force_n") return bone.peak_force_n;
  if (key == "mean_force_n") return bone.mean_force_n;
  return bone.deepest_mm;
}

double value_of(const Report& report, const std::string& key) {
  if (key == "path_length_mm") return report.path_length_mm;
  if (key == "duration_s") return report.duration_s;
  if (key == "smoothness_sparc") return report.smoothness_sparc;
  if (key == "ticks") return static_cast<double>(report.ticks);
  if (key == "missed_ticks") return static_cast<double>(report.missed_ticks);
  return report.realtime_factor;
}

double tick_time_of(const Report& report, const std::string& key) {
  if (key == "p50") return report.tick_p50_us;
  if (key == "p99") return report.tick_p99_us;
  if (key == "p999") return report.tick_p999_us;
  return report.tick_max_us;
}

// Bones that the expectation wants touched, in whatever way it says so.
std::set<std::string> wanted_touched(const Expectation& e) {
  std::set<std::string> names(e.touched.begin(), e.touched.end());
  names.insert(e.order.begin(), e.order.end());
  for (const auto& [name, ranges] : e.bones) names.insert(name);
  return names;
}

Result<void> check_names(const Expectation& e, const Report& report) {
  const std::set<std::string> wanted = wanted_touched(e);
  std::set<std::string> all = wanted;
  all.insert(e.untouched.begin(), e.untouched.end());
  for (const std::string& name : all)
    if (!find_bone(report, name))
      return fail("the case has no bone '" + name + "'", "expectation",
                  "Check the bone's name with `osteon case info`");
  for (const std::string& name : e.untouched)
    if (wanted.count(name))
      return fail("'" + name + "' is expected to be touched and not to be touched", "expectation",
                  "Remove one of the two");
  return {};
}

void check_touched(const Expectation& e, const Report& report, Lines& lines) {
  const std::set<std::string> wanted = wanted_touched(e);
  const std::set<std::string> unwanted(e.untouched.begin(), e.untouched.end());
  for (const BoneReport& bone : report.bones) {
    const bool want = wanted.count(bone.name) > 0;
    if (want && !bone.touched()) lines.push_back(bone.name + " was never touched");
    const bool forbidden = unwanted.count(bone.name) > 0 || (e.all_others_untouched && !want);
    if (forbidden && bone.touched())
      lines.push_back(bone.name + " was touched at " + text_of(bone.first_contact_s) +
                      " s, expected never");
  }
}

void check_order(const Expectation& e, const Report& report, Lines& lines) {
  for (std::size_t i = 1; i < e.order.size(); ++i) {
    const BoneReport& before = *find_bone(report, e.order[i - 1]);
    const BoneReport& after = *find_bone(report, e.order[i]);
    if (before.touched() && after.touched() && after.first_contact_s < before.first_contact_s)
      lines.push_back(after.name + " was touched before " + before.name + ", expected after");
  }
}

void check_bones(const Expectation& e, const Report& report, Lines& lines) {
  for (const auto& [name, ranges] : e.bones) {
    const BoneReport& bone = *find_bone(report, name);
    if (!bone.touched()) continue;  // said already
    for (const auto& [key, range] : ranges)
      check_range(name + " " + key, value_of(bone, key), range, lines);
  }
}

void check_whole(const Expectation& e, const Report& report, Lines& lines) {
  if (e.case_name && *e.case_name != report.case_name)
    lines.push_back("case is '" + report.case_name + "', expected '" + *e.case_name + "'");
  for (const auto& [key, range] : e.whole) check_range(key, value_of(report, key), range, lines);
  for (const auto& [key, range] : e.tick_us)
    check_range("tick_us " + key, tick_time_of(report, key), range, lines);
  if (e.state_hash && *e.state_hash != hex16(report.state_hash))
    lines.push_back("state_hash is " + hex16(report.state_hash) + ", expected " + *e.state_hash);
}

}  // namespace

Result<std::vector<std::string>> check_expectation(const Report& report,
                                                   const std::string& expectation_json) {
  const auto expectation = parse_expectation(expectation_json);
  if (!expectation) return tl::unexpected(expectation.error());
  if (const auto done = check_names(*expectation, report); !done)
    return tl::unexpected(done.error());
  Lines lines;
  check_whole(*expectation, report, lines);
  check_touched(*expectation, report, lines);
  check_order(*expectation, report, lines);
  check_bones(*expectation, report, lines);
  return lines;
}

}  // namespace osteon
