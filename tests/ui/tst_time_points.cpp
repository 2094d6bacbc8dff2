// Guards the time points of a view. Slider, keys and cine go through the volumes of one file, and only the
// volume changes. Real events on a file of several volumes.
#include <QAbstractButton>
#include <QContextMenuEvent>
#include <QMenu>
#include <QMimeData>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "tests/ui/gestures.h"
#include "tests/ui/perfusion_window.h"
#include "tests/unit/suite.h"
#include "ui/panels/studies_panel.h"
#include "ui/views/cine_bar.h"
#include "ui/views/drawn_measurement.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/time_points.h"

using namespace volumen;
using namespace volumen::tests;

class TestTimePoints : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { path_ = fourVolumes(folder_); }
  void keysStepInAllViewsOfTheGroup();
  void theSliderIsThereWhereThereAreSeveral();
  void aClipRunsInTime();
  void itRunsOnWhileSomethingElseIsChanged();
  void whatIsMeasuredIn3dIsOfOneStep();
  void theListHasOneRow();
  void theSliderIsIn3dToo();

 private:
  QTemporaryDir folder_;
  QString path_;
};

void TestTimePoints::keysStepInAllViewsOfTheGroup() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  drag(w.view(), {60, 60}, {90, 80});                                                  // window
  drag(w.view(), {60, 100}, {60, 70}, Qt::RightButton);                                // zoom
  drag(w.view(coronalViewId), {40, 40}, {60, 55}, Qt::LeftButton, Qt::ShiftModifier);  // crosshair
  const Workspace before = w.workspace();
  const SeriesKey first = before.view(axialViewId).series;
  w.key(Qt::Key_Right);
  QVERIFY(w.shows(200));
  const Workspace& after = w.workspace();
  const SeriesKey second = after.view(axialViewId).series;
  QVERIFY(first != second);
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    QCOMPARE(after.view(id).series, second);
    QVERIFY(flatLookOf(after.view(id)) == flatLookOf(before.view(id)));
  }
  QCOMPARE(after.view(sceneViewId).series, second);
  QVERIFY(after.view(sceneViewId).scenes.at(second) == before.view(sceneViewId).scenes.at(first));
  QVERIFY(after.series.at(second).window && after.series.at(second).window == before.series.at(first).window);
  const auto crosshair = [](const Workspace& of, const SeriesKey& key) {
    return of.crosshairs.at(frameOfReference(*of.series.at(key).series));
  };
  QVERIFY(crosshair(after, second) == crosshair(before, first));
  QCOMPARE(w.corner().section(QLatin1Char('\n'), 2, 2), QStringLiteral("time point 2 of 4"));
  w.key(Qt::Key_Left);
  w.key(Qt::Key_Left);
  QVERIFY(w.shows(100));
  w.key(Qt::Key_Right);
  QSignalSpy settled(w.view(), &FlatView::settled);
  w.key(Qt::Key_Right);
  QVERIFY(w.shows(300));
  QTRY_VERIFY_WITH_TIMEOUT(settled.count() > 0, longest);
  w.shot("time-points");
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows(100));
  QVERIFY(w.workspace().view(axialViewId).series == first);
}

void TestTimePoints::theSliderIsThereWhereThereAreSeveral() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.slider()->isVisible());
  QCOMPARE(w.slider()->maximum(), Perfusion::steps - 1);
  QTest::mouseClick(w.slider(), Qt::LeftButton, {}, {w.slider()->width() - 3, w.slider()->height() / 2});
  QVERIFY(w.slider()->value() > 0);
  QCOMPARE(w.slider(coronalViewId)->value(), w.slider()->value());
  Perfusion alone(QStringLiteral("phantom:sphere:16"));
  QVERIFY(alone.opened());
  QVERIFY(!alone.slider()->isVisible());
}

void TestTimePoints::aClipRunsInTime() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  w.session().setFocus(axialViewId);
  w.view()->setFocus();
  const int before = w.session().undoStack().count();
  const glm::dvec3 place = w.view()->plane()->centre;
  QTest::keyClick(w.view(), Qt::Key_C);
  for (const int value : {200, 300, 400, 100}) QVERIFY(w.shows(value));
  QTest::keyClick(w.view(), Qt::Key_C);
  QCOMPARE(w.view()->plane()->centre, place);
  QCOMPARE(w.session().undoStack().count(), before + 1);
}

void TestTimePoints::itRunsOnWhileSomethingElseIsChanged() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  w.session().setFocus(axialViewId);
  w.view()->setFocus();
  const int before = w.session().undoStack().index();
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(w.shows(200));
  drag(w.view(coronalViewId), {60, 60}, {90, 80});
  const QString changed = w.session().undoStack().undoText();
  for (const int value : {300, 400, 100}) QVERIFY(w.shows(value));
  QVERIFY(w.view()->isPlaying());
  QTest::mouseClick(w.view()->findChild<QAbstractButton*>(QStringLiteral("cinePlay")), Qt::LeftButton);
  QVERIFY(!w.view()->isPlaying());
  QCOMPARE(w.session().undoStack().index(), before + 2);
  QCOMPARE(w.session().undoStack().undoText(), changed);
}

// The measurement is neither drawn nor moved in other time points. Playback ends when something is drawn.
void TestTimePoints::whatIsMeasuredIn3dIsOfOneStep() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  VolumeView* scene = w.window.view();
  QVERIFY(scene->isVisible());
  w.session().edit(sceneViewId, QStringLiteral("opaque"), [](Scene& s) {
    s.transferFunction.points = {{50, {1, 1, 1}, 0.0}, {50, {1, 1, 1}, 1.0}};
  });
  w.session().setFocus(sceneViewId);
  const QPoint middle = scene->rect().center(), beside = middle + QPoint(20, 5);
  const auto click = [&](QPoint at) { QTest::mouseClick(scene, Qt::LeftButton, {}, at); };
  // Goes to another time point that is in memory.
  const auto step = [&] {
    const int next = (w.slider()->value() + 1) % 2;
    const auto isHeld = [&] {
      const auto all = timePointsOf(w.workspace(), w.workspace().view(axialViewId).series);
      return w.session().seriesNamed(keyOf(*all[std::size_t(next)])) != nullptr;
    };
    if (!QTest::qWaitFor(isHeld, longest)) return false;
    w.slider()->setValue(next);
    return scene->series() != nullptr;
  };
  const auto* bar = scene->findChild<CineBar*>();
  scene->togglePlay();
  QVERIFY(bar->isPlaying());
  w.child<QAction>("lengthTool")->trigger();
  click(middle);
  QVERIFY(!bar->isPlaying());
  QCOMPARE(scene->drawnMeasurements().size(), std::size_t(1));
  QVERIFY(step());
  QVERIFY(scene->drawnMeasurements().empty());
  click(middle);
  QVERIFY2(w.workspace().measurements.empty(), "it is the first end");
  click(beside);
  QCOMPARE(w.workspace().measurements.size(), std::size_t(1));
  const Measurement made = w.workspace().measurements[0];
  QCOMPARE(scene->drawnMeasurements()[0].handles.size(), std::size_t(2));
  QTest::mousePress(scene, Qt::LeftButton, {}, scene->drawnMeasurements()[0].handles[1].at.toPoint());
  QVERIFY(step());
  QTest::mouseEvent(QTest::MouseMove, scene, Qt::LeftButton, {}, beside + QPoint(0, 15));
  QTest::mouseRelease(scene, Qt::LeftButton, {}, beside + QPoint(0, 15));
  QVERIFY(w.workspace().measurements[0] == made);
}

// One row shows the number of time points, whichever is on screen. Other lists follow.
void TestTimePoints::theListHasOneRow() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  auto* tree = w.child<QTreeWidget>("studyTree");
  const auto rows = [&] {
    return tree->findItems(QStringLiteral("slices, axial"), Qt::MatchContains | Qt::MatchRecursive);
  };
  QCOMPARE(rows().size(), 1);
  QTreeWidgetItem* const row = rows().front();
  QVERIFY2(row->text(0).contains(QStringLiteral("4 time points")), qPrintable(row->text(0)));
  QVERIFY2(!row->text(0).contains(QLatin1Char('!')), "that the file holds several is no warning");
  QVERIFY2(row->toolTip(0).contains(QStringLiteral("time points 1, 2, 3, 4")), qPrintable(row->toolTip(0)));
  w.shot("time-points-row");
  w.key(Qt::Key_Right);
  w.key(Qt::Key_Right);
  QVERIFY(w.shows(300));
  const SeriesKey third = w.workspace().view(axialViewId).series;
  QVERIFY(row->font(0).bold());
  // A dragged row shows the current time point in another view.
  const std::unique_ptr<QMimeData> dragged(
      tree->model()->mimeData(tree->selectionModel()->selectedIndexes()));
  QVERIFY(dragged);
  const Series* meant = w.window.findChild<StudiesPanel*>()->seriesOf(*dragged);
  QVERIFY(meant && keyOf(*meant) == third);
  const int steps = w.session().undoStack().index();
  QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualItemRect(row).center());
  QVERIFY(w.workspace().view(axialViewId).series == third);
  QCOMPARE(w.session().undoStack().index(), steps);
  // Another series overlays all of them or none. They do not overlay each other.
  QMenu* overlays = w.child<QMenu>("overlayMenu");
  Q_EMIT overlays->aboutToShow();
  QCOMPARE(overlays->actions().size(), 1);
  // All are closed together.
  const QPoint at = tree->visualItemRect(row).center();
  QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree->viewport()->mapToGlobal(at));
  QCoreApplication::sendEvent(tree->viewport(), &event);
  auto* menu = w.child<QMenu>("studyMenu");
  QVERIFY(menu);
  menu->actions().front()->trigger();
  QVERIFY(w.workspace().series.empty());
  QCOMPARE(rows().size(), 0);
}

void TestTimePoints::theSliderIsIn3dToo() {
  openAlone();
  Journey w({path_});
  QVERIFY(w.settle());
  auto* slider = w.window.view()->findChild<QSlider*>();
  QVERIFY(slider && slider->isVisible());
  const QImage first = w.window.view()->grab().toImage();
  const QImage last = w.after([&] {
    QTest::mouseClick(slider, Qt::LeftButton, {}, {slider->width() - 3, slider->height() / 2});
  });
  QVERIFY(!last.isNull() && slider->value() > 0);
  w.shot("time-points-3d");
  const LoadedSeriesPtr shown = w.window.session().series();
  QCOMPARE(shown->volume->value(Perfusion::edge / 2, Perfusion::edge / 2, Perfusion::edge / 2),
           100.f * float(slider->value() + 1));
}

VOLUMEN_TEST(TestTimePoints);
#include "tst_time_points.moc"
