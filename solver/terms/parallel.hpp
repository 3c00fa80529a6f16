// Element kernels on all cores, scatter in element order on one: the result does not depend on the number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <atomic>
#include <vector>

#include "solver/terms/term.hpp"

namespace snug::solver {

/// Calls compute(element, slot) in parallel for chunks of the elements that the sink wants, then consume(element, slot)
/// in order. Returns false as soon as a chunk had a compute that returned false.
template <class Slot, class Compute, class Consume>
bool for_elements(const Sink& sink, int elements, std::vector<Slot>& slots, const Compute& compute,
                  const Consume& consume) {
  std::vector<int> wanted;
  wanted.reserve(slots.size());
  for (int next = 0; next < elements;) {
    for (wanted.clear(); next < elements && wanted.size() < slots.size(); ++next)
      if (sink.wants(next)) wanted.push_back(next);
    std::atomic<bool> ok = true;
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t k) {
      if (!compute(wanted[k], slots[k])) ok = false;
    });
    if (!ok) return false;
    for (std::size_t k = 0; k < wanted.size(); ++k) consume(wanted[k], slots[k]);
  }
  return true;
}

}  // namespace snug::solver
