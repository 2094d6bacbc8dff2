// Guards the moment of exports. A file holds what was there when it was asked for, even if another patient is
// shown and the work changes while the file dialog is open. A session holds what is there when it is saved.
#include <QMenu>
#include <QToolButton>
#include <map>

#include "tests/fixtures/program.h"
#include "tests/ui/numbers_table.h"
#include "tests/ui/segment_window.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/controller/session_files.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns hollowBalls() of a patient.
LoadedSeriesPtr ballsOf(const char* patient) {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->series.patientName = patient;
  series->series.id += patient;
  return series;
}

// A patient's planes with a segment and a length.
struct AskedWindow : SegmentWindow {
  QTemporaryDir folder;

  AskedWindow() : SegmentWindow(ballsOf("Doe")) {}

  bool prepare() {
    if (!make(800, 1200)) return false;
    draw(ShapeKind::length, {{100, 100}, {160, 120}});
    session().select(0);
    return openTable(*this) && QTest::qWaitFor([this] { return view()->isMeasured(); }, longest);
  }
  void chooseFrom(const char* button, const char* entry) {
    for (QAction* action : child<QToolButton>(button)->menu()->actions())
      if (action->objectName() == QLatin1String(entry)) action->trigger();
  }
  // Changes all that exports show, then shows another patient in place of the first.
  void goOn() {
    session().change(QStringLiteral("test"), [this](Workspace& after) {
      const auto all = [](const auto&) { return true; };
      after.segmentMaps.editIf(all, [](SegmentMap& map) {
        map.segments[0].label = "Other";
        map.steps.clear();
      });
      after.measurements.editIf(all, [](Measurement& m) { m.shape.points[1].x += 3; });
      after.series.edit(series()).window = Window{100, 50};
    });
    session().endGesture();
    session().show(ballsOf("Roe"));
    session().edit(QStringLiteral("test"), [](Scene& scene) {
      scene.transferFunction.points = {{200, {1, 0, 0}, 0.0}, {300, {1, 0, 0}, 1.0}};
    });
  }
  QString at(const QString& name) const { return folder.filePath(name); }
};

// How a file is asked for, and the dialog that asks for its name.
struct Export {
  void (*ask)(AskedWindow& w);
  const char* dialog;
  const char* file;
};

const std::map<QString, Export> exports{
    {QStringLiteral("scene"),
     {[](AskedWindow& w) { w.child<QAction>("saveScene")->trigger(); }, "saveSceneDialog", "a.json"}},
    {QStringLiteral("recipe"),
     {[](AskedWindow& w) { w.child<QAction>("saveRecipe")->trigger(); }, "saveRecipeDialog", "a.json"}},
    {QStringLiteral("CSV of measurements"),
     {[](AskedWindow& w) { w.chooseFrom("measurementSave", "saveMeasurementsCsv"); }, "measurementSaveDialog",
      "a.csv"}},
    {QStringLiteral("shapes"),
     {[](AskedWindow& w) { w.chooseFrom("measurementSave", "saveShapes"); }, "measurementSaveDialog",
      "a.json"}},
    {QStringLiteral("CSV of segments"),
     {[](AskedWindow& w) { w.click("segmentNumbersCsv"); }, "segmentNumbersFileDialog", "a.csv"}},
    {QStringLiteral("JSON of segments"),
     {[](AskedWindow& w) { w.click("segmentNumbersJson"); }, "segmentNumbersFileDialog", "a.json"}}};

}  // namespace

class TestWhenAsked : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void filesAreOfTheMomentOfAsking_data();
  void filesAreOfTheMomentOfAsking();
  void aSessionHoldsWhatIsThereWhenItIsSaved();
};

void TestWhenAsked::filesAreOfTheMomentOfAsking_data() {
  QTest::addColumn<QString>("name");
  for (const auto& [name, how] : exports) QTest::newRow(qPrintable(name)) << name;
}

void TestWhenAsked::filesAreOfTheMomentOfAsking() {
  QFETCH(QString, name);
  const Export& how = exports.at(name);
  AskedWindow w;
  QVERIFY(w.prepare());
  const auto save = [&](const QString& file, bool goesOn) {
    how.ask(w);
    if (goesOn) w.goOn();
    answer(w, how.dialog, file);
    const bool isThere = QTest::qWaitFor(
        [&] { return QFileInfo(file).size() > 0 && w.window.jobs().rows().empty(); }, longest);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return isThere ? contentsOf(file) : QByteArray();
  };
  const QString file = QString::fromLatin1(how.file);
  const QByteArray undisturbed = save(w.at(QStringLiteral("first-") + file), false);
  QVERIFY(!undisturbed.isEmpty());
  QCOMPARE(save(w.at(QStringLiteral("then-") + file), true), undisturbed);
}

// A job may end while the dialog is open, and its result would seem saved.
void TestWhenAsked::aSessionHoldsWhatIsThereWhenItIsSaved() {
  AskedWindow w;
  QVERIFY(w.make(800, 1200));
  w.child<QDoubleSpinBox>("segmentLow")->setValue(400);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(600);
  w.click("segment");
  QCOMPARE(w.count(), std::size_t(1));
  w.child<QAction>("saveSessionAs")->trigger();
  QVERIFY(w.idle() && w.count() == 2);
  const QString path = w.at(QStringLiteral("s.volumen"));
  answer(w, "saveSessionDialog", path);
  const SessionFiles& files = w.window.document().files;
  QTRY_COMPARE_WITH_TIMEOUT(files.path(), path, longest);
  QVERIFY(!files.modified() && files.unsavedWork().empty());
  QVERIFY(contentsOf(path).contains("400 to 600 HU"));
}

VOLUMEN_TEST(TestWhenAsked);
#include "tst_when_asked.moc"
