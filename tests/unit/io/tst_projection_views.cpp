// Guards import.md: projections of one series form one stack, whatever their sides, which names side and view
// of each. A coded view is read.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a mammogram without a position. `view` is a word, or a code if it has a digit.
DicomPicture mammogram(int instance, const char* side, const char* view) {
  DicomPicture p;
  p.instance = instance;
  p.orientation = "";
  p.spacing = "";
  p.pixels = {std::uint16_t(instance)};
  p.edit = [=](DcmDataset& d) {
    d.findAndDeleteElement(DCM_ImagePositionPatient);
    d.putAndInsertString(DCM_Modality, "MG");
    d.putAndInsertString(DCM_ImageLaterality, side);
    const std::string text = view;
    if (text.find_first_of("0123456789") == std::string::npos) {
      d.putAndInsertString(DCM_ViewPosition, view);
    } else {
      DcmItem* item = nullptr;
      d.findOrCreateSequenceItem(DCM_ViewCodeSequence, item);
      item->putAndInsertString(DCM_CodeValue, view);
    }
  };
  return p;
}

}  // namespace

class TestProjectionViews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void sidesAndViewsAreOneStack();
  void whatAllShareIsOfTheSeries();
  void alikeOnesSayItOnce();
  void codesAreRead_data();
  void codesAreRead();
};

void TestProjectionViews::sidesAndViewsAreOneStack() {
  const DicomFolder folder;
  folder.add("a", mammogram(1, "R", "CC"));
  folder.add("b", mammogram(2, "L", "CC"));
  folder.add("c", mammogram(3, "R", "399368009"));
  folder.add("d", mammogram(4, "L", "MLO"));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.files.size(), std::size_t(4));
  QVERIFY(series.id.find('#') == std::string::npos);
  const ProjectionView expected[] = {{"R", "CC"}, {"L", "CC"}, {"R", "MLO"}, {"L", "MLO"}};
  QCOMPARE(series.projections.size(), std::size_t(4));
  for (int n = 0; n < 4; ++n) QVERIFY(projectionOf(series, n) == expected[n]);
  QVERIFY2(series.laterality.empty() && series.viewPosition.empty(), "they differ");
  QVERIFY(projectionOf(series, 4) == ProjectionView());
}

void TestProjectionViews::whatAllShareIsOfTheSeries() {
  const DicomFolder folder;
  folder.add("a", mammogram(1, "R", "CC"));
  folder.add("b", mammogram(2, "R", "MLO"));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].laterality, std::string("R"));
  QVERIFY(study.volumes[0].viewPosition.empty());
  QVERIFY(projectionOf(study.volumes[0], -1) == (ProjectionView{"R", ""}));
}

void TestProjectionViews::alikeOnesSayItOnce() {
  const DicomFolder folder;
  for (int n = 1; n <= 3; ++n) folder.add(numbered("m", n), mammogram(n, "R", "CC"));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].files.size(), std::size_t(3));
  QVERIFY(study.volumes[0].projections.empty());
  QVERIFY(projectionOf(study.volumes[0], 2) == (ProjectionView{"R", "CC"}));
}

void TestProjectionViews::codesAreRead_data() {
  QTest::addColumn<QByteArray>("code");
  QTest::addColumn<QString>("view");
  QTest::newRow("SNOMED CT, cranio-caudal") << QByteArray("399162004") << QStringLiteral("CC");
  QTest::newRow("SNOMED CT, oblique") << QByteArray("399368009") << QStringLiteral("MLO");
  QTest::newRow("SNOMED RT, cranio-caudal") << QByteArray("R-10242") << QStringLiteral("CC");
  QTest::newRow("SNOMED RT, oblique") << QByteArray("R-10226") << QStringLiteral("MLO");
  QTest::newRow("another") << QByteArray("R-99999") << QString();
}

void TestProjectionViews::codesAreRead() {
  QFETCH(QByteArray, code);
  QFETCH(QString, view);
  const DicomFolder folder;
  folder.add("a", mammogram(1, "R", code.constData()));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(QString::fromStdString(study.volumes[0].viewPosition), view);
}

VOLUMEN_TEST(TestProjectionViews);
#include "tst_projection_views.moc"
