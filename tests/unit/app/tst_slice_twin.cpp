// Guards slices.md 1, 3 and 5: values and grey of `volumen slice` equal those of a twin written from SLICE
// alone. Uses real studies and small grids of every shape.
#include <QHash>
#include <QTemporaryDir>
#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "io/files/write_volume.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/app/slice_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

namespace {

constexpr const char* chest = "ct-chest-lidc0314-138";
constexpr const char* obliqueHead = "mr-head-ge-mprage-130";
constexpr const char* tilted = "dicom-geometry/ct-ge-tilt-varspacing-28";
constexpr const char* sheared = "nifti-meta/niivue/shear.nii.gz";
constexpr const char* leftHanded = "nifti-meta/nibabel/anatomical.nii";

/// Options of a command line for a named plane.
struct Asked {
  const char* plane = "axial";
  std::optional<double> fromCentre = {};  ///< --at relative to the volume's centre, mm
  double mmPerPixel = 0;                  ///< 0: not given
  glm::ivec2 size{0};                     ///< 0: not given
  double slabMm = 0;
  TwinSlab slab = TwinSlab::max;
  TwinInterpolation interpolation = TwinInterpolation::linear;
  bool average = false;
};

struct NamedPlane {
  const char* name;
  dvec3 right, down;
  int along;  ///< the patient axis of --at
};

constexpr NamedPlane namedPlanes[] = {{"axial", {1, 0, 0}, {0, 1, 0}, 2},
                                      {"coronal", {1, 0, 0}, {0, 0, -1}, 1},
                                      {"sagittal", {0, 1, 0}, {0, 0, -1}, 0}};

const NamedPlane& planeNamed(const char* name) {
  return *std::find_if(std::begin(namedPlanes), std::end(namedPlanes),
                       [&](const NamedPlane& p) { return QByteArray(p.name) == name; });
}

TwinPlane twinOf(const Asked& asked, const VoxelGeometry& geometry) {
  const NamedPlane& named = planeNamed(asked.plane);
  TwinPlane plane = twinPlane(geometry, named.right, named.down);
  plane.centre[named.along] += asked.fromCentre.value_or(0);
  if (asked.mmPerPixel > 0) plane.mmPerPixel = asked.mmPerPixel;
  plane.size = asked.size.x > 0 ? asked.size : twinSize(geometry, plane);
  plane.slabMm = asked.slabMm;
  plane.slab = asked.slab;
  plane.interpolation = asked.interpolation;
  plane.average = asked.average;
  return plane;
}

QStringList optionsOf(const Asked& asked, const TwinPlane& plane) {
  QStringList options = samplingOptions(plane)
                        << QStringLiteral("--plane") << QString::fromLatin1(asked.plane);
  const auto text = [](double x) { return QString::number(x, 'g', 17); };
  if (asked.fromCentre)
    options << QStringLiteral("--at") << text(plane.centre[planeNamed(asked.plane).along]);
  if (asked.mmPerPixel > 0) options << QStringLiteral("--mm-per-pixel") << text(asked.mmPerPixel);
  if (asked.size.x > 0)
    options << QStringLiteral("--size") << QStringLiteral("%1x%2").arg(asked.size.x).arg(asked.size.y);
  return options;
}

/// Reads each real volume once.
VolumePtr realOne(const QString& name) {
  static QHash<QString, VolumePtr> known;
  if (!known.contains(name)) known[name] = volumeAt(dataPath(name.toStdString()));
  return known[name];
}

}  // namespace

class TestSliceTwin : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void defaultSizeCoversTheBoxFromAnyCentre();
  void initTestCase();
  void namedPlanesOfStudies_data();
  void namedPlanesOfStudies();
  void obliquePlanesOfStudies_data();
  void obliquePlanesOfStudies();
  void everySamplingOfEveryGrid_data();
  void everySamplingOfEveryGrid();
  void acquiredSlicesAreShownAsTheyAre();
  void grey_data();
  void grey();

 private:
  QString gridPath(const QString& name) const { return folder_.filePath(name + QStringLiteral(".nrrd")); }

  QTemporaryDir folder_;
};

void TestSliceTwin::initTestCase() {
  int seed = 0;
  for (const Grid& grid : grids) {
    const auto byChance = [&](dvec3 p) {
      return double((int(p.x * 31 + p.y * 17 + p.z * 7) * 37 + seed) % 101);
    };
    const VolumePtr volume = volumeOf<std::int16_t>({9, 8, 5}, grid.patientFromVoxelStep, byChance);
    QVERIFY(writeVolume(*volume, gridPath(QString::fromLatin1(grid.name)).toStdString()).ok());
    ++seed;
  }
}

void TestSliceTwin::namedPlanesOfStudies_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<Asked>("asked");
  const auto row = [](const char* name, const char* file, const Asked& asked) {
    QTest::newRow(name) << QString::fromLatin1(file) << asked;
  };
  using enum TwinSlab;
  using enum TwinInterpolation;
  row("chest, axial", chest, {});
  row("chest, coronal", chest, {.plane = "coronal"});
  row("chest, sagittal", chest, {.plane = "sagittal"});
  row("chest, between slices", chest, {.fromCentre = 31.3});
  row("chest, coarse", chest, {.plane = "coronal", .fromCentre = -20, .mmPerPixel = 1.9});
  row("chest, averaged", chest, {.plane = "coronal", .fromCentre = -20, .mmPerPixel = 1.9, .average = true});
  row("chest, fine", chest, {.fromCentre = 3.7, .mmPerPixel = 0.21, .size = {301, 200}});
  row("chest, larger than the box", chest, {.fromCentre = 0.4, .mmPerPixel = 2, .size = {333, 250}});
  row("chest, nearest", chest, {.fromCentre = 17.6, .interpolation = nearest});
  row("chest, cubic", chest,
      {.plane = "sagittal", .fromCentre = 40, .mmPerPixel = 2, .interpolation = cubic});
  row("chest, slab of maxima", chest, {.fromCentre = 5, .mmPerPixel = 1.1, .slabMm = 12.3});
  row("chest, slab of means", chest,
      {.plane = "sagittal", .fromCentre = 33, .mmPerPixel = 2, .slabMm = 25.5, .slab = mean});
  row("chest, slab half outside", chest, {.fromCentre = 138, .mmPerPixel = 2, .slabMm = 9.3, .slab = min});
  row("chest, outside", chest, {.fromCentre = 150, .mmPerPixel = 3});
  row("head, axial", obliqueHead, {});
  row("head, coronal", obliqueHead, {.plane = "coronal"});
  row("head, sagittal", obliqueHead, {.plane = "sagittal"});
  row("head, slab of minima", obliqueHead,
      {.plane = "coronal", .fromCentre = 11, .slabMm = 7.7, .slab = min});
  row("head, averaged", obliqueHead, {.mmPerPixel = 2.2, .interpolation = nearest, .average = true});
  row("tilted, axial", tilted, {});
  row("tilted, coronal", tilted, {.plane = "coronal"});
  row("tilted, sagittal", tilted, {.plane = "sagittal", .fromCentre = 21});
  row("tilted, slab of means", tilted, {.mmPerPixel = 1, .slabMm = 11, .slab = mean});
  row("tilted, cubic", tilted, {.plane = "sagittal", .mmPerPixel = 1, .interpolation = cubic});
  row("sheared, axial", sheared, {});
  row("sheared, sagittal", sheared, {.plane = "sagittal"});
  row("sheared, coronal slab", sheared, {.plane = "coronal", .mmPerPixel = 1, .slabMm = 9.1});
  row("left-handed, axial", leftHanded, {});
  row("left-handed, coronal", leftHanded, {.plane = "coronal", .fromCentre = 3.3});
  row("left-handed, sagittal", leftHanded, {.plane = "sagittal", .fromCentre = -9.7, .interpolation = cubic});
  row("left-handed, slab", leftHanded, {.fromCentre = 4.1, .mmPerPixel = 0.7, .slabMm = 5.5, .slab = mean});
}

void TestSliceTwin::namedPlanesOfStudies() {
  QFETCH(QString, file);
  QFETCH(Asked, asked);
  const VolumePtr volume = realOne(file);
  NEED_VOLUME(volume);
  const TwinPlane plane = twinOf(asked, volume->geometry());
  const SliceFile slice =
      runSlice(QString::fromStdString(dataPath(file.toStdString())), optionsOf(asked, plane));
  QCOMPARE(faultsOf(slice, *volume, plane), QString());
}

void TestSliceTwin::obliquePlanesOfStudies_data() {
  QTest::addColumn<QString>("file");
  for (const char* file : {chest, obliqueHead, tilted, sheared, leftHanded})
    QTest::newRow(file) << QString::fromLatin1(file);
}

void TestSliceTwin::obliquePlanesOfStudies() {
  QFETCH(QString, file);
  const VolumePtr volume = realOne(file);
  NEED_VOLUME(volume);
  const dvec3 right = glm::normalize(dvec3(0.8, 0.5, -0.3)),
              down = glm::normalize(glm::cross(dvec3(-0.4, 0.5, 0.7), right));
  TwinPlane plane = twinPlane(volume->geometry(), right, down);
  plane.centre += dvec3(4.1, -3.2, 6.3);
  plane.mmPerPixel = 1.37;
  plane.size = {260, 231};
  plane.slabMm = 4.9;
  plane.slab = TwinSlab::mean;
  const SliceFile slice = runSlice(QString::fromStdString(dataPath(file.toStdString())), planeOptions(plane));
  QCOMPARE(faultsOf(slice, *volume, plane), QString());
}

// Each grid has a third of the samplings, so that three grids together have all. If isThorough(), each has
// all.
void TestSliceTwin::everySamplingOfEveryGrid_data() {
  QTest::addColumn<QString>("grid");
  QTest::addColumn<int>("slab");
  QTest::addColumn<int>("interpolation");
  QTest::addColumn<bool>("average");
  static const char* const slabs[] = {"maxima", "minima", "means", "no slab"};
  static const char* const interpolations[] = {"linear", "nearest", "cubic"};
  int n = 0;
  for (const Grid& grid : grids) {
    ++n;
    for (int slab = 0; slab < 4; ++slab)
      for (int interpolation = 0; interpolation < 3; ++interpolation)
        for (bool average : {false, true})
          if (isThorough() || (n + slab + interpolation) % 3 == int(average))
            QTest::addRow("%s, %s, %s%s", grid.name, slabs[slab], interpolations[interpolation],
                          average ? ", averaged" : "")
                << QString::fromLatin1(grid.name) << slab << interpolation << average;
  }
}

void TestSliceTwin::everySamplingOfEveryGrid() {
  QFETCH(QString, grid);
  QFETCH(int, slab);
  QFETCH(int, interpolation);
  QFETCH(bool, average);
  const VolumePtr volume = volumeAt(gridPath(grid).toStdString());
  TwinPlane plane = twinPlane(volume->geometry(), {0.36, 0.48, -0.8}, glm::normalize(dvec3(0.8, -0.6, 0)));
  plane.centre += dvec3(0.13, -0.37, 0.29);
  plane.mmPerPixel *= average ? 2.3 : 0.31;
  plane.size = average ? glm::ivec2(13, 12) : glm::ivec2(67, 71);
  plane.slabMm = slab < 3 ? 2.3 : 0;
  plane.slab = TwinSlab(slab % 3);
  plane.interpolation = TwinInterpolation(interpolation);
  plane.average = average;
  QCOMPARE(faultsOf(runSlice(gridPath(grid), planeOptions(plane)), *volume, plane), QString());
}

// slices.md 1: a plane parallel to the acquired slices shows them unchanged.
void TestSliceTwin::acquiredSlicesAreShownAsTheyAre() {
  const VolumePtr volume = realOne(QString::fromLatin1(chest));
  NEED_VOLUME(volume);
  const glm::ivec3 size = volume->size();
  for (int k : {0, 1, 77, size.z - 1}) {
    const SliceFile slice =
        runSlice(QString::fromStdString(dataPath(chest)), {QStringLiteral("--index"), QString::number(k)});
    QCOMPARE(slice.failure, QString());
    QCOMPARE(slice.size.x, size.x);
    QCOMPARE(slice.size.y, size.y);
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        QCOMPARE(slice.values[std::size_t(j) * size.x + i], volume->value(i, j, k));
  }
}

void TestSliceTwin::grey_data() {
  QTest::addColumn<QString>("file");  // empty for a grid, whose values are no stored integers of DICOM
  QTest::addColumn<double>("centre");
  QTest::addColumn<double>("width");
  QTest::newRow("CT, soft tissue") << QString::fromLatin1(chest) << 40.0 << 400.0;
  QTest::newRow("CT, a step") << QString::fromLatin1(chest) << -600.0 << 1.0;
  QTest::newRow("CT, two values") << QString::fromLatin1(chest) << -600.0 << 2.0;
  QTest::newRow("exact") << QString() << 47.25 << 61.5;
  QTest::newRow("exact, narrow") << QString() << 50.0 << 0.5;
}

void TestSliceTwin::grey() {
  QFETCH(QString, file);
  QFETCH(double, centre);
  QFETCH(double, width);
  const QString path = file.isEmpty() ? gridPath(QStringLiteral("anisotropic"))
                                      : QString::fromStdString(dataPath(file.toStdString()));
  NEED_DATA(path.toStdString());
  const QStringList options = file.isEmpty() ? QStringList{QStringLiteral("--size"), QStringLiteral("40x40")}
                                             : QStringList{QStringLiteral("--index"), QStringLiteral("60")};
  const SliceFile slice = runSlice(path, options);
  QCOMPARE(slice.failure, QString());
  const QString png = folder_.filePath(QStringLiteral("a.png"));
  const Outcome done =
      runProgram(QStringList{QStringLiteral("slice"), path, QStringLiteral("-o"), png,
                             QStringLiteral("--window"), QStringLiteral("%1,%2").arg(centre).arg(width)} +
                 options);
  QVERIFY2(done.status == 0, done.err.constData());
  QCOMPARE(greyFaults(png, slice, {centre, width}, file.isEmpty()), QString());
}

void TestSliceTwin::defaultSizeCoversTheBoxFromAnyCentre() {
  const QString path = gridPath(QStringLiteral("oblique"));
  const VolumePtr volume = volumeAt(path.toStdString());
  TwinPlane plane = twinPlane(volume->geometry(), {0.6, 0.8, 0}, {0, 0, -1});
  plane.centre += dvec3(1.3, -0.7, 0.9);
  plane.mmPerPixel = 0.45;
  plane.size = twinSize(volume->geometry(), plane);
  QStringList options = planeOptions(plane);
  options.remove(options.indexOf(QStringLiteral("--size")), 2);
  QCOMPARE(faultsOf(runSlice(path, options), *volume, plane), QString());
}

VOLUMEN_TEST(TestSliceTwin);
#include "tst_slice_twin.moc"
