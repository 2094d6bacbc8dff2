// Guards window.md "Play, and step through time": how the time points of a series are counted and named.
#include "results/series/time_points.h"
#include "tests/unit/suite.h"
#include "ui/workspace/time_points.h"

using namespace volumen;

class TestTimePointText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void stepsAreNamedByWhatVaries_data();
  void stepsAreNamedByWhatVaries();
  void whatAllHaveInCommon();
};

namespace {

using Names = QStringList;  // "b|TE|time point|label" of each time point

std::vector<Series> seriesNamed(const Names& names) {
  std::vector<Series> all;
  for (const QString& name : names) {
    const QStringList parts = name.split(QLatin1Char('|'));
    Series series;
    series.format = "DICOM";
    series.path = "folder";
    series.seriesUid = "1.2.3";
    series.id = "1.2.3#" + std::to_string(all.size() + 1);
    series.bValue = parts[0].toStdString();
    series.echoTime = parts[1].toStdString();
    series.timePoint = parts[2].toStdString();
    series.label = parts[3].toStdString();
    all.push_back(series);
  }
  return all;
}

}  // namespace

void TestTimePointText::stepsAreNamedByWhatVaries_data() {
  QTest::addColumn<QStringList>("names");
  QTest::addColumn<QString>("count");
  QTest::addColumn<QString>("second");
  QTest::addColumn<QString>("all");
  const auto row = [](const char* name, const Names& names, const char* count, const char* second,
                      const char* all) {
    QTest::newRow(name) << names << QString::fromLatin1(count) << QString::fromLatin1(second)
                        << QString::fromLatin1(all);
  };
  const auto q = [](const char* text) { return QString::fromLatin1(text); };
  row("b-values", {q("800|||"), q("0|||"), q("50|||")}, "3 b-values", "b 50 (2 of 3)", "b = 0, 50, 800");
  row("echoes", {q("|9.5||"), q("|31||")}, "2 echoes", "echo 2 of 2: 31 ms", "echo times 9.5, 31 ms");
  row("echoes of other kinds", {q("|0||FIELD_MAP"), q("|1.52||M")}, "2 echoes", "TE 1.52 ms, M (2 of 2)",
      "echo times 0, 1.52 ms");
  row("times, not as text", {q("||10|"), q("||9|"), q("||8|")}, "3 time points", "time point 2 of 3",
      "time points 8, 9, 10");
  row("directions", {q("|||direction 1"), q("|||direction 2"), q("|||direction 3")}, "3 directions",
      "direction 2 (2 of 3)", "3 directions");
  row("components", {q("|||component x"), q("|||component y")}, "2 components", "component y (2 of 2)",
      "2 components");
  row("by rank", {q("|||1 of 2"), q("|||2 of 2")}, "2 volumes", "volume 2 of 2", "2 volumes");
  row("b-values of several directions", {q("0|||"), q("1000|||direction 1"), q("1000|||direction 2")},
      "3 volumes", "b 1000, direction 1 (2 of 3)", "b = 0, 1000");
  row("an average behind directions", {q("|||direction 1"), q("|||direction 2"), q("|||")}, "3 volumes",
      "direction 2 (2 of 3)", "3 volumes");
  row("one alone", {q("||1|")}, "", "", "");
}

void TestTimePointText::stepsAreNamedByWhatVaries() {
  QFETCH(QStringList, names);
  const std::vector<Series> all = seriesNamed(names);
  Workspace workspace;
  for (const Series& series : all)
    workspace.series.editOrAdd(keyOf(series)).series = std::make_shared<const Series>(series);
  Series other = all.front();
  other.id = other.seriesUid = "1.2.4";
  workspace.series.editOrAdd(keyOf(other)).series = std::make_shared<const Series>(other);
  const auto steps = timePointsOf(workspace, keyOf(all.back()));
  QCOMPARE(steps.size(), all.size());
  QTEST(stepsText(steps), "count");
  QTEST(timePointText(workspace, keyOf(steps.size() > 1 ? *steps[1] : *steps[0])), "second");
  QTEST(timeAxisText(steps), "all");
}

void TestTimePointText::whatAllHaveInCommon() {
  std::vector<Series> all =
      seriesNamed({QStringLiteral("0|80||a"), QStringLiteral("50|80||b"), QStringLiteral("50|80||c")});
  for (Series& series : all) {
    series.description = "DWI";
    series.warnings = {{"Every one."}, {"Only " + series.label + "."}};
  }
  const Series common = commonOf({&all[0], &all[1], &all[2]});
  QCOMPARE(common.description, std::string("DWI"));
  QCOMPARE(common.echoTime, std::string("80"));
  QVERIFY(common.bValue.empty() && common.label.empty());
  QCOMPARE(common.warnings.size(), std::size_t(1));
  QCOMPARE(common.warnings[0].sentence, std::string("Every one."));
  QVERIFY2(commonOf({&all[1]}) == all[1], "one alone is what it is");
}

VOLUMEN_TEST(TestTimePointText);
#include "tst_time_point_text.moc"
