// Guards the text of measurements: numbers with units, lists as text and CSV, and the handles of shapes.
#include <glm/geometric.hpp>

#include "results/series/loaded_frame.h"
#include "results/text/measured_text.h"
#include "tests/unit/suite.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"

using namespace volumen;

namespace {

Measured numberOf(double number, const char* unit) {
  Measured m;
  m.number = number;
  m.unit = unit;
  m.valueUnit = "HU";
  return m;
}

Measured regionOf(double area, std::optional<ValueStatistics> values) {
  Measured m = numberOf(area, "mm^2");
  m.values = values;
  return m;
}

Measured linesOf(double number, const char* unit, TwoLines lines) {
  Measured m = numberOf(number, unit);
  m.lines = std::move(lines);
  if (m.unit == m.lines->unit) m.plusMinus = 0.6;
  return m;
}

// Returns the statistics of a region in a PET over its CT.
Measured fusedRegion() {
  Measured m = regionOf(78.54, ValueStatistics{1200, 45.24, 3.05, -5, 99});
  m.source = "CT Chest";
  m.other =
      OtherValues{"PT WB", "SUVbw", ValueStatistics{30, 5.25, 1.1234, 0.5, 8}, ValuePeak{6.1234, {1, 2, 3}}};
  return m;
}

Shape shapeOf(ShapeKind kind, std::vector<glm::dvec3> points = {{0, 0, 0}}) {
  Shape shape{kind, "", std::move(points), {}, {}, {}};
  if (ruleOf(kind).region) shape.plane = ShapePlane{};
  return shape;
}

}  // namespace

class TestMeasurementText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void numbersRead_data();
  void numbersRead();
  void linesSayNumbersWithUnits_data();
  void linesSayNumbersWithUnits();
  void hoverSaysHowSure();
  void asText();
  void asCsv();
  void asCsvAlongACurve();
  void asCsvOfTwoSeriesAndTwoLines();
  void asCsvOfLegs_data();
  void asCsvOfLegs();
  void handlesKeepBoxes();
  void theSideOfAFrameIsKnown_data();
  void theSideOfAFrameIsKnown();
};

void TestMeasurementText::numbersRead_data() {
  QTest::addColumn<double>("number");
  QTest::addColumn<QString>("text");
  const auto row = [](double number, const char* text) {
    QTest::newRow(text) << number << QString::fromLatin1(text);
  };
  row(0, "0");
  row(123.456, "123.5");
  row(23.44, "23.4");
  row(-853.26, "-853.3");
  row(1.2345, "1.23");
  row(0.98765, "0.988");
  row(0.0012345, "0.00123");
  row(-0.00056789, "-0.000568");
  row(1234567.89, "1234567.9");
  row(-1024, "-1024");
}

void TestMeasurementText::numbersRead() {
  QFETCH(double, number);
  QFETCH(QString, text);
  QCOMPARE(shortNumberText(number), text);
}

void TestMeasurementText::linesSayNumbersWithUnits_data() {
  QTest::addColumn<Shape>("shape");
  QTest::addColumn<Result<Measured>>("measured");
  QTest::addColumn<QStringList>("lines");
  const auto row = [](const char* name, ShapeKind kind, const Result<Measured>& measured, const char* lines) {
    QTest::newRow(name) << shapeOf(kind) << measured
                        << QString::fromUtf8(lines).split(QLatin1Char('|'), Qt::SkipEmptyParts);
  };
  using enum ShapeKind;
  row("length", length, numberOf(23.44, "mm"), "23.4 mm");
  row("length in pixels", length, numberOf(23.44, "px"), "23.4 px");
  row("angle", angle, numberOf(45, "degrees"), "45.0\u00b0");
  row("HU", probe, numberOf(45, "HU"), "45 HU");
  row("SUV", probe, numberOf(2.345, "SUV"), "2.35 SUV");
  row("no unit", probe, numberOf(0.00123, ""), "0.00123");
  row("region", ellipse, regionOf(78.54, ValueStatistics{1200, 45.24, 3.05, -5, 99}),
      "Area 78.5 mm\u00b2|Mean 45.2, SD 3.05 HU|Min -5, max 99 HU|1,200 voxels");
  row("one voxel", ellipse, regionOf(1, ValueStatistics{1, 7, 0, 7, 7}),
      "Area 1 mm\u00b2|Mean 7, SD 0 HU|Min 7, max 7 HU|1 voxel");
  row("no voxel", rectangle, regionOf(0.04, {}), "Area 0.0400 mm\u00b2|no voxel inside");
  Measured suv = regionOf(78.54, ValueStatistics{30, 5.25, 1.1234, 0.5, 8});
  suv.valueUnit = "SUVbw";
  suv.peak = ValuePeak{6.1234, {1, 2, 3}};
  row("region of SUV", ellipse, suv,
      "Area 78.5 mm\u00b2|Mean 5.25, SD 1.12 SUVbw|SUVmax 8, SUVpeak 6.12, min 0.500 SUVbw|30 voxels");
  row("two series", ellipse, fusedRegion(),
      "Area 78.5 mm\u00b2|CT Chest: Mean 45.2, SD 3.05 HU|Min -5, max 99 HU, 1,200 voxels|"
      "PT WB: Mean 5.25, SD 1.12 SUVbw|SUVmax 8, SUVpeak 6.12, min 0.500 SUVbw, 30 voxels");
  Measured beside = fusedRegion();
  beside.other = OtherValues{"PT WB", "SUVbw", {}, {}};
  row("the second series lies elsewhere", ellipse, beside,
      "Area 78.5 mm\u00b2|CT Chest: Mean 45.2, SD 3.05 HU|Min -5, max 99 HU, 1,200 voxels|PT WB: no voxel "
      "inside");
  row("axes", bidirectional, linesOf(23.44, "mm", {23.44, 12.1, "mm"}),
      "23.4 \u00d7 12.1 mm (283.6 mm\u00b2)");
  row("axes in pixels", bidirectional, linesOf(23.44, "px", {23.44, 10, "px"}),
      "23.4 \u00d7 10 px (234.4 px\u00b2)");
  row("ratio", cardiothoracic, linesOf(0.484, "", {130.2, 269, "mm"}),
      "Ratio 0.48|Heart 130.2, thorax 269 mm");
  Measured atDetector = linesOf(0.484, "", {130.2, 269, "mm"});
  atDetector.frame = FrameReading{"at detector", false, {}, {}, {}};
  row("ratio of a radiograph", cardiothoracic, atDetector,
      "Ratio 0.48|Heart 130.2, thorax 269 mm (at detector)");
  Measured leg = numberOf(5.8, "degrees");
  leg.leg = LegAxis{174.2, LegAxis::Bend::unknown};
  row("a leg of no known side", legAxis, leg, "5.8\u00b0|HKA 174.2\u00b0");
  leg.leg->bend = LegAxis::Bend::varus;
  row("varus", legAxis, leg, "5.8\u00b0 varus|HKA 174.2\u00b0");
  leg.leg->bend = LegAxis::Bend::valgus;
  row("valgus", legAxis, leg, "5.8\u00b0 valgus|HKA 174.2\u00b0");
  leg.number = 0.04;
  leg.leg->hka = 179.96;
  row("a straight leg", legAxis, leg, "0.0\u00b0|HKA 180.0\u00b0");
  row("label", label, Error{"A label has no number."}, "");
  row("no number", angle, Error{"There is no angle."}, "There is no angle.");
  row("arrow", arrow, Error{"An arrow has no number."}, "");
}

void TestMeasurementText::linesSayNumbersWithUnits() {
  QFETCH(Shape, shape);
  QFETCH(Result<Measured>, measured);
  QFETCH(QStringList, lines);
  QCOMPARE(measuredLines(shape, measured), lines);
}

void TestMeasurementText::hoverSaysHowSure() {
  Series series;
  series.format = "DICOM";
  series.modality = "CT";
  series.description = "Chest";
  Measured m = numberOf(23.44, "px");
  m.plusMinus = 0.61;
  const Measurement length{4, {}, shapeOf(ShapeKind::length), {}};
  QCOMPARE(detailText(length, m, series),
           QStringLiteral("Length 4: 23.4 \u00b1 0.610 px, not calibrated, from CT Chest"));
  Measured probed = numberOf(45, "HU");
  probed.voxel = ProbedVoxel{{1, 2, 3}, {}, false};
  const Measurement axes{6, {}, shapeOf(ShapeKind::bidirectional), {}};
  QCOMPARE(
      detailText(axes, linesOf(23.44, "px", {23.44, 10, "px"}), series),
      QStringLiteral("Long and short axis 6: 23.4 \u00d7 10 px (234.4 px\u00b2), long axis \u00b1 0.600 px, "
                     "not calibrated, from CT Chest"));
  const Measurement ellipse{7, {}, shapeOf(ShapeKind::ellipse), {}};
  QVERIFY(detailText(ellipse, fusedRegion(), series).endsWith(QStringLiteral(", from CT Chest and PT WB")));
  const Measurement probe{5, {}, shapeOf(ShapeKind::probe), {}};
  QCOMPARE(detailText(probe, probed, series), QStringLiteral("Probe 5: 45 HU, voxel 1, 2, 3, from CT Chest"));
}

void TestMeasurementText::asText() {
  Series series;
  series.modality = "MR";
  const Result<Measured> measured = numberOf(12.5, "mm");
  Measurement named{1, {}, shapeOf(ShapeKind::length), {}};
  named.shape.name = "aorta";
  const Measurement arrow{2, {}, shapeOf(ShapeKind::arrow), {}};
  QCOMPARE(measurementsAsText({{named, &measured, &series}, {arrow, nullptr, nullptr}}),
           QStringLiteral("aorta: 12.5 mm (MR), 0.0, 0.0, 0.0 mm\nArrow 2\n"));
}

void TestMeasurementText::asCsv() {
  Series series;
  series.modality = "CT";
  Measurement named{1, {}, shapeOf(ShapeKind::length, {{0.1, -2, 3}, {4, 5, 6}}), {}};
  named.shape.name = "a \"big\", one";
  Measured length = numberOf(1.0 / 3, "mm");
  length.plusMinus = 0.5;
  const Measurement region{2, {}, shapeOf(ShapeKind::ellipse), {}};
  const Result<Measured> lengths(length), regions(regionOf(2, ValueStatistics{3, 1.5, 0.5, 1, 2})),
      none(regionOf(2, {}));
  const Measurement arrow{3, {}, shapeOf(ShapeKind::arrow), {}};
  const QStringList lines = measurementsAsCsv({{named, &lengths, &series},
                                               {region, &regions, &series},
                                               {region, &none, &series},
                                               {region, nullptr, nullptr},
                                               {arrow, nullptr, &series}})
                                .split(QStringLiteral("\r\n"));
  const QString further(16, QLatin1Char(','));
  QCOMPARE(lines.size(), 7);
  QCOMPARE(lines[0].count(QLatin1Char(',')), 41);
  const auto last = further + QStringLiteral(",,,,,,,,drawn in slices");
  QCOMPARE(
      lines[1],
      QStringLiteral("\"a \"\"big\"\", one\",length,0.3333333,mm,0.5,,,,,,,,CT,0.1 -2 3; 4 5 6,,,,") + last);
  QCOMPARE(lines[2], QStringLiteral("Ellipse 2,ellipse,2,mm^2,,1.5,0.5,1,2,3,HU,,CT,0 0 0,,,,") + last);
  QCOMPARE(lines[3], QStringLiteral("Ellipse 2,ellipse,2,mm^2,,,,,,,,no voxel inside,CT,0 0 0,,,,") + last);
  QCOMPARE(lines[4], QStringLiteral("Ellipse 2,ellipse,,,,,,,,,,not measured yet,,0 0 0,,,,") + last);
  QCOMPARE(lines[5], QStringLiteral("Arrow 3,arrow,,,,,,,,,,,CT,0 0 0,,,,") + last);
}

// Along a curve, positions are not in patient space. None is written, nor that of the peak.
void TestMeasurementText::asCsvAlongACurve() {
  Series curved;
  curved.curved = CurvedFrom{std::make_shared<const Series>(), {}, "Curve 1"};
  const Measurement region{2, {}, shapeOf(ShapeKind::ellipse), {}};
  Measured hot = regionOf(2, ValueStatistics{3, 1.5, 0.5, 1, 2});
  hot.peak = ValuePeak{};
  hot.peak->mean = 7.5;
  const Result<Measured> measured(hot);
  const Series plain;
  const QStringList rows = measurementsAsCsv({{region, &measured, &plain}, {region, &measured, &curved}})
                               .split(QStringLiteral("\r\n"));
  const QStringList names = rows[0].split(QLatin1Char(','));
  const auto field = [&](int row, const char* name) {
    return rows[row].split(QLatin1Char(',')).value(names.indexOf(QLatin1String(name)));
  };
  QCOMPARE(field(1, "points_mm"), QStringLiteral("0 0 0"));
  QCOMPARE(field(1, "suv_peak_mm"), QStringLiteral("0 0 0"));
  QCOMPARE(field(2, "points_mm"), QString());
  QCOMPARE(field(2, "suv_peak_mm"), QString());
  QCOMPARE(field(2, "suv_peak"), QStringLiteral("7.5"));
  QCOMPARE(field(2, "number"), field(1, "number"));
}

void TestMeasurementText::asCsvOfTwoSeriesAndTwoLines() {
  const Measurement region{2, {}, shapeOf(ShapeKind::ellipse), {}},
      axes{3, {}, shapeOf(ShapeKind::bidirectional), {}};
  const Result<Measured> both(fusedRegion()), lines(linesOf(8, "mm", {8, 2.5, "mm"})),
      ratio(linesOf(0.5, "", {8, 16, "px"}));
  const QStringList rows =
      measurementsAsCsv({{region, &both, nullptr}, {axes, &lines, nullptr}, {axes, &ratio, nullptr}})
          .split(QStringLiteral("\r\n"));
  const QStringList names = rows[0].split(QLatin1Char(','));
  const auto field = [&](int row, const char* name) {
    return rows[row].split(QLatin1Char(',')).value(names.indexOf(QLatin1String(name)));
  };
  QCOMPARE(field(1, "mean"), QStringLiteral("45.24"));
  QCOMPARE(field(1, "suv_peak"), QString());
  QCOMPARE(field(1, "other_series"), QStringLiteral("PT WB"));
  QCOMPARE(field(1, "other_mean"), QStringLiteral("5.25"));
  QCOMPARE(field(1, "other_max"), QStringLiteral("8"));
  QCOMPARE(field(1, "other_voxels"), QStringLiteral("30"));
  QCOMPARE(field(1, "other_unit"), QStringLiteral("SUVbw"));
  QCOMPARE(field(1, "other_suv_peak"), QStringLiteral("6.1234"));
  QCOMPARE(field(2, "first_length"), QStringLiteral("8"));
  QCOMPARE(field(2, "second_length"), QStringLiteral("2.5"));
  QCOMPARE(field(2, "product"), QStringLiteral("20"));
  QCOMPARE(field(2, "length_unit"), QStringLiteral("mm"));
  QCOMPARE(field(3, "number"), QStringLiteral("0.5"));
  QCOMPARE(field(3, "length_unit"), QStringLiteral("px"));
  QCOMPARE(field(3, "product"), QString());
}

void TestMeasurementText::asCsvOfLegs_data() {
  QTest::addColumn<int>("bend");
  QTest::addColumn<QString>("word");
  QTest::newRow("varus") << int(LegAxis::Bend::varus) << QStringLiteral("varus");
  QTest::newRow("valgus") << int(LegAxis::Bend::valgus) << QStringLiteral("valgus");
  QTest::newRow("of no known side") << int(LegAxis::Bend::unknown) << QString();
}

void TestMeasurementText::asCsvOfLegs() {
  QFETCH(int, bend);
  const Measurement axis{1, {}, shapeOf(ShapeKind::legAxis), {}};
  Measured measured = numberOf(5.75, "degrees");
  measured.leg = LegAxis{174.25, LegAxis::Bend(bend)};
  const Result<Measured> leg(measured);
  const QStringList rows = measurementsAsCsv({{axis, &leg, nullptr}}).split(QStringLiteral("\r\n"));
  const QStringList names = rows[0].split(QLatin1Char(',')), fields = rows[1].split(QLatin1Char(','));
  QCOMPARE(fields.size(), names.size());
  const auto field = [&](const char* name) { return fields.value(names.indexOf(QLatin1String(name))); };
  QCOMPARE(field("number"), QStringLiteral("5.75"));
  QCOMPARE(field("unit"), QStringLiteral("degrees"));
  QCOMPARE(field("hka"), QStringLiteral("174.25"));
  QTEST(field("bend"), "word");
}

void TestMeasurementText::handlesKeepBoxes() {
  Shape box = shapeOf(ShapeKind::rectangle, {{1, 2, 7}, {5, 4, 7}});
  box.plane->centre.z = 7;
  const std::vector<glm::dvec3> handles = handlesOf(box);
  QCOMPARE(handles.size(), std::size_t(4));
  for (std::size_t n = 0; n < 4; ++n) {
    // includes an offset from the plane
    const Shape moved = withHandleAt(box, n, handles[n] + glm::dvec3(0.5, 0.25, 3));
    const std::vector<glm::dvec3> now = handlesOf(moved);
    const auto holds = [&](glm::dvec3 p) {
      return std::ranges::any_of(now, [&](glm::dvec3 q) { return glm::length(p - q) < 1e-12; });
    };
    QVERIFY(holds(handles[(n + 2) % 4]));
    QVERIFY(holds(handles[n] + glm::dvec3(0.5, 0.25, 0)));
  }
  QVERIFY(withHandleAt(box, 9, {0, 0, 0}) == box);
}

void TestMeasurementText::theSideOfAFrameIsKnown_data() {
  QTest::addColumn<QString>("laterality");
  QTest::addColumn<QString>("rowSide");
  QTest::addColumn<int>("outwards");
  const auto row = [](const char* name, const char* laterality, const char* rowSide, int outwards) {
    QTest::newRow(name) << QString::fromLatin1(laterality) << QString::fromLatin1(rowSide) << outwards;
  };
  row("the left one, rows to the left", "L", "L", 1);
  row("the right one, rows to the left", "R", "L", -1);
  row("the right one, rows to the right", "R", "RF", 1);
  row("from the side", "L", "P", 0);
  row("both", "B", "L", 0);
  row("of no side", "", "L", 0);
  row("rows of no side", "L", "", 0);
}

void TestMeasurementText::theSideOfAFrameIsKnown() {
  QFETCH(QString, laterality);
  QFETCH(QString, rowSide);
  QFETCH(int, outwards);
  auto slice = std::make_shared<LoadedSeries>();
  slice->series.laterality = laterality.toStdString();
  LoadedFrame frame;
  frame.slice = slice;
  frame.rowSide = rowSide.toStdString();
  QCOMPARE(pixelsOf(frame).outwards, outwards);
}

VOLUMEN_TEST(TestMeasurementText);
#include "tst_measurement_text.moc"
