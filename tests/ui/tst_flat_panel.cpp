// Guards the panel of slices and frames. It describes the view in focus, and its settings change that view,
// one undo step a gesture. Real key events for typed values.
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QToolButton>

#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "ui/widgets/explained.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct FlatPanelWindow : MeasureWindow {
  using MeasureWindow::MeasureWindow;

  SeriesState seriesState() { return session().workspace().series.at(view()->state().series); }
  FlatLook look(ViewId id = axialViewId) { return flatLookOf(session().workspace().view(id)); }
  int steps() { return session().undoStack().index(); }
  void choose(const char* combo, const char* text) {
    auto* box = child<QComboBox>(combo);
    const int n = box->findText(QLatin1String(text), Qt::MatchStartsWith);
    QVERIFY2(n >= 0, text);
    box->setCurrentIndex(n);
    Q_EMIT box->activated(n);
  }
  void type(const char* name, const char* text) {
    auto* field = child<QDoubleSpinBox>(name);
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, QLatin1String(text));
    QTest::keyClick(field, Qt::Key_Return);
  }
  double shown(const char* name) { return child<QDoubleSpinBox>(name)->value(); }
};

}  // namespace

class TestFlatPanel : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theWindowIsTyped_data();
  void theWindowIsTyped();
  void noWindowHasNoWidth_data();
  void noWindowHasNoWidth();
  void windowsAreChosenByName();
  void coloursAndInversionAreSet();
  void slabAndInterpolationAreSet();
  void behindAnotherTabItRests();
  void anOverlayHasWindowColoursAndOpacity();
  void itSaysWhatTheSeriesIs();
  void framesHaveNoSlab();
  void coloursHaveNoWindow();
  void withoutAFlatViewItSaysSo();
};

void TestFlatPanel::theWindowIsTyped_data() {
  QTest::addColumn<QByteArray>("field");
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<double>("centre");
  QTest::addColumn<double>("width");
  const auto row = [](const char* name, const char* field, const char* text, double centre, double width) {
    QTest::newRow(name) << QByteArray(field) << QByteArray(text) << centre << width;
  };
  // Starts from 40 / 400, which is -160 to 240.
  row("centre", "flatCentre", "100", 100, 400);
  row("width", "flatWidth", "200", 40, 200);
  row("lowest", "flatLow", "0", 120, 240);
  row("highest", "flatHigh", "100", -30, 260);
  row("lowest above highest", "flatLow", "500", 700, 400);
  row("highest below lowest", "flatHigh", "-300", -500, 400);
}

void TestFlatPanel::theWindowIsTyped() {
  QFETCH(QByteArray, field);
  QFETCH(QByteArray, text);
  QFETCH(double, centre);
  QFETCH(double, width);
  FlatPanelWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  QCOMPARE(w.shown("flatCentre"), 40.0);
  QVERIFY(w.child<QDoubleSpinBox>("flatCentre")->suffix() == QStringLiteral(" HU"));
  w.type(field.constData(), text.constData());
  QCOMPARE(w.seriesState().window, std::optional(Window{centre, width}));
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.shown("flatCentre"), centre);
  QCOMPARE(w.shown("flatWidth"), width);
  QCOMPARE(w.shown("flatLow"), centre - width / 2);
  QCOMPARE(w.shown("flatHigh"), centre + width / 2);
  w.undo();
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(w.shown("flatCentre"), 40.0);
}

void TestFlatPanel::noWindowHasNoWidth_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::newRow("0") << QByteArray("0");
  QTest::newRow("less than the field's digits") << QByteArray("0.0");
}

void TestFlatPanel::noWindowHasNoWidth() {
  QFETCH(QByteArray, text);
  FlatPanelWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  w.type("flatWidth", text.constData());
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(w.steps(), steps);
  QCOMPARE(w.shown("flatWidth"), 400.0);
  w.type("flatWidth", "300");
  QCOMPARE(w.seriesState().window, std::optional(Window{40, 300}));
}

void TestFlatPanel::windowsAreChosenByName() {
  FlatPanelWindow w;
  auto* choice = w.child<QComboBox>("flatWindowChoice");
  QVERIFY(choice->isVisible());
  QCOMPARE(choice->currentText(), QStringLiteral("Automatic"));
  w.choose("flatWindowChoice", "Lung");
  QCOMPARE(w.seriesState().window, std::optional(Window{-600, 1500}));
  QVERIFY(choice->currentText().startsWith(QStringLiteral("Lung")));
  w.type("flatWidth", "1400");
  QCOMPARE(choice->currentIndex(), -1);
  QTest::keyClick(w.view(), Qt::Key_0);
  QCOMPARE(choice->currentText(), QStringLiteral("Automatic"));
}

void TestFlatPanel::coloursAndInversionAreSet() {
  FlatPanelWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  w.choose("flatColours", "Hot iron");
  QCOMPARE(w.seriesState().colours, ColourMap::hotIron);
  auto* inverted = w.child<QCheckBox>("flatInverted");
  QTest::mouseClick(inverted, Qt::LeftButton, {}, QPoint(8, inverted->height() / 2));
  QVERIFY(w.look().inverted);
  QTest::keyClick(w.view(), Qt::Key_I);
  QVERIFY(!w.look().inverted && !inverted->isChecked());
  QCOMPARE(w.steps(), steps + 3);
  while (w.steps() > steps) w.undo();
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(w.child<QComboBox>("flatColours")->currentText(), QStringLiteral("Grey"));
}

void TestFlatPanel::slabAndInterpolationAreSet() {
  FlatPanelWindow w;
  const int steps = w.steps();
  w.type("flatSlab", "12.5");
  QCOMPARE(w.look().slabMm, 12.5);
  QCOMPARE(w.look(coronalViewId).slabMm, 0.0);
  w.choose("flatSlabMode", "Mean");
  QCOMPARE(w.look().slabMode, SlabMode::mean);
  QCOMPARE(w.look().slabMm, 12.5);
  auto* smooth = w.child<QCheckBox>("flatInterpolated");
  QVERIFY(smooth->isChecked());
  for (const QString& text : {smooth->text(), w.child<QAction>("interpolate")->text()})
    QCOMPARE(text, QStringLiteral("Interpolate between voxels"));
  QTest::mouseClick(smooth, Qt::LeftButton, {}, QPoint(8, smooth->height() / 2));
  QVERIFY(w.look().nearest && w.look(coronalViewId).nearest);
  QCOMPARE(w.steps(), steps + 3);
  // Another view in focus has another slab.
  QTest::mouseClick(w.view(coronalViewId), Qt::LeftButton, {}, {60, 60});
  QCOMPARE(w.shown("flatSlab"), 0.0);
}

void TestFlatPanel::behindAnotherTabItRests() {
  FlatPanelWindow w;
  auto* dock = w.child<QDockWidget>("flatDock");
  QTRY_VERIFY_WITH_TIMEOUT(dock->geometry().right() >= 0, longest);
  w.child<QDockWidget>("transferDock")->raise();
  QTRY_VERIFY_WITH_TIMEOUT(dock->geometry().right() < 0, longest);
  editFlat(w.session(), axialViewId, QStringLiteral("test"), [](FlatLook& look) { look.slabMm = 7; });
  QCOMPARE(w.shown("flatSlab"), 0.0);
  dock->raise();
  QTRY_COMPARE_WITH_TIMEOUT(w.shown("flatSlab"), 7.0, longest);
}

void TestFlatPanel::anOverlayHasWindowColoursAndOpacity() {
  FlatPanelWindow w(ballIn("A"));
  auto* name = w.child<QToolButton>("overlayButton");
  QCOMPARE(name->text(), QStringLiteral("None"));
  QCOMPARE(name->menu(), w.child<QMenu>("overlayMenu"));
  QVERIFY(!w.child<QComboBox>("overlayColours")->isVisible());
  const LoadedSeriesPtr pet = petIn("A");
  w.session().keep(pet);
  w.session().change(QStringLiteral("test"), withOverlay(w.session().workspace(), axialViewId, &pet->series));
  QVERIFY2(name->text().contains(QStringLiteral("Uptake")), qPrintable(name->text()));
  QVERIFY(w.child<QComboBox>("overlayColours")->isVisible());
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  w.choose("overlayColours", "Rainbow");
  QCOMPARE(w.look(sagittalViewId).overlayColours, ColourMap::rainbow);
  w.type("Opacity", "80");
  QCOMPARE(w.look(coronalViewId).overlayOpacity, 0.8);
  QVERIFY(w.child<QDoubleSpinBox>("Opacity")->text() == QStringLiteral("80 %"));
  w.type("overlayLow", "1");
  w.type("overlayHigh", "6");
  QVERIFY(w.child<QDoubleSpinBox>("overlayHigh")->suffix() == QStringLiteral(" SUVbw"));
  const std::optional<Window> window = w.session().workspace().series.at(keyOf(pet->series)).window;
  QVERIFY(window);
  // 1 to 6 SUVbw, inverted as PET is when shown alone. 9 digits of a double remain.
  QVERIFY(std::abs(window->centre - 700) < 1e-6 && std::abs(window->width + 1000) < 1e-6);
  QVERIFY2(!w.seriesState().window, "the window of the CT is another one");
  QCOMPARE(w.steps(), steps + 4);
  while (w.steps() > steps) w.undo();
  QVERIFY(w.session().workspace() == before);
}

void TestFlatPanel::itSaysWhatTheSeriesIs() {
  auto series = std::make_shared<LoadedSeries>(*ballIn("A", 0.5));
  series->series.sliceThickness = 0.5;
  series->warnings = {Warning("Something is odd.")};
  FlatPanelWindow w(series);
  QCOMPARE(
      w.child<QLabel>("flatFacts")->text(),
      QStringLiteral("CT Ball\n32 slices, axial\n32 rows x 32 columns\nPixels of 0.5 x 0.5 mm\nSlices 0.5 "
                     "mm thick\nValues in HU\n! Something is odd."));
}

void TestFlatPanel::framesHaveNoSlab() {
  NEED_FILES();
  Frames w({"mg-sigmoid-voilut3.dcm"});
  QVERIFY(w.shows());
  QVERIFY(w.child<QWidget>("flatWindowChoice")->isVisible());
  QVERIFY(!w.child<QWidget>("flatSlab")->isVisible());
  QVERIFY(!w.child<QWidget>("overlayButton")->isVisible());
  QVERIFY(w.child<QWidget>("noSlab")->isVisible());
  for (const QString& text :
       {w.child<QCheckBox>("flatInterpolated")->text(), w.child<QAction>("interpolate")->text()})
    QCOMPARE(text, QStringLiteral("Interpolate between pixels"));
  // The frame's own windows and LUTs are listed, first the one in use.
  auto* choice = w.child<QComboBox>("flatWindowChoice");
  QStringList names;
  for (const FlatView::WindowChoice& each : w.view()->windows()) names << each.name;
  QVERIFY(names.size() > 2);
  QCOMPARE(choice->count(), int(names.size()));
  QCOMPARE(choice->itemText(2), names[2]);
  QVERIFY(w.after([&] { Q_EMIT choice->activated(2); }));
  QVERIFY(w.view()->windows()[2].isChosen);
  QCOMPARE(choice->currentIndex(), 2);
}

void TestFlatPanel::coloursHaveNoWindow() {
  NEED_FILES();
  Frames w({"sc-rgb-41.dcm"});
  QVERIFY(w.shows());
  QVERIFY(w.child<QWidget>("noWindow")->isVisible());
  QVERIFY(!w.child<QWidget>("flatWindowChoice")->isVisible());
  QVERIFY(!w.child<QWidget>("flatWidth")->isVisible());
}

void TestFlatPanel::withoutAFlatViewItSaysSo() {
  FlatPanelWindow w;
  const auto* explained = w.child<QDockWidget>("flatDock")->findChild<Explained*>();
  QCOMPARE(explained->sentence(), QString());
  w.session().setFocus(sceneViewId);
  QVERIFY(!explained->sentence().isEmpty());
  w.session().setFocus(axialViewId);
  QCOMPARE(explained->sentence(), QString());
}

VOLUMEN_TEST(TestFlatPanel);
#include "tst_flat_panel.moc"
