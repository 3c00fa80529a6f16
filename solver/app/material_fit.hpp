// snug materials fit: raw tests reduced to a fabric.
#pragma once

#include <memory>

#include "solver/app/command.hpp"

namespace snug::app {

std::unique_ptr<Command> make_fit();

}  // namespace snug::app
