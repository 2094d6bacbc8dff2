// Guards import.md: projections of one series from different sides are series of their own, and a view that
// is given by a code is read.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <set>

#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A mammogram without a place; `view`: a word, or a code where it has a digit.
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
  void sidesAndViewsAreSeries();
  void alikeOnesAreOneSeries();
  void codesAreRead_data();
  void codesAreRead();
};

void TestProjectionViews::sidesAndViewsAreSeries() {
  const DicomFolder folder;
  folder.add("a", mammogram(1, "R", "CC"));
  folder.add("b", mammogram(2, "L", "CC"));
  folder.add("c", mammogram(3, "R", "MLO"));
  folder.add("d", mammogram(4, "L", "MLO"));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(4));
  QStringList found;
  std::set<std::string> ids;
  for (const Series& series : study.volumes) {
    found << QString::fromStdString(series.laterality + " " + series.viewPosition);
    QCOMPARE(series.files.size(), std::size_t(1));
    QVERIFY(ids.insert(series.id).second);
  }
  found.sort();
  const QStringList expected{QStringLiteral("L CC"), QStringLiteral("L MLO"), QStringLiteral("R CC"),
                             QStringLiteral("R MLO")};
  QCOMPARE(found, expected);
}

void TestProjectionViews::alikeOnesAreOneSeries() {
  const DicomFolder folder;
  for (int n = 1; n <= 3; ++n) folder.add(numbered("m", n), mammogram(n, "R", "CC"));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].files.size(), std::size_t(3));
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
