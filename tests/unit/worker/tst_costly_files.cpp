// Guards import.md, "Safety": an operation that cost a worker is not tried again on that file until it
// changes.
#include <sys/mman.h>

#include <QTemporaryDir>
#include <atomic>
#include <cstdlib>
#include <fstream>

#include "io/regular_file.h"
#include "io/worker/batches.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::worker;

namespace {

/// Returns how often a worker read a file, in memory that workers share with the test.
std::atomic<int>& timesRead() {
  static void* const shared =
      mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return *static_cast<std::atomic<int>*>(shared);
}
const bool isShared = timesRead() == 0;  // before there is a zygote

/// Returns the contents of files. The contents "crash" and "loop" are carried out.
std::vector<std::string> contents(const std::vector<std::string>& paths) {
  std::vector<std::string> all;
  for (const std::string& path : paths) {
    ++timesRead();
    const Result<RegularFile> file = RegularFile::open(path);
    std::vector<std::uint8_t> bytes;
    if (!file || !file->readUpTo(bytes, 100)) return all;
    all.emplace_back(bytes.begin(), bytes.end());
    if (all.back() == "crash") std::abort();
    if (all.back() == "loop")
      for (std::atomic<unsigned> n = 0;;) n.fetch_add(1);
    finishStep();
  }
  return all;
}

std::uint64_t sizeOf(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  return file ? file->size() : 0;
}

}  // namespace

class TestCostlyFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isNotTriedAgain_data();
  void isNotTriedAgain();
};

void TestCostlyFiles::isNotTriedAgain_data() {
  QTest::addColumn<QByteArray>("does");
  QTest::addColumn<QString>("reason");
  QTest::newRow("crashes") << QByteArray("crash") << QString::fromLatin1(reasonOf(Failure::ended));
  QTest::newRow("computes for ever") << QByteArray("loop") << QString::fromLatin1(reasonOf(Failure::slow));
}

// Two of five files cost a worker each, once. Until they change they are then refused unread, for the same
// reason. Other requests are still answered.
void TestCostlyFiles::isNotTriedAgain() {
  QVERIFY(isShared);
  QFETCH(QByteArray, does);
  QFETCH(QString, reason);
  QTemporaryDir folder;
  std::vector<std::string> paths;
  const auto write = [&](std::size_t n, const std::string& text) { std::ofstream(paths[n]) << text; };
  for (std::size_t n = 0; n < 5; ++n) {
    paths.push_back(folder.filePath(QString::number(n)).toStdString());
    write(n, n % 2 == 1 ? does.toStdString() : "good");
  }
  const auto refuse = [](Failure why) { return std::string(reasonOf(why)); };
  const auto readAll = [&] { return forFiles<contents>(paths, "reading", {}, CancelToken(), refuse); };
  const std::string why = reason.toStdString();
  const std::vector<std::string> expected{"good", why, "good", why, "good"};
  QCOMPARE(readAll(), expected);
  timesRead() = 0;
  QCOMPARE(readAll(), expected);
  QCOMPARE(timesRead().load(), 3);
  Request one{.files = {paths[1]}};
  Failure failure{};
  QVERIFY(!isolated<contents>(one, failure, std::vector{paths[1]}).ok());
  QCOMPARE(timesRead().load(), 3);
  one = {.files = {paths[1]}};
  QVERIFY2(isolated<sizeOf>(one, failure, paths[1]).ok(), "something else of the same file");
  write(1, "repaired");
  QCOMPARE(readAll(), (std::vector<std::string>{"good", "repaired", "good", why, "good"}));
}

VOLUMEN_TEST(TestCostlyFiles);
#include "tst_costly_files.moc"
