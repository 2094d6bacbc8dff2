// Guards design.md 8 (drafts keep the frame time) and design.md 2 (draft: same colours, no jump).
#include <cmath>
#include <glm/trigonometric.hpp>

#include "tests/unit/suite.h"
#include "ui/controller/screen_picture.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/scene/presets.h"

using namespace volumen;

class TestDrafts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void paceKeepsTheFrameTime_data();
  void paceKeepsTheFrameTime();
  void aFinerDraftWhereTheRestTakesLong_data();
  void aFinerDraftWhereTheRestTakesLong();
  void theRestIsExpectedAsItWas();
  void draftSeesWhatTheFullPictureSees_data();
  void draftSeesWhatTheFullPictureSees();
  void draftsShowTheSegmentsOfThePictureAtRest_data();
  void draftsShowTheSegmentsOfThePictureAtRest();
  void enlargingKeepsColours();
  void theScreenShowsWhatIsWritten();
  void draftLooksLikeStandard_data();
  void draftLooksLikeStandard();
};

void TestDrafts::paceKeepsTheFrameTime_data() {
  QTest::addColumn<double>("fullMs");
  QTest::addColumn<double>("factor");
  QTest::newRow("fast machine, full size") << 10.0 << 1.0;
  QTest::newRow("100 ms a picture") << 100.0 << 2.0;
  QTest::newRow("1000 ms a picture") << 1000.0 << 5.0;
  QTest::newRow("slower than any draft") << 100000.0 << 7.0;
}

void TestDrafts::paceKeepsTheFrameTime() {
  QFETCH(double, fullMs);
  QFETCH(double, factor);
  DraftPace pace(40);
  for (int n = 0; n < 20; ++n) pace.measured(fullMs / (pace.factor() * pace.factor()));
  QCOMPARE(pace.factor(), factor);
  pace.measured(fullMs / (pace.factor() * pace.factor()));
  QCOMPARE(pace.factor(), factor);  // stays there
}

void TestDrafts::aFinerDraftWhereTheRestTakesLong_data() {
  QTest::addColumn<double>("draftMs");
  QTest::addColumn<double>("factor");
  QTest::addColumn<int>("edge");
  QTest::addColumn<double>("finer");  // 0 if there is none
  // Until measured, a ray at rest is expected to take three times as long.
  QTest::newRow("the rest takes 3 s") << 20.0 << 7.0 << 1 << 1.0;
  QTest::newRow("the rest takes 0.16 s") << 1.1 << 7.0 << 1 << 1.0;
  QTest::newRow("the rest takes 0.14 s") << 0.95 << 7.0 << 1 << 0.0;
  QTest::newRow("the draft was as fine already") << 200.0 << 1.0 << 1 << 0.0;
  QTest::newRow("a coarser rest of 2.3 s") << 62.0 << 7.0 << 2 << 2.0;
}

void TestDrafts::aFinerDraftWhereTheRestTakesLong() {
  QFETCH(double, draftMs);
  QFETCH(double, factor);
  QFETCH(int, edge);
  QFETCH(double, finer);
  RestCost cost;
  cost.draftTook(draftMs, factor);
  QCOMPARE(cost.factorOfFiner(factor, edge).value_or(0), finer);
}

void TestDrafts::theRestIsExpectedAsItWas() {
  RestCost cost;
  QVERIFY(!cost.factorOfFiner(7, 1));
  cost.draftTook(10, 7);
  cost.restTook(4900, 1);  // ten times as long per ray
  QCOMPARE(cost.expected(1), 4900.0);
  cost.draftTook(1.5, 7);
  QCOMPARE(cost.expected(1), 735.0);
  QCOMPARE(*cost.factorOfFiner(7, 1), 1.0);
  cost.restTook(150, 1);  // twice as long
  cost.draftTook(10, 7);
  QCOMPARE(*cost.factorOfFiner(7, 1), 1.5);
}

void TestDrafts::draftSeesWhatTheFullPictureSees_data() {
  QTest::addColumn<QSize>("full");
  QTest::addColumn<double>("factor");
  QTest::newRow("divides") << QSize(512, 512) << 4.0;
  QTest::newRow("odd size") << QSize(1013, 677) << 8.0;
  QTest::newRow("fraction") << QSize(511, 333) << 1.5;
}

void TestDrafts::draftSeesWhatTheFullPictureSees() {
  QFETCH(QSize, full);
  QFETCH(double, factor);
  Camera camera;
  const DraftView view = draftView(camera, full, factor);
  // A draft pixel covers `factor` times the millimetres of a full pixel in both directions, because pixels
  // are square.
  const double fullMm = camera.height / full.height(), draftMm = view.camera.height / view.size.height();
  QVERIFY(std::abs(draftMm / fullMm - factor) < 1e-9);
  QVERIFY(view.size.width() * factor >= full.width() && view.size.height() * factor >= full.height());
  const auto tangent = [](double fov) { return std::tan(glm::radians(fov) / 2); };
  QVERIFY(std::abs(tangent(view.camera.fov) / view.size.height() -
                   factor * tangent(camera.fov) / full.height()) < 1e-12);
}

void TestDrafts::draftsShowTheSegmentsOfThePictureAtRest_data() {
  QTest::addColumn<Resampler>("resampler");
  QTest::addColumn<Quality>("level");
  QTest::addColumn<int>("shown");
  QTest::newRow("the CPU draws them") << Resampler::cpu << Quality::standard << 1;
  QTest::newRow("OpenGL leaves them out") << Resampler::gl << Quality::standard << 0;
  QTest::newRow("a draft is the picture at rest") << Resampler::gl << Quality::draft << 1;
}

void TestDrafts::draftsShowTheSegmentsOfThePictureAtRest() {
  QFETCH(Resampler, resampler);
  QFETCH(Quality, level);
  const VolumePtr volume = *makePhantom("sphere:16");
  ScreenRequest request;
  request.scene.segments = {{std::make_shared<const OccupancyField>(), glm::dvec3(1), 1}};
  request.pixels = {16, 16};
  request.resampler = resampler;
  request.level = {level, 1};
  Scene asked;
  Draw draw;
  draw.plan = [&](const Scene& scene, const RenderOptions&, const CancelToken&) -> Result<Planned> {
    asked = scene;
    return Error{"not drawn"};
  };
  QVERIFY(!drawPass(draw, *volume, request, {Quality::draft, 2}, {}));
  QTEST(int(asked.segments.size()), "shown");
}

void TestDrafts::enlargingKeepsColours() {
  // Bilinear enlargement of a linear horizontal ramp gives the ramp at the finer pixels.
  Picture picture{.size = {20, 10}, .transparent = false, .rgba = std::vector<float>(800, 1.0f)};
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c) picture.row(y)[4 * x + c] = float((x + 0.5) / 20);
  const QImage image = enlarged(picture, 4, {78, 39});
  QCOMPARE(image.size(), QSize(78, 39));
  for (int x = 4; x < 74; ++x) {
    const double expected = ((x + 0.5 - 39) / 4 + 10) / 20;
    QVERIFY(std::abs(qRed(image.pixel(x, 20)) - 255 * expected) <= 0.51);  // rounding to bytes
  }
}

void TestDrafts::theScreenShowsWhatIsWritten() {
  Picture picture{.size = {37, 200}, .transparent = false, .rgba = std::vector<float>(4 * 37 * 200, 1.0f)};
  for (std::size_t n = 0; n < picture.rgba.size(); ++n)
    if (n % 4 != 3) picture.rgba[n] = float(n % 1021) / 1020;
  const std::vector<std::uint8_t> bytes = toBytes(picture);
  const QImage image = toImage(picture);
  for (int n = 0; n < 37 * 200; ++n)
    QCOMPARE(image.pixel(n % 37, n / 37), qRgb(bytes[3 * n], bytes[3 * n + 1], bytes[3 * n + 2]));
}

void TestDrafts::draftLooksLikeStandard_data() {
  QTest::addColumn<double>("factor");
  for (double factor : {1.5, 3.0, 5.0, 7.0})
    QTest::addRow("one ray for %g x %g pixels", factor, factor) << factor;
}

void TestDrafts::draftLooksLikeStandard() {
  QFETCH(double, factor);
  static const VolumePtr head = *makePhantom("ct-head:96");
  static const Draw draw = drawWithCaches(std::make_shared<StoredVoxels>(head));
  static Scene scene = *presetScene("auto", *head);
  const QSize full(400, 336);
  scene.camera = fitCamera(Camera{}, head->geometry(), double(full.width()) / full.height());
  RenderOptions options;
  options.size = {full.width(), full.height()};
  static const Result<Drawn> standard = draw(scene, options, {});
  QVERIFY(standard.ok());
  const DraftView view = draftView(*scene.camera, full, factor);
  Scene draftScene = scene;
  draftScene.camera = view.camera;
  options.size = {view.size.width(), view.size.height()};
  options.quality = Quality::draft;
  const Result<Drawn> drawn = draw(draftScene, options, {});
  QVERIFY(drawn.ok());
  const QImage draft = enlarged(drawn->picture, factor, full), rest = toImage(standard->picture);
  // design.md 2: means over blocks of 16 x 16 are within 3/255 RMSE, the mean colour within 1/255.
  constexpr int edge = draftPromise.blockEdge;
  double squares = 0, sum[3] = {};
  int blocks = 0;
  for (int by = 0; by + edge <= full.height(); by += edge)
    for (int bx = 0; bx + edge <= full.width(); bx += edge, ++blocks) {
      double difference[3] = {};
      for (int y = by; y < by + edge; ++y)
        for (int x = bx; x < bx + edge; ++x) {
          const QRgb a = draft.pixel(x, y), b = rest.pixel(x, y);
          difference[0] += qRed(a) - qRed(b);
          difference[1] += qGreen(a) - qGreen(b);
          difference[2] += qBlue(a) - qBlue(b);
        }
      for (int c = 0; c < 3; ++c) {
        const double mean = difference[c] / (edge * edge);
        squares += mean * mean;
        sum[c] += mean;
      }
    }
  const double rmse = std::sqrt(squares / (3 * blocks));
  QVERIFY2(rmse <= draftPromise.mostRmse, qPrintable(QString::number(rmse)));
  for (double total : sum)
    QVERIFY2(std::abs(total / blocks) <= draftPromise.mostMeanColour,
             qPrintable(QString::number(total / blocks)));
}

VOLUMEN_TEST(TestDrafts);
#include "tst_drafts.moc"
