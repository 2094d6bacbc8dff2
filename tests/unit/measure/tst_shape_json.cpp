// Guards measure.md: a written shape is read back bit for bit, and an arrow has no number.
#include <limits>

#include "tests/unit/suite.h"
#include "viewer/measure/shape_json.h"

using namespace volumen;

class TestShapeJson : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsWrittenIsRead_data();
  void whatIsWrittenIsRead();
  void theTextOfAShapeIsFixed_data();
  void theTextOfAShapeIsFixed();
  void aListKeepsItsOrder();
  void anArrowHasNoNumber();
};

void TestShapeJson::whatIsWrittenIsRead_data() {
  QTest::addColumn<Shape>("shape");
  const double third = 1.0 / 3, infinity = std::numeric_limits<double>::infinity();
  for (const ShapeRule& rule : shapeRules()) {
    Shape shape{rule.kind, "a \"name\", \xc3\xa9", {}, {}, {}, {}};
    for (std::size_t n = 0; n < rule.fewest; ++n)
      shape.points.push_back({third * double(n), -1e-300, 123456.789 + double(n * n)});
    if (rule.region) shape.plane = ShapePlane{{third, 2, 3}, {0.6, 0.8, 0}, {0, 0, -1}};
    if (rule.kind == ShapeKind::volume) shape.range = {-infinity, third};
    QTest::newRow(rule.name) << shape;
  }
  Shape picked{ShapeKind::length, "", {{0, 0, third}, {1, 2, 3}}, {}, {}, {}};
  picked.softMm = third;
  QTest::newRow("picked in 3D") << picked;
  QTest::newRow("no name") << Shape{ShapeKind::probe, "", {{0, 0, 0}}, {}, {}, {}};
}

void TestShapeJson::whatIsWrittenIsRead() {
  QFETCH(Shape, shape);
  const auto read = shapesFromJson(shapesToJson({shape}));
  QVERIFY2(read.ok(), read.ok() ? "" : read.message().c_str());
  QCOMPARE(read->size(), std::size_t(1));
  QVERIFY(read->front() == shape);
  const std::string named = shapesToJson({shape}, {{"patient", "Doe, \"Jane\""}, {"series_uid", "1.2.3"}});
  QVERIFY(named.find(R"("series_uid":"1.2.3")") != std::string::npos);
  const auto again = shapesFromJson(named);
  QVERIFY2(again.ok(), again.ok() ? "" : again.message().c_str());
  QVERIFY(again->front() == shape);
}

void TestShapeJson::theTextOfAShapeIsFixed_data() {
  QTest::addColumn<Shape>("shape");
  QTest::addColumn<QString>("text");
  const auto row = [](const char* name, const Shape& shape, const char* text) {
    QTest::newRow(name) << shape << QStringLiteral("[{%1}]\n").arg(QLatin1String(text));
  };
  row("picked in 3D", {ShapeKind::length, "bone", {{0, 0.5, -1}, {1, 2, 3}}, {}, {}, {}, 0.25},
      R"("kind":"length","name":"bone","points":[[0.0,0.5,-1.0],[1.0,2.0,3.0]],"softMm":0.25)");
  row("on a plane", {ShapeKind::ellipse, "", {{0, 0, 0}, {4, 2, 0}}, ShapePlane{{1, 2, 3}}, {}, {}},
      R"("kind":"ellipse","points":[[0.0,0.0,0.0],[4.0,2.0,0.0]],)"
      R"("plane":{"centre":[1.0,2.0,3.0],"right":[1.0,0.0,0.0],"down":[0.0,1.0,0.0]})");
  row("on a frame",
      {ShapeKind::ellipse, "", {{0, 0, 0}, {4, 2, 0}}, ShapePlane{}, {}, ShapeFrame{"1.2.3", 7}},
      R"("kind":"ellipse","frame":{"instance":"1.2.3","number":7},"points":[[0.0,0.0],[4.0,2.0]])");
  row("of values", {ShapeKind::volume, "", {}, {}, {-std::numeric_limits<double>::infinity(), 300}, {}},
      R"("kind":"volume","range":[null,300.0])");
}

void TestShapeJson::theTextOfAShapeIsFixed() {
  QFETCH(Shape, shape);
  QFETCH(QString, text);
  QCOMPARE(QString::fromStdString(shapesToJson({shape})), text);
  QVERIFY(*shapesFromJson(text.toStdString()) == std::vector{shape});
}

void TestShapeJson::aListKeepsItsOrder() {
  std::vector<Shape> shapes;
  for (int n = 0; n < 5; ++n)
    shapes.push_back({ShapeKind::length, std::to_string(n), {{n, 0, 0}, {0, 1, 2}}, {}, {}, {}});
  QVERIFY(*shapesFromJson(shapesToJson(shapes)) == shapes);
  QVERIFY(shapesFromJson(shapesToJson({}))->empty());
}

void TestShapeJson::anArrowHasNoNumber() {
  const Shape arrow{ShapeKind::arrow, "here", {{0, 0, 0}, {1, 0, 0}}, {}, {}, {}};
  std::vector<std::string> warnings;
  VolumeParts parts;
  parts.values = std::vector<float>(1);
  const auto json = measuredToJson(arrow, measure(arrow, **Volume::make(std::move(parts), warnings), "HU"));
  QVERIFY(!json.contains("number"));
  QCOMPARE(json["problem"].get<std::string>(), std::string("An arrow has no number."));
}

VOLUMEN_TEST(TestShapeJson);
#include "tst_shape_json.moc"
