// Guards design.md 8: lengthy work is a job. Jobs are listed with their progress, cancelled one by one, and
// end exactly once.
#include <map>
#include <semaphore>

#include "results/text/text.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/document/job_lane.h"

using namespace volumen;

namespace {

constexpr int longest = 20000;

// Work that blocks until the gate is opened.
struct Gate {
  std::shared_ptr<std::counting_semaphore<>> open = std::make_shared<std::counting_semaphore<>>(0);

  int operator()(const Job&) const {
    open->acquire();
    return 7;
  }
  void letGo() const { open->release(); }
};

QStringList texts(const Jobs& jobs) {
  QStringList found;
  for (const JobRow& row : jobs.rows()) found << row.text;
  return found;
}

}  // namespace

class TestJobs : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void resultsComeInOrderOnThisThread();
  void theListShowsWhatRunsAndWaits();
  void whatIsToldOfProgress_data();
  void whatIsToldOfProgress();
  void rowsSayWhatAJobWorksOn_data();
  void rowsSayWhatAJobWorksOn();
  void oneOfThreeIsCancelled();
  void whatWaitsIsNeverBegun();
  void whatIsWrittenIsWrittenToItsEnd();
  void whatIsGivenUpSaysNothing();
  void aLaneThatGoesWaitsAndSaysNothing();
  void whatMayBeTellsWhileItRuns();
  void lackOfMemoryIsAnError();
  void lackOfMemoryCancelsWhatCannotFail_data();
  void lackOfMemoryCancelsWhatCannotFail();
  void eachEndsOnce_data();
  void eachEndsOnce();
};

void TestJobs::resultsComeInOrderOnThisThread() {
  JobLane lane;
  std::vector<int> results;
  QThread* const here = QThread::currentThread();
  bool isElsewhere = true, isHere = true;
  for (int n = 0; n < 20; ++n)
    lane.run(
        {},
        [&, n](const Job&) {
          isElsewhere = isElsewhere && QThread::currentThread() != here;
          return n;
        },
        [&](int result) {
          isHere = isHere && QThread::currentThread() == here;
          results.push_back(result);
        });
  int ends = 0;
  lane.run(
      {}, [](const Job&) {}, [&] { ++ends; });
  QVERIFY(lane.isBusy());
  QTRY_COMPARE_WITH_TIMEOUT(ends, 1, longest);
  QVERIFY(!lane.isBusy());
  QVERIFY(isElsewhere && isHere);
  for (int n = 0; n < 20; ++n) QCOMPARE(results.at(std::size_t(n)), n);
}

void TestJobs::theListShowsWhatRunsAndWaits() {
  Jobs jobs;
  JobLane one(&jobs), two(&jobs);
  const Gate gate;
  int ends = 0;
  const auto done = [&](int) { ++ends; };
  one.run(QStringLiteral("a"), gate, done);
  two.run(QStringLiteral("b"), gate, done);
  one.run(QStringLiteral("c"), gate, done);
  one.run({}, gate, done);
  QCOMPARE(texts(jobs), QStringList({QStringLiteral("a"), QStringLiteral("b"), QStringLiteral("c")}));
  for (int n = 0; n < 4; ++n) gate.letGo();
  QTRY_COMPARE_WITH_TIMEOUT(ends, 4, longest);
  QVERIFY(jobs.rows().empty());
}

void TestJobs::whatIsToldOfProgress_data() {
  using Tell = std::function<void(const Job&)>;
  QTest::addColumn<Tell>("tell");
  QTest::addColumn<QString>("text");
  QTest::addColumn<double>("part");
  const auto row = [](const char* name, Tell tell, const char* text, double part) {
    QTest::newRow(name) << tell << QString::fromLatin1(text) << part;
  };
  row(
      "nothing yet", [](const Job&) {}, "Reading", -1);
  row(
      "of files", [](const Job& job) { job.progress()("reading slices", 1500, 3000); },
      "reading slices: 1,500 of 3,000", 0.5);
  row(
      "of files, not known how many", [](const Job& job) { job.progress()("looking", 5, 0); }, "looking", -1);
  row(
      "by its token", [](const Job& job) { job.cancel().setDone(0.25); }, "Reading: 25 %", 0.25);
  row(
      "in words", [](const Job& job) { job.tell(QStringLiteral("almost"), 0.99); }, "almost", 0.99);
}

void TestJobs::whatIsToldOfProgress() {
  using Tell = std::function<void(const Job&)>;
  QFETCH(Tell, tell);
  QFETCH(QString, text);
  QFETCH(double, part);
  Jobs jobs;
  const Job job(QStringLiteral("Reading"));
  jobs.add(job, {});
  tell(job);
  const JobRow row = jobs.rows().at(0);
  QCOMPARE(row.text, text);
  QCOMPARE(row.part, part);
}

void TestJobs::rowsSayWhatAJobWorksOn_data() {
  QTest::addColumn<QString>("object");
  QTest::addColumn<QString>("told");
  QTest::addColumn<bool>("namesHidden");
  QTest::addColumn<QString>("text");
  const auto row = [](const char* name, const char* object, const char* told, bool hidden, const char* text) {
    QTest::newRow(name) << QString::fromUtf8(object) << QString::fromUtf8(told) << hidden
                        << QString::fromUtf8(text);
  };
  row("nothing", "", "", false, "Opening");
  row("nothing, told", "", "reading slices", false, "reading slices");
  row("a folder", "CT-chest", "", false, "Opening CT-chest");
  row("a folder, told", "CT-chest", "reading slices", false, "Opening CT-chest (reading slices)");
  row("a folder, names hidden", "CT-chest", "", true, "Opening");
  row("a folder, told, names hidden", "CT-chest", "reading slices", true, "reading slices");
  row("a long name is shortened", "1.2.840.113619.2.55.3.604688119.969", "", false,
      "Opening 1.2.840.113619….604688119.969");
}

void TestJobs::rowsSayWhatAJobWorksOn() {
  QFETCH(QString, object);
  QFETCH(QString, told);
  QFETCH(bool, namesHidden);
  QFETCH(QString, text);
  const Job job({QStringLiteral("Opening"), object});
  if (!told.isEmpty()) job.tell(told, -1);
  hideNames(namesHidden);
  const QString shown = job.row().text;
  hideNames(false);
  QCOMPARE(shown, text);
}

void TestJobs::oneOfThreeIsCancelled() {
  Jobs jobs;
  JobLane lanes[3] = {JobLane(&jobs), JobLane(&jobs), JobLane(&jobs)};
  const Gate gate;
  int ended[3] = {}, cancelled[3] = {};
  for (int n = 0; n < 3; ++n)
    lanes[n].run(
        QString::number(n), gate, [&, n](int) { ++ended[n]; }, [&, n] { ++cancelled[n]; });
  jobs.cancel(jobs.rows().at(1).id);
  QCOMPARE(texts(jobs), QStringList({QStringLiteral("0"), QStringLiteral("2")}));
  for (int n = 0; n < 3; ++n) gate.letGo();
  QTRY_VERIFY_WITH_TIMEOUT(ended[0] && ended[2], longest);
  for (JobLane& lane : lanes) lane.wait();
  QCoreApplication::processEvents();
  for (int n = 0; n < 3; ++n) QCOMPARE(ended[n], n == 1 ? 0 : 1);
  for (int n = 0; n < 3; ++n) QCOMPARE(cancelled[n], n == 1 ? 1 : 0);
}

void TestJobs::whatWaitsIsNeverBegun() {
  Jobs jobs;
  JobLane lane(&jobs);
  const Gate gate;
  std::atomic<int> begun = 0;
  const auto work = [&](const Job&) { return ++begun; };
  int ended = 0;
  const int running = lane.run(QStringLiteral("runs"), gate, [&](int) { ++ended; });
  QTRY_VERIFY_WITH_TIMEOUT(!jobs.rows().empty(), longest);
  lane.run(QStringLiteral("cancelled"), work, [&](int) { ++ended; });
  const int waiting = lane.run(QStringLiteral("given up"), work, [&](int) { ++ended; });
  jobs.cancel(jobs.rows().at(1).id);
  lane.giveUpWaiting(waiting);
  QTest::qWait(50);
  lane.giveUpWaiting(running);  // no effect: the job already runs
  QCOMPARE(texts(jobs), QStringList(QStringLiteral("runs")));
  gate.letGo();
  QTRY_COMPARE_WITH_TIMEOUT(ended, 1, longest);
  lane.wait();
  QCOMPARE(begun, 0);
}

void TestJobs::whatIsWrittenIsWrittenToItsEnd() {
  Jobs jobs;
  JobLane lane(&jobs);
  lane.keepToTheEnd();
  const Gate gate;
  int ended = 0;
  lane.run(QStringLiteral("Saving"), gate, [&](int) { ++ended; });
  const JobRow row = jobs.rows().at(0);
  QVERIFY(!row.canBeCancelled);
  jobs.cancel(row.id);
  QCOMPARE(jobs.rows().size(), std::size_t(1));
  gate.letGo();
  QTRY_COMPARE_WITH_TIMEOUT(ended, 1, longest);
}

void TestJobs::whatIsGivenUpSaysNothing() {
  Jobs jobs;
  JobLane lane(&jobs);
  const Gate gate;
  int ended = 0, cancelled = 0;
  const int job = lane.run(
      QStringLiteral("a"), gate, [&](int) { ++ended; }, [&] { ++cancelled; });
  lane.giveUp(job);
  lane.giveUp(job);
  QVERIFY(jobs.rows().empty());
  QVERIFY(!lane.isBusy());
  gate.letGo();
  lane.wait();
  QCoreApplication::processEvents();
  QCOMPARE(ended, 0);
  QCOMPARE(cancelled, 0);
  int after = 0;
  const int last = lane.run(
      {}, [](const Job&) { return 3; }, [&](int result) { after = result; });
  QTRY_COMPARE_WITH_TIMEOUT(after, 3, longest);
  lane.giveUp(last);  // no effect: the job has ended
}

void TestJobs::aLaneThatGoesWaitsAndSaysNothing() {
  Jobs jobs;
  std::atomic<bool> hasSeenIt = false;
  int ended = 0;
  {
    JobLane lane(&jobs);
    lane.run(
        QStringLiteral("a"),
        [&](const Job& job) {
          while (!job.cancelled()) QThread::msleep(1);
          hasSeenIt = true;
        },
        [&] { ++ended; });
    lane.run(
        {}, [](const Job&) {}, [&] { ++ended; });
    QTest::qWait(20);
  }
  QVERIFY(hasSeenIt);
  QVERIFY(jobs.rows().empty());
  QCoreApplication::processEvents();
  QCOMPARE(ended, 0);
}

void TestJobs::whatMayBeTellsWhileItRuns() {
  JobLane lane;
  const Gate gate;
  QStringList told;
  const auto work = [&](const char* text) {
    return [&, text](const Job& job) {
      lane.tell(job, [&told, text] { told << QString::fromLatin1(text); });
      return gate(job);
    };
  };
  lane.run({}, work("first"), [&](int) { told << QStringLiteral("end"); });
  QTRY_COMPARE_WITH_TIMEOUT(told, QStringList(QStringLiteral("first")), longest);
  gate.letGo();
  QTRY_COMPARE_WITH_TIMEOUT(told.size(), 2, longest);
  const int job = lane.run({}, work("second"), [&](int) { told << QStringLiteral("end"); });
  QTest::qWait(20);
  lane.giveUp(job);
  gate.letGo();
  lane.wait();
  told.clear();
  QCoreApplication::processEvents();
  QCOMPARE(told, QStringList());
}

void TestJobs::lackOfMemoryIsAnError() {
  JobLane lane;
  std::optional<Result<int>> result;
  lane.run(
      {}, [](const Job&) -> Result<int> { throw std::bad_alloc(); },
      [&](const Result<int>& made) { result = made; });
  QTRY_VERIFY_WITH_TIMEOUT(result && !*result, longest);
  QVERIFY2(result->message().find("not enough memory") != std::string::npos, result->message().c_str());
}

void TestJobs::lackOfMemoryCancelsWhatCannotFail_data() {
  QTest::addColumn<bool>("hasResult");
  QTest::newRow("with a result") << true;
  QTest::newRow("without one") << false;
}

void TestJobs::lackOfMemoryCancelsWhatCannotFail() {
  QFETCH(bool, hasResult);
  Jobs jobs;
  JobLane lane(&jobs);
  int done = 0, cancelled = 0;
  const JobName name(QStringLiteral("Counting"));
  if (hasResult)
    lane.run(
        name, [](const Job&) -> int { throw std::bad_alloc(); }, [&](int) { ++done; }, [&] { ++cancelled; });
  else
    lane.run(
        name, [](const Job&) { throw std::bad_alloc(); }, [&] { ++done; }, [&] { ++cancelled; });
  lane.run(
      {}, [](const Job&) { return 1; }, [&](int) { ++done; });
  QTRY_COMPARE_WITH_TIMEOUT(done, 1, longest);
  QCOMPARE(cancelled, 1);
  QVERIFY(jobs.rows().empty() && !lane.isBusy());
}

void TestJobs::eachEndsOnce_data() {
  QTest::addColumn<int>("seed");
  const tests::Seeds seeds = tests::seedsOf(30, 1000);
  for (int seed = seeds.first; seed < seeds.first + seeds.count; ++seed)
    QTest::addRow("seed %d", seed) << seed;
}

// Starts, cancels and abandons random jobs on three lanes. Each ends in exactly one way, in order.
void TestJobs::eachEndsOnce() {
  QFETCH(int, seed);
  tests::Chance chance{std::uint64_t(seed)};
  Jobs jobs;
  struct Fate {
    int lane = 0, ended = 0, cancelled = 0;
    bool isGivenUp = false;
  };
  std::map<int, Fate> fates;   // keyed by the number that the work returns
  std::map<int, int> numbers;  // the same numbers, keyed by job
  std::vector<int> order[3];
  {
    JobLane lanes[3] = {JobLane(&jobs), JobLane(&jobs), JobLane(&jobs)};
    for (int n = 0; n < 60; ++n) {
      const int lane = chance.below(3), pause = chance.below(3);
      fates[n].lane = lane;
      const int job = lanes[lane].run(
          chance.oneIn(3) ? QString() : QString::number(n),
          [n, pause](const Job&) {
            if (pause) QThread::usleep(unsigned(300 * pause));
            return n;
          },
          [&fates, &order](int number) {
            ++fates[number].ended;
            order[fates[number].lane].push_back(number);
          },
          [&fates, n] { ++fates[n].cancelled; });
      numbers[job] = n;
      const int other = std::next(numbers.begin(), chance.below(int(numbers.size())))->first;
      Fate& fate = fates[numbers[other]];
      const std::vector<JobRow> rows = jobs.rows();
      if (chance.oneIn(6) && !rows.empty()) jobs.cancel(rows[std::size_t(chance.below(int(rows.size())))].id);
      if (chance.oneIn(8)) {
        fate.isGivenUp = fate.isGivenUp || fate.ended + fate.cancelled == 0;
        lanes[fate.lane].giveUp(other);
      }
      if (chance.oneIn(5)) QCoreApplication::processEvents();
    }
    for (JobLane& lane : lanes) lane.wait();
    QCoreApplication::processEvents();
    for (const JobLane& lane : lanes) QVERIFY(!lane.isBusy());
  }
  QVERIFY(jobs.rows().empty());
  for (const auto& [n, fate] : fates)
    QVERIFY2(fate.ended + fate.cancelled + int(fate.isGivenUp) == 1, qPrintable(QString::number(n)));
  for (const std::vector<int>& numbersOfLane : order) QVERIFY(std::ranges::is_sorted(numbersOfLane));
}

VOLUMEN_TEST(TestJobs);
#include "tst_jobs.moc"
