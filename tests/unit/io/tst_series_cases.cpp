// Guards design.md 7 on inputs made after public reports (../shared/data/field-cases): which pictures form a
// volume, their order, and the volumes' names.
#include <algorithm>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/series_summary.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSeriesCases : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesThatBelongTogether_data();
  void picturesThatBelongTogether();
};

namespace {

const QString comma = QStringLiteral(",");

}  // namespace

void TestSeriesCases::picturesThatBelongTogether_data() {
  QTest::addColumn<QString>("folder");
  QTest::addColumn<QStringList>("volumes");
  QTest::addColumn<QString>("told");     // in a warning of each
  QTest::addColumn<QString>("notTold");  // in no warning
  const auto row = [](const char* folder, const QStringList& volumes, const char* told = "",
                      const char* notTold = "nothing in the files") {
    QTest::newRow(folder) << QString::fromLatin1(folder) << volumes << QString::fromLatin1(told)
                          << QString::fromLatin1(notTold);
  };
  const auto steps = [](const QStringList& words, int count = 5) {
    QStringList all;
    for (int n = 0; n < words.size(); ++n) {
      QStringList numbers;
      for (int z = 0; z < count; ++z) numbers << QString::number(100 * n + z);
      all << QStringLiteral("8x8x%1 1,1,2 @0,0,0: ").arg(count) + numbers.join(comma) + QStringLiteral("; ") +
                 words[n];
    }
    return all;
  };
  row("c36b-two-patients-interleaved",
      {QStringLiteral("8x8x5 1,1,2 @0,0,0: 0,2,4,6,8"),
       QStringLiteral("8x8x5 1,1,2 @0,0,1: 501,503,505,507,509")},
      "2 patients share this series UID, \"Test^CaseA\" (ID P1) and \"Test^CaseB\" (ID P2)");
  row("c36e-two-frames-of-reference",
      {QStringLiteral("8x8x5 1,1,1 @0,0,0: 0,1,2,3,4"),
       QStringLiteral("8x8x5 1,1,1 @0,0,0.5: 500,501,502,503,504")},
      "2 frames of reference");
  row("c04b-cardiac-phases", {QStringLiteral("8x8x5 1,1,2 @0,0,0: 0,1,2,3,4; phase 0 %"),
                              QStringLiteral("8x8x5 1,1,2 @0,0,0: 250,251,252,253,254; phase 25 %"),
                              QStringLiteral("8x8x5 1,1,2 @0,0,0: 500,501,502,503,504; phase 50 %"),
                              QStringLiteral("8x8x5 1,1,2 @0,0,0: 750,751,752,753,754; phase 75 %")});
  row("c66a-kernel",
      steps({QStringLiteral("kernel B30f"), QStringLiteral("kernel B70f"), QStringLiteral("kernel I50f")}));
  row("c66c-flip-angle",
      steps({QStringLiteral("flip angle 3 degrees"), QStringLiteral("flip angle 15 degrees"),
             QStringLiteral("flip angle 30 degrees")}));
  row("c66f-cardiac-phase",
      steps({QStringLiteral("phase 0 %"), QStringLiteral("phase 40 %"), QStringLiteral("phase 75 %")}));
  row("c66h-echo-time",
      steps({QStringLiteral("TE 2 ms"), QStringLiteral("TE 4 ms"), QStringLiteral("TE 6 ms")}));
  row("c66j-acquisition-time",
      steps({QStringLiteral("10:00:00"), QStringLiteral("10:00:10"), QStringLiteral("10:00:20")}));
  row("c66n-ge-private-b", steps({QStringLiteral("b 0"), QStringLiteral("b 500"), QStringLiteral("b 1000")}));
  row("c66q-frame-reference-time",
      steps({QStringLiteral("1 s"), QStringLiteral("20 s"), QStringLiteral("40 s")}));
  row("c66r-kernel-same-number", steps({QStringLiteral("kernel B30f"), QStringLiteral("kernel B70f")}, 6));
  row("c62-two-blocks",
      {QStringLiteral("8x8x6 1,1,4 @0,0,0: 0,1,2,3,4,5"),
       QStringLiteral("8x8x6 1,1,4 @0,40,24: 100,101,102,103,104,105")},
      "lie along 2 lines, up to 40 mm", "tilt");
  row("c62b-jitter", {QStringLiteral("8x8x10 1,1,1 @0,0,0: 0,1,2,3,4,5,6,7,8,9")}, "0.4 mm beside it",
      "tilt");
  row("c09-cine-trigger-times", {QStringLiteral("8x8x3 1,1,8 @0,0,0: 0,1,2; trigger 1 of 4"),
                                 QStringLiteral("8x8x3 1,1,8 @0,0,0: 100,101,102; trigger 2 of 4"),
                                 QStringLiteral("8x8x3 1,1,8 @0,0,0: 200,201,202; trigger 3 of 4"),
                                 QStringLiteral("8x8x3 1,1,8 @0,0,0: 300,301,302; trigger 4 of 4")});
}

void TestSeriesCases::picturesThatBelongTogether() {
  QFETCH(QString, folder);
  QFETCH(QStringList, volumes);
  QFETCH(QString, told);
  QFETCH(QString, notTold);
  const std::string path = dataPath("field-cases/" + folder.toStdString());
  NEED_DATA(path);
  const auto study = openStudy(path);
  QVERIFY(study.ok());
  QStringList found;
  for (const Series& s : study->volumes) {
    found << summaryOf(s);
    QVERIFY2(told.isEmpty() || warns(s.warnings, told.toStdString()),
             s.warnings.empty() ? "no warning" : s.warnings[0].sentence.c_str());
    QVERIFY(!warns(s.warnings, notTold.toStdString()));
  }
  QCOMPARE(found, volumes);
}

VOLUMEN_TEST(TestSeriesCases);
#include "tst_series_cases.moc"
