// Guards de-facing: nose, ears and all air in front of the face go, brain and the back of the head stay,
// however head and grid lie; what is no head is refused.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <functional>
#include <glm/vec2.hpp>
#include <string>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/made_head.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/face.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Scan {
  MadeHead head{};
  glm::dmat3 step{4};
  std::string modality = "MR";
  double lowest = -180, highest = 110;  // mm of the volume along the patient
  bool hasTable = false;
};

glm::dmat3 turned(int axis, double degrees) {
  const double angle = degrees * glm::pi<double>() / 180;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  glm::dmat3 turn(1);
  turn[a][a] = turn[b][b] = std::cos(angle);
  turn[a][b] = std::sin(angle), turn[b][a] = -std::sin(angle);
  return turn;
}

// Values of MR, or HU.
double valueOf(HeadPart part, const std::string& modality) {
  const bool isCt = modality == "CT";
  switch (part) {
    case HeadPart::air:
      return isCt ? -1000 : 8;
    case HeadPart::brain:
      return isCt ? 35 : 500;
    case HeadPart::flesh:
      return isCt ? 60 : 150;
    case HeadPart::nose:
    case HeadPart::ear:
      return isCt ? -50 : 300;
  }
  return 0;
}

// Covers the head and air around it, from the lowest to the highest place.
VoxelGeometry gridOf(const Scan& scan) {
  const glm::dvec3 low(-125, -155, scan.lowest), high(125, 125, scan.highest);
  VoxelGeometry grid;
  grid.patientFromVoxelStep = scan.step;
  const glm::dmat3 inverse = grid.voxelFromPatientStep();
  glm::dvec3 first(1e9), last(-1e9);
  for (int n = 0; n < 8; ++n) {
    const glm::dvec3 corner(n & 1 ? high.x : low.x, n & 2 ? high.y : low.y, n & 4 ? high.z : low.z);
    first = min(first, inverse * corner), last = max(last, inverse * corner);
  }
  grid.size = glm::ivec3(ceil(last - first));
  grid.origin = scan.step * first;
  return grid;
}

HeadPart partAt(const Scan& scan, glm::dvec3 pPatient) { return scan.head.at(pPatient); }

VolumePtr volumeOf(const Scan& scan) {
  VolumeParts parts;
  parts.geometry = gridOf(scan);
  parts.attributes.name = "made head";
  parts.attributes.modality = scan.modality;
  std::vector<std::int16_t> values;
  for (const glm::ivec3 voxel : voxelsOf(parts.geometry)) {
    const glm::dvec3 p = parts.geometry.patientFromVoxel(voxel);
    const bool isTable = scan.hasTable && p.y > 97 && p.y < 100;
    values.push_back(std::int16_t(isTable ? 100 : valueOf(partAt(scan, p), scan.modality)));
  }
  parts.values = std::move(values);
  return volumeFrom(std::move(parts));
}

// Returns what is wrong with the face found in a scan; empty if nothing is.
std::string problemOf(const Scan& scan) {
  const VolumePtr volume = volumeOf(scan);
  const auto face = faceOf(*volume);
  if (!face) return face.message();
  const VoxelGeometry& grid = volume->geometry();
  const glm::dvec3 air = scan.head.inPatient(MadeHead::tipOfNose - glm::dvec3(0, 15, 0));
  bool isAirGone = false;
  int noses = 0, ears = 0, earsLeft = 0;
  for (const glm::ivec3 voxel : voxelsOf(grid)) {
    const glm::dvec3 p = grid.patientFromVoxel(voxel);
    const bool isGone = face->at(voxel);
    const HeadPart part = partAt(scan, p);
    const std::string place =
        " at " + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z);
    if (part == HeadPart::brain && isGone) return "brain is taken" + place;
    if (part == HeadPart::nose && ++noses && !isGone) return "nose is left" + place;
    if (part == HeadPart::ear) ++ears, earsLeft += !isGone;
    const glm::dvec3 upright = glm::transpose(scan.head.turn) * p;
    if (isGone && part == HeadPart::flesh && upright.y > 60 * scan.head.scale &&
        upright.z > -40 * scan.head.scale)
      return "the back of the head is taken" + place;
    if (glm::length(p - air) <= 6) isAirGone = isAirGone || isGone;
  }
  if (earsLeft * 2 > ears)
    return std::to_string(earsLeft) + " of " + std::to_string(ears) + " voxels of ears are left";
  if (noses == 0) return "the scan shows no nose";
  return isAirGone ? "" : "air in front of the nose is left";
}

}  // namespace

class TestFace : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void noseGoesAndBrainStays_data();
  void noseGoesAndBrainStays();
  void inRandomScans();
  void aForeheadAloneKeepsItsBrain();
  void allElseStays();
  void whatIsNoHeadIsRefused_data();
  void whatIsNoHeadIsRefused();
  void cancelledFindsNothing();
};

void TestFace::noseGoesAndBrainStays_data() {
  QTest::addColumn<Scan>("scan");
  QTest::newRow("upright") << Scan{};
  QTest::newRow("chin up by 20 degrees") << Scan{.head = {.turn = turned(0, 20)}};
  QTest::newRow("chin down by 20 degrees") << Scan{.head = {.turn = turned(0, -20)}};
  QTest::newRow("looks aside by 20 degrees") << Scan{.head = {.turn = turned(2, 20)}};
  QTest::newRow("leans by 20 degrees") << Scan{.head = {.turn = turned(1, 20)}};
  QTest::newRow("child") << Scan{.head = {.scale = 0.72}};
  QTest::newRow("CT") << Scan{.modality = "CT"};
  QTest::newRow("CT on a table") << Scan{.modality = "CT", .hasTable = true};
  QTest::newRow("no modality") << Scan{.modality = ""};
  QTest::newRow("mirrored grid") << Scan{.step = glm::dmat3{-4, 0, 0, 0, 4, 0, 0, 0, 4}};
  QTest::newRow("sagittal slices from the feet up") << Scan{.step = glm::dmat3{0, 4, 0, 0, 0, -4, 3, 0, 0}};
  QTest::newRow("thick slices") << Scan{.step = glm::dmat3{3, 0, 0, 0, 3, 0, 0, 0, 7}};
  QTest::newRow("oblique grid") << Scan{.step = turned(0, 17) * turned(2, 11) * glm::dmat3(4)};
  QTest::newRow("without the top") << Scan{.highest = 20};
  QTest::newRow("without the chin") << Scan{.lowest = -110};
}

void TestFace::noseGoesAndBrainStays() {
  QFETCH(const Scan, scan);
  const std::string problem = problemOf(scan);
  QVERIFY2(problem.empty(), problem.c_str());
}

void TestFace::inRandomScans() {
  const Seeds seeds = seedsOf(8, 500);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    Scan scan;
    for (int axis = 0; axis < 3; ++axis)
      scan.head.turn = scan.head.turn * turned(axis, chance.between(-12, 12));
    scan.head.scale = chance.between(0.72, 1.05);
    scan.step = turned(0, chance.between(-30, 30)) * turned(2, chance.between(-30, 30));
    for (int axis = 0; axis < 3; ++axis) scan.step[axis] *= chance.between(3, 5) * (chance.oneIn(2) ? -1 : 1);
    scan.modality = chance.oneIn(2) ? "CT" : "MR";
    const std::string problem = problemOf(scan);
    QVERIFY2(problem.empty(), ("seed " + std::to_string(seed) + ": " + problem).c_str());
  }
}

void TestFace::aForeheadAloneKeepsItsBrain() {
  const Scan scan{.lowest = -45, .highest = 60};
  QCOMPARE(problemOf(scan), std::string("the scan shows no nose"));
}

void TestFace::allElseStays() {
  const VolumePtr volume = volumeOf(Scan{.modality = "CT"});
  const auto face = faceOf(*volume);
  const auto without = defaced(*volume);
  QVERIFY2(without, without ? "" : without.message().c_str());
  QVERIFY(face->count() > 1000);
  for (std::size_t n = 0; const glm::ivec3 voxel : voxelsOf(volume->geometry())) {
    QCOMPARE((*without)->valueAt(n), face->at(voxel) ? -1000.0f : volume->valueAt(n));
    ++n;
  }
  QVERIFY((*without)->geometry() == volume->geometry());
}

void TestFace::whatIsNoHeadIsRefused_data() {
  using Holds = std::function<bool(glm::dvec3)>;
  QTest::addColumn<Holds>("isMatter");
  QTest::addColumn<QString>("modality");
  QTest::addColumn<bool>("isCalibrated");
  QTest::addColumn<double>("highest");
  QTest::addColumn<QString>("says");
  const auto head = [](glm::dvec3 p) { return MadeHead{}.at(p) != HeadPart::air; };
  const auto row = [](const char* name, const Holds& isMatter, const char* says, const char* modality = "CT",
                      bool isCalibrated = true, double highest = 110) {
    QTest::newRow(name) << isMatter << QString::fromLatin1(modality) << isCalibrated << highest
                        << QString::fromLatin1(says);
  };
  row(
      "chest", [](glm::dvec3 p) { return glm::length(glm::dvec2(p.x / 115, p.y / 75)) < 1; },
      "shows no head with air around it");
  row(
      "all matter", [](glm::dvec3) { return true; }, "shows no head with air around it");
  row(
      "all air", [](glm::dvec3) { return false; }, "shows no head with air around it");
  row(
      "ball of 30 mm", [](glm::dvec3 p) { return glm::length(p) < 30; }, "shows no head with air around it");
  row("PET", head, "is neither CT nor MR", "PT");
  row("not calibrated", head, "is not calibrated", "MR", false);
  row("slab of 24 mm", head, "is thinner than 30 mm", "MR", true, -156);
}

void TestFace::whatIsNoHeadIsRefused() {
  QFETCH(const std::function<bool(glm::dvec3)>, isMatter);
  QFETCH(const QString, modality);
  QFETCH(const bool, isCalibrated);
  QFETCH(const double, highest);
  QFETCH(const QString, says);
  VolumeParts parts;
  parts.geometry = gridOf(Scan{.highest = highest});
  parts.geometry.calibrated = isCalibrated;
  parts.attributes.name = "scan";
  parts.attributes.modality = modality.toStdString();
  std::vector<std::int16_t> values;
  for (const glm::ivec3 voxel : voxelsOf(parts.geometry))
    values.push_back(std::int16_t(isMatter(parts.geometry.patientFromVoxel(voxel)) ? 50 : -1000));
  parts.values = std::move(values);
  const auto face = faceOf(*volumeFrom(std::move(parts)));
  QVERIFY(!face);
  QVERIFY2(face.message().starts_with("scan " + says.toStdString()), face.message().c_str());
}

void TestFace::cancelledFindsNothing() {
  const CancelToken cancel;
  cancel.cancel();
  QCOMPARE(faceOf(*volumeOf(Scan{}), cancel).message(), std::string("No face was taken away: cancelled."));
}

VOLUMEN_TEST(TestFace);
#include "tst_face.moc"
