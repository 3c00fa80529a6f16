// The commands of snug materials that learn from the library.
#pragma once

#include <memory>
#include <vector>

#include "solver/app/command.hpp"

namespace snug::app {

/// near, clusters, regress, suggest.
void add_learning_commands(std::vector<std::unique_ptr<Command>>& commands);
std::unique_ptr<Command> make_suggest();

}  // namespace snug::app
