// Guards slices.md 3 (PS3.3 C.11.2): from values to grey, with the edges of windows.
#include <cmath>
#include <limits>

#include "tests/fixtures/chance.h"
#include "tests/unit/suite.h"
#include "viewer/slice/grey.h"

using namespace volumen;
using namespace volumen::tests;

class TestGrey : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void greyOfValues_data();
  void greyOfValues();
  void wholeValuesHaveTheByteOfTheDefinition_data();
  void wholeValuesHaveTheByteOfTheDefinition();
  void bytesAreThoseOfTheGrey_data();
  void bytesAreThoseOfTheGrey();
  void outsideIsAsAsked();
};

namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

GreyMapping mapping(double centre, double width, WindowFunction function) {
  GreyMapping m;
  m.window = {centre, width};
  m.function = function;
  return m;
}
GreyMapping linear(double centre, double width) { return mapping(centre, width, WindowFunction::linear); }
GreyMapping exact(double centre, double width) { return mapping(centre, width, WindowFunction::linearExact); }
GreyMapping sigmoid(double centre, double width) { return mapping(centre, width, WindowFunction::sigmoid); }
GreyMapping table() {
  GreyMapping m;
  m.table = {-3, {0.25f, 0.5f, 1, 0.75f}};
  return m;
}
GreyMapping inverted(GreyMapping m) {
  m.inverted = true;
  return m;
}

}  // namespace

void TestGrey::greyOfValues_data() {
  QTest::addColumn<GreyMapping>("mapping");
  QTest::addColumn<double>("value");
  QTest::addColumn<double>("grey");
  const auto row = [](const char* name, const GreyMapping& mapping, double value, double grey) {
    QTest::newRow(name) << mapping << value << grey;
  };
  // Examples of C.11.2.1.2.1: 2048, 4096 maps 0 .. 4095 to all greys; 2048, 1 is a step at 2047.5.
  row("LINEAR 2048, 4096 at 0", linear(2048, 4096), 0, 0);
  row("LINEAR 2048, 4096 at 1", linear(2048, 4096), 1, 1 / 4095.);
  row("LINEAR 2048, 4096 at 4094", linear(2048, 4096), 4094, 4094 / 4095.);
  row("LINEAR 2048, 4096 at 4095", linear(2048, 4096), 4095, 1);
  row("LINEAR 2048, 4096 below", linear(2048, 4096), -7, 0);
  row("LINEAR 2048, 4096 above", linear(2048, 4096), 5000, 1);
  row("LINEAR c - 1/2 is the middle", linear(40, 400), 39.5, 0.5);
  row("LINEAR lower end", linear(40, 400), 39.5 - 199.5, 0);
  row("LINEAR upper end", linear(40, 400), 39.5 + 199.5, 1);
  row("LINEAR width 1 at c - 1/2", linear(2048, 1), 2047.5, 0);
  row("LINEAR width 1 above it", linear(2048, 1), std::nextafter(2047.5, 3000), 1);
  row("LINEAR width 1 at 2047", linear(2048, 1), 2047, 0);
  row("LINEAR width 1 at 2048", linear(2048, 1), 2048, 1);
  row("LINEAR width below 1 is 1", linear(2048, 0.25), 2047.6, 1);
  row("LINEAR width 2", linear(10, 2), 9.25, 0.25);
  row("LINEAR of infinity", linear(40, 400), infinity, 1);
  row("LINEAR_EXACT c is the middle", exact(40, 400), 40, 0.5);
  row("LINEAR_EXACT lower end", exact(40, 400), -160, 0);
  row("LINEAR_EXACT upper end", exact(40, 400), 240, 1);
  row("LINEAR_EXACT below", exact(40, 400), -161, 0);
  row("LINEAR_EXACT narrow", exact(0.5, 0.001), 0.50025, 0.75);
  row("SIGMOID c is the middle", sigmoid(40, 400), 40, 0.5);
  row("SIGMOID half a width above", sigmoid(40, 400), 240, 1 / (1 + std::exp(-2.)));
  row("SIGMOID far below", sigmoid(40, 400), -1e30, 0);
  row("table, first", table(), -3, 0.25);
  row("table, below", table(), -1000, 0.25);
  row("table, second", table(), -2, 0.5);
  row("table, last", table(), 0, 0.75);
  row("table, above", table(), 1e30, 0.75);
  row("table, nearer the third", table(), -1.5, 1);
  row("table, inverted", inverted(table()), -2.2, 0.5);
  row("inverted, lower end", inverted(linear(40, 400)), -160, 1);
  row("inverted, a quarter", inverted(exact(40, 400)), -60, 0.75);
}

void TestGrey::greyOfValues() {
  QFETCH(GreyMapping, mapping);
  QFETCH(double, value);
  QFETCH(double, grey);
  QVERIFY(std::abs(greyOf(value, mapping) - grey) < 1e-12);
  QVERIFY(std::isnan(greyOf(noNumber, mapping)));
}

void TestGrey::wholeValuesHaveTheByteOfTheDefinition_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<bool>("inverted");
  // At 256 and 511, greys of integer values are whole bytes or midpoints between two.
  for (const int width : {1, 2, 3, 256, 257, 400, 511, 1021, 4096, 65536})
    for (const bool upsideDown : {false, true})
      QTest::addRow("%d, %d", width, upsideDown) << width << upsideDown;
}

// Uses integers: floor(255 y + 1/2) with y = (2 v - 2 c + 1) / (2 (w - 1)) + 1/2.
void TestGrey::wholeValuesHaveTheByteOfTheDefinition() {
  QFETCH(int, width);
  QFETCH(bool, inverted);
  const int centre = 40;
  std::vector<float> values;
  std::vector<int> bytes;
  for (int v = centre - width; v <= centre + width; ++v) {
    const long long twice = 2ll * (v - centre) + 1, most = 2ll * (width - 1);
    int byte = 0;
    if (twice <= -(width - 1))
      byte = inverted ? 255 : 0;
    else if (twice > width - 1)
      byte = inverted ? 0 : 255;
    else  // 255 y + 1/2 = 255 twice / most + 128
      byte = int((255 * (inverted ? -twice : twice) + 128 * most) / most);
    values.push_back(float(v)), bytes.push_back(byte);
  }
  GreyMapping mapping = linear(centre, width);
  mapping.inverted = inverted;
  const auto is = greyBytes(values, mapping);
  for (std::size_t n = 0; n < values.size(); ++n) QCOMPARE(int(is[n]), bytes[n]);
}

void TestGrey::bytesAreThoseOfTheGrey_data() {
  QTest::addColumn<GreyMapping>("mapping");
  QTest::newRow("LINEAR") << linear(40, 400);
  QTest::newRow("LINEAR, a step") << linear(40, 1);
  QTest::newRow("LINEAR_EXACT") << exact(-12.3, 71.9);
  QTest::newRow("SIGMOID") << sigmoid(40, 400);
  QTest::newRow("table") << table();
}

// Covers any count of values, so that the last ones are checked too. Random values lie on no byte's edge.
void TestGrey::bytesAreThoseOfTheGrey() {
  QFETCH(GreyMapping, mapping);
  Chance chance(7);
  for (const bool inverted : {false, true})
    for (int count = 0; count < 70; ++count) {
      mapping.inverted = inverted;
      std::vector<float> values;
      for (int n = 0; n < count; ++n)
        values.push_back(chance.oneIn(9) ? float(noNumber) : float(chance.between(-300, 400)));
      const auto bytes = greyBytes(values, mapping, 17);
      QCOMPARE(int(bytes.size()), count);
      for (int n = 0; n < count; ++n) {
        const double grey = greyOf(double(values[n]), mapping);
        QCOMPARE(int(bytes[n]), std::isnan(grey) ? 17 : int(std::floor(255 * grey + 0.5)));
      }
    }
}

void TestGrey::outsideIsAsAsked() {
  const std::vector<float> values{float(noNumber), 1e38f, -1e38f, float(infinity), float(-infinity)};
  QCOMPARE(greyBytes(values, linear(0, 10)), (std::vector<std::uint8_t>{0, 255, 0, 255, 0}));
  QCOMPARE(greyBytes(values, inverted(exact(0, 10)), 99), (std::vector<std::uint8_t>{99, 0, 255, 0, 255}));
}

VOLUMEN_TEST(TestGrey);
#include "tst_grey.moc"
