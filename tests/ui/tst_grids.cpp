// Guards grids of series. Each of the 20 is chosen in the layout menu by the mouse, a drag and keys. Also
// guards where their views lie and what an empty view says.
#include <QLabel>
#include <QMenu>
#include <QToolButton>

#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/grid_chooser.h"
#include "ui/workspace/layout_text.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct GridWindow : MeasureWindow {
  using MeasureWindow::MeasureWindow;

  QMenu* menu() { return child<QMenu>("layoutMenu"); }
  QToolButton* cell(int rows, int columns) {
    return child<QToolButton>(qPrintable(QStringLiteral("grid%1x%2").arg(rows).arg(columns)));
  }
  QString said() { return child<QLabel>("gridSaid")->text(); }
  Layout layout() { return session().workspace().layout; }
  // Opens the menu as the button of the tool bar does.
  bool openMenu() {
    menu()->popup({10, 10});
    return QTest::qWaitFor([this] { return cell(1, 1)->isVisible(); }, longest);
  }
  // Presses a key in the widget that has the keyboard focus in the menu.
  void key(Qt::Key key) { QTest::keyClick(menu()->focusWidget(), key); }
};

Layout gridOf(int rows, int columns) { return {Layout::Kind::grid, rows, columns}; }

// Counts the light pixels of a picture.
int lightPixels(const QImage& picture) {
  int count = 0;
  for (int y = 4; y < picture.height() - 4; ++y)
    for (int x = 4; x < picture.width() - 4; ++x) count += qGreen(picture.pixel(x, y)) > 100;
  return count;
}

}  // namespace

class TestGrids : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyGridLiesInRowsAndColumns_data();
  void everyGridLiesInRowsAndColumns();
  void oneCellIsOneView();
  void aDragChooses();
  void keysChoose();
  void cellsHaveNames();
  void smallWindowsHoldThemAll();
  void emptyViewsSayWhatToDo();
};

void TestGrids::everyGridLiesInRowsAndColumns_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  for (int rows = 1; rows <= 4; ++rows)
    for (int columns = rows == 1 ? 2 : 1; columns <= 5; ++columns)
      QTest::addRow("%d x %d", rows, columns) << rows << columns;
}

void TestGrids::everyGridLiesInRowsAndColumns() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  GridWindow w;
  const Workspace before = w.session().workspace();
  QVERIFY(w.openMenu());
  QTest::mouseClick(w.cell(rows, columns), Qt::LeftButton);
  QVERIFY2(!w.menu()->isVisible(), "it was chosen");
  QCOMPARE(w.layout(), gridOf(rows, columns));
  const std::vector<ViewId> shown = viewsOnScreen(w.session().workspace());
  QCOMPARE(int(shown.size()), rows * columns);
  const QSizeF area = w.window.views()->size();
  for (int n = 0; n < rows * columns; ++n) {
    QCOMPARE(shown[std::size_t(n)], firstComparedId + n);
    const View* view = w.window.views()->viewOf(shown[std::size_t(n)]);
    QVERIFY(view->isVisible());
    // The closed form is exact except for gaps of two pixels and rounding.
    const QPointF expected((n % columns + 0.5) * area.width() / columns,
                           (n / columns + 0.5) * area.height() / rows);
    const QPointF off = QRectF(view->geometry()).center() - expected;
    QVERIFY2(std::abs(off.x()) < 3 && std::abs(off.y()) < 3, qPrintable(QString::number(n)));
    QVERIFY(std::abs(view->width() - area.width() / columns) < 4);
    QVERIFY(std::abs(view->height() - area.height() / rows) < 4);
  }
  w.undo();
  QVERIFY(w.session().workspace() == before);
}

void TestGrids::oneCellIsOneView() {
  GridWindow w;
  QVERIFY(w.openMenu());
  QTest::mouseClick(w.cell(1, 1), Qt::LeftButton);
  QCOMPARE(w.layout(), Layout::one);
}

void TestGrids::aDragChooses() {
  GridWindow w;
  QVERIFY(w.openMenu());
  QToolButton* first = w.cell(1, 1);
  const auto within = [&](QToolButton* cell) {
    return first->mapFromGlobal(cell->mapToGlobal(cell->rect().center()));
  };
  QTest::mousePress(first, Qt::LeftButton, {}, within(first));
  QTest::mouseEvent(QTest::MouseMove, first, Qt::LeftButton, {}, within(w.cell(2, 4)));
  QCOMPARE(w.said(), QStringLiteral("2 rows, 4 columns"));
  QVERIFY(w.cell(2, 4)->isChecked() && w.cell(1, 2)->isChecked());
  QVERIFY(!w.cell(3, 1)->isChecked() && !w.cell(1, 5)->isChecked());
  QTest::mouseEvent(QTest::MouseMove, first, Qt::LeftButton, {}, within(w.cell(3, 2)));
  QTest::mouseRelease(first, Qt::LeftButton, {}, within(w.cell(3, 2)));
  QCOMPARE(w.layout(), gridOf(3, 2));
}

void TestGrids::keysChoose() {
  GridWindow w;
  QTest::keyClick(&w.window, Qt::Key_6, Qt::AltModifier);
  QTRY_VERIFY(w.menu()->isVisible() && w.cell(1, 1)->isVisible());
  QTRY_VERIFY(w.menu()->focusWidget() == w.cell(1, 1));
  for (const Qt::Key key : {Qt::Key_Right, Qt::Key_Right, Qt::Key_Down, Qt::Key_Left}) w.key(key);
  QCOMPARE(w.menu()->focusWidget(), w.cell(2, 2));
  w.key(Qt::Key_Right);
  QCOMPARE(w.said(), QStringLiteral("2 rows, 3 columns"));
  w.key(Qt::Key_Return);
  QCOMPARE(w.layout(), gridOf(2, 3));
  QVERIFY(!w.menu()->isVisible());
}

void TestGrids::cellsHaveNames() {
  GridWindow w;
  QCOMPARE(w.cell(1, 1)->accessibleName(), QStringLiteral("1 row, 1 column"));
  QCOMPARE(w.cell(4, 5)->accessibleName(), QStringLiteral("4 rows, 5 columns"));
  QCOMPARE(w.child<GridChooser>("gridChooser")->accessibleName(), QStringLiteral("Grid of series"));
}

void TestGrids::smallWindowsHoldThemAll() {
  GridWindow w;
  QVERIFY(w.openMenu());
  QTest::mouseClick(w.cell(4, 5), Qt::LeftButton);
  for (const QSize size : {QSize(1, 1), QSize(900, 600)}) {
    w.window.resize(size);
    QCoreApplication::processEvents();
    const std::vector<ViewId> shown = viewsOnScreen(w.session().workspace());
    for (const ViewId id : shown) {
      const QRect at = w.window.views()->viewOf(id)->geometry();
      QVERIFY(w.window.views()->rect().contains(at));
      for (const ViewId other : shown)
        if (other != id) QVERIFY(!at.intersects(w.window.views()->viewOf(other)->geometry()));
    }
    w.window.grab();
  }
}

void TestGrids::emptyViewsSayWhatToDo() {
  GridWindow w;
  w.child<QAction>("layoutTwo")->trigger();
  View* second = w.window.views()->viewOf(firstComparedId + 1);
  QVERIFY(lightPixels(second->grab().toImage()) > 50);
  QVERIFY2(lightPixels(second->capture()) == 0, "no picture that is kept says it");
  ViewState wanted;
  QVERIFY(invitationText(wanted).startsWith(QStringLiteral("Drop a series here")));
  wanted.wanted = "T2";
  QVERIFY(invitationText(wanted).startsWith(QStringLiteral("T2\n")));
  w.session().show(ballSeries(), firstComparedId + 1);
  QVERIFY(!w.session().workspace().view(firstComparedId + 1).series.empty());
}

VOLUMEN_TEST(TestGrids);
#include "tst_grids.moc"
