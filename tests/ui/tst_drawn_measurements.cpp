// Guards which measurement is under the pointer and where measurement texts stand, without a window.
#include <QImage>
#include <QPainter>
#include <glm/geometric.hpp>

#include "results/pictures/picture_font.h"
#include "tests/fixtures/chance.h"
#include "tests/unit/suite.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/rect_index.h"

using namespace volumen;
using tests::Chance;

namespace {

DrawnMeasurement lineOf(int id, std::vector<QPointF> points) {
  DrawnMeasurement d;
  d.id = id, d.kind = ShapeKind::polyline, d.whole = true;
  d.lines = {QPolygonF(QList<QPointF>(points.begin(), points.end()))};
  d.middle = d.lines[0].boundingRect().center();
  d.text = QStringList(QStringLiteral("23.4 mm"));
  return d;
}

DrawnMeasurement boxOf(int id, const QRectF& rect) {
  DrawnMeasurement d =
      lineOf(id, {rect.topLeft(), rect.topRight(), rect.bottomRight(), rect.bottomLeft(), rect.topLeft()});
  d.kind = ShapeKind::rectangle;
  return d;
}

const QRectF area(0, 0, 400, 300);

}  // namespace

class TestDrawnMeasurements : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatLiesUnderAPoint_data();
  void whatLiesUnderAPoint();
  void textsStandBesideTheirShapes_data();
  void textsStandBesideTheirShapes();
  void manyTextsKeepApart();
  void whatFillsTheViewKeepsItsText();
  void textsByChanceKeepApart_data();
  void textsByChanceKeepApart();
  void whatIsInTheWayIsFound_data();
  void whatIsInTheWayIsFound();
  void aFullAreaHasNoSecondPlace();
  void aSmallViewHasALegend();
  void whatIsLargeOrAloneHasNone_data();
  void whatIsLargeOrAloneHasNone();
};

void TestDrawnMeasurements::whatLiesUnderAPoint_data() {
  QTest::addColumn<QPointF>("at");
  QTest::addColumn<int>("id");  // 0 if there is none
  QTest::addColumn<int>("part");
  QTest::addColumn<int>("handle");
  const auto row = [](const char* name, QPointF at, int id, MeasurementPart part, int handle = 0) {
    QTest::newRow(name) << at << id << int(part) << handle;
  };
  using enum MeasurementPart;
  row("on the line", {50, 100}, 1, line);
  row("5 pixels beside it", {50, 104.9}, 1, line);
  row("further off", {50, 105.1}, 0, line);
  row("beyond its end", {206, 100}, 0, line);
  row("inside a box, off its edge", {150, 250}, 0, line);
  row("a handle", {106, 203}, 2, handle, 0);
  row("the last of several", {200, 297}, 2, handle, 2);
  row("its edge between handles", {150, 199}, 2, line);
  row("a text", {310, 20}, 2, text);
  row("a mark", {300, 157}, 3, line);
  row("where two cross, the later one", {100, 100}, 4, line);
}

void TestDrawnMeasurements::whatLiesUnderAPoint() {
  QFETCH(QPointF, at);
  QFETCH(int, id);
  QFETCH(int, part);
  QFETCH(int, handle);
  std::vector<DrawnMeasurement> drawn{lineOf(1, {{0, 100}, {200, 100}}), boxOf(2, {100, 200, 100, 100}),
                                      lineOf(3, {{300, 150}}), lineOf(4, {{100, 50}, {100, 150}})};
  for (const std::size_t n : {0u, 1u, 2u, 3u})
    drawn[1].handles.push_back({n, drawn[1].lines[0][qsizetype(n)]});
  drawn[1].textRect = {300, 10, 50, 20};
  const auto hit = hitAt(drawn, at);
  QCOMPARE(hit ? hit->drawn->id : 0, id);
  if (!hit) return;
  QCOMPARE(int(hit->part), part);
  QCOMPARE(int(hit->handle), handle);
}

void TestDrawnMeasurements::textsStandBesideTheirShapes_data() {
  QTest::addColumn<QRectF>("shape");
  QTest::newRow("in the middle") << QRectF(150, 100, 60, 60);
  QTest::newRow("at the right edge") << QRectF(340, 100, 58, 60);
  QTest::newRow("at the left edge") << QRectF(2, 100, 58, 60);
  QTest::newRow("in the upper right corner") << QRectF(330, 0, 70, 60);
  QTest::newRow("as wide as the view") << QRectF(0, 100, 400, 60);
  QTest::newRow("as high as the view") << QRectF(100, 0, 100, 300);
  QTest::newRow("partly outside") << QRectF(-50, -50, 120, 120);
  QTest::newRow("beside what is taken") << QRectF(100, 20, 100, 100);
}

void TestDrawnMeasurements::textsStandBesideTheirShapes() {
  QFETCH(QRectF, shape);
  const std::vector<QRectF> taken{{208, 0, 60, 140}};
  std::vector<DrawnMeasurement> drawn{boxOf(1, shape)};
  placeTexts(drawn, area, taken, QFontMetricsF(pictureFont()));
  QVERIFY(!drawn[0].textRect.isEmpty() && area.contains(drawn[0].textRect));
  QVERIFY(!drawn[0].textRect.intersects(shape));
  QVERIFY(!drawn[0].textRect.intersects(taken[0]));
}

void TestDrawnMeasurements::manyTextsKeepApart() {
  std::vector<DrawnMeasurement> drawn;
  for (int n = 0; n < 12; ++n)
    drawn.push_back(lineOf(n, {{30.0 + 25 * n, 40.0 + 15 * n}, {70.0 + 25 * n, 50.0 + 15 * n}}));
  placeTexts(drawn, area, {}, QFontMetricsF(pictureFont()));
  for (const DrawnMeasurement& d : drawn)
    for (const DrawnMeasurement& other : drawn) {
      if (d.id != other.id) QVERIFY(!d.textRect.intersects(other.textRect));
      for (int n = 0; n <= 10; ++n) {
        const QPointF on = other.lines[0][0] + (other.lines[0][1] - other.lines[0][0]) * n / 10;
        QVERIFY(!d.textRect.contains(on));
      }
    }
}

// There is no space beside the shape, but hiding the number would be worse.
void TestDrawnMeasurements::whatFillsTheViewKeepsItsText() {
  std::vector<DrawnMeasurement> drawn{boxOf(1, {-10, -10, 500, 400}), boxOf(2, {500, 500, 10, 10})};
  placeTexts(drawn, area, {}, QFontMetricsF(pictureFont()));
  QVERIFY(area.contains(drawn[0].textRect));
  QVERIFY2(drawn[1].textRect.isEmpty(), "what is outside the view has none");
}

void TestDrawnMeasurements::textsByChanceKeepApart_data() {
  QTest::addColumn<quint64>("seed");
  for (quint64 seed = 1; seed <= 60; ++seed) QTest::addRow("seed %llu", seed) << seed;
}

// Ten texts of one to four lines cover less than a sixth of the area. Each keeps the others off less than a
// tenth, so all have space, beside shapes or anywhere. Repeating it gives the same places.
void TestDrawnMeasurements::textsByChanceKeepApart() {
  QFETCH(quint64, seed);
  Chance chance(seed);
  const QRectF large(0, 0, 1200, 800);
  const std::vector<QRectF> taken{{0, 0, 180, 60}, {1000, 740, 200, 60}};
  std::vector<DrawnMeasurement> drawn;
  const int count = 2 + chance.below(9);
  const QPointF about(chance.between(100, 1000), chance.between(100, 600));
  for (int n = 0; n < count; ++n) {
    // Most shapes are clustered.
    const QPointF at = chance.oneIn(4) ? QPointF(chance.between(20, 1100), chance.between(20, 700))
                                       : about + QPointF(chance.between(-40, 40), chance.between(-40, 40));
    const QSizeF size(chance.between(4, 90), chance.between(4, 70));
    drawn.push_back(chance.oneIn(2) ? boxOf(n, {at, size})
                                    : lineOf(n, {at, at + QPointF(size.width(), size.height())}));
    for (int more = chance.below(4); more > 0; --more)
      drawn.back().text << QStringLiteral("Mean 45.2, SD 3.1");
  }
  std::vector<DrawnMeasurement> again = drawn;
  placeTexts(drawn, large, taken, QFontMetricsF(pictureFont()));
  placeTexts(again, large, taken, QFontMetricsF(pictureFont()));
  for (int n = 0; n < count; ++n) {
    const QRectF text = drawn[std::size_t(n)].textRect;
    QVERIFY(!text.isEmpty() && large.contains(text));
    QCOMPARE(again[std::size_t(n)].textRect, text);
    for (const QRectF& other : taken) QVERIFY(!text.intersects(other));
    for (int k = 0; k < n; ++k) QVERIFY(!text.intersects(drawn[std::size_t(k)].textRect));
  }
}

void TestDrawnMeasurements::whatIsInTheWayIsFound_data() {
  QTest::addColumn<double>("largest");
  QTest::newRow("small ones") << 30.0;
  QTest::newRow("as large as the area") << 400.0;
  QTest::newRow("far beyond it") << 1e7;
}

// Inside and outside the area an index agrees with a test of each rectangle.
void TestDrawnMeasurements::whatIsInTheWayIsFound() {
  QFETCH(double, largest);
  Chance chance(11);
  const auto rect = [&] {
    const QPointF at(chance.between(-largest, 400 + largest), chance.between(-largest, 300 + largest));
    return QRectF(at, QSizeF(chance.between(0, largest), chance.between(0, largest)));
  };
  RectIndex index(area);
  std::vector<QRectF> all;
  for (int n = 0; n < 60; ++n) {
    all.push_back(rect());
    index.add(all.back(), std::size_t(n));
  }
  for (int n = 0; n < 500; ++n) {
    const QRectF place = rect();
    const auto isInTheWay = [&](const QRectF& other) { return other.intersects(place); };
    QCOMPARE(index.any(place), std::ranges::any_of(all, isInTheWay));
    QCOMPARE(index.any(place, [](std::size_t item) { return item == 7; }), isInTheWay(all[7]));
  }
}

// An overlapping number is better than none.
void TestDrawnMeasurements::aFullAreaHasNoSecondPlace() {
  const QFontMetricsF metrics{pictureFont()};
  const QRectF narrow(0, 0, metrics.horizontalAdvance(QStringLiteral("23.4 mm")) + 8, metrics.height() + 8);
  std::vector<DrawnMeasurement> drawn{lineOf(1, {{2, 2}}), lineOf(2, {{4, 4}})};
  placeTexts(drawn, narrow, {}, metrics);
  for (const DrawnMeasurement& d : drawn) QVERIFY(!d.textRect.isEmpty());
}

void TestDrawnMeasurements::aSmallViewHasALegend() {
  const QFontMetricsF metrics{pictureFont()};
  const QRectF small(0, 0, 260, 240);
  const std::vector<QRectF> taken{{0, 220, 100, 20}, {60, 0, 100, 20}};
  std::vector<DrawnMeasurement> drawn{lineOf(7, {{60, 60}, {120, 90}}), boxOf(8, {130, 100, 60, 40}),
                                      lineOf(9, {{80, 150}})};
  drawn[1].text << QStringLiteral("Mean 45.2, SD 3.1 HU") << QString(400, QLatin1Char('x'));
  drawn[2].text.clear();  // it has no text
  placeLegend(drawn, small, taken, metrics);
  QCOMPARE(drawn[0].letter, QStringLiteral("A"));
  QCOMPARE(drawn[1].letter, QStringLiteral("B"));
  QVERIFY(drawn[2].letter.isEmpty() && drawn[2].legend.isEmpty());
  QCOMPARE(drawn[0].legend, QStringLiteral("A  23.4 mm"));
  QVERIFY2(drawn[1].legend.startsWith(QStringLiteral("B  23.4 mm, Mean 45.2")), qPrintable(drawn[1].legend));
  QVERIFY2(metrics.horizontalAdvance(drawn[1].legend) <= small.width(), "what is too long is cut off");
  QVERIFY(!drawn[0].legendRect.intersects(drawn[1].legendRect));
  // The legend is as low as other texts allow, and stays when shapes move.
  const QRectF first = drawn[0].legendRect;
  for (const std::size_t n : {0u, 1u}) {
    QVERIFY(small.contains(drawn[n].legendRect));
    for (const QRectF& other : taken) QVERIFY(!drawn[n].legendRect.intersects(other));
  }
  QVERIFY(drawn[1].legendRect.bottom() > 200);
  drawn[0].lines[0].translate(10, 30);
  placeLegend(drawn, small, taken, metrics);
  QCOMPARE(drawn[0].legendRect, first);
  // The letters stand where the texts would, and are smaller.
  placeTexts(drawn, small, taken, metrics);
  QVERIFY(drawn[0].textRect.width() < metrics.horizontalAdvance(QStringLiteral("23.4 mm")));
  for (const std::size_t n : {0u, 1u})
    for (const std::size_t k : {0u, 1u}) QVERIFY(!drawn[n].textRect.intersects(drawn[k].legendRect));
  // Letters and legends are drawn.
  QImage picture(260, 240, QImage::Format_RGB32);
  picture.fill(Qt::black);
  QPainter painter(&picture);
  paintMeasurements(painter, drawn);
  painter.end();
  for (const QRectF& place : {drawn[0].legendRect, drawn[0].textRect}) {
    int lit = 0;
    for (int y = int(place.top()); y < int(place.bottom()); ++y)
      for (int x = int(place.left()); x < int(place.right()); ++x) lit += qGray(picture.pixel(x, y)) > 100;
    QVERIFY(lit > 3);
  }
}

void TestDrawnMeasurements::whatIsLargeOrAloneHasNone_data() {
  QTest::addColumn<QSizeF>("size");
  QTest::addColumn<int>("count");
  QTest::newRow("large") << QSizeF(500, 400) << 3;
  QTest::newRow("just large enough") << QSizeF(smallView, smallView) << 3;
  QTest::newRow("one alone") << QSizeF(200, 200) << 1;
  QTest::newRow("no room for a legend") << QSizeF(200, 20) << 3;
}

void TestDrawnMeasurements::whatIsLargeOrAloneHasNone() {
  QFETCH(QSizeF, size);
  QFETCH(int, count);
  std::vector<DrawnMeasurement> drawn;
  for (int n = 0; n < count; ++n) drawn.push_back(lineOf(n, {{5.0 + 20 * n, 10}, {15.0 + 20 * n, 12}}));
  placeLegend(drawn, {{0, 0}, size}, {}, QFontMetricsF(pictureFont()));
  for (const DrawnMeasurement& d : drawn) QVERIFY(d.letter.isEmpty() && d.legendRect.isEmpty());
}

VOLUMEN_TEST(TestDrawnMeasurements);
#include "tst_drawn_measurements.moc"
