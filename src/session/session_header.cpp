// What a session's recording says of its case, instruments and portals.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "osteon/physics/skin_setup.h"
#include "osteon/scene/tool_hash.h"
#include "osteon/session/session.h"
#include "whole_tray.h"

namespace osteon {
namespace {

constexpr const char* kAll = "all";

using NamesJson = nlohmann::ordered_json;

template <class List>
NamesJson names_of(const List& list) {
  NamesJson names = NamesJson::array();
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

NamesJson instrument_names(const SessionSettings& settings, const Tray& tray) {
  if (!settings.tray.empty()) return settings.tray;
  if (tray.empty()) return {"wrist_probe"};
  NamesJson names = NamesJson::array();
  for (const auto& tool : tray) names.push_back(tool->name);
  return names;
}

// By the kinds of SubjectKind that have names.
std::string subject_names(const Case& the_case, const SessionSettings& settings,
                          const std::vector<Portal>& portals, const Tray& tray) {
  NamesJson json = {{"bones", names_of(the_case.bones)},
                    {"soft_parts", names_of(the_case.softs)},
                    {"landmarks", names_of(the_case.landmarks)},
                    {"instruments", instrument_names(settings, tray)},
                    {"portals", names_of(portals)},
                    {"hands", names_of(settings.hands)}};
  return json.dump(-1, ' ', false, NamesJson::error_handler_t::replace);
}

std::string listed(const std::vector<Portal>& portals) {
  std::string text;
  for (const Portal& portal : portals) text += (text.empty() ? "" : ", ") + portal.title;
  return text.empty() ? "The case has none: give none" : "Choose among " + text + ", all or none";
}

bool lies_under(const Portal& portal, const std::vector<Portal>& to_make) {
  return std::any_of(to_make.begin(), to_make.end(),
                     [&](const Portal& made) { return made.landmark == portal.landmark; });
}

// Those of the case that the settings name; of all those over which whole skin lies are shut.
Result<std::vector<Portal>> fixed_portals(const Case& the_case, const SessionSettings& settings,
                                          const std::vector<Portal>& to_make) {
  std::vector<Portal> all = find_portals(the_case, settings.portal_skin);
  const std::vector<std::string>& names = settings.portals;
  if (names == std::vector<std::string>{kAll}) {
    std::erase_if(all, [&](const Portal& portal) { return lies_under(portal, to_make); });
    return all;
  }
  for (const std::string& name : names)
    if (!find_portal(all, name))
      return fail("the case has no portal '" + name + "'", "portals", listed(all));
  std::vector<Portal> open;
  for (const Portal& portal : all)
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return portal.name == name || portal.title == name;
        }))
      open.push_back(portal);
  return open;
}

}  // namespace

Result<std::vector<Portal>> open_portals(const Case& the_case, const SessionSettings& settings) {
  const auto to_make = portals_to_make(the_case, settings.soft, settings.portal_skin);
  auto portals = fixed_portals(the_case, settings, to_make);
  if (portals) portals->insert(portals->end(), to_make.begin(), to_make.end());
  return portals;
}

RecordingHeader recording_header(const Case& the_case, const SessionSettings& settings,
                                 const std::string& case_source, const std::string& osteon_version,
                                 const Tray& tray) {
  RecordingHeader header;
  header.case_name = the_case.name;
  header.case_source = case_source;
  header.case_hash = the_case.hash;
  header.seed = settings.seed;
  header.settings_json = to_json(settings);
  header.osteon_version = osteon_version;
  header.hands = static_cast<std::uint32_t>(settings.hands.size());
  if (!tray.empty() || settings.tray.empty())
    header.tray_hash = felt_hash(whole_tray(tray, settings));
  const auto portals = open_portals(the_case, settings);
  if (portals) header.portals_hash = hash_of(*portals);
  header.names_json =
      subject_names(the_case, settings, portals ? *portals : std::vector<Portal>(), tray);
  return header;
}

StoredState stored_state(const Session& session) {
  StoredState state;
  for (std::size_t h = 0; h < session.hands(); ++h) state.ticks[h] = session.tool_state(h).tick;
  state.step = session.bones().step;
  state.bytes = to_bytes(session.save());
  return state;
}

}  // namespace osteon
