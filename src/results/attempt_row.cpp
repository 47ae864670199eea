#include "osteon/results/attempt_row.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

namespace osteon {
namespace {

using RowJson = nlohmann::ordered_json;

RowJson or_null(const std::optional<double>& value) {
  return value ? RowJson(*value) : RowJson(nullptr);
}

std::optional<double> number_or_none(const RowJson& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

std::int64_t utc_now_ms() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
}

}  // namespace

std::string new_uuid() {
  std::random_device device;
  std::string text = "xxxxxxxx-xxxx-4xxx-yxxx-xxxxxxxxxxxx";
  for (char& c : text) {
    const unsigned digit = device() & 15u;
    if (c == 'x') c = "0123456789abcdef"[digit];
    if (c == 'y') c = "89ab"[digit & 3u];
  }
  return text;
}

bool is_uuid(std::string_view text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-' : !std::isxdigit(static_cast<unsigned char>(text[i]))) return false;
  }
  return true;
}

bool is_learner_id(std::string_view text) {
  const auto fits = [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '_' || c == '-';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), fits);
}

Result<AttemptRow> row_from_report(const std::string& report_json, const std::string& learner) {
  if (!is_learner_id(learner))
    return fail("'" + learner + "' is not a valid learner's id", "learner",
                "Use 1 to 64 letters, digits, '.', '_' and '-'");
  try {
    const RowJson json = RowJson::parse(report_json);
    AttemptRow row;
    row.id = new_uuid();
    row.learner = learner;
    row.scenario = json.at("scenario");
    row.scenario_version = json.at("scenario_version");
    row.standard_version = json.at("standard_version");
    row.verdict = json.at("verdict");
    row.score = number_or_none(json.at("score"));
    if (const RowJson& interval = json.at("score_interval"); !interval.is_null()) {
      row.score_lo = interval.at(0).get<double>();
      row.score_hi = interval.at(1).get<double>();
    }
    row.ended_ms = utc_now_ms();
    row.duration_s = json.at("duration_s");
    row.case_name = json.at("case");
    row.state_hash = json.at("state_hash");
    row.report_json = report_json;
    return row;
  } catch (const RowJson::exception& e) {
    return fail(std::string("the report is not that of an attempt (") + e.what() + ")", "report");
  }
}

bool was_guided(const AttemptRow& row) {
  const RowJson json = RowJson::parse(row.report_json, nullptr, false);
  if (!json.is_object() || !json.contains("metrics") || !json["metrics"].is_object()) return false;
  const RowJson& metrics = json["metrics"];
  const auto guided = metrics.find("guided_s");
  return guided != metrics.end() && guided->is_number() && guided->get<double>() > 0;
}

std::string to_json(const AttemptRow& row) {
  return RowJson{{"id", row.id},
                 {"learner", row.learner},
                 {"scenario", row.scenario},
                 {"scenario_version", row.scenario_version},
                 {"standard_version", row.standard_version},
                 {"verdict", row.verdict},
                 {"score", or_null(row.score)},
                 {"score_lo", or_null(row.score_lo)},
                 {"score_hi", or_null(row.score_hi)},
                 {"ended_ms", row.ended_ms},
                 {"duration_s", row.duration_s},
                 {"case", row.case_name},
                 {"state_hash", row.state_hash},
                 {"report", row.report_json}}
             .dump(2) +
         "\n";
}

Result<AttemptRow> parse_attempt_row(const std::string& text, const std::string& where) {
  try {
    const RowJson json = RowJson::parse(text);
    AttemptRow row;
    row.id = json.at("id");
    row.learner = json.at("learner");
    row.scenario = json.at("scenario");
    row.scenario_version = json.at("scenario_version");
    row.standard_version = json.at("standard_version");
    row.verdict = json.at("verdict");
    row.score = number_or_none(json.at("score"));
    row.score_lo = number_or_none(json.at("score_lo"));
    row.score_hi = number_or_none(json.at("score_hi"));
    row.ended_ms = json.at("ended_ms");
    row.duration_s = json.at("duration_s");
    row.case_name = json.at("case");
    row.state_hash = json.at("state_hash");
    row.report_json = json.at("report");
    if (!is_uuid(row.id) || !is_learner_id(row.learner))
      return fail("the attempt has no id or no learner", where);
    return row;
  } catch (const RowJson::exception& e) {
    return fail(std::string("is not an attempt (") + e.what() + ")", where,
                "Move the file away if it is damaged");
  }
}

}  // namespace osteon
