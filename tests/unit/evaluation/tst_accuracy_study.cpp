// Guards design.md 2 and 6: errors against the reference on a stratified subset, times, the Pareto front, CSV
// and JSON output, and cancelling.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <set>

#include "tests/unit/suite.h"
#include "viewer/evaluation/accuracy_study.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/reference/reference.h"

using namespace volumen;

Q_DECLARE_METATYPE(std::vector<glm::dvec2>)
Q_DECLARE_METATYPE(std::vector<bool>)

class TestStudy : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneChosenPixelOfEachCell_data();
  void oneChosenPixelOfEachCell();
  void theTruthIsTheReference();
  void aSmallerPictureIsReadAtItsPlaces_data();
  void aSmallerPictureIsReadAtItsPlaces();
  void errorsOfMadeUpPictures_data();
  void errorsOfMadeUpPictures();
  void theFrontIsWhatNothingBeats_data();
  void theFrontIsWhatNothingBeats();
  void settingsTurnOneKnobEach();
  void smallerStepsAreNearerTheTruth();
  void whatCannotBeDrawnIsNamed();
  void csvAndJsonSayTheSame();
  void cancelIsAnError();
};

namespace {

RenderOptions smallBase() {
  RenderOptions base = studyBase({24, 24}, 0);
  base.step = 1;
  return base;
}

Setting stepOf(double step) {
  Setting s{"step", std::to_string(step), smallBase(), 1};
  s.options.step = step;
  return s;
}

AccuracyStudy studyOf(const std::vector<Setting>& settings) {
  RenderCaches caches(*makePhantom("soft-sphere:24"));
  Scene scene;
  scene.transferFunction.points = {{100, {1, 0.5, 0.2}, 0}, {900, {0.5, 0.8, 1}, 0.6}};
  return *measure(scene, settings, {.frames = 2, .mostMs = 100, .mostPixels = 200}, caches);
}

}  // namespace

void TestStudy::oneChosenPixelOfEachCell_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("most");
  QTest::newRow("a small picture: all of it") << 20 << 10 << 200;
  QTest::newRow("a large one") << 512 << 512 << 16384;
  QTest::newRow("an odd one") << 101 << 37 << 500;
  QTest::newRow("a wide one") << 1000 << 3 << 90;
  QTest::newRow("one pixel of many") << 300 << 200 << 1;
}

void TestStudy::oneChosenPixelOfEachCell() {
  QFETCH(int, width);
  QFETCH(int, height);
  QFETCH(int, most);
  Truth truth;
  choosePixels(truth, {width, height}, most);
  QCOMPARE(truth.pixels.size(), std::size_t(truth.grid.x) * truth.grid.y);
  QVERIFY(int(truth.pixels.size()) <= most);
  // The grid has the picture's aspect ratio. Only rounding its edges may lose pixels.
  QVERIFY((truth.grid.x + 1) * (truth.grid.y + 1) > std::min(most, width * height) * 0.99);
  std::set<std::pair<int, int>> places;
  for (std::size_t n = 0; n < truth.pixels.size(); ++n) {
    const int cx = int(n) % truth.grid.x, cy = int(n) / truth.grid.x;
    const glm::ivec2 p = truth.pixels[n];
    QVERIFY(p.x >= cx * width / truth.grid.x && p.x < (cx + 1) * width / truth.grid.x);
    QVERIFY(p.y >= cy * height / truth.grid.y && p.y < (cy + 1) * height / truth.grid.y);
    places.insert({p.x * truth.grid.x % width, p.y * truth.grid.y % height});
  }
  // The chosen pixel must differ between cells that hold many pixels.
  if (truth.pixels.size() > 100 && width * height > 4 * most) QVERIFY(places.size() > 4);
}

void TestStudy::theTruthIsTheReference() {
  RenderCaches caches(*makePhantom("sphere:16"));
  const glm::ivec2 size(30, 20);
  RenderOptions options;
  options.size = size;
  const Scene scene = makePlan(Scene(), caches.facts(), options)->scene;
  const Picture whole = *renderReference(scene, *caches.volume(), size);
  const auto well = *wellConditioned(scene, *caches.volume(), size);
  for (const int most : {600, 70}) {
    const Truth truth = *makeTruth(scene, *caches.volume(), size, most, 0);
    QVERIFY(atPixelsOf(truth, whole) == truth.picture);
    for (std::size_t n = 0; n < truth.pixels.size(); ++n)
      QCOMPARE(truth.well[n], well[std::size_t(truth.pixels[n].y) * size.x + truth.pixels[n].x]);
  }
}

void TestStudy::aSmallerPictureIsReadAtItsPlaces_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<int>("height");
  QTest::newRow("half") << 32 << 24;
  QTest::newRow("a quarter") << 16 << 12;
  QTest::newRow("of other proportions: more is seen at the sides") << 40 << 24;
  QTest::newRow("the same") << 64 << 48;
}

// The colour of each pixel is its position in the image plane (picture.md 7: a and b over the height). After
// enlargement every pixel must still hold its own position.
void TestStudy::aSmallerPictureIsReadAtItsPlaces() {
  QFETCH(int, width);
  QFETCH(int, height);
  const auto place = [](glm::ivec2 pixel, glm::ivec2 size) {
    return glm::vec2((float(pixel.x) + 0.5f - 0.5f * float(size.x)) / float(size.y),
                     (float(pixel.y) + 0.5f) / float(size.y) - 0.5f);
  };
  Picture small{{width, height}, true, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec2 p = place({x, y}, small.size);
      small.rgba.insert(small.rgba.end(), {p.x, p.y, 0, 1});
    }
  Truth truth;
  choosePixels(truth, {64, 48}, 10000);
  const Picture read = atPixelsOf(truth, small);
  for (std::size_t n = 0; n < truth.pixels.size(); ++n) {
    const glm::ivec2 pixel = truth.pixels[n];
    if (pixel.x < 3 || pixel.x > 60 || pixel.y < 3 || pixel.y > 44) continue;  // borders are clamped
    const glm::vec2 expected = place(pixel, truth.size);
    QVERIFY(std::abs(read.rgba[4 * n] - expected.x) < 1e-5);
    QVERIFY(std::abs(read.rgba[4 * n + 1] - expected.y) < 1e-5);
  }
}

void TestStudy::errorsOfMadeUpPictures_data() {
  QTest::addColumn<int>("off");       // number of differing pixels of 200
  QTest::addColumn<double>("by");     // their difference in one component, in /255
  QTest::addColumn<double>("p99");    // value of rank 198 of 200
  QTest::addColumn<double>("share");  // share of pixels above 2/255
  QTest::newRow("none") << 0 << 0. << 0. << 0.;
  QTest::newRow("two of 200 are not the 99th percentile") << 2 << 10. << 0. << 0.01;
  QTest::newRow("three are") << 3 << 10. << 10. << 0.015;
  QTest::newRow("all, by little") << 200 << 1.5 << 1.5 << 0.;
}

void TestStudy::errorsOfMadeUpPictures() {
  QFETCH(int, off);
  QFETCH(double, by);
  QFETCH(double, p99);
  QFETCH(double, share);
  const Picture truth{{20, 10}, false, std::vector<float>(800, 0.25f)};
  Picture other = truth;
  for (int n = 0; n < off; ++n) other.rgba[4 * std::size_t(n) + 1] += float(by / 255);
  const PictureError e = compare(other, truth);
  QVERIFY(std::abs(e.maximum - by) < 1e-4);
  QVERIFY(std::abs(e.percentile99 - p99) < 1e-4);
  QVERIFY(std::abs(e.rmse - std::sqrt(by * by * off / 600)) < 1e-4);
  QVERIFY(off == 0 ? std::isinf(e.psnrDb) : std::abs(e.psnrDb - 20 * std::log10(255 / e.rmse)) < 1e-9);
  QCOMPARE(e.shareAbove2, share);
}

void TestStudy::theFrontIsWhatNothingBeats_data() {
  QTest::addColumn<std::vector<glm::dvec2>>("points");
  QTest::addColumn<std::vector<bool>>("front");
  using Points = std::vector<glm::dvec2>;
  using Front = std::vector<bool>;
  QTest::newRow("nothing") << Points{} << Front{};
  QTest::newRow("one alone") << Points{{3, 3}} << Front{true};
  QTest::newRow("slower and worse") << Points{{1, 1}, {2, 2}} << Front{true, false};
  QTest::newRow("a trade") << Points{{1, 2}, {2, 1}} << Front{true, true};
  QTest::newRow("as fast, but worse") << Points{{1, 1}, {1, 2}} << Front{true, false};
  QTest::newRow("as good, but slower") << Points{{2, 1}, {1, 1}} << Front{false, true};
  QTest::newRow("twins stand both") << Points{{1, 1}, {1, 1}, {3, 0}} << Front{true, true, true};
  QTest::newRow("inside the bend") << Points{{1, 9}, {5, 5}, {9, 1}, {6, 6}}
                                   << Front{true, true, true, false};
}

void TestStudy::theFrontIsWhatNothingBeats() {
  QFETCH(std::vector<glm::dvec2>, points);
  QFETCH(std::vector<bool>, front);
  QVERIFY(paretoFront(points) == front);
}

void TestStudy::settingsTurnOneKnobEach() {
  const RenderOptions base = studyBase({64, 64}, 0);
  const auto settings = oneKnobAtATime(base);
  std::set<std::string> knobs, names;
  QVERIFY(settings.front().options == base);
  for (const Setting& s : settings) {
    knobs.insert(s.knob);
    QVERIFY2(names.insert(s.knob + s.value).second, s.value.c_str());
    QVERIFY(makePlan(Scene(), factsOf(**makePhantom("sphere:8")), s.options).ok());
  }
  for (const char* knob : {"step", "level", "precision", "shader", "map, nearest", "tolerance", "stop at",
                           "opacity threshold", "gradient", "curve table", "resolution"})
    QVERIFY2(knobs.count(knob), knob);
  for (const Setting& s : gridOfKnobs(base)) QVERIFY2(names.insert(s.knob + s.value).second, s.value.c_str());
}

void TestStudy::smallerStepsAreNearerTheTruth() {
  const AccuracyStudy study = studyOf({stepOf(2), stepOf(0.5), stepOf(0.0625)});
  QCOMPARE(study.rows.size(), std::size_t(3));
  QVERIFY(study.rows[0].error.rmse > 4 * study.rows[1].error.rmse);
  QVERIFY(study.rows[1].error.rmse > 4 * study.rows[2].error.rmse);
  QVERIFY(study.rows[2].error.maximum < 0.5);
  for (const StudyRow& row : study.rows) {
    QVERIFY(row.frames >= 1 && row.medianMs >= row.minimumMs && row.minimumMs > 0);
    QVERIFY(row.bytes > 0 && row.resampled > row.shaded && row.shaded > 0);
  }
  QVERIFY(study.rows[0].resampled < study.rows[1].resampled);
  QVERIFY(study.rows[2].front);  // no other row is as accurate
}

void TestStudy::whatCannotBeDrawnIsNamed() {
  Setting impossible = stepOf(1);
  impossible.knob = "map size";
  impossible.options.mapSize = 1;
  const AccuracyStudy study = studyOf({stepOf(1), impossible});
  QCOMPARE(study.rows.size(), std::size_t(1));
  QCOMPARE(study.leftOut.size(), std::size_t(1));
  QVERIFY(QString::fromStdString(study.leftOut[0]).startsWith(QStringLiteral("map size, ")));
}

void TestStudy::csvAndJsonSayTheSame() {
  Setting named = stepOf(1);
  named.value = "1, \"one\"";
  const AccuracyStudy study = studyOf({named, stepOf(0.5)});
  const QStringList lines =
      QString::fromStdString(studyCsv(study)).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
  QCOMPARE(lines.size(), 3);
  QVERIFY(lines[1].startsWith(QStringLiteral("step,\"1, \"\"one\"\"\",planes,")));
  const QJsonObject all =
      QJsonDocument::fromJson(QByteArray::fromStdString(studyJson(study, {"v", "s", "m", "d"}))).object();
  QCOMPARE(all[QStringLiteral("machine")].toString(), QStringLiteral("m"));
  QVERIFY(all[QStringLiteral("reference")].toObject()[QStringLiteral("pixels")].toInt() <= 200);
  const QJsonArray rows = all[QStringLiteral("rows")].toArray();
  QCOMPARE(rows.size(), 2);
  QCOMPARE(rows[0].toObject()[QStringLiteral("value")].toString(), QStringLiteral("1, \"one\""));
  const QStringList head = lines[0].split(QLatin1Char(',')), cells = lines[2].split(QLatin1Char(','));
  QCOMPARE(cells.size(), head.size());
  for (const char* key : {"medianMs", "rmse", "p99", "bytes", "resampled"})
    QCOMPARE(cells[head.indexOf(QLatin1String(key))].toDouble(),
             rows[1].toObject()[QLatin1String(key)].toDouble());
}

void TestStudy::cancelIsAnError() {
  RenderCaches caches(*makePhantom("sphere:16"));
  const CancelToken cancel;
  int calls = 0;
  const auto stopAtOnce = [&](const char*, std::size_t, std::size_t) {
    ++calls;
    cancel.cancel();
  };
  const auto study = measure(Scene(), {stepOf(1), stepOf(0.5)}, {}, caches, stopAtOnce, cancel);
  QVERIFY(!study.ok());
  QCOMPARE(QString::fromStdString(study.message()), QStringLiteral("cancelled"));
  QCOMPARE(calls, 1);
}

VOLUMEN_TEST(TestStudy);
#include "tst_accuracy_study.moc"
