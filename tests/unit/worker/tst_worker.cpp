// Guards import.md, "Safety": whatever a file does to the process that reads it, only that file fails, with a
// report, and the next file is read. Operations of this test do what files cannot be made to do here.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <QTemporaryDir>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <map>
#include <thread>

#include "io/regular_file.h"
#include "io/worker/call.h"
#include "io/worker/sandbox.h"
#include "tests/unit/suite.h"
#include "tests/unit/worker/processes.h"

using namespace volumen;
using namespace volumen::tests;
using namespace volumen::worker;

namespace {

/// Imitates a well-behaved file.
std::string reversed(const std::string& text) { return {text.rbegin(), text.rend()}; }

bool crash(int) { std::abort(); }
/// Recurses deeper than any stack.
int depth(int levels) {
  volatile char frame[1 << 12];
  frame[0] = char(levels);
  return levels == 0 ? 0 : depth(levels - 1) + frame[0];
}
bool loop(int) {
  for (std::atomic<unsigned> n = 0;;) n.fetch_add(1);
}
/// Waits for a message that never arrives.
bool sleep(int) {
  char byte = 0;
  iovec part{&byte, 1};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  for (int fd = 3; fd < 64; ++fd) (void)recvmsg(fd, &message, 0);
  return false;
}
constexpr std::uint32_t manySteps = 1000;
template <bool (*end)(int)>
bool afterManySteps(int) {
  for (std::uint32_t n = 0; n < manySteps; ++n) finishStep();
  return end(0);
}
bool bloat(int) {
  std::vector<std::vector<char>> all;
  while (true) all.emplace_back(std::size_t(16) << 20, 'x');
}
bool readsAnother(const std::string& path) { return RegularFile::open(path).ok(); }

/// Streams an endless answer.
void flood(Wire& answer, int) {
  const std::vector<char> bytes(1 << 16);
  while (answer.ok()) answer.bytes(const_cast<char*>(bytes.data()), bytes.size());
}
void endlessQuestions(Wire&, const std::string& path) {
  while (true) (void)RegularFile::open(path);
}
/// Claims a vector of 2^60 elements.
void claim(Wire& answer, int) { answer.write(Outcome::value, std::uint64_t(1) << 60, std::uint64_t(7)); }
void endEarly(Wire& answer, int) { answer.write(Outcome::value, std::uint64_t(1000), std::uint8_t(1)); }
void goOn(Wire& answer, int) { answer.write(Outcome::value, std::string("all of it"), std::uint64_t(0)); }
void unknownOutcome(Wire& answer, int) { answer.write(std::int32_t(77)); }

enum class Syscall {
  open,
  openat2,
  socket,
  connect,
  fork,
  exec,
  kill,
  ptrace,
  unlink,
  rename,
  mkdir,
  chmod,
  truncate,
  setrlimit,
  executable,
  executableLater,
  memfd
};

long callSystem(Syscall which) {
  const char* path = "/tmp/volumen-worker-test";
  switch (which) {
    case Syscall::open:
      return syscall(SYS_openat, AT_FDCWD, "/etc/passwd", O_RDONLY, 0);
    case Syscall::openat2:
      return syscall(SYS_openat2, AT_FDCWD, path, nullptr, 0);
    case Syscall::socket:
      return syscall(SYS_socket, AF_INET, SOCK_STREAM, 0);
    case Syscall::connect:
      return syscall(SYS_connect, 3, nullptr, 0);
    case Syscall::fork:
      return syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
    case Syscall::exec:
      return syscall(SYS_execve, "/bin/true", nullptr, nullptr);
    case Syscall::kill:
      return syscall(SYS_kill, syscall(SYS_getpid), SIGURG);
    case Syscall::ptrace:
      return syscall(SYS_ptrace, 0, 0, 0, 0);
    case Syscall::unlink:
      return syscall(SYS_unlinkat, AT_FDCWD, path, 0);
    case Syscall::rename:
      return syscall(SYS_renameat2, AT_FDCWD, path, AT_FDCWD, path, 0);
    case Syscall::mkdir:
      return syscall(SYS_mkdirat, AT_FDCWD, path, 0700);
    case Syscall::chmod:
      return syscall(SYS_fchmodat, AT_FDCWD, path, 0700);
    case Syscall::truncate:
      return syscall(SYS_ftruncate, 0, 0);
    case Syscall::setrlimit:
      return syscall(SYS_prlimit64, 0, 0, nullptr, nullptr);
    case Syscall::executable:
      return syscall(SYS_mmap, nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    case Syscall::executableLater:
      return syscall(SYS_mprotect, &path, 4096, PROT_READ | PROT_EXEC);
    case Syscall::memfd:
      return syscall(SYS_memfd_create, "x", 0);
  }
  return 0;
}
bool callsSystem(int which) { return callSystem(Syscall(which)) >= 0; }

/// Returns the number of open descriptors that can be written to.
int writable(int) {
  int count = 0;
  for (int fd = 0; fd < 128; ++fd) count += ::write(fd, "x", 1) == 1;
  return count;
}

/// Waits for a worker that computes endlessly and returns it.
pid_t busyWorker() {
  constexpr long started = 5;  // more than any other request takes
  std::map<pid_t, long> before;
  while (true)
    for (const pid_t worker : workers()) {
      const Activity now = activityOf(worker);
      const long from = before.emplace(worker, now.ticks).first->second;
      if (now.state == 'R' && now.ticks >= from + started) return worker;
    }
}

template <auto function, class Argument>
Failure outcomeOf(const Argument& argument, Request request = {.files = {}}) {
  Failure failure{};
  (void)isolated<function>(request, failure, argument).ok();
  return failure;
}

/// Reads an answer as a vector of numbers, of which nothing may be kept.
template <auto function>
Failure lieOf(std::size_t& kept) {
  Request request{.files = {}};
  Call call(request, &streamWith<function>, Signature<decltype(function)>::written(0));
  Outcome outcome{};
  std::vector<std::int16_t> numbers;
  call(outcome, numbers);
  const bool whole = call.finish();
  kept = numbers.size();
  return whole ? Failure::none : call.failure();
}

}  // namespace

class TestWorker : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void cleanup();
  void costsItsOwnRequest_data();
  void costsItsOwnRequest();
  void liesAreNoticed_data();
  void liesAreNoticed();
  void opensOnlyWhatItIsGiven();
  void systemCallsAreRefused_data();
  void systemCallsAreRefused();
  void writesNothing();
  void disturbedFromOutside_data();
  void disturbedFromOutside();
  void waitingWorkerKilled();
  void cancelledWhileItHangs();
  void leavesNothingBehind();
};

namespace {

/// Operations by their number, as rows hold plain values.
using Try = Failure (*)();
constexpr std::pair<const char*, std::pair<Try, Failure>> trials[] = {
    {"answers", {[] { return outcomeOf<reversed>(std::string("abc")); }, Failure::none}},
    {"crashes", {[] { return outcomeOf<crash>(0); }, Failure::ended}},
    {"overflows its stack", {[] { return outcomeOf<depth>(1 << 20); }, Failure::ended}},
    {"computes for ever", {[] { return outcomeOf<loop>(0); }, Failure::slow}},
    {"waits for ever", {[] { return outcomeOf<sleep>(0); }, Failure::slow}},
    {"computes for ever after many quick steps",
     {[] { return outcomeOf<afterManySteps<loop>>(0, {.files = {}, .steps = manySteps}); }, Failure::slow}},
    {"waits for ever after many quick steps",
     {[] { return outcomeOf<afterManySteps<sleep>>(0, {.files = {}, .steps = manySteps}); }, Failure::slow}},
    {"takes all memory", {[] { return outcomeOf<bloat>(0); }, Failure::memory}},
};

std::size_t keptOfLie = 0;
constexpr std::pair<const char*, Try> lies[] = {
    {"2^60 elements", [] { return lieOf<claim>(keptOfLie); }},
    {"ends early", [] { return lieOf<endEarly>(keptOfLie); }},
    {"goes on behind its end", [] { return lieOf<goOn>(keptOfLie); }},
    {"no such enumerator", [] { return lieOf<unknownOutcome>(keptOfLie); }},
    {"a flood", [] { return lieOf<flood>(keptOfLie); }},
};

}  // namespace

void TestWorker::init() { QVERIFY(isolating() && !inside()); }

// After any failure the next request must be answered.
void TestWorker::cleanup() {
  Request request{.files = {}};
  Failure failure{};
  const auto answer = isolated<reversed>(request, failure, std::string("next"));
  QVERIFY2(answer.ok(), answer.ok() ? "" : answer.message().c_str());
  QCOMPARE(*answer, std::string("txen"));
}

void TestWorker::costsItsOwnRequest_data() {
  QTest::addColumn<int>("trial");
  for (int n = 0; n < int(std::size(trials)); ++n) QTest::newRow(trials[n].first) << n;
}

void TestWorker::costsItsOwnRequest() {
  QFETCH(int, trial);
  const auto [attempt, expected] = trials[trial].second;
  if (sanitized && expected == Failure::memory) QSKIP("sanitizers take memory of their own");
  QCOMPARE(attempt(), expected);
}

void TestWorker::liesAreNoticed_data() {
  QTest::addColumn<int>("lie");
  for (int n = 0; n < int(std::size(lies)); ++n) QTest::newRow(lies[n].first) << n;
}

void TestWorker::liesAreNoticed() {
  QFETCH(int, lie);
  const double before = peakMebibytes();
  QCOMPARE(lies[lie].second(), Failure::wrong);
  QVERIFY2(peakMebibytes() < before + 200, "the lie took memory");
}

void TestWorker::opensOnlyWhatItIsGiven() {
  QTemporaryDir folder;
  const auto file = [&](const char* name) {
    const std::string path = folder.filePath(QLatin1String(name)).toStdString();
    std::ofstream(path) << "text";
    return path;
  };
  const std::string mine = file("mine"), other = file("other"), third = file("third");
  QCOMPARE(outcomeOf<readsAnother>(mine, {.files = {mine}}), Failure::none);
  QCOMPARE(outcomeOf<readsAnother>(std::string("/etc/passwd"), {.files = {other}}), Failure::wrong);
  QCOMPARE(outcomeOf<readsAnother>(third + "/../third", {.files = {third}}), Failure::wrong);
  Request request{.files = std::vector<std::string>(40, mine)};  // too many to send with the request
  Call call(request, &streamWith<endlessQuestions>, Signature<decltype(&endlessQuestions)>::written(mine));
  Outcome outcome{};
  call(outcome);
  QCOMPARE(call.failure(), Failure::wrong);
}

void TestWorker::systemCallsAreRefused_data() {
  QTest::addColumn<int>("which");
  const char* names[] = {"open",
                         "openat2",
                         "socket",
                         "connect",
                         "fork",
                         "execve",
                         "kill",
                         "ptrace",
                         "unlink",
                         "rename",
                         "mkdir",
                         "chmod",
                         "truncate",
                         "setrlimit",
                         "executable memory",
                         "memory made executable",
                         "memfd"};
  for (int n = 0; n < int(std::size(names)); ++n) QTest::newRow(names[n]) << n;
}

void TestWorker::systemCallsAreRefused() {
  if (sanitized) QSKIP("sanitizers make such calls themselves");
  QFETCH(int, which);
  QCOMPARE(outcomeOf<callsSystem>(which), Failure::ended);
}

void TestWorker::writesNothing() {
  if (sanitized) QSKIP("sanitizers keep a descriptor that they write to");
  Request request{.files = {}};
  Failure failure{};
  const Result<int> count = isolated<writable>(request, failure, 0);
  QVERIFY(count.ok());
  QCOMPARE(*count, 0);
}

void TestWorker::disturbedFromOutside_data() {
  QTest::addColumn<int>("signal");
  QTest::addColumn<int>("times");
  QTest::addColumn<int>("failure");
  const auto row = [](const char* name, int signal, int times, Failure failure) {
    QTest::newRow(name) << signal << times << int(failure);
  };
  row("killed", SIGKILL, 1, Failure::slow);  // the second worker fails by itself
  row("killed twice", SIGKILL, 2, Failure::killed);
  row("ended by another signal", SIGUSR1, 2, Failure::killed);
  row("stopped", SIGSTOP, 1, Failure::slow);
  row("stopped twice", SIGSTOP, 2, Failure::stopped);
}

// The request is tried once more in a new worker.
void TestWorker::disturbedFromOutside() {
  QFETCH(int, signal);
  QFETCH(int, times);
  QFETCH(int, failure);
  std::atomic<Failure> found = Failure::none;
  std::thread waiting([&] { found = outcomeOf<loop>(0); });
  pid_t last = 0;
  for (int n = 0; n < times; ++n) {
    pid_t busy = last;
    while (busy == last) busy = busyWorker();
    kill(last = busy, signal);
  }
  waiting.join();
  QCOMPARE(int(found.load()), failure);
}

void TestWorker::waitingWorkerKilled() {
  QCOMPARE(outcomeOf<reversed>(std::string("abc")), Failure::none);
  QVERIFY(!workers().empty());
  for (const pid_t worker : workers()) {
    kill(worker, SIGKILL);
    while (activityOf(worker).state != 'Z') std::this_thread::yield();
  }
}

void TestWorker::cancelledWhileItHangs() {
  const CancelToken cancel;
  std::atomic<Failure> failure = Failure::none;
  std::thread waiting([&] { failure = outcomeOf<loop>(0, {.files = {}, .cancel = &cancel}); });
  (void)busyWorker();
  cancel.cancel();
  waiting.join();
  QCOMPARE(failure.load(), Failure::cancelled);
}

void TestWorker::leavesNothingBehind() {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("file")).toStdString();
  std::ofstream(path) << "text";
  const std::size_t before = openDescriptors();
  for (int n = 0; n < 1000; ++n) {
    if (n % 50 == 0) QCOMPARE(outcomeOf<crash>(0), Failure::ended);
    QCOMPARE(outcomeOf<readsAnother>(path, {.files = {path}}), Failure::none);
  }
  QVERIFY(openDescriptors() <= before + 1);  // the socket of the single waiting worker
  QVERIFY(workers().size() <= 1);
}

VOLUMEN_TEST(TestWorker);
#include "tst_worker.moc"
