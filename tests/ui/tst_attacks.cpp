// Guards the window against unintended acts: views and series that disappear in the middle of an act, windows
// of any size, and empty volumes.
#include <QDockWidget>
#include <QFile>
#include <QTemporaryDir>
#include <limits>
#include <memory>

#include "tests/ui/measure_window.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/views/flat_view.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

void press(QWidget* view, QPoint at, Qt::MouseButton button = Qt::LeftButton,
           Qt::KeyboardModifiers keys = {}) {
  QTest::mousePress(view, button, keys, at);
}

void moveTo(QWidget* view, QPoint at, Qt::MouseButton button = Qt::LeftButton,
            Qt::KeyboardModifiers keys = {}) {
  QTest::mouseEvent(QTest::MouseMove, view, button, keys, at);
}

using Switch = void (*)(MeasureWindow& w, const LoadedSeriesPtr& other);
using Close = void (*)(Journey& w);

}  // namespace

Q_DECLARE_METATYPE(Switch)
Q_DECLARE_METATYPE(Close)

class TestAttacks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void windowsOfAnySize_data();
  void windowsOfAnySize();
  void aToolIsForTheSeriesOfItsView();
  void volumesOfNothing_data();
  void volumesOfNothing();
  void closedWhileItIsComputed_data();
  void closedWhileItIsComputed();
  void whatGoesInTheMiddleOfADrag_data();
  void whatGoesInTheMiddleOfADrag();

 private:
  std::unique_ptr<MeasureWindow> shared_;
};

void TestAttacks::whatGoesInTheMiddleOfADrag_data() {
  shared_ = std::make_unique<MeasureWindow>();
  // Object name of the flat view's tool, or of the 3D tool with its action's name.
  QTest::addColumn<QByteArray>("tool");
  QTest::addColumn<int>("button");
  QTest::addColumn<int>("keys");
  QTest::addColumn<Switch>("act");
  const std::pair<const char*, Switch> acts[] = {
      {"another series",
       [](MeasureWindow& w, const LoadedSeriesPtr& other) { w.session().show(other, axialViewId); }},
      {"it is closed",
       [](MeasureWindow& w, const LoadedSeriesPtr&) {
         w.session().close({w.session().workspace().view(axialViewId).series});
       }},
      {"all is closed", [](MeasureWindow& w, const LoadedSeriesPtr&) { w.session().show(nullptr); }},
      {"another layout",
       [](MeasureWindow& w, const LoadedSeriesPtr&) { w.child<QAction>("layoutTwo")->trigger(); }},
      {"undo", [](MeasureWindow& w, const LoadedSeriesPtr&) { w.child<QAction>("undo")->trigger(); }}};
  const auto row = [&](const char* what, const char* tool, Qt::MouseButton button, int keys) {
    for (const auto& [when, act] : acts)
      QTest::addRow("%s: %s", what, when) << QByteArray(tool) << int(button) << keys << act;
  };
  for (const Tool& tool : tools())
    if (tool.inSlices) row(tool.name, tool.name, Qt::LeftButton, Qt::NoModifier);
  row("flat, middle", "window", Qt::MiddleButton, Qt::NoModifier);
  row("flat, right", "window", Qt::RightButton, Qt::NoModifier);
  row("flat, Shift", "window", Qt::LeftButton, Qt::ShiftModifier);
  for (const char* tool : {"rotateTool", "curveTool", "scissorsTool"}) {
    row(tool, tool, Qt::LeftButton, Qt::NoModifier);
    row((QByteArray(tool) + ", Ctrl").constData(), tool, Qt::LeftButton, Qt::ControlModifier);
  }
  row("3D, middle", "rotateTool", Qt::MiddleButton, Qt::NoModifier);
  row("3D, right", "rotateTool", Qt::RightButton, Qt::NoModifier);
}

// All rows use one window: it keeps working, and what a switch shows keeps its state.
void TestAttacks::whatGoesInTheMiddleOfADrag() {
  QFETCH(QByteArray, tool);
  QFETCH(int, button);
  QFETCH(int, keys);
  QFETCH(Switch, act);
  const LoadedSeriesPtr other = ballSeries(20, 6, {2, 1, 0}, {1.5, 1, 0.7});
  MeasureWindow& w = *shared_;
  w.child<QAction>("layoutOne")->trigger();
  w.session().show(nullptr);
  w.session().undoStack().clear();
  w.session().setFocus(sceneViewId);
  QVERIFY(w.window.view()->picture().isNull());
  w.session().show(ballSeries(32, 10, {3, -2, 4}));
  w.child<QAction>("layoutPlanes")->trigger();
  QCoreApplication::processEvents();
  w.session().setFocus(axialViewId);
  const bool in3d = tool.endsWith("Tool");
  if (in3d) {
    w.session().setFocus(sceneViewId);
    w.child<QAction>(tool.constData())->trigger();
  } else {
    w.window.views()->setTool(toolNamed(tool.constData()));
  }
  QWidget* view = in3d ? static_cast<QWidget*>(w.window.view()) : w.view();
  const Qt::MouseButton held = Qt::MouseButton(button);
  const Qt::KeyboardModifiers with(keys);
  const int steps = w.session().undoStack().index();
  QCOMPARE(steps, 1);  // as in a new window
  press(view, {70, 60}, held, with);
  for (const QPoint at : {QPoint(80, 66), QPoint(95, 80), QPoint(90, 100)}) moveTo(view, at, held, with);
  act(w, other);
  const Workspace after = w.session().workspace();
  for (const QPoint at : {QPoint(99, 90), QPoint(120, 70), QPoint(60, 60)}) moveTo(view, at, held, with);
  QTest::mouseRelease(view, held, with, {60, 60});
  const Workspace& now = w.session().workspace();
  const SeriesKey key = keyOf(other->series);
  for (ViewId id = 0; id < viewCount; ++id)
    if (after.view(id).series == key) {
      const auto same = [&](const auto& a, const auto& b) {
        const auto x = a.find(key), y = b.find(key);
        return (x == a.end()) == (y == b.end()) && (x == a.end() || x->second == y->second);
      };
      QVERIFY(now.view(id).series == key);
      QVERIFY(same(after.view(id).scenes, now.view(id).scenes));
      QVERIFY(same(after.view(id).flats, now.view(id).flats));
    }
  for (const Measurement& m : now.measurements) QVERIFY(now.series.contains(m.series));
  // Everything can be undone, and a series shown again.
  while (w.session().undoStack().index() > std::min(steps, w.session().undoStack().count()))
    w.session().undoStack().undo();
  w.session().show(other, sceneViewId);
  w.session().setFocus(sceneViewId);
  w.child<QAction>("layoutOne")->trigger();
  QVERIFY(w.session().series() == other);
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.view()->picture().isNull(), longest);
}

void TestAttacks::windowsOfAnySize_data() {
  QTest::addColumn<QByteArray>("layout");
  for (const char* layout : {"layoutOne", "layoutPlanes", "layoutBesidePlanes", "layoutTwo", "layoutFour"})
    QTest::newRow(layout) << QByteArray(layout);
}

void TestAttacks::windowsOfAnySize() {
  QFETCH(QByteArray, layout);
  MeasureWindow w;
  w.child<QAction>(layout.constData())->trigger();
  for (const QSize size : {QSize(1, 1), QSize(3840, 2160), QSize(1, 2160), QSize(3840, 1), QSize(900, 600)}) {
    w.window.resize(size);
    QCoreApplication::processEvents();
    const QRect all = w.window.views()->rect();
    const std::vector<ViewId> shown = viewsOnScreen(w.session().workspace());
    for (const ViewId id : shown) {
      const QRect at = w.window.views()->viewOf(id)->geometry();
      QVERIFY(w.window.views()->viewOf(id)->isVisible());
      QVERIFY2(all.contains(at), qPrintable(QStringLiteral("%1x%2").arg(size.width()).arg(size.height())));
      for (const ViewId other : shown)
        if (other != id) QVERIFY(!at.intersects(w.window.views()->viewOf(other)->geometry()));
    }
    w.window.grab();
  }
}

void TestAttacks::aToolIsForTheSeriesOfItsView() {
  const LoadedSeriesPtr a = ballSeries(), b = ballSeries(20, 6);
  MeasureWindow w(a);
  w.child<QAction>("layoutTwo")->trigger();
  const ViewId left = firstComparedId, right = firstComparedId + 1;
  w.session().show(b, right);
  w.session().setFocus(left);
  const auto stateOf = [&](const LoadedSeriesPtr& s) {
    return w.session().workspace().series.at(keyOf(s->series));
  };
  const SeriesState untouched = stateOf(a);
  // Sets a window, a length and a cut, each in the view that is not in focus.
  QVERIFY(w.view(right));
  drag(w.view(right), {70, 60}, {120, 90});
  QVERIFY(stateOf(b).window.has_value());
  w.session().setFocus(left);
  w.window.views()->setTool(toolNamed("length"));
  drag(w.view(right), {70, 60}, {120, 90});
  QVERIFY(w.last().series == keyOf(b->series));
  w.session().showAs(right, ViewKind::volume);
  w.session().setFocus(right);
  w.child<QAction>("scissorsTool")->trigger();
  w.session().setFocus(left);
  auto* view = w.window.views()->volumeView(right);
  const QPoint centre = view->rect().center();
  press(view, centre);
  for (const QPoint by : {QPoint(40, 0), QPoint(40, 40), QPoint(0, 40)}) moveTo(view, centre + by);
  QTest::mouseRelease(view, Qt::LeftButton, {}, centre);
  QTRY_COMPARE_WITH_TIMEOUT(stateOf(b).mask.lassos.size(), std::size_t(1), longest);
  QVERIFY(stateOf(a) == untouched);
}

void TestAttacks::volumesOfNothing_data() {
  QTest::addColumn<int>("edge");
  QTest::addColumn<float>("value");
  QTest::newRow("all NaN") << 8 << std::numeric_limits<float>::quiet_NaN();
  QTest::newRow("all infinite") << 8 << std::numeric_limits<float>::infinity();
  QTest::newRow("all one value") << 8 << 5.0f;
  QTest::newRow("one voxel") << 1 << 5.0f;
  QTest::newRow("one voxel that is none") << 1 << std::numeric_limits<float>::quiet_NaN();
}

void TestAttacks::volumesOfNothing() {
  QFETCH(int, edge);
  QFETCH(float, value);
  const QTemporaryDir folder;
  QFile file(folder.filePath(QStringLiteral("v.nrrd")));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(
      QStringLiteral("NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: %1 %1 %1\n"
                     "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
                     "endian: little\nencoding: raw\n\n")
          .arg(edge)
          .toLatin1());
  for (int n = 0; n < edge * edge * edge; ++n)
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  file.close();
  Journey w({file.fileName()});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
  w.child<QAction>("layoutPlanes")->trigger();
  QVERIFY(w.settle());
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    FlatView* flat = w.window.views()->viewAs<FlatView>(id);
    QTRY_VERIFY_WITH_TIMEOUT(flat->picture().size() == flat->pixels(), longest);
    for (const Tool& tool : tools()) {
      if (!tool.inSlices) continue;
      w.window.views()->setTool(tool);
      drag(flat, {60, 60}, {110, 90});
      QTest::keyClick(flat, Qt::Key_Escape);
    }
    QTest::keyClick(flat, Qt::Key_End);
    hover(flat, {50, 50});
  }
  w.window.session().setFocus(sceneViewId);
  for (const char* tool : {"rotateTool", "curveTool", "scissorsTool"}) {
    w.child<QAction>(tool)->trigger();
    drag(w.window.view(), {60, 60}, {110, 90});
  }
  QVERIFY(!w.after("viewLeft").isNull());
  QVERIFY(sessionToJson(w.window.session().workspace(), "/").ok());
}

void TestAttacks::closedWhileItIsComputed_data() {
  QTest::addColumn<Close>("begin");
  QTest::newRow("a mask") << Close([](Journey& w) { w.child<QAction>("removeTable")->trigger(); });
  QTest::newRow("a cut") << Close([](Journey& w) {
    w.child<QAction>("scissorsTool")->trigger();
    press(w.window.view(), {60, 60});
    for (const QPoint at : {QPoint(160, 60), QPoint(160, 160)}) moveTo(w.window.view(), at);
    QTest::mouseRelease(w.window.view(), Qt::LeftButton, {}, {60, 160});
  });
  QTest::newRow("a snapshot") << Close([](Journey& w) { w.child<QAction>("copySnapshot")->trigger(); });
  QTest::newRow("thumbnails and levels") << Close([](Journey& w) {
    w.child<QDockWidget>("accuracyDock")->show();
    w.child<QDockWidget>("accuracyDock")->raise();
  });
  QTest::newRow("its picture") << Close([](Journey& w) { w.child<QAction>("viewLeft")->trigger(); });
  QTest::newRow("all planes") << Close([](Journey& w) { w.child<QAction>("layoutPlanes")->trigger(); });
}

void TestAttacks::closedWhileItIsComputed() {
  QFETCH(Close, begin);
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  begin(w);
  w.window.session().close({keyOf(w.window.session().series()->series)});
  QVERIFY(w.window.session().workspace().series.empty());
  QVERIFY(settles(w, [&] { w.window.open({QStringLiteral("phantom:sphere:32")}); }));
  QCOMPARE(w.window.session().workspace().series.size(), std::size_t(1));
  QVERIFY(w.window.session().workspace().series.begin()->second.mask.empty());
}

VOLUMEN_TEST(TestAttacks);
#include "tst_attacks.moc"
