// The commands about what the library holds: its recorded runs, and all of it as a page.
#pragma once

#include <memory>

#include "solver/app/command.hpp"

namespace snug::app {

std::unique_ptr<Command> make_project();
std::unique_ptr<Command> make_library();

}  // namespace snug::app
