// Guards import.md: diffusion weights and directions in private attributes of GE, which are relative to the
// picture.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <glm/geometric.hpp>

#include "io/dicom/diffusion.h"
#include "io/dicom/header.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDiffusion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void directionsOfGe_data();
  void directionsOfGe();
  void weightsOfGe_data();
  void weightsOfGe();
};

namespace {

void text(DcmItem& d, const DcmTag& tag, const char* value) { d.putAndInsertString(tag, value); }

/// Writes a picture with these values of GE and returns what was found in it.
dicom::InspectedFile found(const DicomFolder& folder, const char* orientation, const char* phase,
                           const char* weight, const std::array<const char*, 3>& direction, double b = -1) {
  DicomPicture picture;
  picture.orientation = orientation;
  picture.edit = [&](DcmDataset& d) {
    text(d, DCM_Modality, "MR");
    text(d, DCM_InPlanePhaseEncodingDirection, phase);
    text(d, DcmTag(0x0043, 0x0010, EVR_LO), "GEMS_PARM_01");
    text(d, DcmTag(0x0043, 0x1039, EVR_IS), weight);
    text(d, DcmTag(0x0019, 0x0010, EVR_LO), "GEMS_ACQU_01");
    for (std::size_t axis = 0; axis < 3; ++axis)
      text(d, DcmTag(0x0019, Uint16(0x10bb + axis), EVR_DS), direction[axis]);
    if (b >= 0) d.putAndInsertFloat64(DCM_DiffusionBValue, b);
  };
  folder.add("a", picture);
  return dicom::inspectFile(folder.path("a"));
}

}  // namespace

// A gradient (x, y, z) is x along rows, y along columns, and z against their cross product where the phase is
// encoded along columns; along rows it is y, -x, z.
void TestDiffusion::directionsOfGe_data() {
  QTest::addColumn<QByteArray>("orientation");
  QTest::addColumn<QByteArray>("phase");
  QTest::addColumn<QList<double>>("patient");  // of (0.36, 0.48, 0.8)
  const auto row = [](const char* name, const char* orientation, const char* phase, QList<double> patient) {
    QTest::newRow(name) << QByteArray(orientation) << QByteArray(phase) << patient;
  };
  row("axial", "1\\0\\0\\0\\1\\0", "COL", {0.36, 0.48, -0.8});
  row("axial, phase along rows", "1\\0\\0\\0\\1\\0", "ROW", {0.48, -0.36, -0.8});
  row("sagittal", "0\\1\\0\\0\\0\\-1", "COL", {0.8, 0.36, -0.48});
  row("coronal", "1\\0\\0\\0\\0\\-1", "COL", {0.36, -0.8, -0.48});
  row("turned about z", "0.8\\0.6\\0\\-0.6\\0.8\\0", "COL",
      {0.36 * 0.8 - 0.48 * 0.6, 0.36 * 0.6 + 0.48 * 0.8, -0.8});
}

void TestDiffusion::directionsOfGe() {
  QFETCH(QByteArray, orientation);
  QFETCH(QByteArray, phase);
  QFETCH(QList<double>, patient);
  const DicomFolder folder;
  const auto file =
      found(folder, orientation.constData(), phase.constData(), "1000\\8\\0\\0", {"0.36", "0.48", "0.8"});
  const dicom::DataSet data(file.scanned.head, file.scanned.dataSet.elements);
  const std::vector<double> direction = dicom::privateDirection(data);
  QCOMPARE(direction.size(), std::size_t(3));
  for (int axis = 0; axis < 3; ++axis)
    QVERIFY(std::abs(direction[std::size_t(axis)] - patient[axis]) < 1e-12);
}

void TestDiffusion::weightsOfGe_data() {
  QTest::addColumn<QByteArray>("weight");
  QTest::addColumn<double>("b");       // DiffusionBValue; -1: missing
  QTest::addColumn<double>("length");  // of the direction
  QTest::addColumn<QByteArray>("bValue");
  const auto row = [](const char* name, const char* weight, double length, const char* bValue,
                      double b = -1) {
    QTest::newRow(name) << QByteArray(weight) << b << length << QByteArray(bValue);
  };
  row("as it is", "1000\\8\\0\\0", 1, "1000");
  row("with its offset", "1000001000\\8\\0\\0", 1, "1000");
  row("with its offset, and a short direction", "1000001000\\8\\0\\0", 0.5, "1000");
  row("a shell of a third", "3000\\8\\0\\0", 0.57735, "1000");
  row("a shell, nominal in DICOM too", "3000\\8\\0\\0", 0.57735, "1000", 3000);
  row("a shell that DICOM knows", "3000\\8\\0\\0", 0.57735, "1001", 1001);
  row("none", "0\\8\\0\\0", 0, "0");
}

void TestDiffusion::weightsOfGe() {
  QFETCH(QByteArray, weight);
  QFETCH(double, b);
  QFETCH(double, length);
  QFETCH(QByteArray, bValue);
  const DicomFolder folder;
  const auto file = found(folder, "1\\0\\0\\0\\1\\0", "COL", weight.constData(),
                          {"0", QByteArray::number(length).constData(), "0"}, b);
  QCOMPARE(QByteArray::fromStdString(file.found.header.slices.at(0).bValue), bValue);
  const dicom::DataSet data(file.scanned.head, file.scanned.dataSet.elements);
  QCOMPARE(dicom::privateDirection(data).empty(), length == 0);
}

VOLUMEN_TEST(TestDiffusion);
#include "tst_diffusion.moc"
