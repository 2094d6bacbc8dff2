// Guards design.md 4 (bench: N views, the camera turned by 360/N between views; median, minimum, samples).
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <glm/geometric.hpp>

#include "tests/unit/suite.h"
#include "viewer/evaluation/orbit.h"
#include "viewer/evaluation/statistics.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;

class TestOrbit : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void mediansAndMinima_data();
  void mediansAndMinima();
  void everyViewIsDrawnOnceARound();
  void aTurnedViewTakesItsOwnSamples();
  void theReportSaysWhatWasMeasured();
  void cancelIsAnError();
};

namespace {

RenderOptions smallPicture() {
  RenderOptions options;
  options.size = {24, 20};
  options.step = 1;
  return options;
}

Orbit orbitOf(const char* phantom, OrbitOptions asked) {
  RenderCaches caches(*makePhantom(phantom));
  return *measureOrbit(Scene(), smallPicture(), asked, caches);
}

}  // namespace

void TestOrbit::mediansAndMinima_data() {
  QTest::addColumn<QVector<double>>("values");
  QTest::addColumn<double>("middle");
  QTest::addColumn<double>("least");
  QTest::newRow("none") << QVector<double>{} << 0. << 0.;
  QTest::newRow("one") << QVector<double>{3} << 3. << 3.;
  QTest::newRow("odd, unsorted") << QVector<double>{9, 1, 4} << 4. << 1.;
  QTest::newRow("even: between the middle two") << QVector<double>{8, 2, 100, 4} << 6. << 2.;
}

void TestOrbit::mediansAndMinima() {
  QFETCH(QVector<double>, values);
  QFETCH(double, middle);
  QFETCH(double, least);
  const std::vector<double> v(values.begin(), values.end());
  QCOMPARE(median(v), middle);
  QCOMPARE(minimum(v), least);
}

void TestOrbit::everyViewIsDrawnOnceARound() {
  const Orbit orbit = orbitOf("sphere:16", {.views = 3, .rounds = 4});
  QCOMPARE(orbit.views.size(), std::size_t(3));
  for (int n = 0; n < 3; ++n) {
    QCOMPARE(orbit.views[n].angleDegrees, 120. * n);
    QCOMPARE(orbit.views[n].framesMs.size(), std::size_t(4));
    QCOMPARE(orbit.views[n].processorsMs.size(), std::size_t(4));
  }
  QCOMPARE(allFramesMs(orbit).size(), std::size_t(12));
  QVERIFY(orbit.firstFrameMs >= orbit.gradientsMs);
}

// Views along and across the axis of a long box have different rays and samples.
void TestOrbit::aTurnedViewTakesItsOwnSamples() {
  const VolumePtr sphere = *makePhantom("sphere:16");
  VolumeParts parts;
  parts.geometry = sphere->geometry();
  parts.values = sphere->stored();
  parts.geometry.patientFromVoxelStep[0].x = 3;
  std::vector<std::string> warnings;
  RenderCaches caches(*Volume::make(parts, warnings));
  Scene scene;
  scene.transferFunction.points = {{0, {1, 1, 1}, 0.001}};
  const Orbit orbit = *measureOrbit(scene, smallPicture(), {.views = 4, .rounds = 1}, caches);
  QCOMPARE(orbit.views[0].stats.resampled, orbit.views[2].stats.resampled);
  QVERIFY(orbit.views[0].stats.resampled != orbit.views[1].stats.resampled);
}

void TestOrbit::theReportSaysWhatWasMeasured() {
  const Orbit orbit = orbitOf("ct-head:32", {.views = 2, .rounds = 3});
  const QJsonObject all = QJsonDocument::fromJson(QByteArray::fromStdString(orbitJson(orbit))).object();
  const QJsonArray views = all[QStringLiteral("views")].toArray();
  QCOMPARE(views.size(), 2);
  QCOMPARE(views[1].toObject()[QStringLiteral("framesMs")].toArray().size(), 3);
  QCOMPARE(views[1].toObject()[QStringLiteral("resampled")].toDouble(),
           double(orbit.views[1].stats.resampled));
  QCOMPARE(all[QStringLiteral("overall")].toObject()[QStringLiteral("medianMs")].toDouble(),
           median(allFramesMs(orbit)));
  QCOMPARE(all[QStringLiteral("firstFrameMs")].toDouble(), orbit.firstFrameMs);
  const QString text = QString::fromStdString(orbitText(orbit));
  QVERIFY(text.contains(QStringLiteral("24 x 20, step 1 voxel")));
  QCOMPARE(text.count(QLatin1Char('\n')), 4 + 2 + 1);
}

void TestOrbit::cancelIsAnError() {
  RenderCaches caches(*makePhantom("sphere:16"));
  const CancelToken cancel;
  cancel.cancel();
  const auto orbit = measureOrbit(Scene(), smallPicture(), {}, caches, {}, cancel);
  QVERIFY(!orbit.ok());
  QCOMPARE(QString::fromStdString(orbit.message()), QStringLiteral("cancelled"));
}

VOLUMEN_TEST(TestOrbit);
#include "tst_orbit.moc"
