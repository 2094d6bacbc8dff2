// Guards that acts on segments are recorded as a recipe. A recipe of random steps is saved by the menu and
// makes the same voxels, also in the program. Its text can be edited and rerun. Voxels without a recorded
// step are reported.
#include <QFile>
#include <QMenu>
#include <QPlainTextEdit>
#include <QTemporaryDir>
#include <QToolButton>

#include "io/load.h"
#include "io/open.h"
#include "results/segments/segment_record.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/seeds.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/hand.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/controller/offered_steps.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/morphology.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

void chooseInMenu(SegmentWindow& w, const char* entry) {
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), entry);
}

// Types a radius of 2 mm into the step "grow". Returns false if there is no such step.
bool typeBehindGrow(QPlainTextEdit& text) {
  text.moveCursor(QTextCursor::Start);
  if (!text.find(QStringLiteral("\"step\": \"grow\""))) return false;
  QTextCursor behind = text.textCursor();
  behind.clearSelection();
  text.setTextCursor(behind);
  QTest::keyClicks(&text, QStringLiteral(", \"radiusMm\": 2"));
  return true;
}

// Returns the recipe that the window saves; empty if it saves none.
std::optional<Recipe> savedRecipe(SegmentWindow& w, const QString& path) {
  chooseInMenu(w, "saveRecipe");
  answer(w, "saveRecipeDialog", path);
  if (!w.idle() || !QTest::qWaitFor([&] { return QFile::exists(path); }, longest)) return {};
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const auto recipe = readRecipe(file.readAll().toStdString());
  return recipe ? std::optional<Recipe>(*recipe) : std::nullopt;
}

// Returns the voxels of the only volume of a file.
std::vector<std::uint8_t> voxelsOfFile(const QString& path) {
  const auto study = openStudy(path.toStdString());
  if (!study || study->volumes.size() != 1) return {};
  const auto loaded = loadSeries(study->volumes.front());
  const auto* labels = loaded ? std::get_if<std::vector<std::uint8_t>>(&loaded->acquired->stored()) : nullptr;
  return labels ? *labels : std::vector<std::uint8_t>();
}

}  // namespace

class TestRecordedSteps : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsDoneIsARecipe_data();
  void whatIsDoneIsARecipe();
  void theProgramMakesTheSameVoxels();
  void numbersAreChangedAndRunAgain();
  void whatWasTypedStaysWhereARunFails();
  void theyAreRunInTheMapThatTheyAreOf();
  void slicesBetweenAreFilledByAStep();
  void whatNoStepMadeIsSaid();
};

void TestRecordedSteps::whatIsDoneIsARecipe_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(3, 40);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

void TestRecordedSteps::whatIsDoneIsARecipe() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const QTemporaryDir folder;
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  for (int n = 0; n < 25; ++n) {
    const auto all = offeredSteps();
    const double low = chance.below(1000);
    switch (chance.below(6)) {
      case 0:
        QVERIFY(w.make(low, low + 400, w.count() < 6 ? "segment" : "segmentReplace"));
        break;
      case 1:
        QVERIFY(w.press(w.count() > 3 ? "segmentRemove" : "segmentAdd"));
        break;
      case 2:
        w.tick(chance.below(int(w.count())), 1);
        break;
      default:
        QVERIFY(w.choose(chance.below(int(w.count()))));
        QVERIFY(w.step(all[std::size_t(chance.below(int(all.size())))].name));
    }
  }
  const auto recipe = savedRecipe(w, folder.filePath(QStringLiteral("a.json")));
  QVERIFY(recipe);
  QCOMPARE(recipe->segments.size(), w.count());
  const auto made = follow(*recipe, *w.session().series()->volume);
  QVERIFY2(made, made ? "" : made.message().c_str());
  for (std::size_t n = 0; n < w.count(); ++n)
    QVERIFY(maskOf(made->labels, std::uint8_t(n + 1)) == w.mask(w.segment(n).number));
}

void TestRecordedSteps::theProgramMakesTheSameVoxels() {
  const QTemporaryDir folder;
  const QString recipe = folder.filePath(QStringLiteral("a.json")),
                window = folder.filePath(QStringLiteral("window.seg.nrrd")),
                program = folder.filePath(QStringLiteral("program.seg.nrrd"));
  SegmentWindow w;
  w.window.open({QStringLiteral("phantom:ramp:24")});
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series()->series.path == "phantom:ramp:24", longest);
  QVERIFY(w.make(5, 9) && w.make(15, 18) && w.choose(0));
  w.chooseStep("grow");
  w.setField("radiusMm", 7);
  QVERIFY(w.press("segmentApply") && w.step("shell"));
  QVERIFY(savedRecipe(w, recipe));
  w.child<QAction>("exportSegments")->trigger();
  answer(w, "segmentDialog", window);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(window), longest);
  QVERIFY(w.idle());
  const Outcome done = runProgram({QStringLiteral("segment"), QStringLiteral("phantom:ramp:24"),
                                   QStringLiteral("--recipe"), recipe, QStringLiteral("-o"), program});
  QVERIFY2(done.status == 0, done.err.constData());
  QVERIFY(!voxelsOfFile(window).empty());
  QVERIFY(voxelsOfFile(window) == voxelsOfFile(program));
}

void TestRecordedSteps::numbersAreChangedAndRunAgain() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const BitMask shell = w.mask(1);
  QVERIFY(w.step("grow"));
  const Workspace before = w.workspace();
  chooseInMenu(w, "recipeSteps");
  auto* text = w.child<QPlainTextEdit>("stepsText");
  // The radius is the default of 1, as in its row.
  QVERIFY(text && !text->toPlainText().contains(QStringLiteral("radiusMm")));
  text->setPlainText(text->toPlainText().replace(QStringLiteral("\"step\": \"grow\""),
                                                 QStringLiteral("\"step\": \"grow\", \"radiusMm\": -2")));
  QVERIFY(!w.button("stepsRun")->isEnabled());
  text->setPlainText(text->toPlainText().replace(QStringLiteral("-2"), QStringLiteral("2")));
  const int steps = w.steps();
  QVERIFY(w.press("stepsRun"));
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(w.mask(1) == grown(shell, 2));
  w.undo();
  QVERIFY(w.workspace() == before);
}

// The reason is shown beside the text. After a successful run, the recorded recipe is shown again.
void TestRecordedSteps::whatWasTypedStaysWhereARunFails() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const BitMask shell = w.mask(1);
  QVERIFY(w.step("grow"));
  chooseInMenu(w, "recipeSteps");
  auto* text = w.child<QPlainTextEdit>("stepsText");
  auto* note = w.child<QLabel>("stepsNote");
  const QString recorded = text->toPlainText();
  QVERIFY(typeBehindGrow(*text));
  const QString typed = text->toPlainText();
  QVERIFY(typed != recorded);
  w.tick(0, 1);  // locks the segment
  const Workspace before = w.workspace();
  QVERIFY(w.press("stepsRun"));
  QVERIFY(w.workspace() == before);
  QCOMPARE(text->toPlainText(), typed);
  QVERIFY2(note->text().contains(QStringLiteral("is locked")), qPrintable(note->text()));
  w.tick(0, 1);
  QCOMPARE(text->toPlainText(), typed);
  const int steps = w.steps();
  QVERIFY(w.press("stepsRun"));
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(w.mask(1) == grown(shell, 2));
  QVERIFY(text->toPlainText() != typed && text->toPlainText().contains(QStringLiteral("\"radiusMm\": 2")));
  QCOMPARE(note->text(), QString());
  w.undo();
  QCOMPARE(text->toPlainText(), recorded);
}

// Another map is active meanwhile.
void TestRecordedSteps::theyAreRunInTheMapThatTheyAreOf() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const BitMask shell = w.mask(1);
  QVERIFY(w.step("grow"));
  chooseInMenu(w, "recipeSteps");
  auto* text = w.child<QPlainTextEdit>("stepsText");
  QVERIFY(typeBehindGrow(*text));
  QVERIFY(w.press("segmentDuplicate"));
  const SegmentMap other = *w.map();
  QCOMPARE(other.number, 1);
  QVERIFY(w.press("stepsRun"));
  QVERIFY(*segmentMapOf(w.workspace(), w.series(), 1) == other);
  QVERIFY(maskOf(*segmentMapOf(w.workspace(), w.series(), 0)->labels, 1) == grown(shell, 2));
}

// The hollow ball and the small ball have empty slices between them.
void TestRecordedSteps::slicesBetweenAreFilledByAStep() {
  SegmentWindow w;
  QVERIFY(w.make(800, 1200));
  const std::int64_t before = w.voxels(1);
  w.click("segmentPaint");
  QVERIFY(w.press("segmentFillBetween"));
  QVERIFY(w.voxels(1) > before);
  const RecordedRecipe recorded = recordedRecipe(*w.map(), {});
  QVERIFY(recorded.missing.empty());
  const auto made = follow(recorded.recipe, *w.session().series()->volume);
  QVERIFY(made && maskOf(made->labels, 1) == w.mask(1));
}

// Changes voxels as a brush would.
void TestRecordedSteps::whatNoStepMadeIsSaid() {
  SegmentWindow w;
  QVERIFY(w.make(800, 1200));
  SegmentMap map = *w.map();
  BitMask painted = w.mask(1);
  painted.set({0, 0, 0});
  map = withMask(std::move(map), 1, painted);
  w.session().change(QStringLiteral("test"), withSegmentMap(w.workspace(), map));
  w.session().endGesture();
  chooseInMenu(w, "saveRecipe");
  QVERIFY(
      w.child<Banner>("banner")->sentence().contains(QStringLiteral("No segment here was made by steps")));
}

VOLUMEN_TEST(TestRecordedSteps);
#include "tst_recorded_steps.moc"
