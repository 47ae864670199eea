#include "runs/reports/soft_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "osteon/physics/fallen_pieces.h"
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
  const bool portal = event.subject_kind == SubjectKind::kPortal;
  const std::vector<std::string>& names = portal ? report.portals : report.subjects;
  return event.subject < names.size() ? names[event.subject] : std::to_string(event.subject);
}

SoftJson soft_event_json(const Event& event, const SoftReport& report) {
  const EventKindRow* row = find_event_kind(event.kind);
  SoftJson out{
      {"time_s", static_cast<double>(event.tick) * report.tick_s},
      {"kind", row ? std::string(row->name) : "unknown"},
      {event.subject_kind == SubjectKind::kPortal ? "portal" : "part", subject_in(event, report)},
      {"at_mm", {1e3 * event.p_W.x(), 1e3 * event.p_W.y(), 1e3 * event.p_W.z()}}};
  if (event.hand != kNoHand) out["hand"] = event.hand;
  for (std::size_t v = 0; row && v < row->value_names.size(); ++v)
    if (!row->value_names[v].empty()) out[std::string(row->value_names[v])] = event.values[v];
  return out;
}

SoftJson soft_part_json(const SoftReport::Part& part) {
  SoftJson out{{"name", part.name}, {"peak_force_n", part.peak_force_n}};
  if (part.is_skin) {
    out["deepest_mm"] = part.deepest_mm;
    out["cut_mm"] = part.cut_mm;
    out["holes"] = part.holes;
    out["portals"] = part.portals;
    out["held_open_mm"] = part.held_open_mm;
  } else if (part.is_solid) {
    out["deepest_mm"] = part.deepest_mm;
    out["removed_mm3"] = part.removed_mm3;
    out["pieces"] = part.pieces;
    if (part.is_stump) out["cleared_percent"] = part.cleared_percent;
  } else {
    out["first_tension_n"] = part.first_tension_n;
    out["peak_tension_n"] = part.peak_tension_n;
  }
  out["contact_s"] = part.contact_s;
  out["whole"] = part.whole;
  out["lost"] = part.lost;
  return out;
}

const char* state_of(const SoftReport::Part& part) {
  if (part.lost) return ", lost";
  if (part.whole) return "";
  return part.is_solid || part.is_skin ? ", cut" : ", torn";
}

std::string soft_part_text(const SoftReport::Part& part) {
  char line[200];
  if (part.is_skin)
    std::snprintf(line, sizeof line,
                  "%-14s touched %.3f s, peak %.2f N, deepest %.2f mm, cut %.1f mm, %u hole%s%s\n",
                  part.name.c_str(), part.contact_s, part.peak_force_n, part.deepest_mm,
                  part.cut_mm, part.holes, part.holes == 1 ? "" : "s", state_of(part));
  else if (part.is_solid)
    std::snprintf(line, sizeof line,
                  "%-14s touched %.3f s, peak %.2f N, gave way %.2f mm, lost %.1f mm3%s\n",
                  part.name.c_str(), part.contact_s, part.peak_force_n, part.deepest_mm,
                  part.removed_mm3, state_of(part));
  else
    std::snprintf(line, sizeof line,
                  "%-14s touched %.3f s, peak %.2f N, tension %.1f to %.1f N%s\n",
                  part.name.c_str(), part.contact_s, part.peak_force_n, part.first_tension_n,
                  part.peak_tension_n, state_of(part));
  return line;
}

double most_of(const std::array<double, kMaxHands>& values) {
  return *std::max_element(values.begin(), values.end());
}

}  // namespace

SoftJson to_json(const SoftReport& report) {
  SoftJson out;
  out["parts"] = SoftJson::array();
  for (const SoftReport::Part& part : report.parts) out["parts"].push_back(soft_part_json(part));
  out["loose"] = SoftJson::array();
  for (const SoftReport::Loose& piece : report.loose)
    out["loose"].push_back(
        {{"part", piece.part < report.subjects.size() ? report.subjects[piece.part] : ""},
         {"volume_mm3", piece.volume_mm3},
         {"at_mm", {1e3 * piece.p_W.x(), 1e3 * piece.p_W.y(), 1e3 * piece.p_W.z()}},
         {"held", piece.held}});
  out["events"] = SoftJson::array();
  for (const Event& event : report.events) out["events"].push_back(soft_event_json(event, report));
  return out;
}

std::string to_text(const SoftReport& report) {
  char line[200];
  std::string text;
  for (const SoftReport::Part& part : report.parts) text += soft_part_text(part);
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
  const std::size_t bands = softs.setup().bands.size();
  const std::size_t solids = softs.setup().solids.size();
  report_.parts.resize(bands + solids + softs.setup().skins.size());
  const double step_s = session.bones().time_s / static_cast<double>(session.bones().step);
  for (std::size_t s = 0; s < softs.setup().solids.size(); ++s) {
    SoftReport::Part& part = report_.parts[bands + s];
    const double force_n = most_of(softs.solid_readout(s).force_n);
    part.peak_force_n = std::max(part.peak_force_n, force_n);
    if (!(force_n > 0)) continue;
    part.contact_s += step_s;
    part.deepest_mm = std::max(part.deepest_mm, 1e3 * most_of(softs.solid_readout(s).deep_m));
  }
  for (std::size_t s = 0; s < softs.setup().skins.size(); ++s) {
    SoftReport::Part& part = report_.parts[bands + solids + s];
    const SkinReadout readout = softs.skin_readout(s);
    const double force_n = most_of(readout.force_n);
    part.peak_force_n = std::max(part.peak_force_n, force_n);
    if (!(force_n > 0)) continue;
    part.contact_s += step_s;
    part.deepest_mm = std::max(part.deepest_mm, 1e3 * most_of(readout.deep_m));
    part.held_open_mm = std::max(part.held_open_mm, 1e3 * readout.open_m);
  }
  for (std::size_t b = 0; b < bands; ++b) {
    SoftReport::Part& part = report_.parts[b];
    const BandReadout& readout = softs.readout(b);
    const double force_n = most_of(readout.force_n);
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
  const std::size_t bands = softs->setup().bands.size();
  const std::size_t solids = softs->setup().solids.size();
  report.parts.resize(bands + solids + softs->setup().skins.size());
  for (std::size_t s = 0; s < softs->setup().skins.size(); ++s) {
    SoftReport::Part& part = report.parts[bands + solids + s];
    const SkinReadout readout = softs->skin_readout(s);
    part.name = softs->setup().skins[s].name;
    part.is_skin = true;
    part.cut_mm = 1e3 * readout.cut_m;
    part.holes = readout.holes;
    part.portals = readout.portals;
    part.whole = !(readout.cut_m > 0) && readout.holes == 0;
  }
  for (std::size_t s = 0; s < softs->setup().solids.size(); ++s) {
    report.parts[bands + s].name = softs->setup().solids[s].name;
    report.parts[bands + s].is_solid = true;
    report.parts[bands + s].removed_mm3 = 1e9 * softs->removed_m3(s);
    report.parts[bands + s].pieces = softs->pieces(s);
    report.parts[bands + s].is_stump = softs->setup().solids[s].to_clear != nullptr;
    report.parts[bands + s].cleared_percent = softs->cleared_percent(s);
    report.parts[bands + s].whole = !(report.parts[bands + s].removed_mm3 > 0);
    report.parts[bands + s].lost = softs->state().solid_lost[s];
  }
  for (std::size_t b = 0; b < bands; ++b) {
    const BandState& state = softs->state().bands[b];
    report.parts[b].name = softs->setup().bands[b].name;
    report.parts[b].lost = state.lost;
    report.parts[b].whole = softs->setup().bands[b].left > 0 && !state.torn;
  }
  for (const FallenPiece& piece : softs->lying())
    report.loose.push_back({piece.soft, 1e9 * piece.shape->volume_m3(),
                            piece.X_WB * piece.shape->middle_B(),
                            piece.is == FallenPiece::Is::kHeld});
  for (const SoftPart& part : session.the_case().softs) report.subjects.push_back(part.name);
  for (const Portal& portal : session.portals()) report.portals.push_back(portal.name);
  return report;
}

}  // namespace osteon
