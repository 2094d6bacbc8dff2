#include "io/worker/zygote.h"

#include <linux/seccomp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>

#include "io/worker/sandbox.h"
#include "io/worker/serve.h"
#include "io/worker/worker.h"

namespace volumen::worker {
namespace {

bool hasSeccomp() { return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, nullptr) != 0 && errno == EFAULT; }

/// Ends this process when its maker ends, for whatever reason.
void endWith(pid_t maker) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != maker) _exit(0);
}

/// The widest prepareToServe() so far.
enum class Prepared { nothing, headers, all };

[[noreturn]] void becomeWorker(pid_t maker, int socket, int buffer, Prepared prepared) {
  endWith(maker);
  SharedBuffer shared = SharedBuffer::of(buffer);
  if (!shared || !enterSandbox(socket)) _exit(1);
  serve(socket, std::move(shared), prepared == Prepared::all);
}

void endWorker(Message& order) {
  const auto worker = pid_t(order.first);
  int status = 0;
  bool byItself = waitpid(worker, &status, WNOHANG) == worker;
  for (std::uint64_t ms = 0; !byItself && ms < order.second; ++ms) {
    constexpr timespec millisecond{0, 1'000'000};
    nanosleep(&millisecond, nullptr);
    byItself = waitpid(worker, &status, WNOHANG) == worker;
  }
  if (!byItself) {
    ::kill(worker, SIGKILL);
    while (waitpid(worker, &status, 0) < 0 && errno == EINTR) {
    }
  }
  order.first = std::uint64_t(status);
  order.second = byItself;
}

/// Executes an order of the program.
void obey(Message& order, pid_t self, Prepared& prepared) {
  if (order.topic == Topic::end) {
    endWorker(order);
  } else if (order.topic == Topic::fork && order.files.size() == 2) {
    const Prepared wanted = order.first == 1 ? Prepared::all : Prepared::headers;
    if (prepared < wanted) prepareToServe(wanted == Prepared::all);
    prepared = std::max(prepared, wanted);
    const pid_t worker = ::fork();
    if (worker == 0) becomeWorker(self, order.files[0].get(), order.files[1].get(), prepared);
    order.first = std::uint64_t(worker);
  } else {
    order.first = std::uint64_t(-1);  // stands for no process
  }
}

[[noreturn]] void runZygote(pid_t maker, int socket) {
  if (!becomeZygote(socket)) _exit(1);
  endWith(maker);
  if (sendMessage(socket, {Topic::ready, 0, 0, {}, {}}, true) != Transfer::done) _exit(1);
  // These signals are for the program, and this process ends with it.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  clearenv();
  setenv("TZ", "UTC0", 1);  // avoids that every time conversion looks at a file
  const pid_t self = getpid();
  Prepared prepared{};
  Message order;
  while (receiveMessage(socket, order, true) == Transfer::done) {
    obey(order, self, prepared);
    order.files.clear();
    if (sendMessage(socket, {order.topic, order.first, order.second, {}, {}}, true) != Transfer::done) break;
  }
  _exit(0);
}

/// Waits for an answer of the zygote. Returns false if none comes.
bool hears(int socket, Message& answer) {
  constexpr int patienceMs = 20'000;
  pollfd ready{socket, POLLIN, 0};
  while (::poll(&ready, 1, patienceMs) < 0)
    if (errno != EINTR) return false;
  return ready.revents != 0 && receiveMessage(socket, answer, false) == Transfer::done;
}

}  // namespace

bool start() { return Zygote::instance().start(); }
void stop() { Zygote::instance().stop(); }
bool isolating() { return Zygote::instance().runs(); }

Zygote& Zygote::instance() {
  static Zygote zygote;
  return zygote;
}

bool Zygote::start() {
  int ends[2] = {-1, -1};
  if (runs() || !hasSeccomp() || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    return runs();
  Descriptor ours(ends[0]), theirs(ends[1]);
  const pid_t maker = getpid();
  pid_ = ::fork();
  if (pid_ < 0) return false;
  if (pid_ == 0) {
    ours = {};
    runZygote(maker, theirs.get());
  }
  Message ready;
  if (!hears(ours.get(), ready)) {
    reap();
    return false;
  }
  socket_ = std::move(ours);
  return true;
}

void Zygote::stop() {
  const std::scoped_lock one(mutex_);
  if (!runs()) return;
  socket_ = {};
  if (pid_ > 0) reap();
}

bool Zygote::isWell() {
  const std::scoped_lock one(mutex_);
  return runs() && pid_ > 0;
}

bool Zygote::ask(const Message& question, Message& answer) {
  const std::scoped_lock one(mutex_);
  if (!runs() || pid_ < 0) return false;
  if (sendMessage(socket_.get(), question, false) == Transfer::done && hears(socket_.get(), answer))
    return true;
  reap();  // it was killed or stopped: it gets no more questions, and nothing is read without workers
  return false;
}

void Zygote::reap() {
  ::kill(pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

pid_t Zygote::fork(Descriptor socket, Descriptor buffer, bool forAll) {
  Message question{Topic::fork, forAll, 0, {}, {}}, answer;
  question.files.push_back(std::move(socket));
  question.files.push_back(std::move(buffer));
  return ask(question, answer) ? pid_t(answer.first) : -1;
}

std::optional<int> Zygote::end(pid_t worker, int graceMs) {
  Message answer;
  if (!ask({Topic::end, std::uint64_t(worker), std::uint64_t(graceMs), {}, {}}, answer)) return {};
  return answer.second == 1 ? std::optional(int(answer.first)) : std::nullopt;
}

}  // namespace volumen::worker
