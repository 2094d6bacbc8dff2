// Guards what stands in the menus and in the tool bar of the window, and in which order: features say it,
// each of its own actions.
#include <QMenuBar>
#include <QSettings>
#include <QToolBar>
#include <QWidgetAction>

#include "tests/ui/journey.h"
#include "tests/unit/suite.h"

using namespace volumen;

namespace {

// Its text, "|" of a line, "NAME >" of a menu; of a widget its name in brackets.
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

// The one that titles lead to from the menu bar; none: the bar itself.
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
  void init() { QSettings().clear(); }
  void menusHoldWhatTheyShould_data();
  void menusHoldWhatTheyShould();
  void theToolBarHoldsWhatItShould();
};

void TestMenus::menusHoldWhatTheyShould_data() {
  QTest::addColumn<QStringList>("entries");
  const auto row = [](const char* titles, const char* entries) { QTest::newRow(titles) << listed(entries); };
  row("", "&File >; &Edit >; &View >; &Help >");
  row("&File",
      "Open folder...; Open file...; Open recent >; Sample study; |; "
      "Study list; Find study...; Import folder...; |; "
      "Open session...; Save session; Save session as...; |; "
      "Restore earlier work >; Open scene...; Save scene...; Import segments...; Export segments...; |; Save "
      "picture...; Copy "
      "picture; Save all "
      "views...; Copy all views; Print picture...; "
      "More pictures >; Save 3D snapshot...; Copy 3D snapshot; |; Quit");
  row("&File/More pictures",
      "Picture of any size...; Stack as pictures...; Contact sheet...; |; "
      "Key images as pages...");
  row("&Edit", "Undo; Redo; |; Remove table; Reset scissors; |; Preferences...");
  row("&View",
      "Rotate; Adjust curve (W/L); Scissors; Reset view; |; Window\tW; Scroll; Pan; Zoom; Crosshair; "
      "Magnifier; Window from region; Connected part; Paint; Outline; Cut segment; Lesion in a sphere; Level "
      "trace; Smart brush; |; "
      "Anterior view; Posterior view; Left view; Right view; Superior view; Inferior view; |; "
      "Show as frames; Each image its own window; Overlays and shutters; Play or stop; Go to number...; |; "
      "Key image; Previous key image; Next key image; |; "
      "Use OpenGL (usually slower without a GPU); Show error map; |; "
      "Maximise view; Full screen; Light theme; Hide names; Layout >; Hanging protocols >; "
      "Compare with prior; Second window; Show in this view >; Turn and size >; "
      "Link >; "
      "Measure >; Window presets >; Window of this view alone; Interpolate between voxels; "
      "Crosshair lines; Reference lines; Reference lines of first and last slices; Slab >; Colour map >; PET "
      "values >; Overlay "
      ">; DICOM attributes...; "
      "Panels >");
  row("&View/Layout",
      "One view; Planes and 3D; Large 3D beside planes; Two series; Four series; [gridChooser]; |; "
      "Planes along the slices; Planes along the patient");
  row("&View/Hanging protocols", "Next protocol; Previous protocol; |; Save these views as a protocol...");
  row("&View/Show in this view", "3D; Axial; Coronal; Sagittal");
  row("&View/Turn and size",
      "Turn right; Turn left; Mirror left to right; Mirror top to bottom; |; "
      "A pixel of the picture a pixel of the screen; True size");
  row("&View/Measure",
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
  const MainWindow window(realServices());
  const QWidget* menu = menuAt(window, QString::fromLatin1(QTest::currentDataTag()));
  QVERIFY(menu);
  QCOMPARE(entriesOf(menu), entries);
}

void TestMenus::theToolBarHoldsWhatItShould() {
  const MainWindow window(realServices());
  QCOMPARE(entriesOf(window.findChild<QToolBar*>(QStringLiteral("tools"))),
           listed("Open folder...; Study list; Undo; Redo; |; "
                  "Rotate; Adjust curve (W/L); Scissors; Reset view; |; "
                  "Window\tW; Scroll; Pan; Zoom; Crosshair; Magnifier; |; "
                  "[]; [layoutButton]; [windowButton]; [measureButton]; [linkButton]; []; Save picture...; "
                  "Mouse and keys"));
}

VOLUMEN_TEST(TestMenus);
#include "tst_menus.moc"
