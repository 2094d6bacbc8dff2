#include "io/worker/sandbox.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <vector>

namespace volumen::worker {
namespace {

#if defined(__x86_64__)
constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#else
#error "say the architecture's number for seccomp"
#endif

constexpr int allowed[] = {
    SYS_read,    SYS_pread64,    SYS_lseek,          SYS_close,        SYS_dup,       SYS_recvmsg,
    SYS_sendmsg, SYS_munmap,     SYS_mremap,         SYS_madvise,      SYS_brk,       SYS_futex,
    SYS_exit,    SYS_exit_group, SYS_clock_gettime,  SYS_gettimeofday, SYS_getrandom, SYS_sysinfo,
    SYS_getpid,  SYS_gettid,     SYS_restart_syscall};
// Allowed to the parent of workers in addition.
constexpr int allowedOfZygote[] = {
#ifdef SYS_dup2
    SYS_dup2,
    SYS_access,
    SYS_stat,
    SYS_readlink,
    SYS_poll,
    SYS_arch_prctl,
    SYS_getrlimit,
#endif
    SYS_clone,
    SYS_wait4,
    SYS_kill,
    SYS_getppid,
    SYS_prctl,
    SYS_seccomp,
    SYS_prlimit64,
    SYS_setrlimit,
    SYS_close_range,
    SYS_dup3,
    SYS_fstat,
    SYS_newfstatat,
    SYS_statx,
    SYS_faccessat,
    SYS_readlinkat,
    SYS_getdents64,
    SYS_fcntl,
    SYS_ioctl,
    SYS_ppoll,
    SYS_nanosleep,
    SYS_clock_nanosleep,
    SYS_set_robust_list,
    SYS_set_tid_address,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sched_getaffinity,
    SYS_sched_yield,
    SYS_uname,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_tgkill,
    SYS_mmap,
    SYS_mprotect,
    SYS_readv,
    SYS_getcwd,
    SYS_rseq};
// Allowed if PROT_EXEC is not set in their third argument.
constexpr int allowedUnlessExecutable[] = {SYS_mmap, SYS_mprotect};
// Fails with EBADF in workers, without further harm: libraries report problems on standard error.
constexpr int refused[] = {SYS_write, SYS_writev};

constexpr sock_filter load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, unsigned(offset));
}
constexpr sock_filter end(unsigned verdict) { return BPF_STMT(BPF_RET | BPF_K, verdict); }
// Continues with the next statement if the loaded number is `value`, else skips `skipped` statements.
constexpr sock_filter unlessSkip(unsigned value, unsigned char skipped) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skipped);
}

std::vector<sock_filter> filter() {
  constexpr std::size_t protection = offsetof(seccomp_data, args) + 2 * sizeof(__u64);
  std::vector<sock_filter> f{load(offsetof(seccomp_data, arch)),
                             BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0),
                             end(SECCOMP_RET_KILL_PROCESS), load(offsetof(seccomp_data, nr))};
  for (const int call : allowed) f.insert(f.end(), {unlessSkip(unsigned(call), 1), end(SECCOMP_RET_ALLOW)});
  for (const int call : refused)
    f.insert(f.end(), {unlessSkip(unsigned(call), 1), end(SECCOMP_RET_ERRNO | EBADF)});
  for (const int call : allowedUnlessExecutable)
    f.insert(f.end(), {unlessSkip(unsigned(call), 4), load(protection),
                       BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 0, 1), end(SECCOMP_RET_KILL_PROCESS),
                       end(SECCOMP_RET_ALLOW)});
  f.push_back(end(SECCOMP_RET_KILL_PROCESS));
  return f;
}

// Any other system call fails with ENOSYS instead of ending the process, as libraries that the zygote loads
// may try more.
std::vector<sock_filter> filterOfZygote() {
  constexpr std::size_t flags = offsetof(seccomp_data, args) + 2 * sizeof(__u64);
  constexpr unsigned writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  std::vector<sock_filter> f{load(offsetof(seccomp_data, arch)),
                             BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0),
                             end(SECCOMP_RET_KILL_PROCESS), load(offsetof(seccomp_data, nr))};
  for (const int call : allowed) f.insert(f.end(), {unlessSkip(unsigned(call), 1), end(SECCOMP_RET_ALLOW)});
  for (const int call : allowedOfZygote)
    f.insert(f.end(), {unlessSkip(unsigned(call), 1), end(SECCOMP_RET_ALLOW)});
  for (const int call : refused) f.insert(f.end(), {unlessSkip(unsigned(call), 1), end(SECCOMP_RET_ALLOW)});
  f.insert(f.end(), {unlessSkip(unsigned(SYS_openat), 4), load(flags),
                     BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writing, 0, 1), end(SECCOMP_RET_ERRNO | EACCES),
                     end(SECCOMP_RET_ALLOW)});
  f.push_back(end(SECCOMP_RET_ERRNO | ENOSYS));
  return f;
}

bool install(std::vector<sock_filter> statements) {
  const sock_fprog program{static_cast<unsigned short>(statements.size()), statements.data()};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

bool dropCapabilities() {
  __user_cap_header_struct head{_LINUX_CAPABILITY_VERSION_3, 0};
  const __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3]{};
  return syscall(SYS_capset, &head, none) == 0;
}

bool limit(__rlimit_resource what, rlim_t most) {
  rlimit r{};
  if (getrlimit(what, &r) != 0) return false;
  r.rlim_cur = r.rlim_max = std::min(most, r.rlim_max);
  return setrlimit(what, &r) == 0;
}

bool closeOthers(int socket) {
  const int nowhere = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nowhere < 0 || socket <= 2) return false;
  for (int fd = 0; fd <= 2; ++fd) dup2(nowhere, fd);
  const auto close = [](unsigned from, unsigned to) {
    return from > to || syscall(SYS_close_range, from, to, 0) == 0;
  };
  return close(3, unsigned(socket) - 1) && close(unsigned(socket) + 1, ~0u);
}

}  // namespace

bool becomeZygote(int socket) {
  if (!closeOthers(socket) || !dropCapabilities() || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
    return false;
  return sanitized || install(filterOfZygote());
}

bool enterSandbox(int socket) {
  constexpr rlim_t mostOpen = 128;
  if (!closeOthers(socket) || !limit(RLIMIT_CORE, 0) || !limit(RLIMIT_FSIZE, 0) ||
      !limit(RLIMIT_NOFILE, mostOpen) || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
    return false;
  if (sanitized) return true;
  return install(filter());
}

}  // namespace volumen::worker
