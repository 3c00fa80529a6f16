// The program on several ranks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/app/cleaner.hpp"
#include "solver/app/console.hpp"

namespace snug::app {

/// The words that started this process, the program first; what the launcher adds for its ranks is left out.
std::vector<std::string> own_arguments();

bool mpirun_is_there();

/// Runs this command line again as `ranks` processes under mpirun and gives the exit status that rank 0 has written down
/// (report_status). The first SIGINT, SIGTERM or SIGHUP goes to the ranks, which end in good order; the second kills them.
/// They end with this process whatever ends it, and what they had in temporary folders and in shared memory is removed.
/// Throws input::InputError when there is no mpirun.
int launch_ranks(int ranks, const Cleaner& cleaner, Console& console);

/// In a rank: from here on the process ends when mpirun does, however that ends.
void end_with_parent();
/// In rank 0: the status that the launcher gives back.
void report_status(const std::string& file, int status);

}  // namespace snug::app
