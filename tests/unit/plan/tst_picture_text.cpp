// Guards design.md 3 and 10: a picture states how it was made, and the promised error or why none is
// promised.
#include <algorithm>

#include "tests/unit/suite.h"
#include "viewer/plan/picture_text.h"

using namespace volumen;

namespace {

using Change = void (*)(RenderOptions&);

VolumeFacts someFacts() {
  VolumeFacts f;
  f.geometry.size = {16, 8, 8};
  f.range = {-1000, 1000};
  f.p01 = -1000;
  f.p999 = 900;
  return f;
}

QString textOf(const RenderOptions& options, const std::string& key) {
  const Scene scene;
  const auto plan = makePlan(scene, someFacts(), options);
  if (!plan) return QString::fromStdString("refused: " + plan.message());
  for (const auto& [k, value] : pictureText(*plan))
    if (k == key) return QString::fromStdString(value);
  return {};
}

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestPictureText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void saysItsMethodAndError_data();
  void saysItsMethodAndError();
  void promisesOnlyWhatThePathKeeps_data();
  void promisesOnlyWhatThePathKeeps();
  void saysWhatWasCutAway_data();
  void saysWhatWasCutAway();
  void saysWhatWasMeasured();
  void saysWhatIsEstimated_data();
  void saysWhatIsEstimated();
  void noEstimateIsWorseThanThePromise_data();
  void noEstimateIsWorseThanThePromise();
};

void TestPictureText::saysItsMethodAndError_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("method");
  QTest::addColumn<QString>("error");
  const auto row = [](const char* name, const char* method, const char* error, Change change) {
    QTest::newRow(name) << change << QString::fromLatin1(method) << QString::fromLatin1(error);
  };
  const std::string standard = promiseText(Quality::standard);
  row("by itself", "planes", standard.c_str(), [](RenderOptions&) {});
  row("a step", "planes", "that of the midpoint rule at this step", [](RenderOptions& o) { o.step = 1; });
  row("the reference", "reference", "within 0.05/255 of the limit",
      [](RenderOptions& o) { o.method = Method::reference; });
  row("preshaded", "preshaded", "not promised, chosen by hand: colours of voxels interpolated, not values",
      [](RenderOptions& o) { o.method = Method::preshaded; });
  row("a frame buffer of bytes", "blend",
      "not promised, chosen by hand: 1/2 of 1/255 rounded off after each slice, colours above 1 cut off",
      [](RenderOptions& o) {
        o.method = Method::blend;
        o.blending = Blending::bits8;
      });
  row("voxels of bytes", "planes", "not promised, chosen by hand: values and gradients of 8 bits",
      [](RenderOptions& o) { o.precision = 8; });
  row("a table", "planes", "not promised, chosen by hand: light from a table of 5-bit indices, in 8 bits",
      [](RenderOptions& o) { o.shader = Shader::table; });
  row("a map", "planes", "not promised, chosen by hand: light from a map of 32 directions an edge, nearest",
      [](RenderOptions& o) {
        o.mapSize = 32;
        o.mapLookup = MapLookup::nearest;
      });
}

void TestPictureText::saysItsMethodAndError() {
  QFETCH(Change, change);
  QFETCH(QString, method);
  QFETCH(QString, error);
  RenderOptions options;
  change(options);
  QCOMPARE(textOf(options, "volumen-method"), method);
  QCOMPARE(textOf(options, "volumen-error"), error);
}

void TestPictureText::promisesOnlyWhatThePathKeeps_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<bool>("promised");
  const auto row = [](const char* name, bool promised, Change change) {
    QTest::newRow(name) << change << promised;
  };
  row("planes", true, [](RenderOptions&) {});
  row("planes by OpenGL", false, [](RenderOptions& o) { o.resampler = Resampler::gl; });
  row("blend", false, [](RenderOptions& o) { o.method = Method::blend; });
  row("gpu", false, [](RenderOptions& o) { o.method = Method::gpu; });
  row("preshaded", false, [](RenderOptions& o) { o.method = Method::preshaded; });
}

// design.md 2: a picture and --explain promise only what the path that drew it keeps.
void TestPictureText::promisesOnlyWhatThePathKeeps() {
  QFETCH(Change, change);
  QFETCH(bool, promised);
  const QString none = QStringLiteral("not promised");
  const Scene scene;
  for (Quality quality : {Quality::draft, Quality::standard, Quality::high, Quality::exact}) {
    RenderOptions options;
    options.quality = quality;
    change(options);
    const QString error = textOf(options, "volumen-error");
    QCOMPARE(error == QString::fromStdString(promiseText(quality)), promised);
    QCOMPARE(error.contains(none), !promised);
    const auto plan = makePlan(scene, someFacts(), options);
    const QString explained = QString::fromStdString(explain(*plan));
    if (options.method != Method::preshaded)
      QCOMPARE(explained.contains(QStringLiteral("no error is promised")), !promised);
    options.step = 0.5;
    QVERIFY(!QString::fromStdString(explain(*makePlan(scene, someFacts(), options)))
                 .contains(QStringLiteral("no error is promised")));
  }
}

void TestPictureText::saysWhatWasCutAway_data() {
  QTest::addColumn<int>("outlines");
  QTest::addColumn<bool>("table");
  QTest::addColumn<bool>("reference");
  QTest::addColumn<QString>("cut");
  for (const bool reference : {false, true}) {
    const char* const by = reference ? "reference" : "planes";
    QTest::addRow("nothing, %s", by) << 0 << false << reference << QString();
    QTest::addRow("table, %s", by) << 0 << true << reference << QStringLiteral("table removed");
    QTest::addRow("an outline, %s", by) << 1 << false << reference << QStringLiteral("1 outline");
    QTest::addRow("both, %s", by) << 2 << true << reference << QStringLiteral("2 outlines, table removed");
  }
}

void TestPictureText::saysWhatWasCutAway() {
  QFETCH(int, outlines);
  QFETCH(bool, table);
  QFETCH(bool, reference);
  VolumeFacts facts = someFacts();
  facts.cut = {table, outlines};
  RenderOptions options;
  if (reference) options.method = Method::reference;
  const auto plan = makePlan(Scene(), facts, options);
  QVERIFY(plan.ok());
  QString cut;
  for (const auto& [key, value] : pictureText(*plan))
    if (key == "volumen-cut") cut = QString::fromStdString(value);
  QTEST(cut, "cut");
  const QString line = QStringLiteral("on   cut: ") + cut;
  QCOMPARE(QString::fromStdString(explain(*plan)).contains(line), !cut.isEmpty());
}

void TestPictureText::saysWhatWasMeasured() {
  const MeasuredError measured{
      {.maximum = 4.876, .percentile99 = 2.957, .rmse = 0.69642, .psnrDb = 51.27, .shareAbove2 = 0.036},
      972,
      750000};
  const Scene scene;
  const auto text = pictureText(*makePlan(scene, someFacts(), {}), {.measured = measured});
  const std::pair<std::string, std::string> expected{
      "volumen-error-measured",
      "99 % of pixels within 2.96/255, largest 4.88/255, RMSE 0.696/255, measured at 972 of 750000 pixels"};
  QVERIFY(std::count(text.begin(), text.end(), expected) == 1);
  QCOMPARE(textOf({}, "volumen-error-measured"), QString());
}

void TestPictureText::saysWhatIsEstimated_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<double>("maximum");
  QTest::addColumn<QString>("expected");
  const auto row = [](const char* name, double maximum, const char* expected, Change change) {
    QTest::newRow(name) << change << maximum << QString::fromLatin1(expected);
  };
  row("rounded to the safe side", 4.811, "at most 4.9/255, 99th percentile 0.12/255, PSNR at least 71 dB",
      [](RenderOptions&) {});
  row("the largest there is", 255, "at most 255/255, 99th percentile 0.12/255, PSNR at least 71 dB",
      [](RenderOptions&) {});
  row("nothing", 0, "none but the rounding of floats", [](RenderOptions&) {});
  row("a coarse tolerance is held by it", 0.6,
      "at most 0.6/255, 99th percentile 0.12/255, PSNR at least 71 dB",
      [](RenderOptions& o) { o.tolerance = 0.5; });
  row("what it does not hold", 0.6,
      "at most 0.6/255, 99th percentile 0.12/255, PSNR at least 71 dB; without that of light from a map of "
      "32 directions an edge, bilinear, a table of the curve",
      [](RenderOptions& o) {
        o.mapSize = 32;
        o.curveTable = 64;
      });
}

void TestPictureText::saysWhatIsEstimated() {
  QFETCH(Change, change);
  QFETCH(double, maximum);
  QFETCH(QString, expected);
  RenderOptions options;
  change(options);
  const Scene scene;
  const Plan plan = *makePlan(scene, someFacts(), options);
  const PictureError estimated{.maximum = maximum, .percentile99 = 0.1149, .psnrDb = 71.93};
  const auto text = pictureText(plan, {.estimated = estimated});
  const std::pair<std::string, std::string> line{"volumen-error-estimated", expected.toStdString()};
  QVERIFY2(std::count(text.begin(), text.end(), line) == 1, estimateText(plan, estimated).c_str());
  QCOMPARE(textOf(options, "volumen-error-estimated"), QString());
}

void TestPictureText::noEstimateIsWorseThanThePromise_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<double>("eachPixel");  // 1/255
  QTest::addColumn<double>("maximum");
  QTest::addColumn<double>("percentile99");
  QTest::addColumn<double>("psnrDb");
  const auto row = [](const char* name, double eachPixel, double maximum, double percentile99, double psnrDb,
                      Change change) {
    QTest::newRow(name) << change << eachPixel << maximum << percentile99 << psnrDb;
  };
  const double of20 = 20 * std::log10(255.0 / 20), of1 = 20 * std::log10(255.0),
               ofHalf = 20 * std::log10(255.0 / 0.5);
  row("standard, far off", 20, 20, 8, 42, [](RenderOptions&) {});
  row("standard, below its promise", 0.5, 0.5, 0.5, ofHalf, [](RenderOptions&) {});
  row("high, far off", 20, 20, 2.5, 52, [](RenderOptions& o) { o.quality = Quality::high; });
  row("exact, far off", 20, 1, 1, of1, [](RenderOptions& o) { o.quality = Quality::exact; });
  row("a draft promises nothing of pixels", 20, 20, 20, of20,
      [](RenderOptions& o) { o.quality = Quality::draft; });
  row("a tolerance of its own", 20, 20, 20, of20, [](RenderOptions& o) { o.tolerance = 0.1; });
}

void TestPictureText::noEstimateIsWorseThanThePromise() {
  QFETCH(Change, change);
  QFETCH(double, eachPixel);
  RenderOptions options;
  change(options);
  const auto plan = makePlan(Scene(), someFacts(), options);
  QVERIFY(plan);
  const auto told = estimateOf(*plan, std::vector<float>(400, float(eachPixel)));
  QVERIFY(told);
  QTEST(told->maximum, "maximum");
  QTEST(told->percentile99, "percentile99");
  QTEST(told->psnrDb, "psnrDb");
  QVERIFY2(!estimateOf(*plan, {}), "nothing was estimated");
}

VOLUMEN_TEST(TestPictureText);
#include "tst_picture_text.moc"
