// Guards the bar in the window that plays stacks: ranges, speeds, back and forth, what hands do meanwhile,
// where it comes and what it covers.
#include <QSlider>
#include <QTextDocumentFragment>
#include <QToolButton>
#include <QToolTip>

#include "tests/ui/stack_window.h"
#include "tests/unit/suite.h"
#include "ui/views/cine_bar.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct CineWindow : StackWindow {
  CineWindow() {
    window.resize(1440, 900);
    child<QAction>("layoutOne")->trigger();
    QCoreApplication::processEvents();
  }
  CineBar* bar() { return view()->findChild<CineBar*>(); }
  // With the pointer at rest at the bottom of the view.
  bool showBar() {
    hover(view(), {60.0, view()->height() - 2.0});
    return QTest::qWaitFor([&] { return bar()->isVisible(); }, longest);
  }
  // The places of the next steps while it plays.
  std::vector<int> played(int count) {
    std::vector<int> places{place()};
    const auto listening = QObject::connect(&session(), &Session::workspaceChanged, &window, [&] {
      if (place() != places.back()) places.push_back(place());
    });
    const bool came = QTest::qWaitFor([&] { return int(places.size()) > count; }, longest);
    QObject::disconnect(listening);
    return came ? places : std::vector<int>{};
  }
};

}  // namespace

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
  void theBarCoversNothing();
  void theBarComesWhereThePointerRests();
  void wrongNumbersChangeNothing();
  void whereSlicesAreMissingTheFileCounts();
  void aSliceOffTheGridHasNoPlace();
  void aFieldBringsItsViewIntoFocus();
  void aPlayerEndsWithWhatItPlays();
  void keysChangeTheSpeedTheirWay_data();
  void keysChangeTheSpeedTheirWay();
};

// Slice by slice, all of them, and one step to undo.
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
  w.type(first, QStringLiteral("28"));  // of 31, from the lowest one on
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
  // The next usual speeds.
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
  const std::vector<int> places = w.played(8);  // from the middle, which is 15
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

// However many places come meanwhile; undo leads back through both.
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
    QTest::qWait(200);  // three places
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
  again.focus = after.focus;  // which is no step
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

// Where one comes back to where it began its step is gone; the other one goes on.
void TestCineBar::twoBarsPlayAtOnce() {
  CineWindow w;
  QTest::keyClick(w.view(), Qt::Key_Down);
  QTest::keyClick(w.view(), Qt::Key_Up);  // the crosshair is where it was, and known
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
  const std::vector<int> places = w.played(7);  // from the middle, which is 15
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

// What is written stands above it: no bright pixel is left under it. Without it there is some, the window.
void TestCineBar::theBarCoversNothing() {
  CineWindow w;
  const auto hasText = [&] {
    const QImage seen = w.view()->capture();
    for (int y = seen.height() - CineBar::barHeight; y < seen.height(); ++y)
      for (int x = seen.width() * 2 / 3; x < seen.width(); ++x)
        if (qGray(seen.pixel(x, y)) > 200) return true;
    return false;
  };
  w.session().change(QStringLiteral("test"), [&](Workspace& all) {  // a black picture
    all.series.edit(w.view()->state().series).window = Window{10000, 10};
  });
  QVERIFY(hasText());
  QVERIFY(w.showBar());
  QCOMPARE(w.bar()->geometry(),
           QRect(0, w.view()->height() - CineBar::barHeight, w.view()->width(), CineBar::barHeight));
  QVERIFY(!hasText());
}

void TestCineBar::theBarComesWhereThePointerRests() {
  CineWindow w;
  QVERIFY(!w.bar()->isVisible());
  hover(w.view(), {60.0, w.view()->height() - 40.0});
  QTest::qWait(500);
  QVERIFY(!w.bar()->isVisible());
  QVERIFY(w.showBar());
  w.shot("cine-bar");
  hover(w.view(), {60.0, w.view()->height() - 40.0});
  QVERIFY(!w.bar()->isVisible());
  // Nothing is there to be played.
  w.child<QAction>("layoutFour")->trigger();
  QCoreApplication::processEvents();
  FlatView* empty = w.view(firstComparedId + 3);
  QVERIFY(empty && empty->isVisible() && empty->state().series.empty());
  hover(empty, {60.0, empty->height() - 2.0});
  QTest::qWait(500);
  QVERIFY(empty->findChild<CineBar*>()->isHidden());
}

void TestCineBar::wrongNumbersChangeNothing() {
  CineWindow w;
  QVERIFY(w.showBar());
  const CineRound before = w.bar()->round();
  for (const auto& [name, typed] :
       {std::pair("cineFirst", "0"), std::pair("cineFirst", "32"), std::pair("cineLast", "x"),
        std::pair("cineRate", "0"), std::pair("cineRate", "1000"), std::pair("cineNumber", "99")}) {
    auto* field = w.seen<QLineEdit>(name);
    QVERIFY(field);
    const QString stood = field->text();
    const int place = w.place();
    w.type(field, QLatin1String(typed));
    QVERIFY2(w.bar()->round() == before && w.place() == place, typed);
    QCOMPARE(field->text(), QLatin1String(typed));
    QTest::keyClick(field, Qt::Key_Escape);
    QCOMPARE(field->text(), stood);
    QVERIFY(w.showBar());
  }
  auto* number = w.seen<QLineEdit>("cineNumber");
  w.type(number, QStringLiteral("3"));
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("3 / 31")));
}

// The 16th of 31 that are drawn, from below, is no file's.
void TestCineBar::whereSlicesAreMissingTheFileCounts() {
  CineWindow w;
  auto series = std::make_shared<LoadedSeries>(*stackSeries(31));
  Series& known = series->series;
  known.regular = Series::Regular{known.acquired, 1, {}};
  for (int n = 0; n < 31; ++n) known.regular->copies.push_back(n == 15 ? -1 : n < 15 ? n : n - 1);
  known.acquired.size.z = 30;
  known.files.pop_back();
  known.frames.pop_back();
  known.sopInstanceUids.pop_back();
  w.session().show(series);
  QVERIFY(w.showBar());
  const auto stands = [&](const char* name) {
    const auto* field = w.seen<QLineEdit>(name);
    return field ? field->text() : QStringLiteral("it is not there");
  };
  QCOMPARE(stands("cineFirst"), QStringLiteral("30"));
  QCOMPARE(stands("cineLast"), QStringLiteral("1"));
  for (const auto& [number, place] : {std::pair(15, 16), {1, 30}, {30, 0}, {16, 14}}) {
    w.type(w.seen<QLineEdit>("cineNumber"), QString::number(number));
    QCOMPARE(w.place(), place);
    QVERIFY(w.showBar());
    QCOMPARE(stands("cineNumber"), QString::number(number));
    QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("%1 / 30").arg(number)));
  }
  QTest::keyClick(w.view(), Qt::Key_Down);
  QCOMPARE(w.place(), 15);
  QVERIFY2(stands("cineNumber").isEmpty(), "it lies between two of the file");
  w.type(w.seen<QLineEdit>("cineFirst"), QStringLiteral("17"));
  QVERIFY(w.showBar());
  w.type(w.seen<QLineEdit>("cineLast"), QStringLiteral("14"));
  QVERIFY(w.showBar());
  QCOMPARE(w.bar()->round().first, 13);
  QCOMPARE(w.bar()->round().last, 17);
  QTest::mouseClick(w.seen<QToolButton>("cinePlay"), Qt::LeftButton);
  const std::vector<int> places = w.played(7);  // through the one that has no number
  QVERIFY(places.size() >= 7);
  for (std::size_t n = 1; n < places.size(); ++n)
    QCOMPARE(places[n], places[n - 1] == 17 ? 13 : places[n - 1] + 1);
}

// The eighth of the file lies between two places of the grid that is drawn.
void TestCineBar::aSliceOffTheGridHasNoPlace() {
  CineWindow w;
  auto series = std::make_shared<LoadedSeries>(*stackSeries(31));
  Series& known = series->series;
  known.regular = Series::Regular{known.acquired, 1, {}};
  for (int n = 0; n < 31; ++n) known.regular->copies.push_back(n == 7 ? -1 : n);
  w.session().show(series);
  QVERIFY(w.showBar());
  w.type(w.seen<QLineEdit>("cineNumber"), QStringLiteral("9"));
  const int place = w.place();
  QVERIFY(w.showBar());
  const CineRound round = w.bar()->round();
  for (const char* name : {"cineNumber", "cineFirst", "cineLast"}) {
    const QString stood = w.seen<QLineEdit>(name)->text();
    w.type(w.seen<QLineEdit>(name), QStringLiteral("8"));
    QCOMPARE(w.place(), place);
    QVERIFY(w.bar()->round() == round);
    QCOMPARE(QTextDocumentFragment::fromHtml(QToolTip::text()).toPlainText(),
             QStringLiteral("Slice 8 is not in the volume."));
    QVERIFY(w.showBar());
    QCOMPARE(w.seen<QLineEdit>(name)->text(), stood);
  }
}

void TestCineBar::aFieldBringsItsViewIntoFocus() {
  CineWindow w;
  w.child<QAction>("layoutPlanes")->trigger();
  QCoreApplication::processEvents();
  w.session().setFocus(coronalViewId);
  QVERIFY(w.showBar());
  auto* number = w.seen<QLineEdit>("cineNumber");
  QVERIFY(number);
  QTest::mouseClick(number, Qt::LeftButton);
  number->setFocus();
  QCOMPARE(w.session().workspace().focus, axialViewId);
  QCOMPARE(w.window.focusWidget(), number);
}

void TestCineBar::aPlayerEndsWithWhatItPlays() {
  CineWindow w;
  w.child<QAction>("layoutPlanes")->trigger();
  QCoreApplication::processEvents();
  w.session().setFocus(axialViewId);
  QTest::keyClick(w.view(), Qt::Key_C);
  QVERIFY(!w.played(3).empty());
  w.session().pool().forget(w.view()->state().series);
  w.session().setFocus(coronalViewId);
  QVERIFY(!w.view()->isPlaying());
}

void TestCineBar::keysChangeTheSpeedTheirWay_data() {
  QTest::addColumn<QString>("from");
  QTest::addColumn<int>("key");
  QTest::addColumn<double>("to");
  QTest::newRow("up") << QStringLiteral("15") << int(Qt::Key_Plus) << 20.0;
  QTest::newRow("down") << QStringLiteral("15") << int(Qt::Key_Minus) << 10.0;
  QTest::newRow("up from between") << QStringLiteral("37.5") << int(Qt::Key_Plus) << 40.0;
  QTest::newRow("down from between") << QStringLiteral("37.5") << int(Qt::Key_Minus) << 30.0;
  QTest::newRow("down from below all") << QStringLiteral("0.5") << int(Qt::Key_Minus) << 0.5;
  QTest::newRow("up from below all") << QStringLiteral("0.5") << int(Qt::Key_Plus) << 1.0;
  QTest::newRow("down from the last") << QStringLiteral("1") << int(Qt::Key_Minus) << 1.0;
  QTest::newRow("up from the first") << QStringLiteral("100") << int(Qt::Key_Plus) << 100.0;
}

void TestCineBar::keysChangeTheSpeedTheirWay() {
  QFETCH(QString, from);
  QFETCH(int, key);
  QFETCH(double, to);
  CineWindow w;
  QVERIFY(w.showBar());
  w.type(w.seen<QLineEdit>("cineRate"), from);
  QVERIFY(w.showBar());
  QTest::keyClick(w.view(), Qt::Key(key));
  QCOMPARE(w.bar()->round().rate, to);
}

VOLUMEN_TEST(TestCineBar);
#include "tst_cine_bar.moc"
