// What this process holds.
#pragma once

namespace snug::solver {

/// Bytes of physical memory that this process holds now; 0 where the system does not tell (/proc/self/statm of Linux).
double resident_memory();

}  // namespace snug::solver
