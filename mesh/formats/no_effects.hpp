// The kernel as a second wall behind the check of scripts.
#pragma once

namespace snug::mesh {

/// From here on this process may start no program and no process, open no file for writing, make, move or remove none, and
/// open no connection: the system calls fail with EPERM. Where the kernel cannot do this nothing happens; what a script may
/// say is checked before.
void refuse_effects();

}  // namespace snug::mesh
