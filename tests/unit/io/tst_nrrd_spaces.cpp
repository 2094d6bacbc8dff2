// Guards import.md: the grid of an NRRD in a space that is a mirror image.
#include <QFile>
#include <QTemporaryDir>
#include <glm/geometric.hpp>

#include "io/open.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestNrrdSpaces : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void leftHandedSpacesAreTurnedRound_data();
  void leftHandedSpacesAreTurnedRound();
};

void TestNrrdSpaces::leftHandedSpacesAreTurnedRound_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<double>("third");   // third component of the step along k
  QTest::addColumn<double>("origin");  // third component of the origin
  const QByteArray directions = "space directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (0,0,5)\n";
  QTest::newRow("left-handed, spacings")
      << QByteArray("space: 3D-left-handed\nspacings: 1 1 2\n") << -2.0 << 0.0;
  QTest::newRow("left-handed, directions")
      << QByteArray("space: 3D-left-handed\n") + directions << -2.0 << -5.0;
  QTest::newRow("right-handed, spacings")
      << QByteArray("space: 3D-right-handed\nspacings: 1 1 2\n") << 2.0 << 0.0;
  QTest::newRow("right-handed, directions")
      << QByteArray("space: 3D-right-handed\n") + directions << 2.0 << 5.0;
}

void TestNrrdSpaces::leftHandedSpacesAreTurnedRound() {
  QFETCH(QByteArray, fields);
  QFETCH(double, third);
  QFETCH(double, origin);
  const QTemporaryDir folder;
  QFile file(folder.filePath(QStringLiteral("a.nrrd")));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n" + fields + "\n12345678");
  file.close();
  const auto study = openStudy(file.fileName().toStdString());
  QVERIFY(study.ok() && study->volumes.size() == 1);
  const Series& series = study->volumes[0];
  QCOMPARE(series.acquired.patientFromVoxelStep[2], glm::dvec3(0, 0, third));
  QCOMPARE(series.acquired.origin.z, origin);
  QCOMPARE(warns(series.warnings, "space is left-handed"), third < 0);
}

VOLUMEN_TEST(TestNrrdSpaces);
#include "tst_nrrd_spaces.moc"
