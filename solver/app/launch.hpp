// The program on several ranks.
#pragma once

#include <string>
#include <vector>

namespace snug::app {

/// The words that started this process, the program first.
std::vector<std::string> own_arguments();

/// How many ranks mpirun has started this process with; 1 without mpirun.
int launched_ranks();

/// Runs this command line again as `ranks` processes under mpirun and gives its exit status. Throws input::InputError
/// when there is no mpirun.
int launch_ranks(int ranks);

}  // namespace snug::app
