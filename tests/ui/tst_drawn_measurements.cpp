// Guards what of measurements lies under the pointer and where their texts stand, without a window.
#include <glm/geometric.hpp>

#include "tests/unit/suite.h"
#include "ui/views/drawn_measurement.h"

using namespace volumen;

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
};

void TestDrawnMeasurements::whatLiesUnderAPoint_data() {
  QTest::addColumn<QPointF>("at");
  QTest::addColumn<int>("id");  // 0: none
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
  placeTexts(drawn, area, taken, QFontMetricsF(QFont()));
  QVERIFY(!drawn[0].textRect.isEmpty() && area.contains(drawn[0].textRect));
  QVERIFY(!drawn[0].textRect.intersects(shape));
  QVERIFY(!drawn[0].textRect.intersects(taken[0]));
}

void TestDrawnMeasurements::manyTextsKeepApart() {
  std::vector<DrawnMeasurement> drawn;
  for (int n = 0; n < 12; ++n)
    drawn.push_back(lineOf(n, {{30.0 + 25 * n, 40.0 + 15 * n}, {70.0 + 25 * n, 50.0 + 15 * n}}));
  placeTexts(drawn, area, {}, QFontMetricsF(QFont()));
  for (const DrawnMeasurement& d : drawn)
    for (const DrawnMeasurement& other : drawn) {
      if (d.id != other.id) QVERIFY(!d.textRect.intersects(other.textRect));
      for (int n = 0; n <= 10; ++n) {
        const QPointF on = other.lines[0][0] + (other.lines[0][1] - other.lines[0][0]) * n / 10;
        QVERIFY(!d.textRect.contains(on));
      }
    }
}

// There is no place beside it; a number that is not seen would be worse.
void TestDrawnMeasurements::whatFillsTheViewKeepsItsText() {
  std::vector<DrawnMeasurement> drawn{boxOf(1, {-10, -10, 500, 400}), boxOf(2, {500, 500, 10, 10})};
  placeTexts(drawn, area, {}, QFontMetricsF(QFont()));
  QVERIFY(area.contains(drawn[0].textRect));
  QVERIFY2(drawn[1].textRect.isEmpty(), "what is outside the view has none");
}

VOLUMEN_TEST(TestDrawnMeasurements);
#include "tst_drawn_measurements.moc"
