// Where the engineering database of the user is.
#pragma once

#include <filesystem>
#include <string>

namespace snug::app {

/// The file that SNUG_LIBRARY names, else snug/library.db in the user's data folder (XDG_DATA_HOME, else
/// ~/.local/share); empty where there is no home. Nothing below the commands looks at the environment.
std::filesystem::path library_file();

/// Name of the user, for the history of the library.
std::string user_name();

}  // namespace snug::app
