// Guards the numbers of measurements without a window: which inputs a workspace needs, which numbers are
// there at once, and that a drag shows those of its latest shape.
#include <QSignalSpy>

#include "results/text/value_text.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/workspace/measurements.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Numbers {
  Session session;
  FrameService frames;
  MeasuredNumbers numbers{session, frames};
  LoadedSeriesPtr series = hollowBalls();
  SeriesKey key = keyOf(series->series);
  QSignalSpy changed{&numbers, &MeasuredNumbers::changed};

  Numbers() { session.show(series); }
  void change(const std::function<void(Workspace&)>& edit) { session.change(QStringLiteral("test"), edit); }
  const Measurement& last() { return session.workspace().measurements.back(); }
  void edit(const std::function<void(Measurement&)>& change) {
    editMeasurement(session, last().id, QStringLiteral("test"), change);
  }
  /// Returns -1 if there is no number yet.
  double at(const Measurement& m) {
    const MeasuredPtr made = numbers.numbersOf(m);
    return made && *made ? (*made)->number : -1;
  }
};

Shape lengthTo(double x) {
  Shape shape;
  shape.points = {{0, 0, 0}, {x, 0, 0}};
  return shape;
}

// Takes longer than a picture, as it looks at all voxels.
Shape volumeAbove(double low) {
  Shape shape;
  shape.kind = ShapeKind::volume;
  shape.range = {low, 2000};
  return shape;
}

using Act = std::function<void(Numbers&)>;

}  // namespace

Q_DECLARE_METATYPE(Act)

class TestMeasuredNumbers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void inputsOfAWorkspace_data();
  void inputsOfAWorkspace();
  void fastOnesAreThereAtOnce();
  void theShapeBeingDrawnIsMeasured();
  void aDragShowsTheShapeBeforeThenTheLatest();
  void numbersOutliveTheirVolume();
};

void TestMeasuredNumbers::inputsOfAWorkspace_data() {
  QTest::addColumn<Act>("act");
  QTest::addColumn<bool>("isOther");
  const auto row = [](const char* name, bool isOther, Act act) { QTest::newRow(name) << act << isOther; };
  row("nothing happened", false, [](Numbers&) {});
  row("another shape", true, [](Numbers& n) { n.edit([](Measurement& m) { m.shape = lengthTo(7); }); });
  row("its text moved", false, [](Numbers& n) { n.edit([](Measurement& m) { m.textOffset = {1, 1, 1}; }); });
  row("another look", false,
      [](Numbers& n) { n.change([](Workspace& w) { w = withLayout(w, Layout::planes); }); });
  row("another unit", true,
      [](Numbers& n) { n.session.prefer([](Preferences& p) { p.petUnit = PetUnit::file; }); });
  row("parts cut away", true, [](Numbers& n) {
    const Mask mask{true, {}};
    auto without = std::make_shared<LoadedSeries>(*n.series);
    without->volume = ballSeries(40)->volume;
    n.session.keep(without, mask);
    n.session.setMask(QStringLiteral("test"), n.key, mask);
  });
}

void TestMeasuredNumbers::inputsOfAWorkspace() {
  QFETCH(Act, act);
  QFETCH(bool, isOther);
  Numbers n;
  const PetUnit unit = shownPetUnit();
  addMeasurement(n.session, n.key, lengthTo(5));
  const auto before = numbersKeyOf(n.session, n.last());
  QVERIFY(before && !before->volume.expired());
  act(n);
  const auto after = numbersKeyOf(n.session, n.last());
  QVERIFY(after);
  QCOMPARE(*before != *after, isOther);
  n.session.prefer([&](Preferences& p) { p.petUnit = unit; });
}

void TestMeasuredNumbers::fastOnesAreThereAtOnce() {
  Numbers n;
  addMeasurement(n.session, n.key, lengthTo(5));
  QVERIFY(n.changed.size() > 0);
  QCOMPARE(n.at(n.last()), 5.0);
  n.edit([](Measurement& m) { m.shape = lengthTo(7); });
  QVERIFY(n.numbers.exactNumbersOf(n.last()));
  QCOMPARE(n.at(n.last()), 7.0);
}

void TestMeasuredNumbers::theShapeBeingDrawnIsMeasured() {
  Numbers n;
  for (const double x : {2.0, 3.0}) {
    const Measurement drawn{-1, n.key, lengthTo(x), {}};
    QCOMPARE(n.at(drawn), x);
  }
  QCOMPARE(n.changed.size(), 0);
}

void TestMeasuredNumbers::aDragShowsTheShapeBeforeThenTheLatest() {
  Numbers n;
  addMeasurement(n.session, n.key, volumeAbove(900));
  QVERIFY(!n.numbers.numbersOf(n.last()));
  const auto isDone = [&] { return n.numbers.exactNumbersOf(n.last()) != nullptr; };
  QTRY_VERIFY_WITH_TIMEOUT(isDone(), longest);
  const double first = n.at(n.last());
  for (int step = 1; step <= 5; ++step) {
    n.edit([&](Measurement& m) { m.shape = volumeAbove(900 - 100 * step); });
    QVERIFY(!n.numbers.exactNumbersOf(n.last()));
    QCOMPARE(n.at(n.last()), first);
  }
  QTRY_VERIFY_WITH_TIMEOUT(isDone(), longest);
  QCOMPARE(n.at(n.last()), measure(n.last().shape, *n.series->volume, {})->number);
  QVERIFY(n.at(n.last()) > first);
}

void TestMeasuredNumbers::numbersOutliveTheirVolume() {
  Numbers n;
  addMeasurement(n.session, n.key, lengthTo(5));
  n.session.pool().clear();
  n.change([](Workspace& w) { w.measurementsShown = false; });
  QVERIFY(!numbersKeyOf(n.session, n.last()));
  QCOMPARE(n.at(n.last()), 5.0);
  QVERIFY(n.numbers.exactNumbersOf(n.last()));
}

VOLUMEN_TEST(TestMeasuredNumbers);
#include "tst_measured_numbers.moc"
