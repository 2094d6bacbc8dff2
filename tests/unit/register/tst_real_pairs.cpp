// Guards the rigid registration on real pictures: a matching pair, one of them moved by a known motion, is
// aligned again. The result is printed. The data hold no CT and MR of one patient.
#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "io/load.h"
#include "io/open.h"
#include "io/study/choose.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/suite.h"
#include "viewer/register/rigid_registration.h"

using namespace volumen;
using namespace volumen::tests;

class TestRealPairs : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyAreBroughtTogether_data();
  void theyAreBroughtTogether();
};

namespace {

VolumePtr loaded(const std::string& path) {
  const auto study = openStudy(path);
  if (!study) return nullptr;
  const auto chosen = chooseSeries(*study, {});
  if (!chosen) return nullptr;
  const auto volume = loadSeries(study->volumes[*chosen]);
  return volume ? volume->drawn : nullptr;
}

// Returns the same volume at another position in patient space.
VolumePtr movedBy(const Volume& volume, const Rigid& motion) {
  VolumeParts parts{volume.geometry(), volume.stored(), volume.slope(), volume.intercept(),
                    volume.attributes()};
  parts.geometry.origin = motion(parts.geometry.origin);
  parts.geometry.patientFromVoxelStep = motion.rotation * parts.geometry.patientFromVoxelStep;
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

}  // namespace

void TestRealPairs::theyAreBroughtTogether_data() {
  QTest::addColumn<QString>("fixed");
  QTest::addColumn<QString>("moving");
  QTest::addColumn<double>("within");  // mm, at the points below
  const auto row = [](const char* name, const char* fixed, const char* moving, double within) {
    QTest::newRow(name) << QString::fromLatin1(fixed) << QString::fromLatin1(moving) << within;
  };
  row("MR of a head and itself", "mr-head-siemens-gap-175", "mr-head-siemens-gap-175", 0.5);
  row("CT and PET of one patient", "pet-ct/sts019-ct", "pet-ct/sts019-pet", 8);
}

void TestRealPairs::theyAreBroughtTogether() {
  QFETCH(QString, fixed);
  QFETCH(QString, moving);
  QFETCH(double, within);
  NEED_DATA(dataPath(fixed.toStdString()));
  NEED_DATA(dataPath(moving.toStdString()));
  const VolumePtr still = loaded(dataPath(fixed.toStdString())),
                  other = loaded(dataPath(moving.toStdString()));
  QVERIFY(still && other);
  // Rotates about the centre of the fixed volume, so that both overlap.
  const glm::dvec3 middle = still->geometry().centre();
  const glm::dmat3 turn(
      glm::rotate(glm::dmat4(1), glm::radians(5.0), glm::normalize(glm::dvec3(1, 2, -1.5))));
  const Rigid truth{turn, middle - turn * middle + glm::dvec3(7, -5, 6)};
  const Result<Rigid> found = registerRigidly(*still, *movedBy(*other, truth));
  QVERIFY2(found, found ? "" : found.message().c_str());
  double before = 0, after = 0;
  for (const glm::dvec3 d :
       {glm::dvec3(0), glm::dvec3(60, 0, 0), glm::dvec3(0, 60, 0), glm::dvec3(0, 0, 60)}) {
    const glm::dvec3 p = middle + d;
    before = std::max(before, glm::length(p - truth(p)));
    after = std::max(after, glm::length((*found)(p)-truth(p)));
  }
  qInfo("%s: %.1f mm apart at most before, %.2f mm after", QTest::currentDataTag(), before, after);
  QVERIFY2(after < before, qPrintable(QString::number(after)));
  QEXPECT_FAIL("CT and PET of one patient",
               "8.8 mm: mutual information is larger there (0.512) than where they belong (0.454)", Abort);
  QVERIFY2(after < within, qPrintable(QString::number(after)));
}

VOLUMEN_TEST(TestRealPairs);
#include "tst_real_pairs.moc"
