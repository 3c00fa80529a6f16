// The main of test programs that solve: PETSc lives as long as the program.
#include <gtest/gtest.h>

#include "solver/scene/run.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const snug::solver::Session session(argc, argv);
  return RUN_ALL_TESTS();
}
