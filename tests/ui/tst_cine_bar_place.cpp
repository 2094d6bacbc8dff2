// Guards where the cine bar appears, what it covers, and what its numbers and keys show and accept.
#include <QTextDocumentFragment>
#include <QToolButton>
#include <QToolTip>

#include "tests/ui/cine_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestCineBarPlace : public QObject {
  Q_OBJECT
 private Q_SLOTS:
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

// Texts move above the bar, so that no bright pixel is left under it. Without the bar, the window's numbers
// are there.
void TestCineBarPlace::theBarCoversNothing() {
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

void TestCineBarPlace::theBarComesWhereThePointerRests() {
  CineWindow w;
  QVERIFY(!w.bar()->isVisible());
  hover(w.view(), {60.0, w.view()->height() - 40.0});
  QTest::qWait(500);
  QVERIFY(!w.bar()->isVisible());
  QVERIFY(w.showBar());
  w.shot("cine-bar");
  hover(w.view(), {60.0, w.view()->height() - 40.0});
  QVERIFY(!w.bar()->isVisible());
  // There is nothing to play.
  w.child<QAction>("layoutFour")->trigger();
  QCoreApplication::processEvents();
  FlatView* empty = w.view(firstComparedId + 3);
  QVERIFY(empty && empty->isVisible() && empty->state().series.empty());
  hover(empty, {60.0, empty->height() - 2.0});
  QTest::qWait(500);
  QVERIFY(empty->findChild<CineBar*>()->isHidden());
}

void TestCineBarPlace::wrongNumbersChangeNothing() {
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

// The 16th of 31 drawn slices, from below, belongs to no file.
void TestCineBarPlace::whereSlicesAreMissingTheFileCounts() {
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
  const std::vector<int> places = w.played(7);  // past the slice without a number
  QVERIFY(places.size() >= 7);
  for (std::size_t n = 1; n < places.size(); ++n)
    QCOMPARE(places[n], places[n - 1] == 17 ? 13 : places[n - 1] + 1);
}

// The eighth slice of the file lies between two positions of the drawn grid.
void TestCineBarPlace::aSliceOffTheGridHasNoPlace() {
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

void TestCineBarPlace::aFieldBringsItsViewIntoFocus() {
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

void TestCineBarPlace::aPlayerEndsWithWhatItPlays() {
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

void TestCineBarPlace::keysChangeTheSpeedTheirWay_data() {
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

void TestCineBarPlace::keysChangeTheSpeedTheirWay() {
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

VOLUMEN_TEST(TestCineBarPlace);
#include "tst_cine_bar_place.moc"
