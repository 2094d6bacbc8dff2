// Guards slices.md 2 and 4 in the window: which pictures form a series of frames and which views show them.
// Also guards their grey values, pixel sizes and timing.
#include "io/study/frame_series.h"
#include "io/study/study.h"
#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "ui/data/frame_pool.h"
#include "ui/workspace/cine.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/frame_text.h"

using namespace volumen;

class TestFramesOfSeries : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void filesOfASeriesAreOneStack();
  void picturesWithoutAPlaceOpenAsFrames_data();
  void picturesWithoutAPlaceOpenAsFrames();
  void framesAreAloneInTheirGroup();
  void slicesComeBackToTheFrame();
  void clipsGoByTheClock_data();
  void clipsGoByTheClock();
  void rates_data();
  void rates();
  void windowsAndTablesHaveNames();
  void aWindowStandsInForATable();
  void aSeriesHasOneWindow_data();
  void aSeriesHasOneWindow();
  void onlyTrueMmAreSaid_data();
  void onlyTrueMmAreSaid();
  void regionsHaveMmOfTheirOwn();
  void thePoolForgetsWhatWasUsedLongestAgo();
};

namespace {

Image imageAt(const char* path, const char* series, int frames) {
  Image image;
  image.path = path;
  image.id = path;
  image.seriesUid = series;
  image.studyUid = "study";
  image.modality = "US";
  image.notVolume = "colour image (RGB): cannot be shown in 3D.";
  image.frames = frames;
  image.columns = 4, image.rows = 3;
  return image;
}

// Returns a DICOM series of `slices` slices, 2 mm apart.
Series ct(int slices, const char* id = "ct") {
  Series series;
  series.id = id;
  series.path = "folder";
  series.format = "DICOM";
  series.frameOfReferenceUid = id;
  series.acquired.size = {8, 8, slices};
  series.acquired.patientFromVoxelStep[2] *= 2;
  series.files.assign(std::size_t(slices), "file");
  series.frames.assign(std::size_t(slices), 0);
  return series;
}

Series clip() {
  Study study;
  study.images = {imageAt("folder/clip.dcm", "1.2", 6)};
  return frameSeries(study).front();
}

NamedGrey named(const char* name, Window window, WindowFunction function) {
  return {name, {window, function, {}, false}};
}

// Returns 3 x 2 pixels of grey 0 .. 5, or whatever `change` makes of them.
LoadedFramePtr frameWith(const std::function<void(Frame&)>& change = {}) {
  Frame frame;
  frame.size = {3, 2};
  frame.values = std::vector<float>{0, 1, 2, 3, 4, 5};
  frame.greys = {named("", {2, 5}, WindowFunction::linear)};
  if (change) change(frame);
  return *shownFrame(ct(1), {keyOf(ct(1)), 0}, frame);
}

}  // namespace

void TestFramesOfSeries::filesOfASeriesAreOneStack() {
  Study study;
  study.images = {imageAt("a/x/1.dcm", "1.2", 2), imageAt("a/y/2.dcm", "1.2", 1), imageAt("a/3.dcm", "", 1),
                  imageAt("a/4.dcm", "", 5)};
  const std::vector<Series> all = frameSeries(study);
  QCOMPARE(all.size(), std::size_t(3));
  QCOMPARE(all[0].files, (std::vector<std::string>{"a/x/1.dcm", "a/x/1.dcm", "a/y/2.dcm"}));
  QCOMPARE(all[0].frames, (std::vector<int>{0, 1, 0}));
  QCOMPARE(all[0].path, std::string("a"));
  QCOMPARE(all[0].acquired.size, glm::ivec3(4, 3, 3));
  QVERIFY(!all[0].acquired.calibrated);
  QCOMPARE(all[0].notVolume, study.images[0].notVolume);
  QCOMPARE(all[1].path, std::string("a/3.dcm"));
  QCOMPARE(frameCount(all[2]), 5);
  QVERIFY2(keyOf(all[1]) != keyOf(all[2]), "files without a series are each for itself");
}

void TestFramesOfSeries::picturesWithoutAPlaceOpenAsFrames_data() {
  QTest::addColumn<Series>("series");
  QTest::addColumn<bool>("asFrames");
  Series chest = ct(1), nrrd = ct(1), stack = ct(5);
  chest.acquired.calibrated = nrrd.acquired.calibrated = stack.acquired.calibrated = false;
  nrrd.format = "NRRD";
  QTest::newRow("a clip") << clip() << true;
  QTest::newRow("a chest without a place") << chest << true;
  QTest::newRow("one slice of CT with its place") << ct(1) << false;
  QTest::newRow("slices without a place") << stack << false;
  QTest::newRow("a format without frames") << nrrd << false;
}

void TestFramesOfSeries::picturesWithoutAPlaceOpenAsFrames() {
  QFETCH(Series, series);
  QFETCH(bool, asFrames);
  QCOMPARE(opensAsFrames(series), asFrames);
}

void TestFramesOfSeries::framesAreAloneInTheirGroup() {
  const Series volume = ct(5);
  for (const Layout layout : {Layout::one, Layout::planes, Layout::besidePlanes}) {
    const Workspace before = withLayout(withSeries({}, sceneViewId, volume, {}), layout);
    const Workspace frames = withFrames(before, before.focus, clip());
    QCOMPARE(viewsOnScreen(frames), std::vector{axialViewId});
    QCOMPARE(frames.focus, axialViewId);
    const Workspace back = withSeries(frames, frames.focus, volume, {});
    QCOMPARE(viewsOnScreen(back), viewsOnScreen(before));
    QVERIFY(back.view(axialViewId).kind == ViewKind::axial);
    QVERIFY(!showsFrames(without(frames, keyOf(clip())), axialViewId));
  }
  const Workspace two = withLayout(withFrames({}, sceneViewId, clip()), Layout::two);
  QVERIFY2(showsFrames(two, firstComparedId), "the first view to compare shows what was in focus");
  QCOMPARE(viewsOnScreen(two).size(), std::size_t(2));
}

void TestFramesOfSeries::slicesComeBackToTheFrame() {
  const Series volume = ct(9);
  Workspace workspace = withSeries({}, sceneViewId, volume, {});
  workspace.crosshairs.editOrAdd("ct").at = {1, 2, 6.2};  // the slices lie 2 mm apart
  workspace = withFrames(workspace, sceneViewId, volume);
  QCOMPARE(flatLookOf(workspace.view(axialViewId)).frame, 3);
  workspace.editView(axialViewId).flats.editOrAdd(keyOf(volume)).frame = 7;
  workspace = withSeries(workspace, axialViewId, volume, {});
  QCOMPARE(workspace.crosshairs.at("ct").at, glm::dvec3(1, 2, 14));
}

void TestFramesOfSeries::clipsGoByTheClock_data() {
  QTest::addColumn<Cine>("cine");
  QTest::addColumn<int>("first");
  QTest::addColumn<double>("ms");
  QTest::addColumn<int>("frame");  // index in a clip of 4 frames
  const Cine ten{10, {}, false}, swing{10, {}, true}, times{0, {0, 100, 300, 200}, false};
  const Cine both{0, {0, 100, 300, 200}, true};
  QTest::newRow("at once the first") << ten << 0 << 0.0 << 0;
  QTest::newRow("not before its time") << ten << 0 << 99.0 << 0;
  QTest::newRow("frames are dropped, not time") << ten << 0 << 250.0 << 2;
  QTest::newRow("a loop") << ten << 0 << 450.0 << 0;
  QTest::newRow("from the frame on screen") << ten << 3 << 150.0 << 0;
  QTest::newRow("back") << swing << 0 << 450.0 << 2;
  QTest::newRow("and forth") << swing << 0 << 650.0 << 0;
  QTest::newRow("15 a second where nothing is said") << Cine{} << 0 << 140.0 << 2;
  QTest::newRow("before the second's time") << times << 0 << 99.0 << 0;
  QTest::newRow("each its own time") << times << 0 << 399.0 << 1;
  QTest::newRow("after the long one") << times << 0 << 401.0 << 2;
  QTest::newRow("the last as long as on average") << times << 0 << 799.0 << 3;
  QTest::newRow("from the start again") << times << 0 << 801.0 << 0;
  QTest::newRow("times from the third on") << times << 2 << 201.0 << 3;
  QTest::newRow("back by the same times") << both << 0 << 801.0 << 2;
  QTest::newRow("back over the long one") << both << 0 << 1099.0 << 2;
}

void TestFramesOfSeries::clipsGoByTheClock() {
  QFETCH(Cine, cine);
  QFETCH(int, first);
  QFETCH(double, ms);
  QFETCH(int, frame);
  QCOMPARE(CineTrack(cine, {0, 3, cine.backAndForth}, first).pass(ms), frame);
  QCOMPARE(CineTrack(cine, {0, 0, cine.backAndForth}, 0).pass(ms), 0);
}

void TestFramesOfSeries::rates_data() {
  QTest::addColumn<Cine>("cine");
  QTest::addColumn<double>("rate");
  QTest::newRow("as recommended") << Cine{33, {0, 10, 10}, false} << 33.0;
  QTest::newRow("times on average") << Cine{0, {0, 100, 300}, false} << 5.0;
  QTest::newRow("times of nothing") << Cine{0, {0, 0, 0}, false} << 15.0;
  QTest::newRow("nothing said") << Cine{} << 15.0;
}

void TestFramesOfSeries::rates() {
  QFETCH(Cine, cine);
  QFETCH(double, rate);
  QCOMPARE(cineRate(cine), rate);
}

void TestFramesOfSeries::windowsAndTablesHaveNames() {
  const auto breast = frameWith([](Frame& frame) {
    frame.greys = {named("NORMAL", {2653, 900}, WindowFunction::sigmoid),
                   named("", {2713, 750}, WindowFunction::linear),
                   named("SOFTER", {}, WindowFunction::linear)};
    frame.greys[2].mapping.table = {0, {0, 0.5, 1}};
    frame.unit = "HU";
  });
  QStringList names;
  for (const GreyChoice& choice : greyChoices(*breast)) names << choice.name;
  const QStringList expected{QStringLiteral("Automatic"), QStringLiteral("NORMAL (900 / 2653), sigmoid"),
                             QStringLiteral("From file, 2 (750 / 2713)"), QStringLiteral("SOFTER, LUT"),
                             QStringLiteral("Brain (80 / 40)")};
  QCOMPARE(names.mid(0, 5), expected);
  const SeriesState chosen = withGrey({}, greyChoices(*breast)[3]);
  QCOMPARE(greyText(chosen, {}, *breast), QStringLiteral("LUT SOFTER"));
  QCOMPARE(greyText({}, {}, *breast), QStringLiteral("W 900 L 2653, sigmoid"));
  // A file without windows offers none.
  QCOMPARE(greyChoices(*frameWith([](Frame& f) { f.greys.front().ofValues = true; })).size(), std::size_t(1));
}

void TestFramesOfSeries::aWindowStandsInForATable() {
  const auto negative = frameWith([](Frame& frame) {
    frame.greys.front().mapping.table = {0, {0, 0.5, 1}};
    frame.greys.front().mapping.inverted = true;
  });
  SeriesState state;
  QVERIFY(!frameGrey(state, {}, *negative).table.grey.empty());
  QVERIFY(frameGrey(state, {}, *negative).inverted);
  QVERIFY(!frameGrey(state, {.inverted = true}, *negative).inverted);
  state.window = {100, 50};
  const GreyMapping grey = frameGrey(state, {}, *negative);
  QVERIFY(grey == (GreyMapping{{100, 50}, WindowFunction::linear, {}, true}));
  state.window = {100, -50};
  QVERIFY2(!frameGrey(state, {}, *negative).inverted, "an inverted window of an inverted picture");
}

void TestFramesOfSeries::aSeriesHasOneWindow_data() {
  QTest::addColumn<QByteArray>("modality");
  QTest::addColumn<bool>("placed");
  QTest::addColumn<int>("choice");
  QTest::addColumn<QString>("text");
  const QString ofSeries = QStringLiteral("W 200 L 100"), own = QStringLiteral("W 5 L 2");
  const auto row = [](const char* name, const char* modality, bool placed, FrameWindow choice,
                      const QString& text) {
    QTest::newRow(name) << QByteArray(modality) << placed << int(choice) << text;
  };
  row("MR", "MR", true, FrameWindow::usual, ofSeries);
  row("MR without a place", "MR", false, FrameWindow::usual, ofSeries);
  row("MR, each its own", "MR", true, FrameWindow::ofEach, own);
  row("projections", "MG", false, FrameWindow::usual, own);
  row("ultrasound", "US", false, FrameWindow::usual, own);
  row("angiograms", "XA", false, FrameWindow::usual, own);
  row("slices of a rotating C-arm", "XA", true, FrameWindow::usual, ofSeries);
  row("projections, one for all", "MG", false, FrameWindow::ofSeries, ofSeries);
}

void TestFramesOfSeries::aSeriesHasOneWindow() {
  QFETCH(QByteArray, modality);
  QFETCH(bool, placed);
  QFETCH(int, choice);
  QFETCH(QString, text);
  Series series = ct(7);
  series.modality = modality.toStdString();
  series.acquired.calibrated = placed;
  Frame frame;
  frame.size = {3, 2};
  frame.values = std::vector<float>{0, 1, 2, 3, 4, 5};
  frame.greys = {named("", {2, 5}, WindowFunction::linear)};
  frame.greys[0].mapping.inverted = true;
  const LoadedFramePtr shown =
      *shownFrame(series, {keyOf(series), 0}, frame, {}, {named("", {100, 200}, WindowFunction::linear)});
  SeriesState state;
  state.frameWindow = FrameWindow(choice);
  QCOMPARE(greyText(state, {}, *shown), text);
  QVERIFY2(frameGrey(state, {}, *shown).inverted, "its pixels say so");
  state.window = {50, 60};
  QCOMPARE(greyText(state, {}, *shown), QStringLiteral("W 60 L 50"));
}

void TestFramesOfSeries::onlyTrueMmAreSaid_data() {
  QTest::addColumn<PixelSize>("pixel");
  QTest::addColumn<QString>("size");
  QTest::addColumn<QString>("place");  // text at column 2, row 1
  const auto row = [](const char* name, PixelSize pixel, const char* size, const char* place) {
    QTest::newRow(name) << pixel << QString::fromLatin1(size) << QString::fromLatin1(place);
  };
  row("nothing known", {{1, 0.8}, PixelSizeKind::unknown}, "not calibrated: px", "2, 1 px");
  row("at the detector", {{0.5, 0.5}, PixelSizeKind::atDetector}, "0.5 mm a pixel, at detector",
      "2, 1 px (1.0, 0.5 mm, at detector)");
  row("calibrated", {{0.5, 0.25}, PixelSizeKind::calibrated}, "0.5 x 0.25 mm a pixel, calibrated",
      "2, 1 px (1.0, 0.3 mm, calibrated)");
  row("magnified", {{0.5, 0.5}, PixelSizeKind::magnified}, "0.5 mm a pixel, magnification corrected",
      "2, 1 px (1.0, 0.5 mm, magnification corrected)");
  row("a film", {{0.5, 0.5}, PixelSizeKind::filmScan}, "0.5 mm a pixel, film scan",
      "2, 1 px (1.0, 0.5 mm, film scan)");
  row("of the patient", {{0.5, 0.5}, PixelSizeKind::patient}, "0.5 mm a pixel", "2, 1 px (1.0, 0.5 mm)");
}

void TestFramesOfSeries::onlyTrueMmAreSaid() {
  QFETCH(PixelSize, pixel);
  QFETCH(QString, size);
  QFETCH(QString, place);
  const auto frame = frameWith([&](Frame& f) { f.pixel = pixel; });
  QCOMPARE(pixelSizeText(*frame), size);
  QCOMPARE(pixelPlaceText(*frame, {2, 1}), place);
  QCOMPARE(pixelValueText(*frame, {2, 1}), QStringLiteral("5"));
}

void TestFramesOfSeries::regionsHaveMmOfTheirOwn() {
  const auto heart = frameWith([](Frame& frame) {
    frame.values = {};
    frame.greys.clear();
    frame.rgb.assign(18, 7);
    frame.rgb[17] = 86;
    frame.regions = {{{1, 0}, {2, 0}, 3, 3, {0.1, 0.2}}, {{0, 1}, {2, 1}, 4, 3, {0.1, 0.2}}};
  });
  QCOMPARE(pixelPlaceText(*heart, {2, 0}), QStringLiteral("2, 0 px (1.0, 0.0 mm in its region)"));
  QCOMPARE(pixelPlaceText(*heart, {2, 1}), QStringLiteral("2, 1 px"));  // its horizontal unit is seconds
  QCOMPARE(pixelPlaceText(*heart, {0, 0}), QStringLiteral("0, 0 px"));
  QCOMPARE(pixelValueText(*heart, {2, 1}), QStringLiteral("R 7 G 7 B 86"));
  QVERIFY(greyChoices(*heart).empty());
}

void TestFramesOfSeries::thePoolForgetsWhatWasUsedLongestAgo() {
  const Series series = clip();
  const auto make = [&](int index) {
    Frame frame;
    frame.size = {10, 10};
    frame.rgb.assign(300, 1);
    return *shownFrame(series, {keyOf(series), index}, frame);
  };
  FramePool pool(900);
  for (int n = 0; n < 3; ++n) pool.put(make(n));
  QCOMPARE(pool.bytes(), std::size_t(900));
  QVERIFY(pool.find({keyOf(series), 0}));
  pool.put(make(3));
  QCOMPARE(pool.bytes(), std::size_t(900));
  QVERIFY(pool.contains({keyOf(series), 0}));
  QVERIFY(!pool.contains({keyOf(series), 1}));
  QCOMPARE(pool.heldOf(keyOf(series), {}), (std::vector<int>{0, 2, 3}));
  QVERIFY(pool.heldOf(keyOf(series), "presentation.dcm").empty());
  pool.put(make(3));
  QCOMPARE(pool.bytes(), std::size_t(900));
}

VOLUMEN_TEST(TestFramesOfSeries);
#include "tst_frames_of_series.moc"
