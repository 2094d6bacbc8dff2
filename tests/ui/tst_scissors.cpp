// Guards the scissors: the outlined tissue is removed along the lines of sight, from every view, as undo
// steps.
#include <QAbstractButton>

#include "tests/ui/gestures.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/camera_moves.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Presses, drags once around and returns to the start.
void drawAround(QWidget* view, QRectF area, Qt::KeyboardModifiers keys = {}, bool isReleased = true) {
  const QPointF corners[] = {area.topRight(), area.bottomRight(), area.bottomLeft(), area.topLeft()};
  QTest::mousePress(view, Qt::LeftButton, keys, area.topLeft().toPoint());
  QPointF from = area.topLeft();
  for (const QPointF corner : corners) {
    for (int n = 1; n <= 10; ++n)
      QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, keys,
                        (from + (corner - from) * n / 10.0).toPoint());
    from = corner;
  }
  if (isReleased) QTest::mouseRelease(view, Qt::LeftButton, keys, area.topLeft().toPoint());
}

// A window that shows a CT, with the scissors active.
struct Cutting {
  SessionFolder folder;
  Journey w;

  bool open() {
    w.window.open({folder.ct()});
    if (!w.settle()) return false;
    QTest::keyClick(&w.window, Qt::Key_X);
    return w.child<QAction>("scissorsTool")->isChecked();
  }
  QWidget* view() { return w.window.view(); }
  Session& session() { return w.window.session(); }
  VolumePtr volume() { return session().series() ? session().series()->volume : nullptr; }
  QRectF middle() { return {view()->width() * 0.4, view()->height() * 0.35, 70, 60}; }
  QImage cut(QRectF area, Qt::KeyboardModifiers keys = {}) {
    return w.after([&] { drawAround(view(), area, keys); });
  }
};

using Act = void (*)(Cutting& t);

}  // namespace

Q_DECLARE_METATYPE(Act)

class TestScissors : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsDrawnAroundGoes_data();
  void whatIsDrawnAroundGoes();
  void stepsAreUndoneAndMadeAgain();
  void twoInARowAreTwoSteps();
  void slicesShowWhatWasCut();
  void theOutlineIsSeen();
  void whatIsGivenUpCutsNothing_data();
  void whatIsGivenUpCutsNothing();
  void oneOfTwoCutsIsCancelled();
  void theWindowClosesWhileItCuts();
  void aSessionKeepsTheCuts();
  void itsMaskIsComputedOnce();
  void otherValuesCanBeCutToo();
};

void TestScissors::whatIsDrawnAroundGoes_data() {
  QTest::addColumn<bool>("perspective");
  QTest::addColumn<bool>("inside");
  QTest::newRow("parallel, inside") << false << true;
  QTest::newRow("parallel, outside by Ctrl") << false << false;
  QTest::newRow("perspective, inside") << true << true;
  QTest::newRow("perspective, outside by Ctrl") << true << false;
}

// A voxel is removed if its centre is seen inside the rectangle.
void TestScissors::whatIsDrawnAroundGoes() {
  QFETCH(bool, perspective);
  QFETCH(bool, inside);
  Cutting t;
  QVERIFY(t.open());
  if (perspective)
    QVERIFY(settles(t.w, [&] {
      t.session().edit(QStringLiteral("Perspective"), [&](Scene& s) {
        s.camera = withProjection(t.w.window.view()->camera(), Projection::perspective);
        s.camera->direction = {0.3, 0.9, 0.2};
      });
    }));
  const VolumePtr before = t.volume();
  const Camera camera = t.w.window.view()->camera();
  const glm::dvec2 size(t.view()->width(), t.view()->height());
  const QRectF area(t.middle().topLeft().toPoint(), t.middle().size());
  const QImage whole = t.w.window.view()->picture();
  const QImage cut = t.cut(area, inside ? Qt::NoModifier : Qt::ControlModifier);
  QVERIFY(!cut.isNull() && cut != whole);
  if (inside && !perspective) t.w.shot("scissors-cut");
  const VolumePtr after = t.volume();
  std::int64_t gone = 0;
  for (int k = 0; k < before->size().z; ++k)
    for (int j = 0; j < before->size().y; ++j)
      for (int i = 0; i < before->size().x; ++i) {
        const glm::dvec2 p = seenAt(camera, size, before->geometry().patientFromVoxel({i, j, k}));
        // Rounding may put what lies on the line on either side.
        const double off = std::min({std::abs(p.x - area.left()), std::abs(p.x - area.right()),
                                     std::abs(p.y - area.top()), std::abs(p.y - area.bottom())});
        if (off < 1e-6) continue;
        const bool isGone = area.contains(QPointF(p.x, p.y)) == inside;
        gone += isGone;
        QCOMPARE(after->value(i, j, k), isGone ? -1000.f : before->value(i, j, k));
      }
  QVERIFY(gone > 0 && gone < before->geometry().voxelCount());
}

void TestScissors::stepsAreUndoneAndMadeAgain() {
  Cutting t;
  QVERIFY(t.open());
  const QImage whole = t.w.window.view()->picture();
  const VolumePtr before = t.volume();
  auto* reset = t.w.child<QAction>("resetScissors");
  QVERIFY(!reset->isEnabled());
  const QImage once = t.cut(t.middle());
  QVERIFY(reset->isEnabled());
  const QImage twice = t.cut(t.middle().translated(-60, 0));
  QVERIFY(!once.isNull() && !twice.isNull() && whole != once && once != twice);
  QVERIFY(t.w.after("undo") == once);
  QVERIFY(t.w.after("undo") == whole);
  QCOMPARE(t.volume(), before);
  QVERIFY(t.w.after("redo") == once);
  QVERIFY(t.w.after("redo") == twice);
  QVERIFY(t.w.after("resetScissors") == whole);
  QVERIFY(!reset->isEnabled());
  QVERIFY(t.w.after("undo") == twice);
  QCOMPARE(t.session().undoStack().undoText(), QStringLiteral("Cut inside"));
  // The table belongs to the same mask.
  QVERIFY(!t.w.after("removeTable").isNull());
  QVERIFY(t.volume()->attributes().cut.table);
  QVERIFY(t.w.after("undo") == twice);
}

// The second cut is drawn while the first is being computed.
void TestScissors::twoInARowAreTwoSteps() {
  Cutting t;
  QVERIFY(t.open());
  const int steps = t.session().undoStack().index();
  drawAround(t.view(), t.middle());
  drawAround(t.view(), t.middle().translated(-60, 0));
  QCOMPARE(t.session().undoStack().index(), steps);
  QTRY_COMPARE_WITH_TIMEOUT(t.session().undoStack().index(), steps + 2, longest);
  const SeriesKey key = keyOf(t.session().series()->series);
  const Mask both = t.session().maskOf(key);
  QCOMPARE(both.lassos.size(), std::size_t(2));
  const VolumePtr whole = t.session().seriesWith(key, {})->volume;
  QVERIFY2(t.volume()->stored() == (*masked(*whole, both))->stored(), "the same as of both at once");
  t.w.child<QAction>("undo")->trigger();
  QCOMPARE(t.session().maskOf(key).lassos.size(), std::size_t(1));
}

void TestScissors::slicesShowWhatWasCut() {
  Cutting t;
  QVERIFY(t.open());
  t.w.child<QAction>("layoutPlanes")->trigger();
  FlatView* coronal = t.w.window.views()->viewAs<FlatView>(coronalViewId);
  QSignalSpy drawn(coronal, &FlatView::settled);
  QTRY_VERIFY_WITH_TIMEOUT(drawn.count() > 0, longest);
  const QRgb skin = coronal->picture().pixel(coronal->pixels().width() / 2, coronal->pixels().height() / 2);
  QVERIFY(qRed(skin) > 50);
  // From the front, the middle of the view shows the middle of the coronal plane.
  QVERIFY(!t.w.after("viewAnterior").isNull());
  const QPointF centre = QRectF(t.view()->rect()).center();
  QVERIFY(!t.cut({centre - QPointF(30, 25), QSizeF(60, 50)}).isNull());
  const auto middleNow = [&] {
    return coronal->picture().pixelColor(coronal->picture().rect().center()).red();
  };
  QTRY_COMPARE_WITH_TIMEOUT(middleNow(), 0, longest);
  QVERIFY(coronal->overlays().topRight.contains(QStringLiteral("parts cut away")));
  t.w.shot("scissors-planes");
}

void TestScissors::theOutlineIsSeen() {
  Cutting t;
  QVERIFY(t.open());
  const QImage before = t.view()->grab().toImage();
  drawAround(t.view(), t.middle(), {}, false);
  const QImage during = t.view()->grab().toImage();
  t.w.shot("scissors-outline");
  const QPoint inside = t.middle().center().toPoint();
  QVERIFY(qRed(during.pixel(inside)) > qBlue(during.pixel(inside)));
  QVERIFY(before.pixel(4, 200) == during.pixel(4, 200));
  QTest::keyClick(t.view(), Qt::Key_Escape);
  QVERIFY(t.view()->grab().toImage() == before);
}

void TestScissors::whatIsGivenUpCutsNothing_data() {
  QTest::addColumn<Act>("act");
  QTest::newRow("a click") << Act(
      [](Cutting& t) { QTest::mouseClick(t.view(), Qt::LeftButton, {}, t.middle().center().toPoint()); });
  QTest::newRow("Esc") << Act([](Cutting& t) {
    drawAround(t.view(), t.middle(), {}, false);
    QTest::keyClick(t.view(), Qt::Key_Escape);
    QTest::mouseRelease(t.view(), Qt::LeftButton, {}, {50, 50});
  });
  QTest::newRow("another tool") << Act([](Cutting& t) {
    drawAround(t.view(), t.middle(), {}, false);
    t.w.child<QAction>("rotateTool")->trigger();
    QTest::mouseRelease(t.view(), Qt::LeftButton, {}, {50, 50});
  });
  QTest::newRow("the camera moved") << Act([](Cutting& t) {
    drawAround(t.view(), t.middle(), {}, false);
    t.w.child<QAction>("viewLeft")->trigger();
    QTest::mouseRelease(t.view(), Qt::LeftButton, {}, {50, 50});
    t.w.child<QAction>("undo")->trigger();
  });
  QTest::newRow("cancelled") << Act([](Cutting& t) {
    drawAround(t.view(), t.middle());
    Jobs& jobs = t.w.window.jobs();
    jobs.cancel(jobs.rows().back().id);
  });
}

// The other cut waits meanwhile, and is made.
void TestScissors::oneOfTwoCutsIsCancelled() {
  Cutting t;
  QVERIFY(t.open());
  const SeriesKey series = keyOf(t.session().series()->series);
  drawAround(t.view(), t.middle());
  drawAround(t.view(), t.middle());
  Jobs& jobs = t.w.window.jobs();
  QCOMPARE(jobs.rows().size(), std::size_t(1));
  jobs.cancel(jobs.rows().front().id);
  QTRY_COMPARE_WITH_TIMEOUT(t.session().maskOf(series).lassos.size(), std::size_t(1), longest);
  QTRY_VERIFY_WITH_TIMEOUT(jobs.rows().empty(), longest);
  QCOMPARE(t.session().maskOf(series).lassos.size(), std::size_t(1));
}

void TestScissors::theWindowClosesWhileItCuts() {
  Cutting t;
  QVERIFY(t.open());
  drawAround(t.view(), t.middle());
  QCOMPARE(t.w.window.jobs().rows().size(), std::size_t(1));
}

void TestScissors::whatIsGivenUpCutsNothing() {
  QFETCH(Act, act);
  Cutting t;
  QVERIFY(t.open());
  const Workspace before = t.session().workspace();
  const VolumePtr volume = t.volume();
  act(t);
  // A later act is done only after the cut has ended.
  QVERIFY(!t.w.after("removeTable").isNull());
  QVERIFY(!t.w.after("undo").isNull());
  QVERIFY(t.session().workspace() == before);
  QCOMPARE(t.volume(), volume);
}

void TestScissors::aSessionKeepsTheCuts() {
  Cutting t;
  QVERIFY(t.open());
  QVERIFY(!t.cut(t.middle()).isNull());
  QVERIFY(!t.w.after("removeTable").isNull());
  const Workspace saved = t.session().workspace();
  // Maximised, the view has the same size in both windows. Beside panels its size depends on their texts.
  const QImage picture = t.w.after("maximise");
  QVERIFY(!picture.isNull());
  QVERIFY(t.folder.save(t.w));
  QVERIFY2(QFileInfo(t.folder.at("s.volumen")).size() < 60000, "the outline, not the voxels");
  Journey again;
  QVERIFY(t.folder.open(again));
  QVERIFY(again.window.session().workspace() == saved);
  QCOMPARE(again.after("maximise"), picture);
}

void TestScissors::itsMaskIsComputedOnce() {
  Cutting t;
  QVERIFY(t.open());
  QVERIFY(!t.cut(t.middle()).isNull());
  const VolumePtr cut = t.volume();
  QVERIFY(!t.w.after("undo").isNull());
  QVERIFY(!t.w.after("redo").isNull());
  QCOMPARE(t.volume(), cut);
  t.w.child<QAction>("layoutPlanes")->trigger();
  for (const ViewId id : {axialViewId, coronalViewId, sceneViewId})
    QCOMPARE(t.session().seriesOf(id)->volume, cut);
}

void TestScissors::otherValuesCanBeCutToo() {
  Journey w({QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  QTest::keyClick(&w.window, Qt::Key_X);
  VolumeView* view = w.window.view();
  const QPointF centre = QRectF(view->rect()).center();
  QVERIFY(settles(w, [&] { drawAround(view, {centre - QPointF(20, 20), QSizeF(40, 40)}); }));
  QCOMPARE(w.window.session().series()->volume->value(16, 16, 16), 0.f);
}

VOLUMEN_TEST(TestScissors);
#include "tst_scissors.moc"
