// Guards import.md, "Safety": workers take no more memory together than there is, and what does not fit is
// refused by both figures.
#include <sys/mman.h>
#include <sys/resource.h>

#include <QRegularExpression>
#include <array>
#include <atomic>
#include <fstream>
#include <thread>

#include "io/worker/call.h"
#include "io/worker/sandbox.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::worker;

namespace {

constexpr std::uint64_t mebi = 1 << 20;

/// Calls that run at present and the most that ever did, in memory that workers share with the test.
struct Running {
  std::atomic<int> now, most;
};
Running& running() {
  static void* const shared =
      mmap(nullptr, sizeof(Running), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return *static_cast<Running*>(shared);
}
const bool isCountShared = running().now == 0;  // before there is a zygote

int runForAWhile(int) {
  const int now = ++running().now;
  for (int most = running().most; most < now && !running().most.compare_exchange_weak(most, now);) {
  }
  std::atomic<unsigned> n = 0;
  while (n.fetch_add(1) < 100'000'000 && running().now < 2) {
  }
  return --running().now;
}

/// Leaves the process so many bytes of address space while it lives.
class AddressSpaceLeft {
 public:
  explicit AddressSpaceLeft(std::uint64_t bytes) {
    ::getrlimit(RLIMIT_AS, &before_);
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit low = before_;
    low.rlim_cur = rlim_t(pages * std::uint64_t(sysconf(_SC_PAGESIZE)) + bytes);
    ::setrlimit(RLIMIT_AS, &low);
  }
  ~AddressSpaceLeft() { ::setrlimit(RLIMIT_AS, &before_); }
  AddressSpaceLeft(const AddressSpaceLeft&) = delete;
  AddressSpaceLeft& operator=(const AddressSpaceLeft&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

class TestWorkerMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void tooLittleIsToldByBothFigures();
  void callsShareOneLimit_data();
  void callsShareOneLimit();
};

void TestWorkerMemory::initTestCase() {
  QVERIFY(isCountShared);
  if (sanitized) QSKIP("sanitizers reserve more than any limit");
}

void TestWorkerMemory::tooLittleIsToldByBothFigures() {
  const AddressSpaceLeft left(500 * mebi);
  Request request{.files = {}, .needBytes = 1024 * mebi};
  Failure failure{};
  const auto result = isolated<runForAWhile>(request, failure, 0);
  QVERIFY(!result && failure == Failure::scarce);
  const QRegularExpression figures(
      QStringLiteral(R"(^the process that is to read it needs 3\.1 GiB of memory, and (\d+) MiB are )"
                     R"(available \(the limit of ulimit -v\); allow more with ulimit -v$)"));
  const auto told = figures.match(QString::fromStdString(result.message()));
  QVERIFY2(told.hasMatch() && told.captured(1).toInt() <= 500, result.message().c_str());
  QVERIFY(isReasonOfMachine(result.message()));
}

void TestWorkerMemory::callsShareOneLimit_data() {
  QTest::addColumn<int>("left");
  QTest::addColumn<int>("together");
  QTest::newRow("both fit") << 4000 << 2;
  QTest::newRow("only one fits at a time") << 1500 << 1;
}

void TestWorkerMemory::callsShareOneLimit() {
  QFETCH(int, left);
  running().most = 0;
  const AddressSpaceLeft limit(std::uint64_t(left) * mebi);
  std::array<bool, 2> done{};
  std::vector<std::thread> threads;
  for (bool& one : done)
    threads.emplace_back([&one] {
      Request request{.files = {}, .needBytes = 300 * mebi};
      Failure failure{};
      one = isolated<runForAWhile>(request, failure, 0).ok();
    });
  for (std::thread& thread : threads) thread.join();
  QVERIFY2(done[0] && done[1], "what waits is answered in the end");
  QTEST(running().most.load(), "together");
}

VOLUMEN_TEST(TestWorkerMemory);
#include "tst_worker_memory.moc"
