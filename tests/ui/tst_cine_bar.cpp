// Guards the cine bar in the window: ranges, speeds, back and forth, and user actions during playback.
#include <QSlider>
#include <QToolButton>

#include "tests/ui/cine_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestCineBar : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStackIsPlayed();
  void aRangeAndASpeedAreTyped();
  void backAndForthByItsButton();
  void onceToTheEnd();
  void handsEndIt_data();
  void handsEndIt();
  void anEditElsewhereIsOneStep();
  void whatElseIsChangedLetsItGoOn_data();
  void whatElseIsChangedLetsItGoOn();
  void whatIsUndoneCanBeDoneAgain();
  void aStepThatCancelsItselfLetsItGoOn();
  void twoBarsPlayAtOnce();
};

// All slices are played one by one, as one undo step.
void TestCineBar::aStackIsPlayed() {
  CineWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(w.view()->isPlaying());
  QVERIFY(w.bar()->isVisible());
  const std::vector<int> places = w.played(20);
  QVERIFY(!places.empty());
  for (std::size_t n = 1; n < places.size(); ++n) QCOMPARE(places[n], (places[n - 1] + 1) % 31);
  w.shot("cine-stack");
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.view()->isPlaying());
  QVERIFY(!w.bar()->isVisible());
  QCOMPARE(w.steps(), steps + 1);
  w.undo();
  QVERIFY(w.session().workspace() == before);
}

void TestCineBar::aRangeAndASpeedAreTyped() {
  CineWindow w;
  QVERIFY(w.showBar());
  auto* first = w.seen<QLineEdit>("cineFirst");
  auto* last = w.seen<QLineEdit>("cineLast");
  auto* rate = w.seen<QLineEdit>("cineRate");
  QVERIFY(first && last && rate);
  QCOMPARE(rate->text(), QStringLiteral("15"));
  const int steps = w.steps();
  w.type(first, QStringLiteral("28"));  // of 31, counted from the lowest
  w.type(last, QStringLiteral("25"));
  w.type(rate, QStringLiteral("37,5"));
  QCOMPARE(w.window.focusWidget(), w.view());
  QCOMPARE(w.steps(), steps);
  QVERIFY(w.showBar());
  QCOMPARE(rate->text(), QStringLiteral("37.5"));
  QTest::mouseClick(w.seen<QToolButton>("cinePlay"), Qt::LeftButton);
  const std::vector<int> places = w.played(9);
  QVERIFY(!places.empty());
  QCOMPARE(places.front(), 3);
  for (std::size_t n = 1; n < places.size(); ++n)
    QCOMPARE(places[n], places[n - 1] == 6 ? 3 : places[n - 1] + 1);
  // The keys choose the next usual speeds.
  QTest::keyClick(w.view(), Qt::Key_Plus);
  QCOMPARE(rate->text(), QStringLiteral("40"));
  QTest::keyClick(w.view(), Qt::Key_Minus);
  QTest::keyClick(w.view(), Qt::Key_Minus);
  QCOMPARE(rate->text(), QStringLiteral("25"));
  QVERIFY(w.view()->isPlaying());
}

void TestCineBar::backAndForthByItsButton() {
  CineWindow w;
  QVERIFY(w.showBar());
  w.type(w.seen<QLineEdit>("cineFirst"), QStringLiteral("18"));
  w.type(w.seen<QLineEdit>("cineLast"), QStringLiteral("15"));
  QVERIFY(w.showBar());
  QTest::mouseClick(w.seen<QToolButton>("cineBack"), Qt::LeftButton);
  QTest::mouseClick(w.seen<QToolButton>("cinePlay"), Qt::LeftButton);
  const std::vector<int> places = w.played(8);  // from the middle (15)
  QVERIFY(places.size() >= 8);
  QCOMPARE(std::vector<int>(places.begin(), places.begin() + 8),
           (std::vector<int>{15, 16, 15, 14, 13, 14, 15, 16}));
}

void TestCineBar::onceToTheEnd() {
  CineWindow w;
  QVERIFY(w.showBar());
  QTest::mouseClick(w.seen<QToolButton>("cineLoop"), Qt::LeftButton);
  w.type(w.seen<QLineEdit>("cineRate"), QStringLiteral("100"));
  const int steps = w.steps();
  QTest::keyClick(w.view(), Qt::Key_C);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->isPlaying(), longest);
  QCOMPARE(w.place(), 30);
  QCOMPARE(w.steps(), steps + 1);
}

void TestCineBar::handsEndIt_data() {
  using Act = std::function<void(CineWindow&)>;
  QTest::addColumn<Act>("act");
  QTest::newRow("the wheel") << Act([](CineWindow& w) { wheel(w.view(), -1); });
  QTest::newRow("a key") << Act([](CineWindow& w) { QTest::keyClick(w.view(), Qt::Key_Home); });
  QTest::newRow("the bar of the stack") << Act([](CineWindow& w) {
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, {w.view()->width() - 5, 2});
  });
  QTest::newRow("the place in its bar") << Act([](CineWindow& w) {
    const int place = w.place();
    w.seen<QSlider>("cinePlace")->setValue(place > 15 ? 2 : 28);
  });
  QTest::newRow("undo") << Act([](CineWindow& w) { w.undo(); });
  QTest::newRow("another series") << Act([](CineWindow& w) { w.session().show(stackSeries(9)); });
  QTest::newRow("the view goes") << Act([](CineWindow& w) { w.child<QAction>("layoutTwo")->trigger(); });
}

void TestCineBar::handsEndIt() {
  QFETCH(std::function<void(CineWindow&)>, act);
  CineWindow w;
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.played(3).empty());
  act(w);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->isPlaying(), longest);
  const Workspace after = w.session().workspace();
  QTest::qWait(200);
  QVERIFY(w.session().workspace() == after);
}

// The edit is one undo step however many slices are played meanwhile. Undo leads back through both.
void TestCineBar::anEditElsewhereIsOneStep() {
  CineWindow w;
  w.child<QAction>("layoutPlanes")->trigger();
  QCoreApplication::processEvents();
  w.session().setFocus(axialViewId);
  const Workspace before = w.session().workspace();
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.played(3).empty());
  const int steps = w.steps();
  FlatView* other = w.view(coronalViewId);
  QTest::mousePress(other, Qt::LeftButton, {}, {50, 50});
  for (int n = 1; n <= 4; ++n) {
    QTest::mouseEvent(QTest::MouseMove, other, Qt::LeftButton, {}, {50 + 10 * n, 50});
    QTest::qWait(200);  // three slices
  }
  QTest::mouseRelease(other, Qt::LeftButton, {}, {90, 50});
  const auto window = [&] { return w.session().workspace().series.at(other->state().series).window; };
  QVERIFY(window());
  QVERIFY(w.view()->isPlaying());
  QVERIFY(!w.played(3).empty());
  QTest::mouseClick(w.seen<QToolButton>("cinePlay"), Qt::LeftButton);
  QVERIFY(!w.view()->isPlaying());
  QCOMPARE(w.steps(), steps + 1);
  const Workspace after = w.session().workspace();
  w.undo();
  QVERIFY(!window());
  w.undo();
  QVERIFY(w.session().workspace() == before);
  w.redo();
  w.redo();
  Workspace again = w.session().workspace();
  again.focus = after.focus;  // which is no undo step
  QVERIFY(again == after);
}

void TestCineBar::whatElseIsChangedLetsItGoOn_data() {
  using Act = std::function<void(CineWindow&)>;
  QTest::addColumn<Act>("act");
  QTest::newRow("a zoom") << Act([](CineWindow& w) { wheel(w.view(), 1, Qt::ControlModifier); });
  QTest::newRow("inverted") << Act([](CineWindow& w) { QTest::keyClick(w.view(), Qt::Key_I); });
  QTest::newRow("a window") << Act([](CineWindow& w) { QTest::keyClick(w.view(), Qt::Key_1); });
  QTest::newRow("a pan") << Act([](CineWindow& w) {
    drag(w.view(), {80, 80}, {120, 100}, Qt::MiddleButton);
  });
}

void TestCineBar::whatElseIsChangedLetsItGoOn() {
  QFETCH(std::function<void(CineWindow&)>, act);
  CineWindow w;
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.played(3).empty());
  const int steps = w.steps();
  act(w);
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(!w.played(3).empty());
  QVERIFY(w.view()->isPlaying());
  QCOMPARE(w.steps(), steps + 1);
}

void TestCineBar::whatIsUndoneCanBeDoneAgain() {
  CineWindow w;
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.played(3).empty());
  QTest::keyClick(w.view(), Qt::Key_I);
  QVERIFY(!w.played(3).empty());
  w.undo();
  QVERIFY(!w.view()->isPlaying());
  QVERIFY(!flatLookOf(w.view()->state()).inverted);
  QTest::qWait(200);
  w.redo();
  QVERIFY(flatLookOf(w.view()->state()).inverted);
}

void TestCineBar::aStepThatCancelsItselfLetsItGoOn() {
  CineWindow w;
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.played(3).empty());
  const int steps = w.steps();
  const Workspace before = w.session().workspace();
  const QString name = QStringLiteral("there and back");
  w.session().change(
      name, [](Workspace& all) { all.measurementsShown = !all.measurementsShown; }, name);
  QCOMPARE(w.steps(), steps + 1);
  w.session().change(name, before, name);
  QCOMPARE(w.steps(), steps);
  QVERIFY(w.view()->isPlaying());
  QVERIFY(!w.played(3).empty());
}

// If one bar returns to its start, its undo step disappears. The other bar continues.
void TestCineBar::twoBarsPlayAtOnce() {
  CineWindow w;
  QTest::keyClick(w.view(), Qt::Key_Down);
  QTest::keyClick(w.view(), Qt::Key_Up);  // the crosshair is back at its start, and set
  for (const auto& [name, typed] :
       {std::pair("cineFirst", "17"), std::pair("cineLast", "15"), std::pair("cineRate", "100")}) {
    QVERIFY(w.showBar());
    w.type(w.seen<QLineEdit>(name), QLatin1String(typed));
  }
  w.child<QAction>("layoutPlanes")->trigger();
  w.session().setFocus(coronalViewId);
  w.child<QAction>("layoutOne")->trigger();
  QCoreApplication::processEvents();
  FlatView* other = w.view(coronalViewId);
  QVERIFY(other->isVisible());
  QTest::keyClick(other, Qt::Key_C);
  w.type(w.seen<QLineEdit>("cineRate", coronalViewId), QStringLiteral("0.1"));
  QTest::keyClick(other, Qt::Key_C);
  QVERIFY(!other->isPlaying());
  w.child<QAction>("layoutPlanes")->trigger();
  QCoreApplication::processEvents();
  const int steps = w.steps();
  for (const ViewId id : {coronalViewId, axialViewId}) {
    w.session().setFocus(id);
    QTest::keyClick(w.view(id), Qt::Key_C);
    QVERIFY(w.view(id)->isPlaying());
  }
  int gone = 0;
  const QObject listening;
  QObject::connect(&w.session().undoStack(), &QUndoStack::indexChanged, &listening,
                   [&](int index) { gone += index == steps; });
  const std::vector<int> places = w.played(7);  // from the middle (15)
  QVERIFY(places.size() >= 7);
  QCOMPARE(std::vector<int>(places.begin(), places.begin() + 7),
           (std::vector<int>{15, 16, 14, 15, 16, 14, 15}));
  QVERIFY(gone > 0);
  QVERIFY(w.view()->isPlaying() && other->isPlaying());
  for (int n = 0; n < 4; ++n) QTest::keyClick(other, Qt::Key_Plus);
  const int before = w.place(coronalViewId);
  QTRY_VERIFY_WITH_TIMEOUT(w.place(coronalViewId) != before, longest);
  QVERIFY(w.view()->isPlaying() && other->isPlaying());
  QVERIFY(w.steps() > steps);
  w.undo();
  QVERIFY(!w.view()->isPlaying() && !other->isPlaying());
}

VOLUMEN_TEST(TestCineBar);
#include "tst_cine_bar.moc"
