// Guards import.md and slices.md on ../shared/data/field-cases-2 (its CASES.tsv says why).
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/series_summary.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFieldCases2 : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesThatBelongTogether_data();
  void picturesThatBelongTogether();
};

namespace {

/// The study of a case, by its folder or file; an empty one where it cannot be opened.
Study openCase(const QString& name) {
  const Result<Study> study = openStudy(dataPath("field-cases-2/" + name.toStdString()));
  return study ? *study : Study{};
}

}  // namespace

void TestFieldCases2::picturesThatBelongTogether_data() {
  QTest::addColumn<QStringList>("volumes");
  const auto row = [](const char* folder, const QStringList& volumes) { QTest::newRow(folder) << volumes; };
  const QString tenSlices = QStringLiteral("8x8x10 1,1,3 @0,0,0: 0,1,2,3,4,5,6,7,8,9");
  row("lo01d-localizer-on-the-line", {tenSlices, QStringLiteral("8x8x1 1,1,3 @0,0,30: 900; LOCALIZER")});
  row("lo01e-localizer-at-a-slice", {tenSlices, QStringLiteral("8x8x1 1,1,3 @0,0,12: 900; LOCALIZER")});
  row("mf16d-complex-component", {QStringLiteral("8x8x4 1,1,2 @0,0,0: 0,1,2,3; MAGNITUDE"),
                                  QStringLiteral("8x8x4 1,1,2 @0,0,0: 100,101,102,103; PHASE")});
  row("mx01b-two-thicknesses",
      {QStringLiteral("8x8x6 1,1,5 @0,0,0: 0,1,2,3,4,5; slice thickness 5 mm"),
       QStringLiteral("8x8x6 1,1,5 @0,0,2.5: 500,501,502,503,504,505; slice thickness 1 mm")});
  row("mx02c-before-and-after-contrast",
      {QStringLiteral("8x8x6 1,1,5 @0,0,0: 0,1,2,3,4,5; contrast not given"),
       QStringLiteral("8x8x6 1,1,5 @0,0,2.5: 500,501,502,503,504,505; contrast AGENT")});
  row("mx03-kernels-at-the-same-places",
      {QStringLiteral("8x8x6 1,1,5 @0,0,0: 0,1,2,3,4,5; kernel B30f"),
       QStringLiteral("8x8x6 1,1,5 @0,0,0: 500,501,502,503,504,505; kernel B70f")});
}

void TestFieldCases2::picturesThatBelongTogether() {
  NEED_DATA(dataPath());
  QFETCH(QStringList, volumes);
  QStringList found;
  for (const Series& s : openCase(QString::fromUtf8(QTest::currentDataTag())).volumes) found << summaryOf(s);
  QCOMPARE(found, volumes);
}

VOLUMEN_TEST(TestFieldCases2);
#include "tst_field_cases_2.moc"
