// Guards parallel work in all rooms: each part is done once, calls do not wait for each other, and long
// sessions accumulate nothing.
#include <unistd.h>
#include <atomic>
#include <fstream>
#include <mutex>
#include <numeric>
#include <thread>

#include "tests/unit/suite.h"
#include "viewer/volume/parallel.h"

using namespace volumen;

namespace {

double residentMiB() {
  std::ifstream file("/proc/self/statm");
  double pages = 0;
  file >> pages >> pages;
  return pages * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

}  // namespace

class TestParallel : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachPartIsDoneOnce_data();
  void eachPartIsDoneOnce();
  void callsHoldTheirLocksAlone();
  void manyCallsKeepNothing();
};

void TestParallel::eachPartIsDoneOnce_data() {
  QTest::addColumn<int>("count");
  QTest::addColumn<int>("threads");
  for (int count : {0, 1, 2, 1000})
    for (int threads : {0, 1, 2, 7})
      QTest::addRow("%d parts, %d threads", count, threads) << count << threads;
}

void TestParallel::eachPartIsDoneOnce() {
  QFETCH(int, count);
  QFETCH(int, threads);
  std::vector<std::atomic<int>> done(count);
  parallelFor(count, threads, [&](std::int64_t begin, std::int64_t end) {
    // Nests one call inside another.
    parallelFor(end - begin, threads, [&](std::int64_t first, std::int64_t last) {
      for (auto n = begin + first; n < begin + last; ++n) ++done[std::size_t(n)];
    });
  });
  QVERIFY(std::all_of(done.begin(), done.end(), [](int times) { return times == 1; }));
}

// A thread that waits for its parts must not start a call that needs the lock it holds.
void TestParallel::callsHoldTheirLocksAlone() {
  std::mutex mutex;
  std::atomic<int> sum = 0;
  const auto calls = [&] {
    for (int n = 0; n < 300; ++n) {
      const std::lock_guard lock(mutex);
      parallelFor(64, 2, [&](std::int64_t begin, std::int64_t end) { sum += int(end - begin); });
    }
  };
  std::thread other(calls);
  calls();
  other.join();
  QCOMPARE(sum.load(), 2 * 300 * 64);
}

void TestParallel::manyCallsKeepNothing() {
  std::atomic<std::int64_t> sum = 0;
  const auto calls = [&](int count) {
    for (int n = 0; n < count; ++n)
      parallelFor(64, 2, [&](std::int64_t begin, std::int64_t end) { sum += end - begin; });
  };
  calls(100);
  const double before = residentMiB();
  calls(3000);
  const double kept = residentMiB() - before;
  QVERIFY2(kept < 5, qPrintable(QStringLiteral("%1 MiB").arg(kept)));
  QCOMPARE(sum.load(), 3100 * 64);
}

VOLUMEN_TEST(TestParallel);
#include "tst_parallel.moc"
