#include <utility>

#include "osteon/base/file.h"
#include "osteon/procedure/scenario.h"
#include "toml_table.h"

namespace osteon {
namespace {

constexpr double kMany = 1e9;

// Whom a rule is asked of.
std::string read_patients(TomlTable& table, const char* key) {
  const std::string finding = table.text_or(key, "");
  if (!finding.empty() && finding.find('=') == std::string::npos)
    table.set_error("'" + finding + "' has no grade", key, "Write NAME=GRADE");
  return finding;
}

Rule read_rule(TomlTable& table, std::string_view key, bool is_goal) {
  Rule rule;
  rule.line = table.line();
  rule.kind = table.text(key);
  const RuleKind* kind = find_rule_kind(rule.kind);
  if (!kind || kind->is_goal != is_goal) {
    std::string names;
    for (const RuleKind& known : rule_table())
      if (known.is_goal == is_goal) names += (names.empty() ? "" : ", ") + std::string(known.name);
    table.set_error("there is no rule '" + rule.kind + "' for " + (is_goal ? "goals" : "errors"),
                    key, "Use one of: " + names);
    return rule;
  }
  rule.hand = table.text_or("hand", "");
  rule.instruments = table.texts_or_empty("instruments");
  if (kind->about == SubjectKind::kBone || kind->with_bone)
    rule.subjects = table.texts_or_empty("bones");
  if (kind->about == SubjectKind::kLandmark) {
    rule.marks = table.texts_or_empty("marks");
    if (rule.marks.empty()) table.set_error("the rule needs marks", key, "Add marks = [...]");
  }
  if (kind->with_bone && rule.subjects.size() != 1)
    table.set_error("the rule needs one bone", key, "Add bones = [\"NAME\"]");
  rule.when = read_patients(table, "when");
  rule.unless = read_patients(table, "unless");
  for (const RuleNumber& n : kind->numbers)
    rule.numbers[std::string(n.name)] = table.number_or(n.name, n.lo, n.hi, n.usual);
  return rule;
}

ScenarioStage read_stage(TomlTable table) {
  ScenarioStage stage;
  stage.line = table.line();
  stage.name = table.text("name");
  stage.title = table.text("title");
  stage.instruction = table.text("instruction");
  stage.cue = table.text_or("cue", "");
  stage.picture = table.text_or("picture", "");
  stage.restore_point = table.flag_or("restore_point", false);
  stage.restore_title = table.text_or("restore_title", "");
  if (!stage.restore_title.empty() && !stage.restore_point)
    table.set_error("a stage without a restore point names one", "restore_title",
                    "Add restore_point = true");
  for (TomlTable& goal : table.tables_or_empty("goals")) {
    stage.goals.push_back(read_rule(goal, "rule", true));
    goal.refuse_others();
  }
  if (stage.goals.empty()) table.set_error("a stage needs a goal", "name", "Add [[stages.goals]]");
  table.refuse_others();
  return stage;
}

ScenarioError read_error(TomlTable table) {
  ScenarioError error;
  error.name = table.text("name");
  error.title = table.text("title");
  const std::string severity = table.word("severity", {"minor", "major", "critical"});
  error.severity = severity == "minor"   ? Severity::kMinor
                   : severity == "major" ? Severity::kMajor
                                         : Severity::kCritical;
  error.consequence = table.text("consequence");
  error.points = table.number_or("points", 0, 100, 0);
  error.source = table.text("source");
  error.rule = read_rule(table, "rule", false);
  table.refuse_others();
  return error;
}

ScenarioMetric read_metric(TomlTable table) {
  ScenarioMetric metric;
  metric.name = table.text("name");
  metric.unit = table.text("unit");
  metric.weight = table.number("weight", 0, 100);
  metric.lower_is_better = table.word("better", {"lower", "higher"}) == "lower";
  metric.threshold = table.number("threshold", -kMany, kMany);
  metric.source = table.text("source");
  table.refuse_others();
  return metric;
}

AskedFinding read_asked(TomlTable table) {
  AskedFinding asked;
  asked.line = table.line();
  asked.name = table.text("finding");
  asked.title = table.text("title");
  asked.grades = table.texts_or_empty("grades");
  if (asked.grades.empty())
    table.set_error("no answer can be stated", "finding", "Add grades = [...]");
  table.refuse_others();
  return asked;
}

// One word for all bones, or what may follow the '#' of a case: "femur=field,flexion=120".
std::string read_felt(TomlTable& table) {
  const std::string felt = table.text_or("felt", "pieces");
  const bool one_word = felt == "pieces" || felt == "hull" || felt == "field" || felt == "covered";
  if (!one_word && felt.find('=') == std::string::npos)
    table.set_error("'" + felt + "' is not a felt shape of a bone", "felt",
                    "Use pieces, hull, field or covered, or BONE=field,... as after a case's '#'");
  return felt;
}

ScenarioHand read_hand(TomlTable table) {
  ScenarioHand hand;
  hand.line = table.line();
  hand.name = table.text("name");
  hand.instrument = table.text("instrument");
  hand.portal = table.text_or("portal", "");
  hand.also = table.texts_or_empty("also");
  table.refuse_others();
  return hand;
}

Scenario read_scenario(TomlTable& table) {
  Scenario scenario;
  table.number("format", 1, 1);
  scenario.name = table.text("name");
  scenario.title = table.text("title");
  scenario.text = table.text("text");
  scenario.version = static_cast<int>(table.number("version", 1, kMany));
  scenario.anatomy =
      table.word("anatomy", {"wrist", "knee", "fast_box", "fast_maze", "fast_meniscus", "fast_ring",
                             "fast_suture", "graft_bench"});
  scenario.felt = read_felt(table);
  scenario.soft = table.texts_or_empty("soft");
  scenario.fields = table.texts_or_empty("fields");
  scenario.cortex_mm = table.number_or("cortex_mm", 0, 30, scenario.cortex_mm);
  scenario.irrigation_ml_per_min =
      table.number_or("irrigation_ml_per_min", 0, 2000, scenario.irrigation_ml_per_min);
  scenario.time_limit_s = table.number_or("time_limit_s", 1, 36000, scenario.time_limit_s);
  scenario.ghost = table.flag_or("ghost", scenario.ghost);
  scenario.sides = table.texts_or_empty("sides");
  for (const std::string& side : scenario.sides)
    if (side != "left" && side != "right")
      table.set_error("'" + side + "' is not a side", "sides", "Use left and right");
  scenario.findings = table.texts_or_empty("findings");
  scenario.always = table.texts_or_empty("always");
  scenario.one_of = table.texts_or_empty("one_of");
  for (const auto& [key, list] :
       {std::pair("findings", &scenario.findings), std::pair("always", &scenario.always),
        std::pair("one_of", &scenario.one_of)})
    for (const std::string& finding : *list)
      if (finding.find('=') == std::string::npos)
        table.set_error("'" + finding + "' has no grade", key, "Write NAME=GRADE");
  for (TomlTable& hand : table.tables_or_empty("hands")) scenario.hands.push_back(read_hand(hand));
  if (scenario.hands.size() > 4) table.set_error("at most four hands are allowed", "hands");
  for (TomlTable& stage : table.tables_or_empty("stages"))
    scenario.stages.push_back(read_stage(stage));
  for (TomlTable& error : table.tables_or_empty("errors"))
    scenario.errors.push_back(read_error(error));
  for (TomlTable& metric : table.tables_or_empty("metrics"))
    scenario.metrics.push_back(read_metric(metric));
  for (TomlTable& asked : table.tables_or_empty("asks")) scenario.asks.push_back(read_asked(asked));
  if (scenario.stages.empty())
    table.set_error("a scenario needs a stage", "name", "Add [[stages]]");
  table.refuse_others();
  return scenario;
}

}  // namespace

std::string_view to_text(Severity severity) {
  if (severity == Severity::kMinor) return "minor";
  return severity == Severity::kMajor ? "major" : "critical";
}

Result<Scenario> parse_scenario(std::string_view text, const std::string& where) {
  const auto parsed = parse_procedure_toml(text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  std::optional<Error> error;
  TomlTable table(*parsed, where, error);
  Scenario scenario = read_scenario(table);
  scenario.where = where;
  scenario.source_text = text;
  if (error) return tl::unexpected(*error);
  return scenario;
}

Result<Scenario> load_scenario(const std::filesystem::path& file) {
  const auto text = read_file(file, 4u << 20);
  if (!text) return tl::unexpected(text.error());
  return parse_scenario(*text, file.string());
}

}  // namespace osteon
