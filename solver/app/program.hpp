// The program: finds the command, turns what went wrong into messages and an exit status.
#pragma once

namespace snug::app {

/// Runs the command line; never throws. Errors go to standard error.
int run_program(int argc, char** argv);

}  // namespace snug::app
