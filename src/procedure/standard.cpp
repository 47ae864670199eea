#include "osteon/procedure/standard.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/file.h"
#include "toml_table.h"

namespace osteon {
namespace {

constexpr double kPointsPerSd = 10;
constexpr double kFarthestZ = 6;
constexpr double kTwoSided95 = 1.96;

StandardMetric read_standard_metric(TomlTable table) {
  StandardMetric metric;
  metric.name = table.text("name");
  metric.mean = table.number("mean", -1e12, 1e12);
  metric.sd = table.number("sd", 1e-12, 1e12);
  metric.weight = table.number("weight", 0, 100);
  metric.lower_is_better = table.word("better", {"lower", "higher"}) == "lower";
  table.refuse_others();
  return metric;
}

std::string exact_text(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.6g", value);
  return digits;
}

// As a TOML string holds it.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20 || c == '\t')
      out += c;
    else
      out += ' ';
  }
  return out + '"';
}

}  // namespace

Result<Standard> parse_standard(std::string_view text, const std::string& where) {
  const auto parsed = parse_procedure_toml(text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  std::optional<Error> error;
  TomlTable table(*parsed, where, error);
  Standard standard;
  table.number("format", 1, 1);
  standard.scenario = table.text("scenario");
  standard.version = static_cast<int>(table.number("version", 1, 1e9));
  standard.source = table.text("source");
  standard.experts = static_cast<int>(table.number("experts", 0, 1e9));
  standard.reliability = table.number("reliability", 0, 1);
  standard.score_sd = table.number("score_sd", 0, 1e6);
  standard.pass_score = table.number("pass_score", -1e6, 1e6);
  for (TomlTable& metric : table.tables_or_empty("metrics"))
    standard.metrics.push_back(read_standard_metric(metric));
  double weights = 0;
  for (const StandardMetric& metric : standard.metrics) weights += metric.weight;
  if (!(weights > 0)) table.set_error("a standard needs a metric with a weight", "scenario");
  table.refuse_others();
  if (error) return tl::unexpected(*error);
  return standard;
}

Result<Standard> load_standard(const std::filesystem::path& file) {
  const auto text = read_file(file, 4u << 20);
  if (!text) return tl::unexpected(text.error());
  return parse_standard(*text, file.string());
}

std::string to_toml(const Standard& s) {
  std::string text =
      "format = 1\nscenario = " + quoted(s.scenario) + "\nversion = " + std::to_string(s.version) +
      "\nsource = " + quoted(s.source) + "\nexperts = " + std::to_string(s.experts) +
      "\nreliability = " + exact_text(s.reliability) + "\nscore_sd = " + exact_text(s.score_sd) +
      "\npass_score = " + exact_text(s.pass_score) + "\n";
  for (const StandardMetric& m : s.metrics)
    text += "\n[[metrics]]\nname = " + quoted(m.name) + "\nmean = " + exact_text(m.mean) +
            "\nsd = " + exact_text(m.sd) + "\nweight = " + exact_text(m.weight) +
            "\nbetter = " + (m.lower_is_better ? "\"lower\"" : "\"higher\"") + "\n";
  return text;
}

Result<Score> score_of(const Standard& standard, const Metrics& metrics, double points) {
  double sum = 0, weights = 0;
  for (const StandardMetric& m : standard.metrics) {
    const auto found = metrics.find(m.name);
    if (found == metrics.end() || !std::isfinite(found->second))
      return fail("the attempt has no metric '" + m.name + "'", "standard of " + standard.scenario,
                  "Check the standard's metrics");
    const double z = (found->second - m.mean) / m.sd * (m.lower_is_better ? -1 : 1);
    sum += m.weight * std::clamp(z, -kFarthestZ, kFarthestZ);
    weights += m.weight;
  }
  if (!(weights > 0))
    return fail("the weights of the standard are all zero", "standard of " + standard.scenario);
  const double value = 100 + kPointsPerSd * sum / weights - points;
  const double sem = standard.score_sd * std::sqrt(1 - standard.reliability);
  return Score{value, value - kTwoSided95 * sem, value + kTwoSided95 * sem};
}

std::string_view to_text(Verdict verdict) {
  if (verdict == Verdict::kPassed) return "passed";
  return verdict == Verdict::kNotPassed ? "not_passed" : "undecided";
}

Verdict verdict_of(const Standard& standard, const Score& score) {
  if (score.lo >= standard.pass_score) return Verdict::kPassed;
  return score.hi < standard.pass_score ? Verdict::kNotPassed : Verdict::kUndecided;
}

}  // namespace osteon
