// Guards recipes in the window: which are offered for a series, and that one click is one undo step. They
// respect masking and locked segments. On a real chest the result equals that of the command.
#include <QMenu>
#include <QToolButton>
#include <QTreeWidget>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/hand.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "viewer/recipe/recipe.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

LoadedSeriesPtr ofModality(const char* modality) {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->series.modality = modality;
  return series;
}

QStringList offered(const SegmentWindow& w) {
  QStringList names;
  for (const QAction* action :
       w.window.findChild<QToolButton*>(QStringLiteral("segmentRecipes"))->menu()->actions())
    names << action->text();
  return names;
}

}  // namespace

class TestSegmentRecipes : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void eachModalityHasItsOwn_data();
  void eachModalityHasItsOwn();
  void aClickIsOneStep();
  void lockedSegmentsKeepTheirVoxels();
  void whatCannotBeFoundIsSaid();
  void contrastThatIsNotNamedIsSaid_data();
  void contrastThatIsNotNamedIsSaid();
  void aRealChestHasTheBonesThatTheRecipeFinds();
};

void TestSegmentRecipes::eachModalityHasItsOwn_data() {
  QTest::addColumn<QString>("modality");
  QTest::addColumn<bool>("bone");
  QTest::addColumn<bool>("head");
  QTest::newRow("CT") << QStringLiteral("CT") << true << false;
  QTest::newRow("MR") << QStringLiteral("MR") << false << true;
  QTest::newRow("PT") << QStringLiteral("PT") << false << false;
}

void TestSegmentRecipes::eachModalityHasItsOwn() {
  QFETCH(QString, modality);
  QFETCH(bool, bone);
  QFETCH(bool, head);
  SegmentWindow w(ofModality(modality.toLatin1().constData()));
  QCOMPARE(offered(w).contains(QStringLiteral("Bone")), bone);
  QCOMPARE(offered(w).contains(QStringLiteral("Head surface (MR)")), head);
  const auto* button = w.child<QToolButton>("segmentRecipes");
  QCOMPARE(button->toolTip().contains(QStringLiteral("Built-in ones are for")), !bone && !head);
  for (const char* own : {"Open recipe...", "Save steps as a recipe...", "Steps..."})
    QVERIFY2(offered(w).contains(QLatin1String(own)), own);
}

// The hollow ball of 1000 is filled. The small ball is left out because it is less than 1 ml.
void TestSegmentRecipes::aClickIsOneStep() {
  SegmentWindow w(ofModality("CT"));
  const Workspace before = w.workspace();
  const int steps = w.steps();
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), "recipeBone");
  QTRY_COMPARE_WITH_TIMEOUT(w.count(), std::size_t(1), longest);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(QString::fromStdString(w.segment(0).label), QStringLiteral("Bone"));
  QCOMPARE(QString::fromStdString(w.segment(0).type.value), QStringLiteral("272673000"));
  for (const Recipe& recipe : builtInRecipes())
    if (recipe.name == "Bone") {
      const auto made = follow(recipe, *w.session().series()->volume);
      QVERIFY(made && maskOf(made->labels, 1) == w.mask(w.segment(0).number));
    }
  QVERIFY(w.mask(1).at(glm::ivec3(14)) && !w.mask(1).at(glm::ivec3(31)));
  w.undo();
  QVERIFY(w.workspace() == before);
}

void TestSegmentRecipes::lockedSegmentsKeepTheirVoxels() {
  SegmentWindow w(ofModality("CT"));
  QVERIFY(w.make(400, 600));  // the core
  w.tick(0, 1);
  const BitMask core = w.mask(1);
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), "recipeBone");
  QTRY_COMPARE_WITH_TIMEOUT(w.count(), std::size_t(2), longest);
  QVERIFY(w.idle());
  QVERIFY(w.mask(1) == core);
  QVERIFY(w.voxels(2) > 1000);
}

void TestSegmentRecipes::whatCannotBeFoundIsSaid() {
  SegmentWindow w(ofModality("CT"));
  const Workspace before = w.workspace();
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), "recipeAirways");
  QTRY_VERIFY_WITH_TIMEOUT(
      w.child<Banner>("banner")->sentence().contains(QStringLiteral("no trachea was found")), longest);
  QVERIFY(w.workspace() == before);
}

void TestSegmentRecipes::contrastThatIsNotNamedIsSaid_data() {
  QTest::addColumn<QString>("recipe");
  QTest::addColumn<QString>("agent");
  QTest::addColumn<bool>("said");
  QTest::newRow("no agent") << QStringLiteral("recipeVessels with contrast") << QString() << true;
  QTest::newRow("an agent") << QStringLiteral("recipeVessels with contrast") << QStringLiteral("IOHEXOL")
                            << false;
  QTest::newRow("a recipe that needs none") << QStringLiteral("recipeBone") << QString() << false;
}

// The warning appears once the recipe was followed.
void TestSegmentRecipes::contrastThatIsNotNamedIsSaid() {
  QFETCH(QString, recipe);
  QFETCH(QString, agent);
  QFETCH(bool, said);
  const LoadedSeriesPtr plain = ofModality("CT");
  auto series = std::make_shared<LoadedSeries>(*plain);
  series->series.format = "DICOM";
  series->series.contrastAgent = agent.toStdString();
  SegmentWindow w(series);
  const QByteArray entry = recipe.toLatin1();
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), entry.constData());
  QTRY_COMPARE_WITH_TIMEOUT(w.count(), std::size_t(1), longest);
  QVERIFY(w.idle());
  const auto* banner = w.child<Banner>("banner");
  const QString told = banner->isVisible() ? banner->sentence() : QString();
  QVERIFY2(told.contains(QStringLiteral("The header names no contrast agent")) == said, qPrintable(told));
}

// A woman's chest: its bones are about a litre, and white in slices.
void TestSegmentRecipes::aRealChestHasTheBonesThatTheRecipeFinds() {
  NEED_DATA(dataPath("ct-chest-lidc0314-138"));
  openAlone(false);
  Journey w({QString::fromStdString(dataPath("ct-chest-lidc0314-138"))});
  w.window.resize(1440, 900);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series() != nullptr, longest);
  QVERIFY(w.settle());
  w.child<QDockWidget>("segmentDock")->show();
  w.child<QDockWidget>("segmentDock")->raise();
  QCoreApplication::processEvents();
  Hand(w.window).menuOf(w.child<QToolButton>("segmentRecipes"), "recipeBone");
  const auto ml = [&] {
    const auto* list = w.child<QTreeWidget>("segmentList");
    const QTreeWidgetItem* row = list->topLevelItem(0);
    for (int column = 0; row && column < list->columnCount(); ++column)
      if (const double value = row->text(column).toDouble(); value > 0) return value;
    return 0.0;
  };
  QTRY_VERIFY_WITH_TIMEOUT(ml() > 900 && ml() < 1100, 10 * longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.jobs().rows().empty(), longest);
  QTest::qWait(500);  // waits for slices with the segment
  w.shot("segments-bone");
}

VOLUMEN_TEST(TestSegmentRecipes);
#include "tst_segment_recipes.moc"
