// Guards the colour bar of slices. The overlay has a separate window whose ends are dragged at the bar or
// typed there, in one undo step. Also guards the initial window of PET. Real mouse and key events.
#include <QLineEdit>

#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/views/colour_bar.h"
#include "ui/workspace/windows.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// 7 SUVbw in Bq/ml.
constexpr double sevenSuv = 7 / 0.005;

// A PET over a CT.
struct FusedWindow : MeasureWindow {
  LoadedSeriesPtr pet = petIn("A");

  FusedWindow() : MeasureWindow(ballIn("A")) {
    session().keep(pet);
    session().change(QStringLiteral("test"), withOverlay(session().workspace(), axialViewId, &pet->series));
    session().endGesture();
  }
  QRectF bar() { return colourBarRect(view()->rect()); }
  // Positions are whole pixels, like the mouse's.
  QPointF top() { return QPointF(bar().center().x(), bar().top() + 1).toPoint(); }
  QPointF bottom() { return QPointF(bar().center().x(), bar().bottom() - 1).toPoint(); }
  SeriesState stateOf(const LoadedSeriesPtr& series) {
    return session().workspace().series.at(keyOf(series->series));
  }
  // Returns the window ends of the overlay over the CT.
  WindowEnds ends() { return endsOf(overlayWindow(stateOf(pet), *pet)); }
  int steps() { return session().undoStack().index(); }
};

bool isNear(double a, double b) { return std::abs(a - b) < 1e-6; }

}  // namespace

class TestColourBar : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void petBeginsAtSevenSuv_data();
  void petBeginsAtSevenSuv();
  void anEndIsDragged_data();
  void anEndIsDragged();
  void endsDoNotPass();
  void escapeGivesItUp();
  void itsNumbersAreTyped();
  void whatIsNoWindowStays();
  void aSeriesInColoursHasOneToo();
  void handlesAreOnScreenAlone();
};

void TestColourBar::petBeginsAtSevenSuv_data() {
  QTest::addColumn<QString>("modality");
  QTest::addColumn<double>("factor");
  QTest::addColumn<double>("centre");
  QTest::addColumn<double>("width");
  QTest::newRow("SUV is known") << QStringLiteral("PT") << 0.005 << sevenSuv / 2 << -sevenSuv;
  QTest::newRow("SUV in the file") << QStringLiteral("PT") << 1.0 << 3.5 << -7.0;
  QTest::newRow("it is not") << QStringLiteral("PT") << 0.0 << 500.0 << -1000.0;
  QTest::newRow("no PET") << QStringLiteral("NM") << 0.0 << 500.0 << 1000.0;
}

void TestColourBar::petBeginsAtSevenSuv() {
  QFETCH(QString, modality);
  QFETCH(double, factor);
  QFETCH(double, centre);
  QFETCH(double, width);
  auto series = std::make_shared<LoadedSeries>(*petIn("A"));
  series->series.modality = modality.toStdString();
  series->series.suv = {};
  if (factor > 0) series->series.suv.bodyWeight = factor;
  const Window window = flatWindow({}, *series), over = overlayWindow({}, *series);
  QVERIFY2(isNear(window.centre, centre) && isNear(window.width, width),
           qPrintable(QString::number(window.width)));
  QVERIFY2(isNear(over.centre, centre) && isNear(over.width, std::abs(width)), "never inverted over another");
  QVERIFY2(windowToCome(series->series, series->window) == window, "known before its values are");
  SeriesState set;
  set.window = Window{1, 2};
  QCOMPARE(flatWindow(set, *series), (Window{1, 2}));
}

void TestColourBar::anEndIsDragged_data() {
  QTest::addColumn<bool>("atTop");
  QTest::addColumn<int>("up");
  QTest::addColumn<int>("keys");
  QTest::addColumn<double>("share");
  QTest::newRow("the brightest up") << true << 30 << 0 << 1.0;
  QTest::newRow("the brightest down") << true << -30 << 0 << 1.0;
  QTest::newRow("the darkest up") << false << 25 << 0 << 1.0;
  QTest::newRow("the darkest down") << false << -25 << 0 << 1.0;
  QTest::newRow("fast") << true << 20 << int(Qt::ControlModifier) << 5.0;
}

void TestColourBar::anEndIsDragged() {
  QFETCH(bool, atTop);
  QFETCH(int, up);
  QFETCH(int, keys);
  QFETCH(double, share);
  FusedWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  QVERIFY(w.bar().height() >= 50);
  const QPointF from = atTop ? w.top() : w.bottom();
  drag(w.view(), from, from - QPointF(0, up), Qt::LeftButton, Qt::KeyboardModifiers(keys));
  const double moved = share * sevenSuv * up / w.bar().height();
  QVERIFY2(isNear(w.ends().bright, atTop ? sevenSuv + moved : sevenSuv),
           qPrintable(QString::number(w.ends().bright)));
  QVERIFY2(isNear(w.ends().dark, atTop ? 0 : moved), qPrintable(QString::number(w.ends().dark)));
  QVERIFY2(flatWindow(w.stateOf(w.pet), *w.pet).width < 0, "by itself PET stays inverted");
  QVERIFY2(!w.stateOf(w.view()->shown()).window, "the window of the CT is another one");
  QCOMPARE(w.steps(), steps + 1);
  w.undo();
  QVERIFY(w.session().workspace() == before);
}

void TestColourBar::endsDoNotPass() {
  FusedWindow w;
  drag(w.view(), w.bottom(), w.bottom() - QPointF(0, 2 * w.bar().height()));
  QVERIFY(isNear(w.ends().bright, sevenSuv));
  QVERIFY(isNear(w.ends().bright - w.ends().dark, narrowestWindow(*w.pet)));
}

void TestColourBar::escapeGivesItUp() {
  FusedWindow w;
  const Workspace before = w.session().workspace();
  QTest::mousePress(w.view(), Qt::LeftButton, {}, w.top().toPoint());
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, (w.top() - QPointF(0, 20)).toPoint());
  QVERIFY(w.session().workspace() != before);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, w.top().toPoint());
  QVERIFY(w.session().workspace() == before);
}

void TestColourBar::itsNumbersAreTyped() {
  FusedWindow w;
  const int steps = w.steps();
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, w.bar().center().toPoint());
  auto *low = w.child<QLineEdit>("barLow"), *high = w.child<QLineEdit>("barHigh");
  QVERIFY(low && high && low->isVisible());
  QCOMPARE(low->text(), QStringLiteral("0"));
  QCOMPARE(high->text(), QStringLiteral("7"));
  QTest::keyClicks(low, QStringLiteral("1"));
  QTest::keyClick(low, Qt::Key_Tab);
  QTest::keyClicks(high, QStringLiteral("6"));
  QTest::keyClick(high, Qt::Key_Return);
  QVERIFY(isNear(w.ends().dark, 200) && isNear(w.ends().bright, 1200));
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY2(w.window.view()->isVisible(), "the view is not alone");
}

void TestColourBar::whatIsNoWindowStays() {
  FusedWindow w;
  const Workspace before = w.session().workspace();
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, w.bar().center().toPoint());
  auto *low = w.child<QLineEdit>("barLow"), *high = w.child<QLineEdit>("barHigh");
  QVERIFY(low && high);
  for (const char* text : {"8", "7", "one", ""}) {
    low->setFocus();
    low->selectAll();
    QTest::keyClick(low, Qt::Key_Delete);
    QTest::keyClicks(low, QLatin1String(text));
    QTest::keyClick(low, Qt::Key_Return);
    QVERIFY2(low->isVisible(), text);
  }
  QTest::keyClick(low, Qt::Key_Escape);
  QVERIFY(!low->isVisible());
  QVERIFY(w.session().workspace() == before);
}

void TestColourBar::aSeriesInColoursHasOneToo() {
  MeasureWindow w;
  const LoadedSeriesPtr shown = w.view()->shown();
  const auto set = [&] { return w.session().workspace().series.at(keyOf(shown->series)).window; };
  const QRectF bar = colourBarRect(w.view()->rect());
  const QPointF top = QPointF(bar.center().x(), bar.top() + 1).toPoint();
  const QPointF bottom = QPointF(bar.center().x(), bar.bottom() - 1).toPoint();
  drag(w.view(), bottom, bottom - QPointF(0, 20));
  QVERIFY(set());
  QVERIFY2(isNear(set()->width, 400), "in grey there is no bar: the window tool moves the centre");
  w.undo();
  w.session().change(QStringLiteral("test"), [&](Workspace& workspace) {
    workspace.series.edit(keyOf(shown->series)).colours = ColourMap::hotIron;
  });
  w.session().endGesture();
  drag(w.view(), top, top - QPointF(0, 20));
  QVERIFY(set());
  QVERIFY(isNear(set()->width, 400 * (1 + 20 / bar.height())));
  QVERIFY(isNear(endsOf(*set()).dark, -160));
}

void TestColourBar::handlesAreOnScreenAlone() {
  FusedWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QPoint beside(int(w.bar().left()) - 2, int(w.bar().top()));
  const auto greyAt = [&](const QImage& image) { return qGray(image.pixel(beside)); };
  QVERIFY(greyAt(w.view()->grab().toImage()) > 200);
  QVERIFY(greyAt(w.view()->capture()) < 200);
  hover(w.view(), w.top());
  QCOMPARE(w.view()->cursor().shape(), Qt::PointingHandCursor);
}

VOLUMEN_TEST(TestColourBar);
#include "tst_colour_bar.moc"
