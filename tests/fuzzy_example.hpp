// The Mamdani system of the reference book, section 8.
#pragma once

#include "postproc/comfort/fuzzy.hpp"

namespace snug::tests {

/// Two inputs, five rules, bells.
inline postproc::FuzzySystem worked_example() {
  using postproc::bell;
  postproc::FuzzySystem system;
  system.inputs = {{"p", 0, 5, {bell("low", 0, 1.25, 2.5), bell("mid", 2.5, 1.25, 2.5), bell("high", 5, 1.25, 2.5)}},
                   {"s", 0, 10, {bell("soft", 0, 5, 3), bell("stiff", 10, 5, 3)}}};
  system.output = {"y", 0, 10, {bell("bad", 0, 2.5, 2), bell("fair", 5, 2.5, 2), bell("good", 10, 2.5, 2)}};
  system.rules = {"if p is low and s is soft then y is good", "if p is low and s is stiff then y is fair",
                  "if p is mid and s is soft then y is fair", "if p is mid and s is stiff then y is bad",
                  "if p is high then y is bad"};
  return system;
}

}  // namespace snug::tests
