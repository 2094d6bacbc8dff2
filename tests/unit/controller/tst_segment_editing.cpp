// Guards the editing of segments without a window: segments, options and a click or stroke in, workspace or a
// sentence out.
#include "tests/unit/controller/editing.h"
#include "tests/unit/suite.h"
#include "ui/controller/offered_steps.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using enum PartUse;
using enum PaintBeside;
using Options = SegmentOptions;
using Ranges = std::vector<ValueRange>;
using Act = void (*)(Editing& e);
constexpr ValueRange bright{800, 1200}, dim{400, 600}, none{3000, 4000};
const SeriesKey other{"other", "1"};

void noAct(Editing&) {}
void clickShell(Editing& e) { e.part(inShell); }
void clickSmall(Editing& e) { e.part(inSmallBall); }
void clickAir(Editing& e) { e.part(inAir); }
void clickBeside3d(Editing& e) { e.part(PartClick{e.key, {12, 12, 15.4}, true, {}}); }
void clickFrame(Editing& e) { e.part(PartClick{e.key, {}, false, {}, true}); }
void clickOther(Editing& e) { e.part(PartClick{other, {}}); }
void ctrlSmall(Editing& e) { e.part(inSmallBall, Qt::ControlModifier); }
void ctrlAir(Editing& e) { e.part(inAir, Qt::ControlModifier); }
void altSmall(Editing& e) { e.part(inSmallBall, Qt::AltModifier); }
void strokeSmall(Editing& e) { e.paint(inSmallBall, 4.9); }
void strokeCore(Editing& e) { e.paint(bigBall, 5.1); }
void strokeBall(Editing& e) { e.paint(bigBall, 8.1); }
void strokeFrame(Editing& e) { e.paint(SegmentStroke{.series = e.key, .onFrame = true}); }
void strokeOther(Editing& e) { e.paint(SegmentStroke{.series = other}); }
void cutAll(Editing& e) { e.cut(false); }
void cutOutside(Editing& e) { e.cut(false, false); }
void cutSlice(Editing& e) { e.cut(true); }
void cutFrame(Editing& e) { e.cut(SegmentCut{.series = e.key, .onFrame = true}); }
void cutOther(Editing& e) { e.cut(SegmentCut{.series = other}); }
void lesion(Editing& e) { e.editing.change(e.lesion(6)); }
void leakingLesion(Editing& e) { e.editing.change(e.lesion(1.5)); }
void lesionFrame(Editing& e) { e.editing.change(lesionOf(e.session, {}, {e.key, {}, 5, true})); }
void lesionOther(Editing& e) { e.editing.change(lesionOf(e.session, {}, {other, {}, 5})); }
void grow(Editing& e) { e.editing.grow(); }
void growTwice(Editing& e) {
  for (int n = 0; n < 2; ++n) e.editing.change(workOf(offeredStep("grow"), {}, e.session));
}
void lock(Editing& e) {
  e.changeCurrent([](Segment& s) { s.locked = true; });
}
void hide(Editing& e) {
  e.changeCurrent([](Segment& s) { s.visible = false; });
}
void close(Editing& e) { e.session.close({e.key}); }
void unsize(Editing& e) {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  VolumeParts parts{series->volume->geometry(), series->volume->stored(), 1, 0, {}};
  parts.geometry.calibrated = false;
  series->volume = volumeFrom(std::move(parts));
  e.session.show(series);
  e.key = keyOf(series->series);
}

bool isBright(glm::dvec3 p) { return isShell(p) || isSmall(p); }
bool isNearSmall(glm::dvec3 p) { return glm::distance(p, inSmallBall) <= 4.9; }
bool isBesideCore(glm::dvec3 p) { return glm::distance(p, bigBall) <= 5.1 && !isCore(p); }
bool isRight(glm::dvec3 p) { return isBright(p) && p.x >= 0; }
bool isLeft(glm::dvec3 p) { return isBright(p) && p.x < 0; }
bool isCutInSlice(glm::dvec3 p) { return isBright(p) && !(p.x < 0 && std::abs(p.z + 4.5) <= 3.2); }

// Segments made of ranges beforehand, what is chosen, what is done, its undo step, and the voxels that the
// current segment then has.
struct Edited {
  const char* name;
  Ranges segments;
  Options options;
  Act act;
  const char* step;
  bool (*isIn)(glm::dvec3 p);
};

const std::vector<Edited> edits{
    {"a click adds a part", {}, {.range = bright}, clickShell, "Add connected part", isShell},
    {"a click beside a surface", {}, {.range = bright}, clickBeside3d, "Add connected part", isSmall},
    {"Ctrl keeps a part", {bright}, {}, ctrlSmall, "Keep connected part", isSmall},
    {"Alt removes a part", {bright}, {}, altSmall, "Remove connected part", isShell},
    {"a choice keeps", {bright}, {.partUse = keep}, clickShell, "Keep connected part", isShell},
    {"a choice removes", {bright}, {.partUse = remove}, clickShell, "Remove connected part", isSmall},
    {"a stroke makes a segment", {}, {}, strokeSmall, "Paint", isNearSmall},
    {"a choice erases", {bright}, {.erases = true}, strokeSmall, "Erase", isShell},
    {"values of the range", {}, {.range = dim, .paintsInRange = true}, strokeBall, "Paint", isCore},
    {"inside", {dim, none}, {.beside = inside, .other = 1}, strokeCore, "Paint", isCore},
    {"outside", {dim, none}, {.beside = outside, .other = 1}, strokeCore, "Paint", isBesideCore},
    {"inside the first other", {dim, none}, {.beside = inside, .other = 77}, strokeCore, "Paint", isCore},
    {"an outline is cut away", {bright}, {}, cutAll, "Cut segment inside", isRight},
    {"its outside is cut away", {bright}, {}, cutOutside, "Cut segment outside", isLeft},
    {"to a depth", {bright}, {.cutWithinMm = 3.2}, cutSlice, "Cut segment inside", isCutInSlice},
    {"3D has no depth", {bright}, {.cutWithinMm = 3.2}, cutAll, "Cut segment inside", isRight},
    {"a lesion", {}, {}, lesion, "Add lesion", isSmall},
};

constexpr auto refused = SegmentAnswer::Kind::refused, failed = SegmentAnswer::Kind::failed;

// As Edited, with what else happens before, and the answer.
struct NotDone {
  const char* name;
  Ranges segments;
  Options options;
  Act before, act;
  SegmentAnswer::Kind kind;
  const char* says;
};

const std::vector<NotDone> refusals{
    {"a part, frame", {}, {}, noAct, clickFrame, refused, "Frames have no connected parts"},
    {"a stroke, frame", {}, {}, noAct, strokeFrame, refused, "Frames cannot be painted on"},
    {"a cut, frame", {bright}, {}, noAct, cutFrame, refused, "cannot be cut on frames"},
    {"a lesion, frame", {}, {}, noAct, lesionFrame, refused, "A lesion cannot be found on frames"},
    {"a part, other series", {}, {}, noAct, clickOther, refused, "is about another series"},
    {"a stroke, other series", {}, {}, noAct, strokeOther, refused, "is about another series"},
    {"a cut, other series", {bright}, {}, noAct, cutOther, refused, "is about another series"},
    {"a lesion, other series", {}, {}, noAct, lesionOther, refused, "is about another series"},
    {"a part, no series", {}, {}, close, clickShell, refused, "Open a series first"},
    {"a stroke, no series", {}, {}, close, strokeSmall, refused, "Open a series first"},
    {"seeds, no series", {}, {}, close, grow, refused, "Open a series first"},
    {"a part, no segment", {}, {}, noAct, ctrlSmall, refused, "Make or add a segment first"},
    {"an eraser, no segment", {}, {.erases = true}, noAct, strokeSmall, refused, "add a segment first"},
    {"a cut, no segment", {}, {}, noAct, cutAll, refused, "Make or add a segment first"},
    {"a stroke, locked", {bright}, {}, lock, strokeSmall, refused, "is locked"},
    {"a cut, locked", {bright}, {}, lock, cutAll, refused, "is locked: unlock it first"},
    {"a stroke, hidden", {bright}, {}, hide, strokeSmall, refused, "is hidden"},
    {"no SUV", {}, {.lesionThreshold = {2.5, false}}, noAct, lesion, refused, "The series has no SUV"},
    {"unknown size", {}, {}, unsize, lesion, refused, "how large its voxels are"},
    {"one seed", {bright}, {}, noAct, grow, refused, "Paint into two or more segments first"},
    {"beside the range", {}, {.range = bright}, noAct, clickAir, failed, "not in the range of values"},
    {"beside the segment", {bright}, {}, noAct, ctrlAir, failed, "not in the current segment"},
    {"a thin part", {}, {.range = bright, .leakGuardMm = 4}, noAct, clickSmall, failed, "leak guard"},
    {"a cut of nothing", {none}, {}, noAct, cutAll, failed, "Nothing of the current segment was cut"},
    {"a lesion that leaks", {}, {}, noAct, leakingLesion, failed, "No lesion in the sphere"},
};

template <class Row>
void addRows(const std::vector<Row>& rows) {
  QTest::addColumn<int>("row");
  for (int n = 0; n < int(rows.size()); ++n) QTest::newRow(rows[std::size_t(n)].name) << n;
}

}  // namespace

class TestSegmentEditing : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsAskedIsOneStep_data() { addRows(edits); }
  void whatIsAskedIsOneStep();
  void whatCannotBeDoneIsSaid_data() { addRows(refusals); }
  void whatCannotBeDoneIsSaid();
  void takenVoxelsAreSaid();
  void aSeriesThatIsClosedMeanwhileIsLeftAlone();
};

void TestSegmentEditing::whatIsAskedIsOneStep() {
  QFETCH(int, row);
  const Edited& edit = edits[std::size_t(row)];
  Editing e;
  e.begin(edit.segments, edit.options);
  const Workspace before = e.session.workspace();
  const int steps = e.session.undoStack().index();
  edit.act(e);
  QVERIFY(e.idle());
  for (const SegmentAnswer& answer : e.answers)
    QVERIFY2(answer.kind == SegmentAnswer::Kind::done, qPrintable(answer.sentence));
  QCOMPARE(e.session.undoStack().index(), steps + 1);
  QCOMPARE(e.session.undoStack().undoText(), QString::fromLatin1(edit.step));
  const BitMask made = e.mask();
  for (int n = 0; n < 40 * 40 * 40; ++n) {
    const glm::ivec3 voxel(n % 40, n / 40 % 40, n / 1600);
    QCOMPARE(made.at(voxel), edit.isIn(glm::dvec3(voxel) - 19.5));
  }
  const Workspace after = e.session.workspace();
  e.session.undoStack().undo();
  QVERIFY(e.session.workspace() == before);
  e.session.undoStack().redo();
  QVERIFY(e.session.workspace() == after);
}

void TestSegmentEditing::whatCannotBeDoneIsSaid() {
  QFETCH(int, row);
  const NotDone& refusal = refusals[std::size_t(row)];
  Editing e;
  e.begin(refusal.segments, refusal.options);
  refusal.before(e);
  const Workspace before = e.session.workspace();
  refusal.act(e);
  QVERIFY(e.idle());
  QVERIFY(e.session.workspace() == before);
  QCOMPARE(e.answers.size(), std::size_t(1));
  QVERIFY2(e.answers[0].sentence.contains(QLatin1String(refusal.says)), qPrintable(e.answers[0].sentence));
  QVERIFY(e.answers[0].kind == refusal.kind);
}

void TestSegmentEditing::takenVoxelsAreSaid() {
  Editing e;
  e.add({400, 600});
  e.add({3000, 4000});
  e.paint(bigBall, 2);
  QCOMPARE(e.answers.size(), std::size_t(1));
  QVERIFY(e.answers[0].kind == SegmentAnswer::Kind::done);
  QVERIFY2(e.answers[0].sentence.contains(QStringLiteral("took")), qPrintable(e.answers[0].sentence));
}

void TestSegmentEditing::aSeriesThatIsClosedMeanwhileIsLeftAlone() {
  for (const Act act : {lesion, grow, growTwice}) {
    Editing e;
    e.begin({dim, bright}, {});
    const Workspace before = e.session.workspace();
    act(e);
    e.session.close({e.key});
    QVERIFY(e.idle());
    QTest::qWait(50);
    QVERIFY(e.session.workspace().segmentMaps.empty() && e.answers.empty());
    e.session.undoStack().undo();
    QVERIFY(e.session.workspace() == before);
  }
}

VOLUMEN_TEST(TestSegmentEditing);
#include "tst_segment_editing.moc"
