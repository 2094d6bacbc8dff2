// Guards user windows. They are added from the view in focus, and named, numbered and removed in their
// dialog. Series of their modality and unit list them after the program's windows. They are named in the
// corner and saved.
#include <QDialog>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>

#include "tests/fixtures/chance.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct OwnWindowsWindow : MeasureWindow {
  using MeasureWindow::MeasureWindow;

  void open() {
    Q_EMIT child<QMenu>("windowMenu")->aboutToShow();
    child<QMenu>("windowMenu")->actions().last()->trigger();
    QVERIFY(child<QDialog>("windowsDialog")->isVisible());
    QVERIFY(!child<QDialog>("windowsDialog")->isModal());
  }
  QTableWidget* table() { return child<QTableWidget>("windowTable"); }
  void press(const char* button) { QTest::mouseClick(child<QPushButton>(button), Qt::LeftButton); }
  // Writes a cell as its editor does on leaving.
  void write(int row, int column, const char* text) {
    table()->item(row, column)->setText(QLatin1String(text));
  }
  QStringList choices() {
    QStringList names;
    for (const FlatView::WindowChoice& each : view()->windows()) names << each.name;
    return names;
  }
  std::optional<Window> windowSet() { return session().workspace().series.at(view()->state().series).window; }
};

LoadedSeriesPtr unitless(const char* modality) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.modality = modality;
  series->series.unit.clear();
  return series;
}

}  // namespace

class TestOwnWindows : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { QSettings().remove(QStringLiteral("windows")); }
  void cleanup() { init(); }
  void oneIsAddedAndChosen();
  void itsNameAndNumbersAreEdited();
  void whatIsNoNumberStays_data();
  void whatIsNoNumberStays();
  void otherModalitiesHaveOthers();
  void theyAreKeptAndSurviveDefaults();
  void petIsInvertedInItsUnit();
  void withoutASliceItSaysSo();
  void settingsByChanceDoNoHarm();
};

void TestOwnWindows::oneIsAddedAndChosen() {
  OwnWindowsWindow w(unitless("MR"));
  QCOMPARE(w.choices(), QStringList{QStringLiteral("Automatic")});
  w.open();
  w.press("addWindow");
  QCOMPARE(w.table()->rowCount(), 1);
  QCOMPARE(w.table()->item(0, 3)->text(), QStringLiteral("MR"));
  w.write(0, 0, "Myelin");
  w.write(0, 1, "150");
  w.write(0, 2, "62.5");
  QCOMPARE(w.choices(), (QStringList{QStringLiteral("Automatic"), QStringLiteral("Myelin (150.0 / 62.5)")}));
  const int steps = w.session().undoStack().index();
  QTest::keyClick(w.view(), Qt::Key_1);
  QCOMPARE(w.windowSet(), std::optional(Window{62.5, 150}));
  QVERIFY2(w.view()->overlays().bottomRight.startsWith(QStringLiteral("Myelin  W 150")),
           qPrintable(w.view()->overlays().bottomRight));
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.press("removeWindow");
  QCOMPARE(w.table()->rowCount(), 0);
  QVERIFY2(w.view()->overlays().bottomRight.startsWith(QStringLiteral("W 150")), "the window stays, unnamed");
  QCOMPARE(w.windowSet(), std::optional(Window{62.5, 150}));
}

void TestOwnWindows::itsNameAndNumbersAreEdited() {
  OwnWindowsWindow w;
  w.open();
  w.press("addWindow");
  const QStringList before = w.choices();
  QVERIFY2(before.last().startsWith(QStringLiteral("My window 1")), "behind the program's own");
  QTest::keyClick(w.view(), Qt::Key_9);
  QCOMPARE(w.windowSet(), std::optional(Window{40, 400}));
  w.write(0, 2, "35,5");
  QTest::keyClick(w.view(), Qt::Key_9);
  QCOMPARE(w.windowSet(), std::optional(Window{35.5, 400}));
}

void TestOwnWindows::whatIsNoNumberStays_data() {
  QTest::addColumn<int>("column");
  QTest::addColumn<QByteArray>("text");
  QTest::newRow("no name") << 0 << QByteArray("  ");
  QTest::newRow("no width") << 1 << QByteArray("wide");
  QTest::newRow("width 0") << 1 << QByteArray("0");
  QTest::newRow("negative width") << 1 << QByteArray("-5");
  QTest::newRow("endless") << 1 << QByteArray("inf");
  QTest::newRow("no centre") << 2 << QByteArray("");
  QTest::newRow("nan") << 2 << QByteArray("nan");
}

void TestOwnWindows::whatIsNoNumberStays() {
  QFETCH(int, column);
  QFETCH(QByteArray, text);
  OwnWindowsWindow w;
  w.open();
  w.press("addWindow");
  const OwnWindows before = w.session().preferences().windows;
  const QString shown = w.table()->item(0, column)->text();
  w.write(0, column, text.constData());
  QVERIFY(w.session().preferences().windows == before);
  QCOMPARE(w.table()->item(0, column)->text(), shown);
}

void TestOwnWindows::otherModalitiesHaveOthers() {
  OwnWindowsWindow w(unitless("MR"));
  w.open();
  w.press("addWindow");
  QCOMPARE(w.choices().size(), 2);
  w.session().show(unitless("NM"));
  w.session().setFocus(axialViewId);
  QCOMPARE(w.choices().size(), 1);
}

void TestOwnWindows::theyAreKeptAndSurviveDefaults() {
  {
    OwnWindowsWindow w(unitless("MR"));
    w.open();
    w.press("addWindow");
    w.write(0, 0, "\"Quoted\" & <b>bold</b>");
    w.session().prefer(defaultsFor(w.session().preferences()));
    w.child<QDialog>("windowsDialog")->close();
  }
  OwnWindowsWindow again(unitless("MR"));
  QCOMPARE(again.session().preferences().windows.size(), std::size_t(1));
  QVERIFY(again.choices().last().startsWith(QStringLiteral("\"Quoted\" & <b>bold</b>")));
}

void TestOwnWindows::petIsInvertedInItsUnit() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = 0.005;
  OwnWindowsWindow w(series);
  w.session().prefer([](Preferences& p) { p.windows = {{"PT", "SUVbw", QStringLiteral("Liver"), {2, 4}}}; });
  const int last = int(w.choices().size()) - 1;
  QVERIFY2(w.choices()[last].startsWith(QStringLiteral("Liver (4 / 2")), qPrintable(w.choices()[last]));
  QTest::keyClick(w.view(), Qt::Key(Qt::Key_0 + last));
  QVERIFY(w.windowSet());
  // 2 and 4 SUVbw in Bq/ml, dark where uptake is high.
  QVERIFY(std::abs(w.windowSet()->centre - 400) < 1e-9 && std::abs(w.windowSet()->width + 800) < 1e-9);
  w.session().prefer([](Preferences& p) { p.petUnit = PetUnit::file; });
  QVERIFY2(!w.choices().join(QLatin1Char('|')).contains(QStringLiteral("Liver")), "Bq/ml are other numbers");
}

void TestOwnWindows::withoutASliceItSaysSo() {
  OwnWindowsWindow w;
  w.session().setFocus(sceneViewId);
  w.open();
  w.press("addWindow");
  QCOMPARE(w.table()->rowCount(), 0);
  QVERIFY(w.child<QLabel>("windowNote")->text().startsWith(QStringLiteral("Click a slice or a frame")));
  w.press("removeWindow");
  QVERIFY(w.child<QLabel>("windowNote")->text().startsWith(QStringLiteral("Choose the window")));
}

void TestOwnWindows::settingsByChanceDoNoHarm() {
  const OwnWindows some{{"CT", "HU", QStringLiteral("One"), {1.25, 1e-3}},
                        {"MR", "", QStringLiteral("Two"), {-7, 1e6}}};
  const QString whole = ownWindowsText(some);
  QVERIFY(ownWindowsIn(whole) == some);
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Chance chance(seed);
    QString text = whole;
    for (int n = chance.below(4); n >= 0 && !text.isEmpty(); --n)
      text.replace(chance.below(int(text.size())), 1 + chance.below(3),
                   QString(chance.below(3), QChar(32 + chance.below(90))));
    for (const OwnWindow& own : ownWindowsIn(text))
      QVERIFY2(!own.name.isEmpty() && own.window.width > 0 && std::isfinite(own.window.centre),
               qPrintable(text));
  }
}

VOLUMEN_TEST(TestOwnWindows);
#include "tst_own_windows.moc"
