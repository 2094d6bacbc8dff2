// Guards design.md 8 (pointing): position and value under the cursor are those that the picture shows
// (picture.md 4, 6). Checked against closed forms and on a real chest.
#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "results/text/text.h"
#include "tests/fixtures/real_volume.h"
#include "tests/ui/gestures.h"
#include "tests/ui/scene_session.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/views/volume_view.h"
#include "viewer/scene/curve_edits.h"
#include "viewer/scene/presets.h"

using namespace volumen;

namespace {

constexpr int side = 40;  // voxels of 1 mm along each axis, centred on the origin

// Returns values that grow along y by `slope` per mm, 0 at the origin.
VolumePtr ramp(double slope = 10) {
  VolumeParts parts;
  parts.geometry.size = {side, side, side};
  parts.geometry.origin = glm::dvec3(-(side - 1) / 2.0);
  std::vector<float> values;
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) values.push_back(float(slope * (j - (side - 1) / 2.0)));
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

Scene curveOf(std::vector<CurvePoint> points) {
  Scene scene;
  scene.transferFunction.points = std::move(points);
  return scene;
}

const SightLine fromTheFront{{0, -500, 0}, {0, 1, 0}};

LoadedSeriesPtr shownSeries(const VolumePtr& volume, const Scene& scene) {
  auto series = std::make_shared<LoadedSeries>();
  series->volume = volume;
  series->series.id = "volume";
  series->series.modality = volume->attributes().modality;
  series->series.unit = "HU";
  series->histogram = histogram(*volume);
  series->firstScene = scene;
  return series;
}

}  // namespace

class TestPick : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void halfOfASlabsOpacityIsItsPlace_data();
  void halfOfASlabsOpacityIsItsPlace();
  void theSlabBeginsAtTheClipAndTheEye();
  void anEdgeReadsAValueThatIsVisible_data();
  void anEdgeReadsAValueThatIsVisible();
  void gradientOpacityMovesThePlaceToTheEdge();
  void projectionsReadTheirExtreme_data();
  void projectionsReadTheirExtreme();
  void whatIsPointedAtIsWrittenOut_data();
  void whatIsPointedAtIsWrittenOut();
  void theChestsRibsReadAsBone();
};

void TestPick::halfOfASlabsOpacityIsItsPlace_data() {
  QTest::addColumn<double>("opacity");
  QTest::newRow("thin") << 0.01;
  QTest::newRow("half opaque within 10 mm") << 0.07;
  QTest::newRow("dense") << 0.5;
  QTest::newRow("opaque") << 1.0;
}

void TestPick::halfOfASlabsOpacityIsItsPlace() {
  QFETCH(double, opacity);
  const auto hit = pick(curveOf({{0, {1, 1, 1}, opacity}}), *ramp(), fromTheFront, true);
  QVERIFY(hit && hit->pPatient);
  const double mu = -std::log1p(-std::min(opacity, 1 - std::ldexp(1.0, -20)));
  const double whole = -std::expm1(-mu * side), depth = -std::log1p(-whole / 2) / mu;
  QVERIFY2(std::abs(hit->pPatient->y - (-side / 2.0 + depth)) < 0.01,
           qPrintable(QString::number(hit->pPatient->y)));
  const double soft = (std::log1p(-whole / 4) - std::log1p(-0.75 * whole)) / mu;
  QVERIFY2(hit->softMm && std::abs(*hit->softMm - soft) < 0.01,
           qPrintable(QString::number(hit->softMm.value_or(-1))));
}

void TestPick::theSlabBeginsAtTheClipAndTheEye() {
  Scene scene = curveOf({{0, {1, 1, 1}, 0.5}});
  const double depth = 1;  // mm in which half of the light is absorbed; all of it within the slab
  const auto y = [&](const SightLine& line, bool parallel) {
    const auto hit = pick(scene, *ramp(), line, parallel);
    return hit && hit->pPatient ? hit->pPatient->y : std::nan("");
  };
  QVERIFY(std::abs(y({{0, -10, 0}, {0, 1, 0}}, false) - (-10 + depth)) < 0.01);
  scene.clip.planes = {{{0, -2, 0}, -4}};  // keeps y >= 4
  QVERIFY(std::abs(y(fromTheFront, true) - 5) < 0.01);
  scene.clip = {};
  scene.clip.boxLow.y = 0.5;
  QVERIFY(std::abs(y(fromTheFront, true) - 1) < 0.01);
}

void TestPick::anEdgeReadsAValueThatIsVisible_data() {
  QTest::addColumn<double>("threshold");
  QTest::addColumn<double>("opacity");
  for (double threshold : {150.0, 500.0, 990.0})
    for (double opacity : {0.05, 0.3, 1.0})
      QTest::addRow("above %g, opacity %g", threshold, opacity) << threshold << opacity;
}

void TestPick::anEdgeReadsAValueThatIsVisible() {
  QFETCH(double, threshold);
  QFETCH(double, opacity);
  const LoadedSeriesPtr ball = tests::ballSeries();
  const Scene scene = curveOf({{float(threshold), {1, 1, 1}, 0}, {float(threshold), {1, 1, 1}, opacity}});
  for (double x = -6; x <= 6; x += 0.37) {
    const auto hit = pick(scene, *ball->volume, {{x, -500, 0.2}, {0, 1, 0}}, true);
    QVERIFY(hit && hit->pPatient);
    QVERIFY2(hit->value >= threshold, qPrintable(QString::number(hit->value)));
  }
}

void TestPick::gradientOpacityMovesThePlaceToTheEdge() {
  const LoadedSeriesPtr ball = tests::ballSeries();  // 1000, radius 10
  Scene scene = curveOf({{500, {1, 1, 1}, 0.05}});
  const auto y = [&] { return pick(scene, *ball->volume, fromTheFront, true)->pPatient->y; };
  QVERIFY2(y() > -7, "inside, where half of the opacity is reached");
  scene.transferFunction.gradientOpacity = {{0, 0}, {100, 1}};
  scene.transferFunction.points[0].opacity = 0.5;
  QVERIFY2(std::abs(y() + 10) < 1.5, "only its edge is seen");
}

void TestPick::projectionsReadTheirExtreme_data() {
  QTest::addColumn<int>("mode");
  QTest::addColumn<double>("y");
  QTest::addColumn<double>("value");
  QTest::newRow("largest") << int(Mode::mip) << 19.5 << 195.0;
  QTest::newRow("smallest") << int(Mode::minip) << -19.5 << -195.0;
}

void TestPick::projectionsReadTheirExtreme() {
  QFETCH(int, mode);
  QFETCH(double, y);
  QFETCH(double, value);
  Scene scene;
  scene.mode = Mode(mode);
  const auto hit = pick(scene, *ramp(), fromTheFront, true);
  QVERIFY(hit && hit->pPatient);
  // Half a voxel beyond the outermost centres is as bright, so the position may lie there.
  QVERIFY(std::abs(hit->pPatient->y - y) < 0.51);
  QVERIFY(std::abs(hit->value - value) < 0.05);
  QVERIFY2(!hit->softMm, "it is no surface");
}

void TestPick::whatIsPointedAtIsWrittenOut_data() {
  QTest::addColumn<int>("mode");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<QString>("text");
  QTest::newRow("CT") << int(Mode::mip) << QStringLiteral("HU") << QStringLiteral("195.0 HU at L ");
  QTest::newRow("MR") << int(Mode::mip) << QString() << QStringLiteral("195.0 at L ");
  QTest::newRow("PET") << int(Mode::minip) << QStringLiteral("Bq/ml") << QStringLiteral("-195.0 Bq/ml at L ");
  QTest::newRow("a mean has no place")
      << int(Mode::average) << QStringLiteral("HU") << QStringLiteral("mean 0.0 HU along the line of sight");
}

void TestPick::whatIsPointedAtIsWrittenOut() {
  QFETCH(int, mode);
  QFETCH(QString, unit);
  QFETCH(QString, text);
  Scene scene;
  scene.mode = Mode(mode);
  const VolumePtr volume = ramp();
  auto series = std::make_shared<LoadedSeries>(*shownSeries(volume, scene));
  series->series.unit = unit.toStdString();
  tests::SceneSession s;
  Session& session = s.session;
  VolumeView view(session, s.scenes, s.drawService);
  view.resize(400, 300);
  session.show(series);
  view.show();
  QSignalSpy hovered(&view, &VolumeView::hovered);
  tests::hover(&view, {230, 150});
  QVERIFY(!hovered.isEmpty());
  const QString said =
      hovered.last().value(0).toString().replace(QLatin1String("mean -0"), QLatin1String("mean 0"));
  QVERIFY2(said.startsWith(text), qPrintable(said));
}

void TestPick::theChestsRibsReadAsBone() {
  const VolumePtr chest = tests::realVolume("ct-chest-lidc0314-138");
  NEED_VOLUME(chest);
  const Scene scene = *presetScene("CT-Bones", *chest);
  tests::SceneSession s;
  Session& session = s.session;
  VolumeView view(session, s.scenes, s.drawService);
  view.resize(600, 450);
  session.show(shownSeries(chest, scene));
  view.show();
  QSignalSpy hovered(&view, &VolumeView::hovered);
  int ribs = 0;
  for (int y = 20; y < view.height(); y += 15)
    for (int x = 100; x < view.width() - 100; x += 15) {
      tests::hover(&view, QPointF(x, y));
      const auto hit = view.pickAt(QPointF(x, y));
      if (!hit) continue;
      ++ribs;
      QVERIFY2(curveAt(scene.transferFunction, hit->value).opacity > 0,
               qPrintable(QStringLiteral("%1 HU at pixel %2, %3").arg(hit->value).arg(x).arg(y)));
      QVERIFY(std::abs(valueAtVoxel(*chest, chest->geometry().voxelFromPatient(*hit->pPatient)) -
                       hit->value) < 0.1);
    }
  QVERIFY2(ribs > 100, qPrintable(QString::number(ribs)));
  QVERIFY(hovered.count() >= ribs);
}

VOLUMEN_TEST(TestPick);
#include "tst_pick.moc"
