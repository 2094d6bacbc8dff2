#include "io/worker/process.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <thread>
#include <vector>

#include "io/worker/call.h"
#include "io/worker/sandbox.h"
#include "io/worker/zygote.h"

namespace volumen::worker {
namespace {

constexpr std::size_t mostFiles = 500;
constexpr std::uint64_t usualBytes = std::uint64_t(1) << 30;  // most address space of a worker that is reused

/// The idle workers.
struct Idle {
  std::mutex mutex;
  std::vector<std::unique_ptr<Process>> workers;
};

std::atomic<bool> allWanted = false;
std::atomic<int> alive = 0;  // number of workers, idle ones included
std::atomic<Failure> lastFailure = Failure::noWorker;

Idle& idle() {
  static Idle all;
  return all;
}

std::uint64_t addressSpaceOf(pid_t pid) {
  const std::string path = "/proc/" + std::to_string(pid) + "/statm";
  unsigned long pages = 0;
  if (FILE* file = std::fopen(path.c_str(), "re")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return std::uint64_t(pages) * std::uint64_t(sysconf(_SC_PAGESIZE));
}

/// Returns the state letter that ps shows.
char stateOf(pid_t pid) {
  const std::string path = "/proc/" + std::to_string(pid) + "/stat";
  char state = 0;
  if (FILE* file = std::fopen(path.c_str(), "re")) {
    if (std::fscanf(file, "%*d (%*[^)]) %c", &state) != 1) state = 0;
    std::fclose(file);
  }
  return state;
}

bool isReady(const Process& worker) {
  constexpr int patienceMs = 5000;
  pollfd socket{worker.socket.get(), POLLIN, 0};
  Message message;
  while (::poll(&socket, 1, patienceMs) < 0)
    if (errno != EINTR) return false;
  return socket.revents != 0 && receiveMessage(worker.socket.get(), message, false) == Transfer::done &&
         message.topic == Topic::ready;
}

/// Returns an idle worker, or null.
std::unique_ptr<Process> takeIdle() {
  while (true) {
    std::unique_ptr<Process> worker;
    {
      const std::scoped_lock one(idle().mutex);
      if (idle().workers.empty()) return {};
      worker = std::move(idle().workers.back());
      idle().workers.pop_back();
    }
    if (worker->forAll || !allWanted) return worker;
  }
}

}  // namespace

Process::~Process() {
  if (pid <= 0) return;
  (void)Zygote::instance().end(pid, 0);
  --alive;
}

bool Process::endsKilled() {
  constexpr int graceMs = 200;  // a closed socket nearly always means that it is ending
  constexpr int byItself[] = {SIGSYS, SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP};
  const std::optional<int> status = Zygote::instance().end(std::exchange(pid, -1), graceMs);
  --alive;
  if (!status) return !Zygote::instance().isWell();
  return WIFSIGNALED(*status) && std::ranges::find(byItself, WTERMSIG(*status)) == std::end(byItself);
}

void Process::limitMemory(std::uint64_t bytes) {
  if (sanitized || bytes == mostBytes) return;
  rlimit limit{};
  if (prlimit(pid, RLIMIT_AS, nullptr, &limit) != 0) return;
  limit.rlim_cur = std::min(rlim_t(bytesAtStart + bytes), limit.rlim_max);
  if (prlimit(pid, RLIMIT_AS, &limit, nullptr) == 0) mostBytes = bytes;
}

double Process::cpuSeconds() const {
  clockid_t clock;
  timespec t{};
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0;
  return double(t.tv_sec) + double(t.tv_nsec) * 1e-9;
}

bool Process::sleeps() const { return stateOf(pid) == 'S'; }

bool Process::isStopped() const { return stateOf(pid) == 'T'; }

namespace {

/// Records the reason of a failure to make a worker. The zygote has the same limit on descriptors. If it is
/// too low, the zygote cannot receive descriptors and closes.
std::unique_ptr<Process> failed(int error) {
  constexpr rlim_t enough = 16;  // descriptors: those of a worker, its socket and buffer in both processes
  rlimit open{};
  const bool few = getrlimit(RLIMIT_NOFILE, &open) == 0 && open.rlim_cur < enough;
  lastFailure = error == EMFILE || error == ENFILE || few ? Failure::noOpening
                : error == EFBIG                          ? Failure::noRoom
                                                          : Failure::noWorker;
  return {};
}

std::unique_ptr<Process> startWorker() {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return failed(errno);
  auto worker = std::make_unique<Process>();
  worker->socket = Descriptor(ends[0]);
  Descriptor theirs(ends[1]), memory;
  worker->buffer = SharedBuffer::make(memory);
  if (!worker->buffer) return failed(errno);
  worker->forAll = allWanted;
  worker->pid = Zygote::instance().fork(std::move(theirs), std::move(memory), worker->forAll);
  if (worker->pid <= 0) return failed(0);
  ++alive;
  if (!isReady(*worker)) return failed(0);
  worker->bytesAtStart = addressSpaceOf(worker->pid) + (std::uint64_t(8) << 20);
  return worker;
}

}  // namespace

// Tries twice, as a worker killed from outside before it serves costs nothing.
std::unique_ptr<Process> makeWorker() {
  std::unique_ptr<Process> worker = startWorker();
  return worker ? std::move(worker) : startWorker();
}

Failure whyNoWorker() { return lastFailure; }

void prepareForAll() { allWanted = true; }

std::unique_ptr<Process> takeWorker() {
  constexpr int patienceMs = 10'000, lookMs = 10;
  std::unique_ptr<Process> worker;
  for (int ms = 0; ms < patienceMs; ms += lookMs) {
    if ((worker = takeIdle()) || (worker = makeWorker()) || alive == 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(lookMs));
  }
  return worker;
}

void giveBack(std::unique_ptr<Process> worker) {
  if (worker->files >= mostFiles || worker->mostBytes > usualBytes) return;
  const std::scoped_lock one(idle().mutex);
  if (idle().workers.size() < std::thread::hardware_concurrency())
    idle().workers.push_back(std::move(worker));
}

}  // namespace volumen::worker
