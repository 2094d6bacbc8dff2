// Guards that each kind of addition takes one file and one table row. Uses the files of this folder through
// the window by real events, or through the room's function.
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QTemporaryDir>
#include <QToolBar>
#include <QTreeView>

#include <cmath>

#include "io/files/image_file.h"
#include "io/files/write_volume.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/session_json.h"
#include "viewer/render/render.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestAdditions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aFeatureStandsInItsMenuAndActs();
  void aDerivedValueFollowsTheSession();
  void aSinkGetsThePicture();
  void aPanelIsATabThatFollowsTheSession();
  void aToolOfSlicesGetsTheDrag();
  void aToolOfSegmentsEditsThem();
  void aToolOf3DGetsTheDrag();
  void aFormatIsReadAndWritten();
  void aKindOfViewIsShownAndSaved();
  void aSourceOfStudiesIsListed();
  void aProjectionModeIsDrawnRight();
  void aProjectionModeIsShownAndSaved();
};

void TestAdditions::aFeatureStandsInItsMenuAndActs() {
  Journey w;
  const QList<QAction*> help = w.child<QMenu>("helpMenu")->actions();
  QCOMPARE(help.front()->text(), QStringLiteral("Greet"));
  QTest::keyClick(&w.window, Qt::Key_G, Qt::ControlModifier);
  QCOMPARE(w.child<QLabel>("toldText")->text(), QStringLiteral("Good morning"));
}

void TestAdditions::aDerivedValueFollowsTheSession() {
  const auto bright = [](const LoadedSeriesPtr& series) {
    const auto& values = std::get<std::vector<std::int16_t>>(series->volume->stored());
    return QString::number(std::ranges::count_if(values, [](int value) { return value > 0; }));
  };
  const LoadedSeriesPtr small = ballSeries(20, 6), large = ballSeries();
  MeasureWindow w(small);
  const auto* label = w.child<QLabel>("brightness");
  QTRY_COMPARE_WITH_TIMEOUT(label->text(), bright(small), longest);
  w.session().show(large);
  QTRY_COMPARE_WITH_TIMEOUT(label->text(), bright(large), longest);
  QVERIFY(bright(small) != bright(large));
  w.session().show(nullptr);
  QTRY_COMPARE_WITH_TIMEOUT(label->text(), QString(), longest);
}

void TestAdditions::aSinkGetsThePicture() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("view.bmp"));
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage seen = w.view()->capture();
  w.child<QAction>("saveBitmap")->trigger();
  w.view()->scroll(3);
  answer(w, "bitmapDialog", path);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<QLabel>("toldText")->text(), QStringLiteral("Saved the bitmap"), longest);
  QCOMPARE(QImage(path).convertToFormat(QImage::Format_RGB32), seen);
}

void TestAdditions::aPanelIsATabThatFollowsTheSession() {
  MeasureWindow w;
  auto* dock = w.child<QDockWidget>("notesDock");
  QVERIFY(w.window.tabifiedDockWidgets(w.child<QDockWidget>("lightsDock")).contains(dock));
  QVERIFY(w.child<QMenu>("panelsMenu")->actions().contains(dock->toggleViewAction()));
  w.child<QAction>("interpolate")->trigger();
  QCOMPARE(w.child<QLabel>("notesPanel")->text(), QString::number(w.window.session().undoStack().index()));
}

void TestAdditions::aToolOfSlicesGetsTheDrag() {
  MeasureWindow w;
  FlatView* view = w.view();
  QTest::keyClick(view, Qt::Key_J);
  const auto window = [&] { return w.session().workspace().series.at(view->state().series).window; };
  drag(view, {90, 90}, {90, 60});
  QVERIFY(window());
  const double before = window()->centre;
  drag(view, {90, 90}, {90, 70});
  QCOMPARE(window()->centre, before + 20);
}

// The segment is previewed while the button is held, and made on release. Esc makes none.
void TestAdditions::aToolOfSegmentsEditsThem() {
  SegmentWindow w;
  QAction* tool = w.child<QAction>("stampTool");
  QVERIFY(w.child<QMenu>("segmentsMenu")->actions().contains(tool));
  tool->trigger();
  const QPoint at = w.showPlace(inSmallBall);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull() && w.coloured() == 0, longest);
  const Workspace before = w.workspace();
  QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() > 0, longest);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() == 0, longest);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle() && w.isAs(before));
  const glm::dvec3 middle = w.view()->plane()->patientFromPixel({double(at.x()), double(at.y())});
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QCOMPARE(w.session().undoStack().undoText(), QStringLiteral("Stamp"));
  QCOMPARE(w.voxels(1), voxelsWhere([&](glm::dvec3 p) { return glm::distance(p, middle) <= 4; }));
  QVERIFY(w.segment(0).label == "Stamp");
}

void TestAdditions::aToolOf3DGetsTheDrag() {
  Journey w;
  w.window.session().show(ballSeries());
  QVERIFY(w.settle());
  const QAction* tool = w.child<QAction>("spinTool");
  QVERIFY(w.child<QMenu>("toolsMenu")->actions().contains(tool));
  QVERIFY(w.child<QToolBar>("tools")->actions().contains(tool));
  QTest::keyClick(w.window.view(), Qt::Key_U);
  QVERIFY(tool->isChecked());
  const Camera before = w.window.view()->camera();
  drag(w.window.view(), {200, 200}, {260, 200});
  QCOMPARE(w.window.session().undoStack().undoText(), QStringLiteral("Spin"));
  QVERIFY(w.window.view()->camera() != before);
}

void TestAdditions::aFormatIsReadAndWritten() {
  VolumeParts parts;
  parts.geometry.size = {2, 2, 2};
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6, 7, 250};
  parts.values = bytes;
  std::vector<std::string> warnings;
  const VolumePtr volume = *Volume::make(std::move(parts), warnings);
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("made.cube")).toStdString();
  QVERIFY(isVolumeFileName(path));
  QVERIFY(writeVolume(*volume, path).ok());
  const auto series = readImageFileHeaders(path);
  QVERIFY(series);
  QCOMPARE(QString::fromStdString(series->front().format), QStringLiteral("Cube"));
  const auto loaded = loadImageFile(series->front());
  QVERIFY(loaded);
  QVERIFY(std::get<std::vector<std::uint8_t>>(loaded->drawn->stored()) == bytes);
}

void TestAdditions::aKindOfViewIsShownAndSaved() {
  Journey w;
  w.window.session().show(ballSeries());
  QVERIFY(w.settle());
  w.child<QAction>("layoutTwo")->trigger();
  w.window.session().setFocus(firstComparedId);
  auto* action = w.child<QAction>("showFacts");
  QVERIFY(w.child<QMenu>("kindMenu")->actions().contains(action));
  action->trigger();
  const auto* view = w.child<QWidget>("factsView4");
  QVERIFY(view && view->isVisible());
  const Workspace shown = w.window.session().workspace();
  const auto text = sessionToJson(shown, "/");
  QVERIFY(text && text->find("\"facts\"") != std::string::npos);
  const auto find = [&](const SavedSeries&) { return shown.series.begin()->second.series; };
  QVERIFY(sessionFromJson(*text, find)->workspace == shown);
  w.child<QAction>("showAxial")->trigger();
  QVERIFY(!view->isVisible());
}

void TestAdditions::aSourceOfStudiesIsListed() {
  Journey w;
  w.child<QAction>("showBrowser")->trigger();
  auto* source = w.child<QComboBox>("browserSource");
  QVERIFY(source->isVisible());
  source->setCurrentText(QStringLiteral("Shelf"));
  auto* tree = w.child<QTreeView>("browserTree");
  QTRY_COMPARE_WITH_TIMEOUT(tree->model()->rowCount(), 1, longest);
  tree->setCurrentIndex(tree->model()->index(0, 0));
  QTest::keyClick(tree, Qt::Key_Return);
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QLabel>("bannerText")->text().contains(QStringLiteral("locked")), longest);
}

// The 11 values along the view rise by 10 per voxel and stay constant in the half voxels at both ends.
void TestAdditions::aProjectionModeIsDrawnRight() {
  RenderCaches caches(
      volumeOf<std::int16_t>({3, 11, 3}, glm::dmat3(1), [](glm::dvec3 p) { return 10 * p.y; }));
  const auto scene = sceneFromJson(R"({"mode": "deviation", "window": {"centre": 50, "width": 100}})");
  QVERIFY(scene);
  RenderOptions options;
  options.size = {9, 9};
  const auto plan = makePlan(*scene, caches.facts(), options);
  QVERIFY(plan && explain(*plan).find("mode deviation has no faster method") != std::string::npos);
  const double deviation = std::sqrt((100 * 1000 / 12.0 + 50 * 50) / 11);
  QVERIFY(std::abs(render(*plan, caches)->picture.row(4)[4 * 4] - deviation / 100) < 1e-6);
  options.method = Method::blend;
  QCOMPARE(QString::fromStdString(makePlan(*scene, caches.facts(), options).message()),
           QStringLiteral("--mode deviation is drawn by --method reference alone."));
}

void TestAdditions::aProjectionModeIsShownAndSaved() {
  Journey w;
  w.window.session().show(ballSeries());
  QVERIFY(w.settle());
  auto* mode = w.child<QComboBox>("mode");
  mode->setCurrentText(QStringLiteral("Deviation"));
  Q_EMIT mode->activated(mode->currentIndex());
  QVERIFY(w.settle());
  QCOMPARE(w.window.session().scene().mode, Mode(4));
  const QImage picture = w.window.view()->picture();
  QVERIFY(picture.pixelColor(picture.rect().center()).red() > 0);
  QVERIFY(sceneToJson(w.window.session().scene()).find("\"deviation\"") != std::string::npos);
}

VOLUMEN_TEST(TestAdditions);
#include "tst_additions.moc"
