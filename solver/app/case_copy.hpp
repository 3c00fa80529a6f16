// A case directory copied, to be gone on from.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace snug::app {

/// Copies a case to a directory that is not there yet, without results and without what it is expected to give; `change` may alter the copy before it
/// takes its name. Throws input::InputError where the place is taken.
void copy_case(const std::filesystem::path& from, const std::filesystem::path& to, const std::function<void(const std::filesystem::path& copy)>& change = {});

}  // namespace snug::app
