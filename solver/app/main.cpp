#include "solver/app/program.hpp"

int main(int argc, char** argv) { return snug::app::run_program(argc, argv); }
