// Guards single pictures of one series shown as one stack: how it is scrolled, and what each picture keeps as
// its own. Marks and sessions stay with the picture. Synthetic radiographs of several sizes and kinds, and
// real localizers. Real wheel, key and mouse events.
#include <QTemporaryDir>
#include <algorithm>

#include "io/open.h"
#include "io/study/frame_series.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/gestures.h"
#include "tests/ui/stills_window.h"
#include "tests/unit/suite.h"
#include "ui/controller/open_session.h"
#include "ui/workspace/key_images.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Act = std::function<void(StillsWindow&)>;

}  // namespace

class TestPictureStacksShown : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesIsOneStack();
  void allWaysThroughIt_data();
  void allWaysThroughIt();
  void eachPictureKeepsItsOwn();
  void withoutAWindowItIsThatOfItsValues();
  void aWindowSetIsThatOfAll();
  void theClockGoesThroughIt();
  void marksStayWithTheirPicture();
  void itComesBackFromASession();
  void aSessionOfBeforeOpens();
  void realOnesAreStacked_data();
  void realOnesAreStacked();
};

void TestPictureStacksShown::aSeriesIsOneStack() {
  StillsWindow w;
  QVERIFY(w.isOpen());
  const OpenStudies& open = w.window.document().open;
  QVERIFY(open.volumes().empty());
  QCOMPARE(open.pictures().size(), std::size_t(1));
  QCOMPARE(frameCount(w.stack()), stillCount);
  for (int n = 0; n < stillCount; ++n)
    QCOMPARE(w.stack().files[std::size_t(n)], w.data.path(n + 1).toStdString());
  QCOMPARE(w.view()->stackBar()->place.count, stillCount);
  QCOMPARE(w.steps(), 0);
}

void TestPictureStacksShown::allWaysThroughIt_data() {
  QTest::addColumn<Act>("act");
  QTest::addColumn<int>("frame");
  const auto row = [](const char* name, int frame, const Act& act) { QTest::newRow(name) << act << frame; };
  const auto key = [](Qt::Key pressed) {
    return [pressed](StillsWindow& w) { QTest::keyClick(w.view(), pressed); };
  };
  row("a notch of the wheel", 1, [](StillsWindow& w) { wheel(w.view(), -1); });
  row("three notches", 3, [](StillsWindow& w) { wheel(w.view(), -3); });
  row("the arrow down", 1, key(Qt::Key_Down));
  row("Page Down", 3, key(Qt::Key_PageDown));
  row("End", 3, key(Qt::Key_End));
  row("the bar of the stack", 2, [](StillsWindow& w) {
    const QPointF third = w.view()->stackBar()->partOf(2, 2).center();
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, QPoint(w.view()->width() - 5, int(third.y())));
  });
  row("a number typed", 2, [](StillsWindow& w) {
    QTest::keyClick(w.view(), Qt::Key_G);
    auto* field = w.child<QLineEdit>("placeNumber");
    QVERIFY(field && field->isVisible());
    QTest::keyClicks(field, QStringLiteral("3"));
    QTest::keyClick(field, Qt::Key_Return);
  });
}

void TestPictureStacksShown::allWaysThroughIt() {
  QFETCH(Act, act);
  QFETCH(int, frame);
  StillsWindow w;
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  act(w);
  QVERIFY(w.showsStill(frame));
  QCOMPARE(w.steps(), 1);
  w.act("undo");
  QVERIFY(w.workspace() == before);
  QVERIFY(w.showsStill(0));
  w.act("redo");
  QVERIFY(w.showsStill(frame));
}

// Each picture keeps size, mm, window, side and view, and fits its view.
void TestPictureStacksShown::eachPictureKeepsItsOwn() {
  StillsWindow w;
  QVERIFY(w.isOpen());
  for (int n = 0; n < stillCount; ++n) {
    QVERIFY(w.showsStill(n));
    const Still& still = stills[n];
    const VoxelGeometry& geometry = w.view()->frame()->geometry();
    QCOMPARE(geometry.size, glm::ivec3(still.columns, still.rows, 1));
    QVERIFY(std::abs(geometry.spacing().x - still.mm) < 1e-9);
    const SlicePlane plane = *w.view()->plane();
    const double fitted =
        still.mm * std::max(double(still.columns) / plane.size.x, double(still.rows) / plane.size.y);
    QVERIFY2(std::abs(plane.mmPerPixel / fitted - 1) < 1e-6, "the whole picture, as large as it can be");
    const Overlays corners = w.view()->overlays();
    const QStringList said = corners.topLeft + corners.topRight;
    QVERIFY(said.contains(QStringLiteral("Frame %1 / 4").arg(n + 1)));
    const bool isSaid =
        said.contains(QStringLiteral("%1 %2").arg(QLatin1String(still.side), QLatin1String(still.view)));
    QCOMPARE(isSaid, still.side[0] != 0);
    if (!still.isColour()) QVERIFY(corners.bottomRight.contains(QLatin1String(still.window)));
    QTest::keyClick(w.view(), Qt::Key_Down);
  }
  // Scrolls back.
  for (int n = stillCount - 2; n >= 0; --n) {
    QTest::keyClick(w.view(), Qt::Key_Up);
    QVERIFY(w.showsStill(n));
  }
}

void TestPictureStacksShown::withoutAWindowItIsThatOfItsValues() {
  const Stills data;
  QVERIFY(data.write());
  QVERIFY(makeTwoValues(data.path(1), 0, 100) && makeTwoValues(data.path(2), 1000, 3000));
  PicturesWindow w(data.folder.path());
  QVERIFY(w.shows(0));
  QVERIFY(w.view()->overlays().bottomRight.contains(QStringLiteral("W 100 L 50")));
  w.view()->setFocus();
  QTest::keyClick(w.view(), Qt::Key_Down);
  QVERIFY(w.shows(1));
  QVERIFY(w.view()->overlays().bottomRight.contains(QStringLiteral("W 2000 L 2000")));
}

// The window applies to all pictures until it is undone.
void TestPictureStacksShown::aWindowSetIsThatOfAll() {
  StillsWindow w;
  QVERIFY(w.isOpen());
  const Workspace before = w.workspace();
  drag(w.view(), {400, 300}, {440, 320});
  QVERIFY(w.workspace().series.at(keyOf(w.stack())).window);
  const auto text = w.view()->overlays().bottomRight;
  QVERIFY(!text.contains(QLatin1String(stills[0].window)));
  QTest::keyClick(w.view(), Qt::Key_End);
  QTest::keyClick(w.view(), Qt::Key_Up);
  QVERIFY(w.shows(2));
  QCOMPARE(w.view()->overlays().bottomRight, text);
  while (w.steps() > 0) w.act("undo");
  QVERIFY(w.workspace() == before);
  QTest::keyClick(w.view(), Qt::Key_PageDown);
  QTest::keyClick(w.view(), Qt::Key_Up);
  QVERIFY(w.showsStill(2));
}

void TestPictureStacksShown::theClockGoesThroughIt() {
  StillsWindow w;
  QVERIFY(w.isOpen());
  QTest::keyClick(w.view(), Qt::Key_C);
  QTRY_VERIFY_WITH_TIMEOUT(frameIn(w.view())->key.index > 0, longest);
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.view()->isPlaying());
  QTRY_COMPARE(frameIn(w.view())->key.index, w.frame());
  QVERIFY(w.showsStill(w.frame()));
}

void TestPictureStacksShown::marksStayWithTheirPicture() {
  StillsWindow w;
  QVERIFY(w.isOpen());
  QTest::keyClick(w.view(), Qt::Key_Down);
  QVERIFY(w.showsStill(1));
  const Workspace before = w.workspace();
  const QPointF middle = QRectF(w.view()->rect()).center();
  w.act("lengthTool");
  drag(w.view(), middle - QPointF(60, 20), middle + QPointF(60, 20));
  QTest::keyClick(&w.window, Qt::Key_K);
  const Measurement drawn = w.workspace().measurements.at(0);
  const KeyImage marked = w.workspace().keyImages.at(0);
  QVERIFY(drawn.series == keyOf(w.stack()) && drawn.shape.frame);
  QCOMPARE(drawn.shape.frame->instance, std::string("1.2.3.4.2"));
  QCOMPARE(marked.sopInstanceUid, std::string("1.2.3.4.2"));
  QCOMPARE(keyImagesOf(w.workspace(), w.stack()), std::vector<int>{1});
  for (int n = 0; n < stillCount; ++n) {
    QTest::keyClick(w.view(), Qt::Key_Home);
    for (int step = 0; step < n; ++step) QTest::keyClick(w.view(), Qt::Key_Down);
    QVERIFY(w.shows(n));
    QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(n == 1));
    QCOMPARE(w.view()->stackBar()->keyImages, std::vector<int>{1});
  }
  while (!w.workspace().measurements.empty()) w.act("undo");
  QVERIFY(w.workspace() == before);
}

void TestPictureStacksShown::itComesBackFromASession() {
  StillsWindow w;
  QVERIFY(w.isOpen());
  QTest::keyClick(w.view(), Qt::Key_End);
  QTest::keyClick(w.view(), Qt::Key_Up);
  QVERIFY(w.showsStill(2));
  const QPointF middle = QRectF(w.view()->rect()).center();
  w.act("lengthTool");
  drag(w.view(), middle - QPointF(40, 20), middle + QPointF(40, 20));
  QTest::keyClick(&w.window, Qt::Key_K);
  wheel(w.view(), 2, Qt::ControlModifier);  // zooms in
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("s.volumen"));
  QVERIFY(saveSession(path.toStdString(), w.workspace()));
  const Result<OpenedSession> opened = openSession(path.toStdString());
  QVERIFY(opened.ok());
  QVERIFY2(opened->problems.isEmpty(), qPrintable(opened->problems.join(u' ')));
  const Workspace& again = opened->workspace;
  QVERIFY(again.series == w.workspace().series && again.views == w.workspace().views);
  QVERIFY(again.measurements == w.workspace().measurements && again.keyImages == w.workspace().keyImages);
  PicturesWindow other(path);
  QVERIFY(other.shows(2));
  QCOMPARE(other.view()->drawnMeasurements().size(), std::size_t(1));
  QCOMPARE(other.window.document().open.pictures().size(), std::size_t(1));
}

// The session was saved when each size was a separate series and files were ordered by path.
void TestPictureStacksShown::aSessionOfBeforeOpens() {
  const Stills data;
  QVERIFY(data.write());
  const Result<Study> study = openStudy(data.folder.path().toStdString());
  QVERIFY(study && study->volumes.size() == 2 && study->images.size() == 1);
  std::vector<Series> all = study->volumes;
  all.push_back(frameSeriesOfPaths(*study).front());
  Workspace saved = withLayout({}, Layout::four);
  for (std::size_t n = 0; n < all.size(); ++n) {
    saved = withFrames(saved, firstComparedId + int(n), all[n]);
    saved = withKeyImageToggled(saved, *keyImageOf(all[n], frameCount(all[n]) - 1));
    saved.editView(firstComparedId + int(n)).flats.edit(keyOf(all[n])).frame = frameCount(all[n]) - 1;
  }
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("s.volumen"));
  QVERIFY(saveSession(path.toStdString(), saved));
  const Result<OpenedSession> opened = openSession(path.toStdString());
  QVERIFY(opened.ok());
  QVERIFY2(opened->problems.isEmpty(), qPrintable(opened->problems.join(u' ')));
  for (std::size_t n = 0; n < all.size(); ++n) {
    const ViewId cell = firstComparedId + int(n);
    const Series* found = seriesIn(opened->workspace, cell);
    QVERIFY(found);
    QCOMPARE(found->sopInstanceUids, all[n].sopInstanceUids);
    QCOMPARE(flatLookOf(opened->workspace.view(cell)).frame, frameCount(all[n]) - 1);
    QCOMPARE(keyImagesOf(opened->workspace, *found), std::vector<int>{frameCount(all[n]) - 1});
  }
  // From now on the stack is opened.
  const auto isFolder = [](const auto& place) { return int(place.second->images.size()) == stillCount; };
  const auto found = std::ranges::find_if(opened->studies, isFolder);
  QVERIFY(found != opened->studies.end());
  QVERIFY(found->second->volumes.empty());
  QCOMPARE(frameCount(frameSeries(*found->second).front()), stillCount);
}

void TestPictureStacksShown::realOnesAreStacked_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<int>("frames");
  QTest::addColumn<QString>("sides");  // for some frames: frame, side at the right, side at the bottom
  const auto row = [](const char* name, const char* path, int frames, const char* sides) {
    QTest::newRow(name) << QString::fromLatin1(path) << frames << QString::fromLatin1(sides);
  };
  row("a localizer in three planes", "dicom-geometry/mr-localizer-ge-3plane-21", 21,
      "0 L P, 6 L P, 7 P I, 14 L I, 20 L I");
  row("a scout from the side and from the front", "dicom-pydicom/test_files/dicomdirtests/98892001/CT2N", 2,
      "0 A I, 1 L I");
  row("projections all around", "dicom-pydicom/test_files/dicomdirtests/98892003/MR700", 7, "");
}

void TestPictureStacksShown::realOnesAreStacked() {
  QFETCH(QString, path);
  QFETCH(int, frames);
  QFETCH(QString, sides);
  const std::string data = dataPath(path.toStdString());
  NEED_DATA(data);
  PicturesWindow w(QString::fromStdString(data));
  QVERIFY(w.shows(0));
  w.view()->setFocus();
  QCOMPARE(w.view()->stackBar()->place.count, frames);
  const QStringList all = sides.split(QStringLiteral(", "), Qt::SkipEmptyParts);
  for (const QString& side : all) {
    const QStringList words = side.split(u' ');
    while (w.frame() < words[0].toInt()) QTest::keyClick(w.view(), Qt::Key_Down);
    QVERIFY(w.shows(words[0].toInt()));
    QCOMPARE(w.view()->overlays().right, words[1]);
    QCOMPARE(w.view()->overlays().bottom, words[2]);
  }
  QTest::keyClick(w.view(), Qt::Key_End);
  QVERIFY(w.shows(frames - 1));
  wheel(w.view(), 1);
  QVERIFY(w.shows(frames - 2));
}

VOLUMEN_TEST(TestPictureStacksShown);
#include "tst_picture_stacks.moc"
