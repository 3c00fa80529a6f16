// Element kernels on all cores, scatter in element order on one: the result does not depend on the number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace snug::solver {

/// Calls compute(element, slot) in parallel for chunks of elements, then sink(element, slot) in order.
/// Returns false as soon as a chunk had a compute that returned false.
template <class Slot, class Compute, class Consume>
bool for_elements(int elements, std::vector<Slot>& slots, const Compute& compute, const Consume& consume) {
  const int chunk = static_cast<int>(slots.size());
  for (int begin = 0; begin < elements; begin += chunk) {
    const int end = std::min(elements, begin + chunk);
    std::atomic<bool> ok = true;
    tbb::parallel_for(begin, end, [&](int e) {
      if (!compute(e, slots[e - begin])) ok = false;
    });
    if (!ok) return false;
    for (int e = begin; e < end; ++e) consume(e, slots[e - begin]);
  }
  return true;
}

}  // namespace snug::solver
