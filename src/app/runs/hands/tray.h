#pragma once

#include <span>
#include <string>

#include "osteon/base/result.h"
#include "osteon/session/session.h"

namespace osteon {

/// The plain probe of the wrist, which a hand holds when nothing else is said.
inline const std::string kWristProbe = "wrist_probe";

/// The instruments of a tray by their names: "hook_probe", "hook_probe:1.5" in that size (mm), or
/// kWristProbe. No names: an empty tray. Fails on a name or a size that there is not.
Result<Tray> make_tray(std::span<const std::string> names, double probe_radius_m);

/// The instruments that the hands of a recording held; empty: the wrist probe alone.
Result<Tray> tray_of(const RecordingHeader& header);

/// What removes bone in a session with these settings; null: nothing.
Result<std::shared_ptr<const CarvingSetup>> carving_for(const Case& the_case,
                                                        const SessionSettings& settings);

/// The same for a run whose hands may take these instruments; null: nothing can be carved. Of the
/// settings `on` is not looked at.
Result<std::shared_ptr<const CarvingSetup>> carving_for_run(const Case& the_case,
                                                            std::span<const std::string> tray,
                                                            const CarveSettings& carve = {});

/// What is soft in a session with these settings; null: nothing. Fails where the settings name what
/// the case has not, or a table has changed since they were recorded.
Result<std::shared_ptr<const SoftSetup>> softs_for(const Case& the_case,
                                                   const SessionSettings& settings);
/// "ligaments", or names with commas between: "acl,pcl". Empty: nothing.
std::vector<std::string> softs_named(const std::string& text);

/// Gives a replay the instruments of the recorded session, what they remove and what is
/// soft.
Result<void> take_instruments(const RecordingHeader& header, const Case& the_case,
                              ReplayOptions& options);

/// Where the case of a folder stands, absolute; empty for one that is built in.
std::string absolute_case_path(const std::string& case_source);

}  // namespace osteon
