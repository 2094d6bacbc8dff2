// Guards the entries of menus and tool bar and their order. Each feature defines those of its own actions.
#include <QDialog>
#include <QMenuBar>
#include <QScrollBar>
#include <QSettings>
#include <QTextBrowser>
#include <QToolBar>
#include <QWidgetAction>
#include <memory>

#include "tests/ui/journey.h"
#include "tests/unit/suite.h"

using namespace volumen;

namespace {

// Returns the entry's text, "|" for a separator, "NAME >" for a menu, and a widget's name in brackets.
QString entryText(const QAction* action) {
  if (action->isSeparator()) return QStringLiteral("|");
  if (const auto* holder = qobject_cast<const QWidgetAction*>(action))
    return QStringLiteral("[%1]").arg(holder->defaultWidget()->objectName());
  return action->menu() ? action->text() + QStringLiteral(" >") : action->text();
}

QStringList entriesOf(const QWidget* menu) {
  QStringList entries;
  for (const QAction* action : menu->actions()) entries << entryText(action);
  return entries;
}

QStringList listed(const char* entries) { return QString::fromLatin1(entries).split(QStringLiteral("; ")); }

// Returns the menu to which titles lead from the menu bar, or the bar if there are no titles.
const QWidget* menuAt(const QMainWindow& window, const QString& titles) {
  const QWidget* at = window.menuBar();
  for (const QString& title : titles.split(QLatin1Char('/'), Qt::SkipEmptyParts)) {
    const QWidget* next = nullptr;
    for (const QAction* action : at->actions())
      if (action->menu() && action->text() == title) next = action->menu();
    if (!next) return nullptr;
    at = next;
  }
  return at;
}

}  // namespace

class TestMenus : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void menusHoldWhatTheyShould_data();
  void menusHoldWhatTheyShould();
  void theToolBarHoldsWhatItShould();
  void noMenuIsLongerThanAScreen();
  void theKeysFitAScreenAndScroll();
  void anActionIsUsedOnlyOnceItIsMade();

 private:
  std::unique_ptr<const MainWindow> window_;
};

void TestMenus::initTestCase() {
  QSettings().clear();
  window_ = std::make_unique<const MainWindow>(realServices());
}

void TestMenus::menusHoldWhatTheyShould_data() {
  QTest::addColumn<QStringList>("entries");
  const auto row = [](const char* titles, const char* entries) { QTest::newRow(titles) << listed(entries); };
  row("", "&File >; &Edit >; &View >; &Tools >; &Segments >; &3D >; &Help >");
  row("&File",
      "Open folder...; Open file...; Open recent >; Sample study; |; "
      "Study list; Find study...; Import folder...; Receive studies; |; "
      "Open session...; Save session; Save session as...; |; "
      "Restore earlier work >; Open scene...; Save scene...; Import segments...; Export segments...; |; Save "
      "picture...; Copy "
      "picture; Save all "
      "views...; Copy all views; Print picture...; "
      "More pictures >; Save 3D snapshot...; Copy 3D snapshot; Export...; Send to archive...; |; Quit");
  row("&File/More pictures",
      "Picture of any size...; Stack as pictures...; Contact sheet...; Film...; |; "
      "Report of key images and measurements...");
  row("&Edit", "Undo; Redo; |; Remove table; Reset scissors; |; Preferences...");
  row("&View",
      "Show as frames; Each image its own window; Overlays and shutters; Play or stop; Go to number...; |; "
      "Maximise view; Full screen; Light theme; Hide names; Layout >; Hanging protocols >; "
      "Compare with prior; Second window; Show in this view >; Reset view; Turn and size >; "
      "Link >; "
      "Window presets >; Window of this view alone; Interpolate between voxels; "
      "Crosshair lines; Reference lines; Reference lines of first and last slices; Slab >; Colour map >; PET "
      "values >; Overlay "
      ">; DICOM attributes...; "
      "Panels >");
  row("&Tools",
      "Rotate; Adjust curve (W/L); Scissors; |; Window\tW; Scroll; Pan; Zoom; Crosshair; Magnifier; Window "
      "from region; |; Measure >; |; Key image; Previous key image; Next key image");
  row("&Segments",
      "Connected part; Paint; Outline; Cut segment; Lesion in a sphere; Level trace; Smart brush; |; Open "
      "recipe...; Save steps as a recipe...; Steps...; |; Import segments...; Export segments...");
  row("&3D",
      "Anterior view; Posterior view; Left view; Right view; Superior view; Inferior view; |; "
      "Show the table in 3D; Remove table; Reset scissors; |; "
      "Use OpenGL (usually slower without a GPU); Show error map");
  row("&View/Layout",
      "One view; Planes and 3D; Large 3D beside planes; Two series; Four series; [gridChooser]; |; "
      "Planes along the slices; Planes along the patient");
  row("&View/Hanging protocols", "Next protocol; Previous protocol; |; Save these views as a protocol...");
  row("&View/Show in this view", "3D; Axial; Coronal; Sagittal");
  row("&View/Turn and size",
      "Turn right; Turn left; Mirror left to right; Mirror top to bottom; |; "
      "A pixel of the picture a pixel of the screen; True size");
  row("&Tools/Measure",
      "Length\tD; Polyline; Curve; Long and short axis; Angle\tA; Cobb angle; Leg axis; Cardiothoracic "
      "ratio; Ellipse\tE; "
      "Rectangle; Freehand; Probe\tP; Arrow\tT; Spine labels; |; Chart of values; Show curved plane; "
      "Curved plane of another width >");
  row("&View/Panels",
      "Quality and speed; Camera; Chart of values; Clip; Effects; Slices and frames; Key images; Lights; "
      "Measure; Contours and segments; "
      "Segments; Snapshot; Studies; Opacity and colour; |; Reset layout");
  row("&Help", "Commands...; Documentation; Mouse and keys; About volumen");
}

void TestMenus::menusHoldWhatTheyShould() {
  QFETCH(QStringList, entries);
  const QWidget* menu = menuAt(*window_, QString::fromLatin1(QTest::currentDataTag()));
  QVERIFY(menu);
  QCOMPARE(entriesOf(menu), entries);
}

void TestMenus::theToolBarHoldsWhatItShould() {
  QCOMPARE(entriesOf(window_->findChild<QToolBar*>(QStringLiteral("tools"))),
           listed("Open folder...; Study list; Undo; Redo; |; "
                  "Rotate; Adjust curve (W/L); Scissors; Reset view; |; "
                  "Window\tW; Scroll; Pan; Zoom; Crosshair; Magnifier; |; "
                  "[]; [layoutButton]; [windowButton]; [measureButton]; [linkButton]; []; Save picture...; "
                  "Mouse and keys"));
}

// The screen has 768 lines.
void TestMenus::noMenuIsLongerThanAScreen() {
  for (const QAction* title : window_->menuBar()->actions())
    QVERIFY2(title->menu()->sizeHint().height() < 700, qPrintable(title->text()));
}

void TestMenus::theKeysFitAScreenAndScroll() {
  volumen::tests::Journey w;
  w.child<QAction>("shortcuts")->trigger();
  auto* box = w.child<QDialog>("shortcutsBox");
  QVERIFY(box && box->isVisible());
  QVERIFY(box->width() <= 1000 && box->height() <= 768);
  auto* text = w.child<QTextBrowser>("shortcutsText");
  QVERIFY2(!text->horizontalScrollBar()->isVisible(), "lines wrap");
  QVERIFY2(text->verticalScrollBar()->maximum() > 0, "there is more below");
  box->resize(420, 300);
  QVERIFY2(box->height() == 300 && !text->horizontalScrollBar()->isVisible(), "in less room, too");
}

void TestMenus::anActionIsUsedOnlyOnceItIsMade() {
  SharedActions shared;
  const auto use = [&] { return static_cast<QAction*>(shared.commands); };
  QVERIFY_THROWS_EXCEPTION(std::logic_error, use());
  QAction made;
  shared.commands = &made;
  QVERIFY(use() == &made);
}

VOLUMEN_TEST(TestMenus);
#include "tst_menus.moc"
