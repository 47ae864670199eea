#pragma once

#include <filesystem>
#include <string>

namespace osteon {

/// Folder of the user's settings: $XDG_CONFIG_HOME/osteon, else ~/.config/osteon. Not created here.
std::filesystem::path config_dir();
/// Folder of what can be made again: $XDG_CACHE_HOME/osteon, else ~/.cache/osteon.
std::filesystem::path cache_dir();
/// Folder of recordings and screenshots: $XDG_DATA_HOME/osteon, else ~/.local/share/osteon.
std::filesystem::path data_home_dir();
/// A name in `folder` that is not taken: "<stem>-2026-01-31-12-05-09<extension>", by local time,
/// with -2, -3 ... when there is one already.
std::filesystem::path dated_file(const std::filesystem::path& folder, const std::string& stem,
                                 const std::string& extension);

}  // namespace osteon
