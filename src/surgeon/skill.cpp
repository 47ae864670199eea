#include "osteon/surgeon/skill.h"

#include <charconv>

#include "osteon/base/random.h"

namespace osteon {

Skill expert_skill() { return {}; }

Skill novice_skill(std::uint64_t seed) {
  Random random(seed * 7919 + 17);
  Skill skill;
  skill.name = "novice:" + std::to_string(seed);
  skill.seed = seed;
  skill.tremor_m = random.uniform(0.00010, 0.00030);
  skill.delay_s = random.uniform(0.18, 0.32);
  skill.travel_m_per_s = random.uniform(0.06, 0.13);
  skill.approach_m_per_s = random.uniform(0.015, 0.045);
  skill.press_n = random.uniform(1.2, 3.2);
  skill.press_spread_n = random.uniform(0.2, 0.8);
  skill.dwell_s = random.uniform(0.5, 1.2);
  skill.think_s = random.uniform(0.3, 1.5);
  skill.detour_m = random.uniform(0.01, 0.05);
  skill.drift_m_per_s = random.uniform(0, 0.003);
  skill.skip_share = random.uniform(0, 0.04);
  skill.misgrade_share = random.uniform(0.2, 0.6);
  return skill;
}

Result<Skill> bad_skill(const Scenario& scenario, const std::string& error_name) {
  for (const ScenarioError& error : scenario.errors) {
    if (error.name != error_name) continue;
    Skill skill = expert_skill();
    skill.name = "bad:" + error_name;
    skill.fault = error.rule.kind;
    skill.fault_hand = error.rule.hand;
    return skill;
  }
  return fail("the scenario '" + scenario.name + "' has no error '" + error_name + "'", "surgeon",
              "See: osteon scenario info " + scenario.name);
}

namespace {

// Who misses faults takes them for sound; who blames what is sound takes it for the first fault.
void misstate(const std::string& fault, const AskedFinding& asked, std::string& grade) {
  const bool sound = grade == kSoundGrade || grade == kNoFinding;
  if (fault == "fault_missed" && !sound) grade = kSoundGrade;
  if (fault != "sound_blamed" || !sound) return;
  for (const std::string& other : asked.grades)
    if (other != kSoundGrade) {
      grade = other;
      return;
    }
}

}  // namespace

StatedFindings stated_by(const Skill& skill, const Scenario& scenario, const Case& the_case) {
  StatedFindings stated = true_findings(scenario.asks, the_case);
  for (const AskedFinding& asked : scenario.asks) misstate(skill.fault, asked, stated[asked.name]);
  Random random(skill.seed * 104729 + 3);
  for (const AskedFinding& asked : scenario.asks) {
    std::vector<std::string> others{kNoFinding};
    others.insert(others.end(), asked.grades.begin(), asked.grades.end());
    std::erase(others, stated[asked.name]);
    const double misses = random.uniform(), which = random.uniform();
    if (misses < skill.misgrade_share && !others.empty())
      stated[asked.name] =
          others[static_cast<std::size_t>(which * static_cast<double>(others.size()))];
  }
  return stated;
}

Result<Skill> parse_skill(const Scenario& scenario, std::string_view text) {
  if (text == "expert") return expert_skill();
  if (text == "novice") return novice_skill(1);
  if (text.starts_with("bad:")) return bad_skill(scenario, std::string(text.substr(4)));
  if (text.starts_with("novice:")) {
    const std::string_view digits = text.substr(7);
    std::uint64_t seed = 0;
    const auto [end, ec] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
    if (ec == std::errc() && end == digits.data() + digits.size() && !digits.empty())
      return novice_skill(seed);
  }
  return fail("there is no surgeon '" + std::string(text) + "'", "surgeon",
              "Use expert, novice, novice:SEED or bad:NAME");
}

std::vector<std::string> surgeons_of(const Scenario& scenario) {
  std::vector<std::string> names{"expert", "novice"};
  for (const ScenarioError& error : scenario.errors) names.push_back("bad:" + error.name);
  return names;
}

}  // namespace osteon
