// Guards design.md 8 with many open series: 10,000 undo steps need little memory and all work. With
// VOLUMEN_FIGURES set, prints the cost of a step.
#include <malloc.h>

#include <QElapsedTimer>
#include <cmath>

#include "tests/unit/suite.h"
#include "ui/controller/session_files.h"
#include "ui/document/jobs.h"

using namespace volumen;

namespace {

constexpr int seriesCount = 30;

// Returns a CT with names as in hospitals, which is not in memory.
Series seriesNumbered(int n) {
  const std::string number = std::to_string(100 + n);
  Series series;
  series.path = "/data/studies/0000" + number + "/a patient's examination/series " + number;
  series.id = "1.2.840.113619.2.55.3.604688119.969.1268071029." + number;
  series.seriesUid = series.id;
  series.frameOfReferenceUid = "1.2.840.113619.2.55.3.604688119.970.1268071030." + number;
  series.format = "DICOM";
  series.modality = "CT";
  series.acquired.size = {512, 512, 300};
  return series;
}

// Shows every series in every view, each with edits of its own.
Workspace manySeries() {
  Workspace w;
  SceneLook look{{}, std::make_shared<const ChosenPreset>(ChosenPreset{"CT-Bone", {}})};
  look.scene.camera.emplace();
  look.scene.transferFunction.points.resize(8);
  for (int n = 0; n < seriesCount; ++n) {
    const Series series = seriesNumbered(n);
    for (const ViewId view : {sceneViewId, firstComparedId + n % 4}) w = withSeries(w, view, series, look);
    w = withKind(w, firstComparedId, ViewKind::volume, look);
    w.series.edit(keyOf(series)).missing.emplace();
    w.crosshairs.editOrAdd(frameOfReference(series)).at = {n, 2, 3};
    for (int made = 1; made <= 3; ++made) w.measurements.push_back({3 * n + made, keyOf(series), {}, {}});
    w.keyImages.push_back({keyOf(series), series.id, n});
  }
  w.layout = Layout::planes;
  w.focus = axialViewId;
  return w;
}

// Compares all parts, as listeners of a session do.
void compareAll(const Workspace& before, const Workspace& after, int& changes) {
  changes += before.series != after.series;
  changes += before.views != after.views;
  for (ViewId id = 0; id < viewCount; ++id) changes += before.view(id) != after.view(id);
  changes += before.crosshairs != after.crosshairs;
  changes += before.frameLinks != after.frameLinks;
  changes += before.measurements != after.measurements;
  changes += before.keyImages != after.keyImages;
  changes += before.regions != after.regions;
  changes += before.closed != after.closed;
  changes += before.unlisted != after.unlisted;
}

std::size_t heapBytes() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

using Edit = void (*)(Workspace&, int n);

void scroll(Workspace& w, int n) { w.crosshairs.edit(frameOfReference(*seriesIn(w, w.focus))).at.z = n; }

void zoom(Workspace& w, int n) {
  w = withFlatLooks(std::move(w), w.focus, [n](FlatLook& look) { look.zoom = 1 + n * 1e-4; });
}

void turn(Workspace& w, int n) {
  ViewState& view = w.editView(sceneViewId);
  view.scenes.edit(view.series).scene.camera->direction = {std::cos(n * 0.01), std::sin(n * 0.01), 0};
}

void setWindow(Workspace& w, int n) { w.series.edit(w.view(w.focus).series).window = Window{40, 400. + n}; }

void drag(Workspace& w, int n) { w.measurements.edit(7).textOffset = glm::dvec3(n, 0, 0); }

void mixed(Workspace& w, int n) {
  const Edit all[] = {scroll, zoom, turn, setWindow, drag};
  all[n % 5](w, n);
}

}  // namespace

Q_DECLARE_METATYPE(Edit)

class TestUndoCost : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void manyStepsCostLittle_data();
  void manyStepsCostLittle();
};

void TestUndoCost::manyStepsCostLittle_data() {
  QTest::addColumn<Edit>("edit");
  QTest::newRow("scrolled") << Edit(scroll);
  QTest::newRow("zoomed in three planes") << Edit(zoom);
  QTest::newRow("turned in 3D") << Edit(turn);
  QTest::newRow("windows set") << Edit(setWindow);
  QTest::newRow("a label dragged") << Edit(drag);
  QTest::newRow("all of these in turn") << Edit(mixed);
}

void TestUndoCost::manyStepsCostLittle() {
  QFETCH(Edit, edit);
  constexpr int steps = 10000, mostMiB = 50;
  Session session;
  Jobs jobs;
  SessionFiles files(session, jobs);
  session.open(QStringLiteral("Open"), manySeries());
  files.opened({});
  int changes = 0;
  connect(&session, &Session::workspaceChanged, this,
          [&](const Workspace& before, const Workspace& after) { compareAll(before, after, changes); });
  const Workspace first = session.workspace();
  const std::size_t before = heapBytes();
  QElapsedTimer timer;
  timer.start();
  for (int n = 1; n <= steps; ++n) session.change(QStringLiteral("Step"), [&](Workspace& w) { edit(w, n); });
  const double stepMs = double(timer.nsecsElapsed()) * 1e-6 / steps;
  const std::size_t bytes = heapBytes() - before;
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES"))
    std::printf("%-24s %7zu bytes and %.4f ms a step\n", QTest::currentDataTag(), bytes / steps, stepMs);
  QCOMPARE(session.undoStack().count(), steps);
  QVERIFY(changes >= steps);
  const Workspace last = session.workspace();
  for (int n = 0; n < steps; ++n) session.undoStack().undo();
  QVERIFY(session.workspace() == first);
  for (int n = 0; n < steps; ++n) session.undoStack().redo();
  QVERIFY(session.workspace() == last);
  QVERIFY2(bytes <= std::size_t(mostMiB) << 20, qPrintable(QString::number(bytes)));
}

VOLUMEN_TEST(TestUndoCost);
#include "tst_undo_cost.moc"
