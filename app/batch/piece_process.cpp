#include "app/batch/piece_process.h"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <new>

#include "app/command_line.h"
#include "app/open_volume.h"
#include "io/worker/worker.h"
#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct PieceAnswer {
  int exitStatus = 0;
  double seconds = 0;
  std::uint64_t peakBytes = 0;
};

// Resets the kernel's count of peak memory (VmHWM).
void forgetPeak() { std::ofstream("/proc/self/clear_refs") << 5; }

// Returns a number of bytes that the kernel counts of this process; 0 where there is no /proc.
std::uint64_t bytesOfProcess(std::string_view name) {
  std::ifstream status("/proc/self/status");
  std::uint64_t kibibytes = 0;
  for (std::string word; status >> word;)
    if (word == name) status >> kibibytes;
  return kibibytes * 1024;
}

std::uint64_t peakOfMemory() {
  if (const std::uint64_t bytes = bytesOfProcess("VmHWM:"); bytes > 0) return bytes;
  rusage use{};  // of the whole process
  return getrusage(RUSAGE_SELF, &use) == 0 ? std::uint64_t(use.ru_maxrss) * 1024 : 0;
}

void startAgain(int fd) {
  if (ftruncate(fd, 0) == 0) lseek(fd, 0, SEEK_SET);
}

PieceAnswer answerOf(const Piece& piece, const CancelToken& cancel) {
  startAgain(STDOUT_FILENO), startAgain(STDERR_FILENO);
  const auto begin = Clock::now();
  PieceAnswer answer;
  answer.exitStatus = CommandLine(cancel).run(piece.words);
  std::cout.flush(), std::cerr.flush(), std::fflush(nullptr);
  answer.seconds = secondsSince(begin);
  answer.peakBytes = peakOfMemory();
  forgetPeak();
  return answer;
}

// What this process has of its maker, such as the list, does not count: the same piece would have less of it
// in a longer list.
void limitMemory(std::uint64_t mostBytes) {
  rlimit limit{};
  if (mostBytes == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  malloc_trim(0);
  const rlim_t asked = bytesOfProcess("VmData:") + mostBytes;
  limit.rlim_cur = std::min(limit.rlim_max, asked);
  if (setrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur == asked) nameDataLimit("--max-memory");
}

[[noreturn]] void doPieces(const std::vector<Piece>& pieces, int socket, std::uint64_t mostBytes,
                           const CancelToken& cancel) {
  limitMemory(mostBytes);
  worker::start();
  if (mostBytes == 0) keepOpened();
  forgetPeak();
  for (std::size_t index = 0; recv(socket, &index, sizeof index, MSG_WAITALL) == sizeof index;) {
    const PieceAnswer answer = answerOf(pieces[index], cancel);
    if (send(socket, &answer, sizeof answer, MSG_NOSIGNAL) != sizeof answer) break;
  }
  worker::stop();
  _exit(0);
}

// Stopped workers would count in what wait() tells of memory.
bool restartsWorkers(const std::vector<Piece>& pieces) {
  return std::ranges::any_of(pieces, [](const Piece& piece) {
    return std::ranges::any_of(piece.words,
                               [](const std::string& word) { return word.starts_with("--largest-frame"); });
  });
}

std::string wholeOf(int fd) {
  std::string text;
  char part[1 << 16];
  for (ssize_t n; (n = pread(fd, part, sizeof part, off_t(text.size()))) > 0;)
    text.append(part, std::size_t(n));
  return text;
}

}  // namespace

PieceProcess::PieceProcess(const std::vector<Piece>& pieces, const PieceLimits& limits,
                           const CancelToken& cancel)
    : restartsWorkers_(restartsWorkers(pieces)),
      limits_(limits),
      cancel_(cancel),
      out_(memfd_create("stdout", MFD_CLOEXEC)),
      error_(memfd_create("stderr", MFD_CLOEXEC)) {
  int ends[2] = {-1, -1};
  if (!out_ || !error_ || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return;
  socket_ = worker::Descriptor(ends[0]);
  const worker::Descriptor theirs(ends[1]);
  std::cout.flush(), std::fflush(nullptr);  // else both processes write what is left
  const pid_t maker = getpid();
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool isReady = getppid() == maker && dup2(nothing, STDIN_FILENO) >= 0 &&
                       dup2(out_.get(), STDOUT_FILENO) >= 0 && dup2(error_.get(), STDERR_FILENO) >= 0;
  if (!isReady) _exit(1);
  socket_ = {};
  doPieces(pieces, theirs.get(), limits.bytes, cancel);
}

PieceProcess::~PieceProcess() {
  socket_ = {};
  end();
}

// Returns why the process ended.
std::string PieceProcess::end() {
  int status = 0;
  rusage use{};
  const bool isThere = pid_ > 0;
  while (isThere && wait4(pid_, &status, 0, &use) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (!isThere) return "could not be started";
  if (use.ru_maxrss > 0 && !restartsWorkers_) peakBytes_ = std::uint64_t(use.ru_maxrss) * 1024;
  if (isLate_) return "took longer than --timeout allows";
  if (WIFSIGNALED(status)) return "was ended by signal " + std::to_string(WTERMSIG(status));
  return "ended with status " + std::to_string(WEXITSTATUS(status));
}

// Passes an interruption on, and ends what takes too long, also to stop.
bool PieceProcess::waitForAnswer() {
  constexpr int patienceMs = 100;
  constexpr double secondsToStop = 0.3;
  pollfd answer{socket_.get(), POLLIN, 0};
  const auto begin = Clock::now();
  for (std::optional<Clock::time_point> told;;) {
    const int ready = poll(&answer, 1, patienceMs);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return ready > 0;
    if (cancel_.cancelled() && !told) {
      kill(pid_, SIGTERM);
      told = Clock::now();
    }
    isLate_ = limits_.seconds > 0 && secondsSince(begin) > limits_.seconds;
    if (isLate_ || (told && secondsSince(*told) > secondsToStop)) kill(pid_, SIGKILL);
  }
}

PieceResult PieceProcess::run(std::size_t index) {
  PieceResult result;
  PieceAnswer answer;
  const auto begin = Clock::now();
  const bool isAsked = pid_ > 0 && send(socket_.get(), &index, sizeof index, MSG_NOSIGNAL) == sizeof index;
  const bool isAnswered =
      isAsked && waitForAnswer() && recv(socket_.get(), &answer, sizeof answer, 0) == sizeof answer;
  result.out = wholeOf(out_.get()), result.error = wholeOf(error_.get());
  if (!isAnswered) {
    result.end = end();
    if (isAsked) result.seconds = secondsSince(begin), result.peakBytes = peakBytes_;
    return result;
  }
  result.exitStatus = answer.exitStatus;
  result.seconds = answer.seconds;
  result.peakBytes = answer.peakBytes;
  return result;
}

}  // namespace volumen
