#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace halfspace::viewer {

/// Where the names of files that were opened are kept:
/// $XDG_STATE_HOME/halfspace/recent, or that below ~/.local/state; empty where
/// neither is known.
std::filesystem::path recent_file();

/// The names in the file, the last opened first; none where it is not there.
std::vector<std::string> read_recent(const std::filesystem::path& file);

/// Puts the path in front of the names in the file, of which a dozen is kept.
/// Where it cannot be written nothing happens: it is a convenience.
void note_recent(const std::filesystem::path& file, const std::string& path);

}  // namespace halfspace::viewer
