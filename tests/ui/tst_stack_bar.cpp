// Guards scrolling through a stack: its bar on the right, dragged and clicked, with key images and slices in
// memory. Also a typed number and Shift+wheel. Positions are compared with closed forms.
#include <QLabel>
#include <QPainter>
#include <set>

#include "tests/fixtures/chance.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/stack_window.h"
#include "tests/unit/suite.h"
#include "ui/views/stack_bar.h"
#include "ui/widgets/number_edit.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int stackSlices = 31;
constexpr QRgb barKeyColour = 0xffffc85a;

double barX(const QWidget* view) { return view->width() - 5; }

// Returns the position at a height of a bar as high as the view.
int barPlaceAt(const QWidget* view, int y, int count) {
  return std::min(count - 1, int(double(y) * count / view->height()));
}

QString saidOf(StackWindow& w) {
  const auto* label = w.seen<QLabel>("placeNumberSaid");
  return label ? label->text() : QString();
}

}  // namespace

class TestStackBar : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aDragGoesWhereTheHandIs();
  void aClickGoesThereToo();
  void escapeGivesADragUp();
  void whatLiesBesideItIsNotStolen();
  void whatIsDrawnThereComesFirst();
  void keyImagesAreMarked();
  void whatIsInMemoryIsWide();
  void framesInMemoryAreTold();
  void aNumberIsTyped();
  void wrongNumbersSayWhy();
  void fieldsCloseWithWhatIsShown_data();
  void fieldsCloseWithWhatIsShown();
  void theNumberInTheCornerIsClicked();
  void escapeInAFieldKeepsTheViewMaximised();
  void framesAreGoneToByNumber();
  void shiftMakesTheWheelFast();
};

void TestStackBar::aDragGoesWhereTheHandIs() {
  StackWindow w(stackSlices);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Chance chance(seed);
    const int from = chance.below(w.view()->height()), to = chance.below(w.view()->height());
    const int expected = barPlaceAt(w.view(), to, stackSlices), was = w.place();
    const Workspace before = w.session().workspace();
    const int steps = w.steps();
    drag(w.view(), {barX(w.view()), double(from)}, {barX(w.view()), double(to)});
    QCOMPARE(w.place(), expected);
    if (expected == was) continue;  // no undo step
    QCOMPARE(w.steps(), steps + 1);
    w.undo();
    QVERIFY(w.session().workspace() == before);
    w.redo();
    QCOMPARE(w.place(), expected);
  }
}

void TestStackBar::aClickGoesThereToo() {
  StackWindow w(stackSlices);
  const int y = w.view()->height() / 5;
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {int(barX(w.view())), y});
  QCOMPARE(w.place(), barPlaceAt(w.view(), y, stackSlices));
  // A second click does not maximise the view.
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, {int(barX(w.view())), y});
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, {int(barX(w.view())), y});
  QCOMPARE(w.place(), barPlaceAt(w.view(), y, stackSlices));
  QVERIFY(w.view(coronalViewId)->isVisible());
}

void TestStackBar::escapeGivesADragUp() {
  StackWindow w(stackSlices);
  const Workspace before = w.session().workspace();
  const QPoint at(int(barX(w.view())), 3);
  QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
  QCOMPARE(w.place(), 0);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.session().workspace() == before);
}

void TestStackBar::whatLiesBesideItIsNotStolen() {
  StackWindow w(stackSlices);
  const int place = w.place();
  const double beside = w.view()->width() - StackBar::edge - 2, y = 0.4 * w.view()->height();
  drag(w.view(), {beside, y}, {beside - 20, y + 30});
  QCOMPARE(w.place(), place);
  QVERIFY(w.session().workspace().series.at(w.view()->state().series).window.has_value());
  QVERIFY(w.view()->stackBar());
  w.session().show(nullptr);
  QVERIFY(!w.view()->stackBar());
}

// Measurements on the bar are grabbed first.
void TestStackBar::whatIsDrawnThereComesFirst() {
  StackWindow w(stackSlices);
  const int place = w.place();
  const double x = barX(w.view()), y = std::floor(0.3 * w.view()->height());
  w.choose(ShapeKind::length);
  drag(w.view(), {x, y}, {x - 60, y + 40});
  QCOMPARE(w.place(), place);
  QCOMPARE(w.all().size(), std::size_t(1));
  // An end of the measurement lies on the bar.
  const Measurement before = w.last();
  drag(w.view(), {x, y}, {x - 2, y + 60});
  QCOMPARE(w.place(), place);
  QVERIFY(!(w.last() == before));
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, QPoint(int(x), int(0.8 * w.view()->height())));
  QVERIFY(w.place() != place);
}

// Each key image marks its own pixel rows of the bar. Captured pictures show no marks.
void TestStackBar::keyImagesAreMarked() {
  StackWindow w(stackSlices);
  const Series series = w.view()->shown()->series;
  Chance chance(7);
  std::set<int> rows;
  for (int n = 0; n < 4; ++n) {
    // The uppermost slice is first.
    const int slice = chance.below(stackSlices), place = stackSlices - 1 - slice;
    const KeyImage image{keyOf(series), series.sopInstanceUids[std::size_t(slice)], 0};
    if (isKeyImage(w.session().workspace(), image)) continue;
    w.session().change(QStringLiteral("test"), withKeyImageToggled(w.session().workspace(), image));
    const int middle = int(std::round((place + 0.5) * w.view()->height() / stackSlices));
    rows.insert({middle - 1, middle});
  }
  const int column = w.view()->width() - 6;
  const auto marked = [column](const QImage& image) {
    std::set<int> found;
    for (int y = 0; y < image.height(); ++y)
      if (image.pixel(column, y) == barKeyColour) found.insert(y);
    return found;
  };
  QVERIFY(rows.size() >= 4);
  QCOMPARE(marked(w.view()->grab().toImage().convertToFormat(QImage::Format_RGB32)), rows);
  QVERIFY(marked(w.view()->capture()).empty());
}

// Rows inside a run of slices in memory are bright over the bar's whole width. Other rows are bright only in
// the line of the stack.
void TestStackBar::whatIsInMemoryIsWide() {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Chance chance(seed);
    const int count = 2 + chance.below(40), height = 200 + chance.below(300);
    std::vector<int> held;
    for (int n = 0; n < count; ++n)
      if (chance.oneIn(2)) held.push_back(n);
    const StackBar bar{QRectF(0, 0, StackBar::edge, height), {chance.below(count), count}, {}, runsOf(held)};
    QImage image(StackBar::edge, height, QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    bar.paint(painter);
    painter.end();
    for (int y = 0; y < height; ++y) {
      const int place = bar.placeAt(y + 0.5);
      // Edges of parts are rounded to pixels.
      const bool isInside = bar.placeAt(y - 0.6) == place && bar.placeAt(y + 1.6) == place;
      if (!isInside || std::abs(place - bar.place.index) < 2) continue;
      const bool isHeld = std::ranges::find(held, place) != held.end();
      QCOMPARE(qGray(image.pixel(StackBar::edge - 5, y)) > 0, isHeld);
      QVERIFY(qGray(image.pixel(StackBar::edge - 3, y)) > 0);
    }
  }
}

void TestStackBar::framesInMemoryAreTold() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  // The frame on screen and the next 32, of 34, are in memory.
  const std::vector<std::pair<int, int>> expected{{0, 32}};
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->stackBar()->held == expected, longest);
  QCOMPARE(w.view()->stackBar()->place.count, 34);
}

void TestStackBar::aNumberIsTyped() {
  StackWindow w(stackSlices);
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  QTest::keyClick(w.view(), Qt::Key_G);
  auto* field = w.seen<QLineEdit>("placeNumber");
  QVERIFY(field);
  QCOMPARE(field->text(), QStringLiteral("16"));
  QCOMPARE(saidOf(w), QStringLiteral("of 31"));
  w.shot("number-typed");
  QTest::keyClicks(field, QStringLiteral("7"));  // replaces the selected text
  QTest::keyClick(field, Qt::Key_Return);
  QVERIFY(w.view()->overlays().topRight.contains(QStringLiteral("7 / 31")));
  QCOMPARE(w.place(), stackSlices - 7);  // numbers are the file's, from the lowest slice
  QVERIFY(!w.seen<QLineEdit>("placeNumber"));
  QCOMPARE(w.window.focusWidget(), w.view());
  QCOMPARE(w.steps(), steps + 1);
  w.undo();
  QVERIFY(w.session().workspace() == before);
}

void TestStackBar::wrongNumbersSayWhy() {
  StackWindow w(stackSlices);
  const Workspace before = w.session().workspace();
  for (const char* typed : {"0", "32", "seven", "1.5", "-3", "", "1e9"}) {
    QTest::keyClick(w.view(), Qt::Key_G);
    auto* field = w.seen<QLineEdit>("placeNumber");
    QVERIFY2(field, typed);
    w.type(field, QLatin1String(typed));
    QVERIFY2(field->isVisible(), typed);
    QCOMPARE(saidOf(w), QStringLiteral("Type a whole number from 1 to 31."));
    QVERIFY2(w.view()->rect().contains(field->parentWidget()->geometry()), typed);
    QTest::keyClick(field, Qt::Key_Escape);
    QVERIFY2(!w.seen<QLineEdit>("placeNumber"), typed);
    QCOMPARE(w.window.focusWidget(), w.view());
    QVERIFY2(w.session().workspace() == before, typed);
  }
}

void TestStackBar::fieldsCloseWithWhatIsShown_data() {
  using Act = std::function<void(StackWindow&, QLineEdit*)>;
  QTest::addColumn<Act>("act");
  QTest::newRow("another series") << Act(
      [](StackWindow& w, QLineEdit*) { w.session().show(stackSeries(9)); });
  QTest::newRow("no series") << Act(
      [](StackWindow& w, QLineEdit*) { w.session().close({w.view()->state().series}); });
  QTest::newRow("the view is hidden") << Act([](StackWindow& w, QLineEdit*) {
    w.session().setFocus(coronalViewId);
    w.child<QAction>("maximise")->trigger();
  });
  QTest::newRow("Enter, and it is out of memory") << Act([](StackWindow& w, QLineEdit* field) {
    w.session().pool().forget(w.view()->state().series);
    QTest::keyClick(field, Qt::Key_Return);
  });
}

void TestStackBar::fieldsCloseWithWhatIsShown() {
  QFETCH(std::function<void(StackWindow&, QLineEdit*)>, act);
  StackWindow w(stackSlices);
  QTest::keyClick(w.view(), Qt::Key_G);
  auto* field = w.seen<QLineEdit>("placeNumber");
  QVERIFY(field);
  QTest::keyClicks(field, QStringLiteral("3"));
  act(w, field);
  for (const NumberEdit* edit : w.view()->findChildren<NumberEdit*>()) QVERIFY(edit->isHidden());
}

void TestStackBar::theNumberInTheCornerIsClicked() {
  StackWindow w(stackSlices);
  const QRectF area = QRectF(w.view()->rect()).adjusted(0, 0, -6, 0);
  QRectF number;
  for (const PlacedText& text : placeOverlays(w.view()->overlays(), area, w.view()->font()).texts)
    if (text.text == QStringLiteral("16 / 31")) number = text.rect;
  QVERIFY(!number.isEmpty());
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, number.center().toPoint());
  QVERIFY(w.seen<QLineEdit>("placeNumber"));
  // A press elsewhere cancels.
  w.view(coronalViewId)->setFocus();
  QVERIFY(!w.seen<QLineEdit>("placeNumber"));
  QCOMPARE(w.window.focusWidget(), w.view(coronalViewId));
}

void TestStackBar::escapeInAFieldKeepsTheViewMaximised() {
  StackWindow w(stackSlices);
  auto* maximise = w.child<QAction>("maximise");
  maximise->trigger();
  QTest::keyClick(w.view(), Qt::Key_G);
  auto* field = w.seen<QLineEdit>("placeNumber");
  QVERIFY(field);
  QTest::keyClick(field, Qt::Key_Escape);
  QVERIFY(!w.seen<QLineEdit>("placeNumber"));
  QVERIFY(maximise->isChecked());
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(!maximise->isChecked());
}

void TestStackBar::framesAreGoneToByNumber() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.child<QAction>("goToNumber")->trigger();
  auto* field = w.child<QLineEdit>("placeNumber");
  QVERIFY(field && field->isVisible());
  QVERIFY(w.after([&] {
    QTest::keyClicks(field, QStringLiteral("20"));
    QTest::keyClick(field, Qt::Key_Return);
  }));
  QCOMPARE(w.look().frame, 19);
  w.child<QAction>("undo")->trigger();
  QCOMPARE(w.look().frame, 0);
}

void TestStackBar::shiftMakesTheWheelFast() {
  struct Turn {
    const char* name;
    QPoint by;
    Qt::KeyboardModifiers keys;
    int places;
  };
  const Qt::KeyboardModifiers shift = Qt::ShiftModifier;
  StackWindow w(stackSlices);
  const QPointF middle = QRectF(w.view()->rect()).center();
  for (const Turn& turn : {Turn{"one a notch", {0, -120}, {}, 1},
                           {"ten with Shift", {0, -120}, shift, 10},
                           {"ten back", {0, 120}, shift, -10},
                           {"where Shift makes it horizontal", {-120, 0}, shift, 10},
                           {"a wheel of fine notches", {0, -36}, shift, 3},
                           {"not beyond the end", {0, -360}, shift, 15}}) {
    w.view()->goTo(15);
    QWheelEvent event(middle, w.view()->mapToGlobal(middle), {}, turn.by, Qt::NoButton, turn.keys,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(w.view(), &event);
    QVERIFY2(w.place() == 15 + turn.places, turn.name);
  }
}

VOLUMEN_TEST(TestStackBar);
#include "tst_stack_bar.moc"
