// Guards the rigid registration: the motion of a moved head is found, also with another contrast. Volumes
// that cannot be registered give a sentence.
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <thread>

#include "tests/unit/suite.h"
#include "viewer/register/rigid_registration.h"

using namespace volumen;

namespace {

VolumePtr made(VolumeParts parts) {
  std::vector<std::string> warnings;
  const auto volume = Volume::make(std::move(parts), warnings);
  if (!volume) qFatal("%s", volume.message().c_str());
  return *volume;
}

// Three balls of different size and value lie in a larger one, so that nothing is symmetric.
double headAt(glm::dvec3 p) {
  const auto within = [&](glm::dvec3 centre, glm::dvec3 radius) {
    return std::clamp(3 * (1 - glm::length((p - centre) / radius)) + 0.5, 0.0, 1.0);
  };
  return 1000 * within({0, 0, 0}, {70, 85, 75}) - 400 * within({0, 4, 0}, {60, 74, 66}) +
         300 * within({25, 20, 10}, {18, 12, 14}) - 350 * within({-20, -25, -12}, {14, 20, 11}) +
         500 * within({5, -35, 30}, {10, 9, 16});
}

// Returns the value that another modality would show at the same place.
double otherContrast(double value) { return 800 * std::abs(std::sin(value / 260)) + value / 9; }

constexpr int n = 72;
constexpr double step = 2.6;  // mm

VolumePtr head(const Rigid& headFromPatient, bool other, glm::dvec3 spacing = glm::dvec3(step)) {
  VolumeParts parts;
  for (int axis = 0; axis < 3; ++axis) {
    parts.geometry.size[axis] = int(n * step / spacing[axis]);
    parts.geometry.patientFromVoxelStep[axis] *= spacing[axis];
  }
  parts.geometry.origin = -0.5 * glm::dvec3(parts.geometry.size - 1) * spacing;
  std::vector<std::int16_t> values;
  const glm::ivec3 size = parts.geometry.size;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double value = headAt(headFromPatient(parts.geometry.patientFromVoxel({i, j, k})));
        values.push_back(std::int16_t(std::lround(other ? otherContrast(value) : value)));
      }
  parts.values = std::move(values);
  return made(std::move(parts));
}

Rigid motion(double degrees, glm::dvec3 axis, glm::dvec3 mm) {
  return {glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::normalize(axis))), mm};
}

double degreesBetween(const glm::dmat3& a, const glm::dmat3& b) {
  const glm::dmat3 c = glm::transpose(a) * b;
  return glm::degrees(std::acos(std::clamp((c[0][0] + c[1][1] + c[2][2] - 1) / 2, -1.0, 1.0)));
}

VolumePtr flat(glm::ivec3 size, float value) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.values = std::vector<float>(std::size_t(parts.geometry.voxelCount()), value);
  return made(std::move(parts));
}

}  // namespace

class TestRigidRegistration : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void findsAKnownMotion_data();
  void findsAKnownMotion();
  void isTheSameOnEveryRun();
  void whatCannotBeRegisteredIsASentence_data();
  void whatCannotBeRegisteredIsASentence();
  void valuesThatAreNoNumbersDoNotEndIt();
  void isCancelled();
};

void TestRigidRegistration::findsAKnownMotion_data() {
  QTest::addColumn<double>("degrees");
  QTest::addColumn<double>("mm");
  QTest::addColumn<bool>("other");
  QTest::addColumn<double>("thick");
  QTest::newRow("at rest") << 0.0 << 0.0 << false << step;
  QTest::newRow("10 degrees and 12 mm") << 10.0 << 12.0 << false << step;
  QTest::newRow("another contrast") << 8.0 << 9.0 << true << step;
  QTest::newRow("another contrast, slices of 5 mm") << -7.0 << 10.0 << true << 5.0;
  QTest::newRow("a place far away") << 5.0 << 400.0 << false << step;
}

void TestRigidRegistration::findsAKnownMotion() {
  QFETCH(double, degrees);
  QFETCH(double, mm);
  QFETCH(bool, other);
  QFETCH(double, thick);
  const Rigid truth = motion(degrees, {1, 2, -1.5}, glm::normalize(glm::dvec3(2, -1, 1)) * mm);
  VolumePtr moved;
  if (mm < 100) {
    moved = head(truth.inverse(), other, {step, step, thick});
  } else {
    // Large translations are in the origin of the moved volume.
    VolumeParts parts;
    const VolumePtr turned = head(Rigid{truth.rotation, {0, 0, 0}}.inverse(), other);
    parts.geometry = turned->geometry();
    parts.geometry.origin += truth.translation;
    parts.values = turned->stored();
    moved = made(std::move(parts));
  }
  const VolumePtr still = head({}, false);
  const Result<Rigid> found = registerRigidly(*still, *moved);
  QVERIFY2(found, found ? "" : found.message().c_str());
  const double off = degreesBetween(found->rotation, truth.rotation);
  QVERIFY2(off < 1, qPrintable(QString::number(off)));
  for (const glm::dvec3 p :
       {glm::dvec3(0), glm::dvec3(70, 0, 0), glm::dvec3(0, 85, 0), glm::dvec3(0, 0, 75)}) {
    const double error = glm::length((*found)(p)-truth(p));
    QVERIFY2(error < 1, qPrintable(QString::number(error)));
  }
}

void TestRigidRegistration::isTheSameOnEveryRun() {
  const VolumePtr still = head({}, false), moved = head(motion(6, {0, 1, 1}, {4, 3, -5}), true);
  const Result<Rigid> first = registerRigidly(*still, *moved), second = registerRigidly(*still, *moved);
  QVERIFY(first && second);
  QVERIFY(*first == *second);
}

void TestRigidRegistration::whatCannotBeRegisteredIsASentence_data() {
  QTest::addColumn<VolumePtr>("fixed");
  QTest::addColumn<VolumePtr>("moving");
  QTest::addColumn<QString>("sentence");
  const VolumePtr good = head({}, false);
  VolumeParts nowhere{good->geometry(), good->stored(), 1, 0, {}};
  nowhere.geometry.calibrated = false;
  QTest::newRow("constant") << good << flat({64, 64, 64}, 7)
                            << QStringLiteral(
                                   "Cannot register: the second series has the same value everywhere.");
  QTest::newRow("all zero, first") << flat({64, 64, 64}, 0) << good
                                   << QStringLiteral("the first series has the same value everywhere.");
  QTest::newRow("one voxel") << good << flat({1, 1, 1}, 7)
                             << QStringLiteral("the second series is too small");
  QTest::newRow("one slice") << flat({64, 64, 1}, 7) << good
                             << QStringLiteral("the first series is too small");
  QTest::newRow("not calibrated") << good << made(std::move(nowhere)) << QStringLiteral("is not calibrated");
}

void TestRigidRegistration::whatCannotBeRegisteredIsASentence() {
  QFETCH(VolumePtr, fixed);
  QFETCH(VolumePtr, moving);
  QFETCH(QString, sentence);
  const Result<Rigid> found = registerRigidly(*fixed, *moving);
  QVERIFY(!found);
  QVERIFY2(QString::fromStdString(found.message()).contains(sentence), found.message().c_str());
}

void TestRigidRegistration::valuesThatAreNoNumbersDoNotEndIt() {
  const VolumePtr good = head({}, false);
  std::vector<float> values(std::size_t(good->geometry().voxelCount()));
  for (std::size_t at = 0; at < values.size(); ++at)
    values[at] = at % 97 == 0   ? std::numeric_limits<float>::quiet_NaN()
                 : at % 89 == 0 ? std::numeric_limits<float>::infinity()
                                : good->valueAt(at);
  const VolumePtr holed = made({good->geometry(), std::move(values), 1, 0, {}});
  const Result<Rigid> found = registerRigidly(*good, *holed);
  QVERIFY2(!found || std::isfinite(glm::length(found->translation)), "a motion or a sentence");
  const std::size_t count = std::size_t(good->geometry().voxelCount());
  const std::vector<float> none(count, std::numeric_limits<float>::quiet_NaN());
  QVERIFY(!registerRigidly(*good, *made({good->geometry(), none, 1, 0, {}})));
}

void TestRigidRegistration::isCancelled() {
  const VolumePtr still = head({}, false), moved = head(motion(9, {0, 1, 1}, {4, 3, -5}), true);
  const CancelToken atOnce;
  atOnce.cancel();
  QVERIFY(!registerRigidly(*still, *moved, atOnce));
  const CancelToken midway;
  std::thread hand([&] {
    while (midway.done() == 0) std::this_thread::yield();
    midway.cancel();
  });
  const Result<Rigid> found = registerRigidly(*still, *moved, midway);
  hand.join();
  QVERIFY(!found);
  QCOMPARE(found.message(), std::string("Registration cancelled."));
  QVERIFY2(midway.done() < 0.5, "it goes no further");
}

VOLUMEN_TEST(TestRigidRegistration);
#include "tst_rigid_registration.moc"
