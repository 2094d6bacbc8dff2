// Guards resources/docs/tasks.md. A workflow of real events does each task of a first hour in the number of
// steps on that page. No task takes more than one step beyond the best other program, and each row has its
// workflow.
#include <QFile>
#include <QRegularExpression>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/hand.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Row {
  int number;
  QString name;
  int here;
  std::optional<int> best;  // of other programs; empty if none is known to do it
};

// Returns the number at the start of a cell; empty for "?" or "no".
std::optional<int> stepsIn(const QString& cell) {
  static const QRegularExpression number(QStringLiteral("^(?:>=)?(\\d+)"));
  const QRegularExpressionMatch found = number.match(cell);
  return found.hasMatch() ? std::optional(found.captured(1).toInt()) : std::nullopt;
}

std::vector<Row> rowsOfThePage() {
  QFile page(QStringLiteral(VOLUMEN_SOURCE_DIR "/resources/docs/tasks.md"));
  std::vector<Row> rows;
  if (!page.open(QIODevice::ReadOnly)) return rows;
  for (const QString& line : QString::fromUtf8(page.readAll()).split(QLatin1Char('\n'))) {
    QStringList cells = line.split(QLatin1Char('|'));
    for (QString& cell : cells) cell = cell.trimmed();
    if (cells.size() != 9 || !stepsIn(cells[1])) continue;  // not a row of the table
    Row row{*stepsIn(cells[1]), cells[2], stepsIn(cells[3]).value_or(-1), {}};
    for (qsizetype n = 4; n < 8; ++n)
      if (const std::optional<int> steps = stepsIn(cells[n]))
        row.best = std::min(row.best.value_or(*steps), *steps);
    rows.push_back(row);
  }
  return rows;
}

std::vector<Task> allTasks() {
  std::vector<Task> all;
  for (const auto& part : {readingTasks(), comparingTasks(), frameTasks(), measuringTasks(), showingTasks()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

class TestTasks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thePageHasARowForEachJourney();
  void noneTakesMoreStepsThanTheBestAndOne();
  void theStepsAreThoseOfThePage_data();
  void theStepsAreThoseOfThePage();
};

void TestTasks::thePageHasARowForEachJourney() {
  std::set<int> told, done;
  for (const Row& row : rowsOfThePage()) QVERIFY2(told.insert(row.number).second, qPrintable(row.name));
  for (const Task& task : allTasks()) QVERIFY2(done.insert(task.number).second, "a journey for each");
  QVERIFY(told.size() >= 40);
  QVERIFY(told == done);
}

void TestTasks::noneTakesMoreStepsThanTheBestAndOne() {
  for (const Row& row : rowsOfThePage()) {
    QVERIFY2(row.here >= 0, qPrintable(row.name));
    QVERIFY2(!row.best || row.here <= *row.best + 1, qPrintable(row.name));
  }
}

void TestTasks::theStepsAreThoseOfThePage_data() {
  QTest::addColumn<int>("number");
  QTest::addColumn<int>("here");
  for (const Row& row : rowsOfThePage()) QTest::newRow(qPrintable(row.name)) << row.number << row.here;
}

void TestTasks::theStepsAreThoseOfThePage() {
  QFETCH(int, number);
  QFETCH(int, here);
  NEED_DATA(dataPath("dicom-2d"));
  QSettings().clear();
  for (const Task& task : allTasks()) {
    if (task.number != number) continue;
    const int steps = task.steps();
    if (!QTest::currentTestFailed()) QCOMPARE(steps, here);
    return;
  }
  QFAIL("no journey does it");
}

VOLUMEN_TEST(TestTasks);
#include "tst_tasks.moc"
