// Guards the steps that the panel offers, without a window: each gives the result of its kernel in one undo
// step, and takes voxels from unlocked segments.
#include <functional>

#include "tests/unit/controller/editing.h"
#include "tests/unit/suite.h"
#include "ui/controller/offered_steps.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/smoothing.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Expected result of a recipe step from the segment and the other one.
using Expected = std::function<BitMask(const BitMask& own, const BitMask& other)>;

}  // namespace

class TestOfferedSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStepIsAJobAndAnUndoStep_data();
  void aStepIsAJobAndAnUndoStep();
  void allAreSmoothedTogether();
  void whatWasLockedMeanwhileLosesNothing();
};

void TestOfferedSteps::aStepIsAJobAndAnUndoStep_data() {
  QTest::addColumn<Expected>("expected");
  const auto row = [](const char* name, const Expected& expected) { QTest::newRow(name) << expected; };
  using M = const BitMask&;
  row("largest", [](M own, M) { return Parts(own, Neighbours::faces).largest(); });
  row("fill", [](M own, M) { return holesFilled(own); });
  row("invert", [](M own, M) { return inverted(own); });
  row("islands", [](M own, M) { return Parts(own, Neighbours::faces).atLeast(1000); });
  row("grow", [](M own, M) { return grown(own, 3); });
  row("shrink", [](M own, M) { return shrunk(own, 3); });
  row("close", [](M own, M) { return closed(own, 3); });
  row("open", [](M own, M) { return opened(own, 3); });
  row("shell", [](M own, M) { return shell(own, 3); });
  row("median", [](M own, M) { return medianSmoothed(own, 3); });
  row("gaussian", [](M own, M) { return gaussianSmoothed(own, 3); });
  row("add", [](M own, M other) { return united(own, other); });
  row("copy", [](M, M other) { return other; });
  row("subtract", [](M own, M other) { return subtracted(own, grown(other, 3)); });
  row("intersect", [](M own, M other) { return intersected(own, grown(other, 3)); });
  row("empty", [](M own, M) { return BitMask(own.geometry()); });
}

// The result is that of the kernel, for 3 mm and 1 ml. The unlocked core loses the voxels that the step
// takes.
void TestOfferedSteps::aStepIsAJobAndAnUndoStep() {
  QFETCH(Expected, expected);
  const QByteArray name = QTest::currentDataTag();
  Editing e;
  e.begin({{400, 600}, {800, 1200}}, {});
  const Workspace before = e.session.workspace();
  const int steps = e.session.undoStack().index();
  const BitMask own = e.mask(), core = maskOf(*e.map()->labels, 1);
  const StepKind& kind = offeredStep(name.toStdString());
  std::map<std::string, StepValue> fields;
  for (const StepField& field : kind.fields)
    if (std::string_view(field.name) == "other")
      fields[field.name] = std::string("1");
    else if (std::string_view(field.unit) == "mm")
      fields[field.name] = 3.0;
  e.editing.change(workOf(kind, fields, e.session));
  QCOMPARE(e.jobs.rows().size(), std::size_t(1));
  QVERIFY(e.idle());
  QCOMPARE(e.session.undoStack().index(), steps + 1);
  const BitMask made = expected(own, core);
  QVERIFY(e.mask() == made);
  QVERIFY(maskOf(*e.map()->labels, 1) == subtracted(core, made));
  // Smoothing, opening, closing or making a shell may leave balls unchanged.
  QVERIFY(made != own || QByteArrayList({"gaussian", "median", "open", "close", "shell"}).contains(name));
  const Workspace after = e.session.workspace();
  e.session.undoStack().undo();
  QVERIFY(e.session.workspace() == before);
  e.session.undoStack().redo();
  QVERIFY(e.session.workspace() == after);
}

// The result is that of the kernel for all labels at once.
void TestOfferedSteps::allAreSmoothedTogether() {
  Editing e;
  e.begin({{400, 600}, {800, 1200}}, {});
  e.session.change(QStringLiteral("test"),
                   withSegmentChanged(e.session.workspace(), e.key, 1, [](Segment& s) { s.locked = true; }));
  const LabelMap before = *e.map()->labels;
  e.editing.change(workOf(offeredStep("joint"), {{"sigmaMm", 1.5}}, e.session));
  QVERIFY(e.idle());
  const std::uint8_t locked[] = {1};
  QVERIFY(*e.map()->labels == jointSmoothed(before, 1.5, locked));
  QVERIFY(*e.map()->labels != before);
}

// A segment is locked while a job runs: one that is merged, that takes it in, or that is split.
void TestOfferedSteps::whatWasLockedMeanwhileLosesNothing() {
  for (const auto& [step, locked] : {std::pair("merge", 0), std::pair("merge", 1), std::pair("split", 1)}) {
    Editing e;
    e.begin({{400, 600}, {800, 1200}}, {});
    std::map<std::string, StepValue> fields;
    if (std::string_view(step) == "merge") fields["other"] = std::string("1");
    const SegmentWork work = workOf(offeredStep(step), fields, e.session);
    SegmentMap map = *e.map();
    QVERIFY(work.makeAll(map, {}).ok());
    map.segments[std::size_t(locked)].locked = true;
    const auto made = work.makeAll(map, {});
    QVERIFY2(!made && QString::fromStdString(made.message()).contains(QStringLiteral("is locked")), step);
  }
}

VOLUMEN_TEST(TestOfferedSteps);
#include "tst_offered_steps.moc"
