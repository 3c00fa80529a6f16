#include "mesh/formats/no_effects.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <vector>

namespace snug::mesh {

namespace {

#ifdef __x86_64__

using Filter = std::vector<sock_filter>;

constexpr unsigned number_at = offsetof(seccomp_data, nr), architecture_at = offsetof(seccomp_data, arch);
/// The lower half of an argument; flags fit in it.
constexpr unsigned argument_at(unsigned n) { return offsetof(seccomp_data, args) + 8 * n; }

sock_filter load(unsigned offset) { return {BPF_LD | BPF_W | BPF_ABS, 0, 0, offset}; }
sock_filter skip_unless_equal(unsigned value, unsigned char count) { return {BPF_JMP | BPF_JEQ | BPF_K, 0, count, value}; }
sock_filter skip_unless_any(unsigned bits, unsigned char count) { return {BPF_JMP | BPF_JSET | BPF_K, 0, count, bits}; }
sock_filter give(unsigned what) { return {BPF_RET | BPF_K, 0, 0, what}; }
constexpr unsigned refused(int error) { return SECCOMP_RET_ERRNO | (static_cast<unsigned>(error) & SECCOMP_RET_DATA); }

void refuse(Filter& filter, unsigned call, int error = EPERM) {
  filter.push_back(skip_unless_equal(call, 1));
  filter.push_back(give(refused(error)));
}

/// Refuses a call of which argument n has one of the bits.
void refuse_with(Filter& filter, unsigned call, unsigned n, unsigned bits) {
  filter.push_back(skip_unless_equal(call, 4));
  filter.push_back(load(argument_at(n)));
  filter.push_back(skip_unless_any(bits, 1));
  filter.push_back(give(refused(EPERM)));
  filter.push_back(load(number_at));
}

Filter filter_of_effects() {
  Filter filter = {load(architecture_at), {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, AUDIT_ARCH_X86_64}, give(SECCOMP_RET_KILL_PROCESS), load(number_at)};
  filter.push_back({BPF_JMP | BPF_JGE | BPF_K, 0, 1, 0x40000000U});  // the calls of the x32 kind
  filter.push_back(give(refused(EPERM)));
  for (const int call : {SYS_execve, SYS_execveat, SYS_fork, SYS_vfork, SYS_ptrace, SYS_kill, SYS_tkill, SYS_socket, SYS_socketpair, SYS_connect,
                         SYS_unlink, SYS_unlinkat, SYS_rename, SYS_renameat, SYS_renameat2, SYS_mkdir, SYS_mkdirat, SYS_rmdir, SYS_creat, SYS_link,
                         SYS_linkat, SYS_symlink, SYS_symlinkat, SYS_truncate, SYS_chmod, SYS_fchmodat, SYS_chown, SYS_fchownat, SYS_mknod,
                         SYS_mknodat, SYS_mount, SYS_openat2})
    refuse(filter, static_cast<unsigned>(call));
  refuse(filter, SYS_clone3, ENOSYS);  // its flags stand in memory; the library then uses clone
  constexpr unsigned writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  refuse_with(filter, SYS_open, 1, writing);
  refuse_with(filter, SYS_openat, 2, writing);
  filter.push_back(skip_unless_equal(SYS_clone, 4));  // threads are admitted
  filter.push_back(load(argument_at(0)));
  filter.push_back({BPF_JMP | BPF_JSET | BPF_K, 1, 0, CLONE_THREAD});
  filter.push_back(give(refused(EPERM)));
  filter.push_back(load(number_at));
  filter.push_back(give(SECCOMP_RET_ALLOW));
  return filter;
}

#endif

}  // namespace

void refuse_effects() {
#ifdef __x86_64__
  Filter filter = filter_of_effects();
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
#endif
}

}  // namespace snug::mesh
