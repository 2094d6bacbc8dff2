// Guards picture.md 1, 2 and design.md 10 (values).
#include <glm/geometric.hpp>
#include <limits>

#include "tests/unit/suite.h"
#include "viewer/volume/volume.h"

using namespace volumen;

class TestVolume : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void voxelAndPatientSpaceAreInverse_data();
  void voxelAndPatientSpaceAreInverse();
  void badPartsAreRefusedInASentence_data();
  void badPartsAreRefusedInASentence();
  void nonFiniteValuesAreReplacedAndReported();
  void valuesTooSmallBesideTheLargestAreZero();
  void valuesAreRoundedOnce();
};

void TestVolume::voxelAndPatientSpaceAreInverse_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("anisotropic") << 0;
  QTest::newRow("oblique") << 1;
  QTest::newRow("sheared") << 2;
  QTest::newRow("left-handed") << 3;
}

void TestVolume::voxelAndPatientSpaceAreInverse() {
  QFETCH(int, kind);
  const glm::dmat3 steps[] = {
      {{0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 2.5}},
      {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 2}},
      {{1, 0, 0}, {0, 1, 0}, {0, 0.5, 2}},
      {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
  };
  VoxelGeometry g{.size = {4, 5, 6}, .patientFromVoxelStep = steps[kind], .origin = {10, -20, 1e5}};
  const glm::dvec3 x(1.25, 3.5, 4.75);
  QVERIFY(glm::length(g.voxelFromPatient(g.patientFromVoxel(x)) - x) < 1e-9);
  const glm::dvec3 gradient(1, 2, 3), move(0.1, -0.2, 0.3);
  const double alongVoxels = glm::dot(gradient, move);
  const double alongPatient =
      glm::dot(g.patientFromVoxelGradient() * gradient, g.patientFromVoxelStep * move);
  QVERIFY(std::abs(alongVoxels - alongPatient) < 1e-12);
}

void TestVolume::badPartsAreRefusedInASentence_data() {
  QTest::addColumn<QString>("what");
  for (const char* what : {"short data", "NaN spacing", "flat axes", "slope 0", "no voxels"})
    QTest::newRow(what) << QString::fromLatin1(what);
}

void TestVolume::badPartsAreRefusedInASentence() {
  QFETCH(QString, what);
  VolumeParts parts;
  parts.geometry.size = {2, 2, 2};
  parts.values = std::vector<std::int16_t>(8);
  if (what == QLatin1String("short data")) parts.values = std::vector<std::int16_t>(7);
  if (what == QLatin1String("NaN spacing"))
    parts.geometry.patientFromVoxelStep[1][1] = std::numeric_limits<double>::quiet_NaN();
  if (what == QLatin1String("flat axes"))
    parts.geometry.patientFromVoxelStep[2] = parts.geometry.patientFromVoxelStep[1];
  if (what == QLatin1String("slope 0")) parts.slope = 0;
  if (what == QLatin1String("no voxels")) parts.geometry.size.z = 0;
  std::vector<std::string> warnings;
  const auto made = Volume::make(parts, warnings);
  QVERIFY(!made.ok());
  QVERIFY(made.message().ends_with("."));
}

void TestVolume::nonFiniteValuesAreReplacedAndReported() {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  VolumeParts parts;
  parts.geometry.size = {6, 1, 1};
  parts.values = std::vector<float>{nan, -inf, inf, -3, 7, 5};
  std::vector<std::string> warnings;
  const auto v = Volume::make(parts, warnings);
  QVERIFY(v.ok());
  QCOMPARE(std::get<std::vector<float>>((*v)->stored()), (std::vector<float>{-3, -3, 7, -3, 7, 5}));
  QCOMPARE(warnings.size(), std::size_t(1));
}

void TestVolume::valuesTooSmallBesideTheLargestAreZero() {
  VolumeParts parts;
  parts.geometry.size = {4, 1, 1};
  parts.values = std::vector<float>{-1e29f, 1e-39f, 1e-3f, 0};
  std::vector<std::string> warnings;
  const auto v = Volume::make(parts, warnings);
  QVERIFY(v.ok());
  QCOMPARE(std::get<std::vector<float>>((*v)->stored()), (std::vector<float>{-1e29f, 0, 1e-3f, 0}));
  QCOMPARE(warnings.size(), std::size_t(1));
  // Small values remain if all values are small.
  parts.values = std::vector<float>{1e-39f, 0, 2e-39f, 1e-44f};
  QCOMPARE(std::get<std::vector<float>>((*Volume::make(parts, warnings))->stored())[3], 1e-44f);
}

void TestVolume::valuesAreRoundedOnce() {
  VolumeParts parts;
  parts.geometry.size = {1, 1, 1};
  parts.values = std::vector<std::int16_t>{1001};
  parts.slope = 2.022;
  parts.intercept = -0.1;
  std::vector<std::string> warnings;
  const auto v = Volume::make(parts, warnings);
  QCOMPARE((*v)->valueAt(0), float(2.022 * 1001 - 0.1));
}

VOLUMEN_TEST(TestVolume);
#include "tst_volume.moc"
