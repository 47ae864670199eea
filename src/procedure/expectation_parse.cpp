#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "expectation.h"

namespace osteon {
namespace {

using Json = nlohmann::json;

constexpr const char* kTodo = "Correct the expectation; docs/file-formats.md describes it";

tl::unexpected<Error> refuse(const std::string& what, const std::string& key) {
  return fail(what, key.empty() ? "expectation" : "expectation, '" + key + "'", kTodo);
}

// A key that comes twice would silently hide what its first value expects.
class RepeatedKeys {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) levels_[depth + 1].clear();
    if (event == Json::parse_event_t::key) {
      std::string key = value.get<std::string>();
      if (!levels_[depth].insert(key).second && first_.empty()) first_ = std::move(key);
    }
    return true;
  }
  const std::string& first() const { return first_; }

 private:
  std::map<int, std::set<std::string>> levels_;
  std::string first_;
};

Result<Json> parse_json(const std::string& text) {
  RepeatedKeys repeated;
  try {
    Json json = Json::parse(text, std::ref(repeated));
    if (!repeated.first().empty()) return refuse("the key is given twice", repeated.first());
    if (!json.is_object()) return refuse("the expectation is not a JSON object", "");
    return json;
  } catch (const Json::exception& e) {
    return refuse(std::string("the expectation is not JSON (") + e.what() + ")", "");
  }
}

Result<void> parse_tolerance(const Json& json, const std::string& key, ExpectedRange& range) {
  const bool relative = json.contains("rel");
  if (json.size() != 2 || !json.contains("value") || (!relative && !json.contains("abs")))
    return refuse("a range must be {min, max}, {value, abs} or {value, rel}", key);
  const double value = json["value"];
  const double tolerance = json[relative ? "rel" : "abs"];
  if (tolerance < 0) return refuse("a tolerance must not be negative", key);
  const double reach = relative ? tolerance * std::abs(value) : tolerance;
  range = {value - reach, value + reach};
  return {};
}

Result<ExpectedRange> parse_range(const Json& json, const std::string& key) {
  if (!json.is_object() || json.empty())
    return refuse("a range must be {min, max}, {value, abs} or {value, rel}", key);
  for (const auto& [name, value] : json.items())
    if (!value.is_number()) return refuse("'" + name + "' is not a number", key);
  ExpectedRange range;
  const std::size_t bounds = json.count("min") + json.count("max");
  if (bounds == 0) {
    if (const auto done = parse_tolerance(json, key, range); !done)
      return tl::unexpected(done.error());
    return range;
  }
  if (bounds != json.size())
    return refuse("a range must be {min, max}, {value, abs} or {value, rel}", key);
  range.min = json.value("min", range.min);
  range.max = json.value("max", range.max);
  if (range.min > range.max) return refuse("the range is empty: min is above max", key);
  return range;
}

// An object of ranges whose keys must be among `allowed`.
Result<std::map<std::string, ExpectedRange>> parse_ranges(const Json& json, const std::string& key,
                                                          const std::set<std::string>& allowed) {
  if (!json.is_object() || json.empty()) return refuse("this is not an object of ranges", key);
  std::map<std::string, ExpectedRange> ranges;
  for (const auto& [name, value] : json.items()) {
    const std::string path = key + "." + name;
    if (!allowed.count(name)) return refuse("unknown key", path);
    const auto range = parse_range(value, path);
    if (!range) return tl::unexpected(range.error());
    ranges[name] = *range;
  }
  return ranges;
}

Result<std::vector<std::string>> parse_names(const Json& json, const std::string& key) {
  if (!json.is_array() || json.empty()) return refuse("this is not a list of bones", key);
  std::vector<std::string> names;
  for (const Json& name : json) {
    if (!name.is_string()) return refuse("this is not a list of bones", key);
    const std::string text = name;
    if (std::find(names.begin(), names.end(), text) != names.end())
      return refuse("'" + text + "' is given twice", key);
    names.push_back(text);
  }
  return names;
}

Result<void> parse_bones(const Json& json, Expectation& expectation) {
  static const std::set<std::string> kKeys = {"first_contact_s", "contact_time_s", "peak_force_n",
                                              "mean_force_n", "deepest_mm"};
  if (!json.is_object() || json.empty()) return refuse("this is not an object of bones", "bones");
  for (const auto& [name, value] : json.items()) {
    auto ranges = parse_ranges(value, "bones." + name, kKeys);
    if (!ranges) return tl::unexpected(ranges.error());
    expectation.bones[name] = std::move(*ranges);
  }
  return {};
}

// Stores what `result` holds in `into`, or passes its error on.
template <class T, class Into>
Result<void> store(Result<T> result, Into& into) {
  if (!result) return tl::unexpected(result.error());
  into = std::move(*result);
  return {};
}

Result<std::string> parse_text(const Json& json, const std::string& key) {
  if (!json.is_string()) return refuse("this is not text", key);
  return json.get<std::string>();
}

Result<std::string> parse_hash(const Json& json, const std::string& key) {
  auto text = parse_text(json, key);
  if (text &&
      (text->size() != 16 || text->find_first_not_of("0123456789abcdef") != std::string::npos))
    return refuse("a hash has 16 hexadecimal digits in lower case", key);
  return text;
}

Result<void> parse_key(const std::string& key, const Json& value, Expectation& e) {
  static const std::set<std::string> kWhole = {"path_length_mm", "duration_s",   "smoothness_sparc",
                                               "ticks",          "missed_ticks", "realtime_factor"};
  if (key == "case") return store(parse_text(value, key), e.case_name);
  if (key == "state_hash") return store(parse_hash(value, key), e.state_hash);
  if (key == "touched") return store(parse_names(value, key), e.touched);
  if (key == "order") return store(parse_names(value, key), e.order);
  if (key == "bones") return parse_bones(value, e);
  if (key == "tick_us")
    return store(parse_ranges(value, key, {"p50", "p99", "p999", "max"}), e.tick_us);
  if (key == "untouched") {
    e.all_others_untouched = value == "all_others";
    return e.all_others_untouched ? Result<void>{} : store(parse_names(value, key), e.untouched);
  }
  if (kWhole.count(key)) return store(parse_range(value, key), e.whole[key]);
  return refuse("unknown key", key);
}

}  // namespace

Result<Expectation> parse_expectation(const std::string& json) {
  const auto parsed = parse_json(json);
  if (!parsed) return tl::unexpected(parsed.error());
  // An expectation that expects nothing would hold for everything: surely a mistake.
  if (parsed->empty()) return refuse("it has no expectations", "");
  Expectation expectation;
  for (const auto& [key, value] : parsed->items())
    if (const auto done = parse_key(key, value, expectation); !done)
      return tl::unexpected(done.error());
  return expectation;
}

}  // namespace osteon
