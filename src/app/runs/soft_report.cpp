#include "runs/soft_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "osteon/physics/soft_world.h"
#include "osteon/scene/event.h"

namespace osteon {
namespace {

using SoftJson = nlohmann::ordered_json;

bool is_of_softs(const Event& event) {
  const int code = static_cast<int>(event.kind);
  return code >= 100 && code < 200;
}

std::string subject_in(const Event& event, const SoftReport& report) {
  return event.subject < report.subjects.size() ? report.subjects[event.subject]
                                                : std::to_string(event.subject);
}

SoftJson soft_event_json(const Event& event, const SoftReport& report) {
  const EventKindRow* row = find_event_kind(event.kind);
  SoftJson out{{"time_s", static_cast<double>(event.tick) * report.tick_s},
               {"kind", row ? std::string(row->name) : "unknown"},
               {"part", subject_in(event, report)},
               {"at_mm", {1e3 * event.p_W.x(), 1e3 * event.p_W.y(), 1e3 * event.p_W.z()}}};
  if (event.hand != kNoHand) out["hand"] = event.hand;
  for (std::size_t v = 0; row && v < row->value_names.size(); ++v)
    if (!row->value_names[v].empty()) out[std::string(row->value_names[v])] = event.values[v];
  return out;
}

const char* state_of(const SoftReport::Part& part) {
  if (part.lost) return ", lost";
  return part.whole ? "" : ", torn";
}

}  // namespace

SoftJson to_json(const SoftReport& report) {
  SoftJson out;
  out["parts"] = SoftJson::array();
  for (const SoftReport::Part& part : report.parts)
    out["parts"].push_back({{"name", part.name},
                            {"peak_force_n", part.peak_force_n},
                            {"first_tension_n", part.first_tension_n},
                            {"peak_tension_n", part.peak_tension_n},
                            {"contact_s", part.contact_s},
                            {"whole", part.whole},
                            {"lost", part.lost}});
  out["events"] = SoftJson::array();
  for (const Event& event : report.events) out["events"].push_back(soft_event_json(event, report));
  return out;
}

std::string to_text(const SoftReport& report) {
  char line[200];
  std::string text;
  for (const SoftReport::Part& part : report.parts) {
    std::snprintf(line, sizeof line,
                  "%-14s touched %.3f s, peak %.2f N, tension %.1f to %.1f N%s\n",
                  part.name.c_str(), part.contact_s, part.peak_force_n, part.first_tension_n,
                  part.peak_tension_n, state_of(part));
    text += line;
  }
  for (const Event& event : report.events) {
    const EventKindRow* row = find_event_kind(event.kind);
    if (!row) continue;
    std::snprintf(line, sizeof line, "  %8.3f s  %s %s\n",
                  static_cast<double>(event.tick) * report.tick_s, std::string(row->text).c_str(),
                  subject_in(event, report).c_str());
    text += line;
  }
  return text;
}

void SoftWatch::see_step(const Session& session) {
  const SoftWorld& softs = *session.softs();
  const bool first = report_.parts.empty();
  report_.parts.resize(softs.setup().bands.size());
  const double step_s = session.bones().time_s / static_cast<double>(session.bones().step);
  for (std::size_t b = 0; b < report_.parts.size(); ++b) {
    SoftReport::Part& part = report_.parts[b];
    const BandReadout& readout = softs.readout(b);
    const double force_n = *std::max_element(readout.force_n.begin(), readout.force_n.end());
    if (first) part.first_tension_n = readout.tension_n;
    part.peak_tension_n = std::max(part.peak_tension_n, readout.tension_n);
    part.peak_force_n = std::max(part.peak_force_n, force_n);
    if (force_n > 0) part.contact_s += step_s;
  }
}

void SoftWatch::see(const Session& session) {
  if (!session.softs()) return;
  for (std::size_t h = 0; h < session.hands(); ++h)
    for (const Event& event : session.last_events(h))
      if (is_of_softs(event)) report_.events.push_back(event);
  if (session.last_steps() > 0) see_step(session);
}

std::optional<SoftReport> SoftWatch::finish(const Session& session) const {
  const SoftWorld* softs = session.softs();
  if (!softs) return std::nullopt;
  SoftReport report = report_;
  report.parts.resize(softs->setup().bands.size());
  for (std::size_t b = 0; b < report.parts.size(); ++b) {
    const BandState& state = softs->state().bands[b];
    report.parts[b].name = softs->setup().bands[b].name;
    report.parts[b].lost = state.lost;
    report.parts[b].whole = softs->setup().bands[b].left > 0 && !state.torn;
  }
  for (const SoftPart& part : session.the_case().softs) report.subjects.push_back(part.name);
  return report;
}

}  // namespace osteon
