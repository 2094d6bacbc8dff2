// Guards design.md 2: its table of levels equals the program's, and other documents quote it correctly.
#include <QFile>

#include "tests/unit/suite.h"
#include "viewer/plan/levels.h"
#include "viewer/plan/rule_lines.h"

using namespace volumen;

namespace {

// Returns a document of the source tree as one line.
QString textOf(const char* path) {
  QFile file(QStringLiteral(VOLUMEN_SOURCE_DIR "/") + QLatin1String(path));
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()).simplified() : QString();
}

std::string goalOf(const QualityLevel& level) {
  if (level.timeGoal == 0) return "the frame time asked for";
  const std::string most = level.mostTime > 0 ? ", at most " + inDigits(level.mostTime) + " x" : "";
  return inDigits(level.timeGoal) + " x" + most;
}

// Returns the level's row of the table without the level's purpose.
QString rowOf(Quality quality) {
  const QualityLevel& level = levelOf(quality);
  return QString::fromStdString(std::string("| ") + level.name + " | " + promiseText(quality) + " | " +
                                inDigits(level.rayBudget) + "/255 | " + inDigits(level.stepVoxels) +
                                " voxel | " + goalOf(level) + " | ");
}

}  // namespace

class TestLevelTable : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theDocumentShowsEveryLevel_data();
  void theDocumentShowsEveryLevel();
  void theDocumentShowsNoOtherLevel();
  void theReadmeQuotesIt();
  void budgetsKeepThePromises();
};

void TestLevelTable::theDocumentShowsEveryLevel_data() {
  QTest::addColumn<int>("level");
  for (int n = 0; n < int(std::size(qualityLevels)); ++n) QTest::newRow(qualityLevels[n].name) << n;
}

void TestLevelTable::theDocumentShowsEveryLevel() {
  QFETCH(int, level);
  const QString row = rowOf(Quality(level));
  QVERIFY2(textOf("resources/docs/design.md").contains(row), qPrintable(row));
}

void TestLevelTable::theDocumentShowsNoOtherLevel() {
  const QString text = textOf("resources/docs/design.md");
  const qsizetype begin = text.indexOf(QStringLiteral("| level | promise"));
  QVERIFY(begin >= 0);
  const QString table =
      text.mid(begin, text.lastIndexOf(QStringLiteral(" |"), text.indexOf(QStringLiteral("## 3"))) - begin);
  // The heading, the line below it and one row for each level have six cells each.
  QCOMPARE(int(table.count(QLatin1Char('|'))) + 1, 7 * (2 + int(std::size(qualityLevels))));
}

void TestLevelTable::theReadmeQuotesIt() {
  const auto decibels = [](Quality q) { return QString::number(promiseOf(q).leastPsnrDb); };
  const QString text = textOf("README.md");
  QVERIFY(text.contains(QStringLiteral("`standard` promises %1 dB").arg(decibels(Quality::standard))));
  QVERIFY(text.contains(QStringLiteral("`high` %1 (").arg(decibels(Quality::high))));
  QVERIFY(text.contains(QStringLiteral("`exact` one grey level at most")));
  QCOMPARE(promiseOf(Quality::exact).mostMaximum, 1.0);
}

void TestLevelTable::budgetsKeepThePromises() {
  for (const QualityLevel& level : qualityLevels) {
    // The budget may not exceed the percentile, so that all rays with that error keep it.
    QVERIFY2(level.rayBudget <= std::min(level.promise.most99, level.promise.mostMaximum), level.name);
    QVERIFY(level.stepVoxels > 0 && level.timeGoal >= 0);
  }
}

VOLUMEN_TEST(TestLevelTable);
#include "tst_level_table.moc"
