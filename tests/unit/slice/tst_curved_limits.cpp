// Guards the limits of curved volumes: padding is marked and not interpolated, long curves get coarser, and
// impossible layouts are refused.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/slice/curved.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestCurvedLimits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void outsideIsPadding();
  void paddingIsNotInterpolated_data();
  void paddingIsNotInterpolated();
  void paddingBeyondFloat32IsTold();
  void largeOnesBecomeCoarser();
  void aTurnBackIsFinite();
  void whatCannotBeLaidOutIsRefused_data();
  void whatCannotBeLaidOutIsRefused();
  void whatIsCancelledIsAnError();
};

void TestCurvedLimits::outsideIsPadding() {
  const VolumePtr source = randomVolume<std::int16_t>({12, 12, 12}, 100, 200);
  const CurvedRecipe recipe = recipeOf(CurvedKind::straightened, {{5, 5, 2}, {5, 5, 9}}, 20);
  const VolumePtr volume = laidOut(*source, recipe);
  const auto padding = volume->attributes().padding;
  QVERIFY(padding.has_value());
  QCOMPARE(double(volume->value(0, 0, 0)), padding->low);
  QVERIFY(padding->high < 100);
  QVERIFY(volume->value(20, 20, 3) >= 100);

  VolumeParts parts{source->geometry(), source->stored(), 1, 0, {}};
  parts.attributes.padding = ValueRange{-2000, -1990};
  const VolumePtr padded = laidOut(*volumeFrom(std::move(parts)), recipe);
  QVERIFY(padded->attributes().padding == (ValueRange{-2000, -1990}));
  QCOMPARE(padded->value(0, 0, 0), -2000.f);
}

// A row of padding lies beside voxels of 100 to 200, seen along a line between voxels. Values with a share of
// padding are padding. All others equal the interpolation of the surrounding voxels.
void TestCurvedLimits::paddingIsNotInterpolated_data() {
  QTest::addColumn<double>("low");
  QTest::newRow("whole numbers") << -2000.0;
  QTest::newRow("float32 that is not what the file says") << -2000.3;
}

void TestCurvedLimits::paddingIsNotInterpolated() {
  QFETCH(double, low);
  const glm::ivec3 size(12, 12, 12);
  const auto isPadding = [](glm::ivec3 v) { return v.x < 4 || (v.x + v.y + v.z) % 11 == 0; };
  VolumeParts parts;
  parts.geometry = randomVolume<std::int16_t>(size, 100, 200)->geometry();
  std::vector<float> stored;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        stored.push_back(isPadding({i, j, k}) ? float(low) : float(100 + (7 * i + j + k) % 100));
  if (low == std::round(low))
    parts.values = std::vector<std::int16_t>(stored.begin(), stored.end());
  else
    parts.values = std::move(stored);
  parts.attributes.padding = ValueRange{low, low};
  const VolumePtr source = volumeFrom(std::move(parts));
  int blank = 0, seen = 0;
  for (const double shift : {0.0, 0.3}) {
    const CurvedRecipe recipe = recipeOf(CurvedKind::straightened, {{5 + shift, 5, 2}, {5 + shift, 5, 9}}, 4);
    const CurvedGrid grid = gridOf(recipe, source->geometry());
    const VolumePtr volume = laidOut(*source, recipe);
    const ValueRange told = *volume->attributes().padding;
    QVERIFY(std::abs(told.low - low) < 1e-3 && std::abs(told.high - low) < 1e-3);
    for (int k = 0; k < volume->size().z; ++k)
      for (int j = 0; j < volume->size().y; ++j)
        for (int i = 0; i < volume->size().x; ++i) {
          const dvec3 p = grid.patientFromCurved(volume->geometry().patientFromVoxel({i, j, k}));
          const dvec3 x = source->geometry().voxelFromPatient(p);
          const glm::ivec3 from(glm::floor(x + 1e-6)), to(glm::ceil(x - 1e-6));
          if (glm::any(glm::lessThan(from, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(to, size)))
            continue;
          bool beside = false;
          for (int n = 0; n < 8; ++n)
            beside |= isPadding({n & 1 ? to.x : from.x, n & 2 ? to.y : from.y, n & 4 ? to.z : from.z});
          const float value = volume->value(i, j, k);
          ++(beside ? blank : seen);
          QVERIFY(beside ? value == float(low) : value > 100 - 1e-3f && value < 200);
        }
  }
  QVERIFY(blank > 100 && seen > 100);
}

// A file may state padding as doubles. The value written for it must be marked as padding too.
void TestCurvedLimits::paddingBeyondFloat32IsTold() {
  const VolumePtr plain = randomVolume<std::int16_t>({12, 12, 12}, 100, 200);
  for (const double low : {-2000.3, -2000.1}) {
    VolumeParts parts{plain->geometry(), plain->stored(), 1, 0, {}};
    parts.attributes.padding = ValueRange{low, low};
    const VolumePtr volume = laidOut(*volumeFrom(std::move(parts)),
                                     recipeOf(CurvedKind::straightened, {{5, 5, 2}, {5, 5, 9}}, 20));
    const double written = double(volume->value(0, 0, 0));
    const ValueRange padding = *volume->attributes().padding;
    QVERIFY(written != low && written >= padding.low && written <= padding.high);
    QVERIFY(low >= padding.low && low <= padding.high);
  }
}

void TestCurvedLimits::largeOnesBecomeCoarser() {
  const std::vector<dvec3> points{{0, 0, 0}, {100, 20, 0}, {200, 0, 0}};
  for (const CurvedKind kind : {CurvedKind::straightened, CurvedKind::stretched})
    for (const double spacing : {1.0, 0.1, 0.01}) {
      const CurvedGrid grid = gridOf(recipeOf(kind, points, 25), boxOf(spacing, 4000));
      const VoxelGeometry& g = grid.geometry();
      QVERIFY(double(g.voxelCount()) < 1.1 * CurvedGrid::mostVoxels);
      QVERIFY(g.spacing().x >= spacing - 1e-9);
      QVERIFY(std::abs(g.spacing().x / g.spacing().z - 1) < 0.01);
      if (spacing == 1) QVERIFY(std::abs(g.spacing().x - 1) < 1e-9);
    }
  // The number of cross-sections of a long curve is limited, also in thin volumes.
  const CurvedGrid thin =
      gridOf(recipeOf(CurvedKind::straightened, {{0, 0, 0}, {5000, 0, 0}}, 0.001), boxOf(0.001));
  QVERIFY(double(thin.sections().size()) < CurvedGrid::mostSections + 2);
}

void TestCurvedLimits::aTurnBackIsFinite() {
  for (const CurvedKind kind : {CurvedKind::straightened, CurvedKind::stretched}) {
    const CurvedGrid grid = gridOf(recipeOf(kind, {{0, 0, 0}, {10, 0, 0}, {2, 0, 0}}), boxOf());
    for (const CurvedGrid::Section& section : grid.sections()) {
      QVERIFY(std::abs(glm::length(section.right) - 1) < 1e-9);
      QVERIFY(glm::distance(glm::cross(section.right, section.down), section.along) < 1e-9);
    }
  }
}

void TestCurvedLimits::whatCannotBeLaidOutIsRefused_data() {
  QTest::addColumn<QList<double>>("zs");  // z of points on a line
  QTest::addColumn<bool>("stretched");
  QTest::addColumn<double>("halfWidth");
  QTest::addColumn<double>("ruled");
  QTest::addColumn<bool>("calibrated");
  QTest::addColumn<QString>("says");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto row = [](const char* name, const QList<double>& zs, const char* says, bool stretched = false,
                      double halfWidth = 5, double ruled = 1, bool calibrated = true) {
    QTest::newRow(name) << zs << stretched << halfWidth << ruled << calibrated << QString::fromLatin1(says);
  };
  row("no point", {}, "two different places");
  row("no point, stretched", {}, "two different places", true);
  row("one point", {3}, "two different places");
  row("no number", {3, nan}, "1e9 mm");
  row("no number, stretched", {3, nan}, "1e9 mm", true);
  row("shorter than a voxel", {3, 3.5}, "shorter than a voxel");
  row("longer than a building", {-9000, 9000}, "longer than 10 m");
  row("more points than a hand sets", QList<double>(2001, 3), "2000 points");
  row("seen along its own line", {-9, 0, 9}, "two different places", true);
  row("no width", {3, 9}, "across", false, 0);
  row("a width that is no number", {3, 9}, "across", false, nan);
  row("no unit vector", {3, 9}, "unit vector", true, 5, 2);
  row("no millimetres", {3, 9}, "not calibrated", false, 5, 1, false);
  row("outside", {300, 309}, "outside");
}

void TestCurvedLimits::whatCannotBeLaidOutIsRefused() {
  QFETCH(QList<double>, zs);
  QFETCH(bool, stretched);
  QFETCH(double, halfWidth);
  QFETCH(double, ruled);
  QFETCH(bool, calibrated);
  QFETCH(QString, says);
  VolumeParts parts;
  parts.geometry = boxOf(1, 21);
  parts.geometry.calibrated = calibrated;
  parts.values = std::vector<float>(std::size_t(parts.geometry.voxelCount()), 1);
  CurvedRecipe recipe = recipeOf(stretched ? CurvedKind::stretched : CurvedKind::straightened, {}, halfWidth);
  recipe.ruled *= ruled;
  for (const double z : zs) recipe.points.emplace_back(0, 0, z);
  const auto volume = curvedVolume(*volumeFrom(std::move(parts)), recipe);
  QVERIFY(!volume);
  QVERIFY2(QString::fromStdString(volume.message()).contains(says), volume.message().c_str());
}

void TestCurvedLimits::whatIsCancelledIsAnError() {
  const VolumePtr source = randomVolume<std::int16_t>({12, 12, 12}, 100, 200);
  CancelToken cancel;
  std::size_t heard = 0;
  const auto volume = curvedVolume(
      *source, recipeOf(CurvedKind::straightened, {{5, 5, 2}, {5, 5, 9}}),
      [&](std::size_t done, std::size_t total) {
        heard = done;
        QCOMPARE(total, std::size_t(8));
        if (done == 3) cancel.cancel();
      },
      cancel);
  QVERIFY(!volume);
  QCOMPARE(heard, std::size_t(3));
}

VOLUMEN_TEST(TestCurvedLimits);
#include "tst_curved_limits.moc"
