// Guards design.md 10 (phantoms): values against independently written closed forms, geometry, names and
// sizes.
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;

class TestPhantoms : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyAreCentredCubesOfOneMm_data();
  void theyAreCentredCubesOfOneMm();
  void headersSayWhatIsMade_data();
  void headersSayWhatIsMade();
  void valuesAreTheClosedForm_data();
  void valuesAreTheClosedForm();
  void wrongTextIsRefusedInASentence_data();
  void wrongTextIsRefusedInASentence();
};

void TestPhantoms::theyAreCentredCubesOfOneMm_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<int>("edge");
  QTest::addColumn<QString>("type");
  const auto row = [](const char* text, int edge, const char* type) {
    QTest::newRow(text) << QString::fromLatin1(text) << edge << QString::fromLatin1(type);
  };
  row("solid", 64, "uint8");
  row("sphere", 64, "uint8");
  row("opaque-sphere", 64, "uint8");
  row("soft-sphere", 64, "float32");
  row("ramp", 64, "int16");
  row("cube", 64, "uint8");
  row("marschner-lobb", 41, "float32");
  row("sphere:2", 2, "uint8");
  row("cube:33", 33, "uint8");
  row("ramp:300", 300, "int16");
}

void TestPhantoms::theyAreCentredCubesOfOneMm() {
  QFETCH(QString, text);
  QFETCH(int, edge);
  QFETCH(QString, type);
  const auto made = makePhantom(text.toStdString());
  QVERIFY(made.ok());
  const Volume& volume = **made;
  QCOMPARE(volume.size().x, edge);
  QCOMPARE(volume.size().y, edge);
  QCOMPARE(volume.size().z, edge);
  QVERIFY(volume.geometry().patientFromVoxelStep == glm::dmat3(1));
  QVERIFY(volume.geometry().centre() == glm::dvec3(0));
  QCOMPARE(QString::fromLatin1(volume.typeName()), type);
  QCOMPARE(volume.attributes().name, text.toStdString());
}

void TestPhantoms::headersSayWhatIsMade_data() {
  QTest::addColumn<QString>("text");
  for (const std::string& name : phantomNames())
    QTest::newRow(name.c_str()) << QString::fromStdString(name) + QStringLiteral(":6");
}

void TestPhantoms::headersSayWhatIsMade() {
  QFETCH(QString, text);
  const auto header = phantomHeader(text.toStdString());
  const auto volume = makePhantom(text.toStdString());
  QVERIFY(header.ok() && volume.ok());
  QVERIFY(header->geometry == (*volume)->geometry());
  QCOMPARE(header->valueType, std::string((*volume)->typeName()));
  QCOMPARE(header->modality, (*volume)->attributes().modality);
}

namespace {

// Returns the value of voxel x of phantom `text` by design.md 10; x in voxels.
double closedForm(const QString& text, glm::dvec3 x, int edge) {
  const double r = glm::length(x - 0.5 * (edge - 1));
  if (text == QLatin1String("solid")) return 1;
  if (text.contains(QLatin1String("soft-sphere")))
    return 1000 * std::erfc((glm::length(x - glm::dvec3(31.8, 31.3, 31.6)) - 20) / (0.6 * std::sqrt(2.0))) /
           2;
  if (text.contains(QLatin1String("sphere"))) return r <= edge / 2.0 ? 1 : 0;
  if (text == QLatin1String("ramp")) return x.x;
  if (text.startsWith(QLatin1String("cube"))) {
    bool inside = true;
    for (int a = 0; a < 3; ++a) inside &= x[a] + 0.5 >= edge / 4.0 && x[a] + 0.5 <= 3 * edge / 4.0;
    return inside ? 1 : 0;
  }
  const glm::dvec3 p = -1.0 + 2.0 * x / double(edge - 1);
  const double rho = std::cos(2 * M_PI * 6 * std::cos(M_PI * std::sqrt(p.x * p.x + p.y * p.y) / 2));
  return (1 - std::sin(M_PI * p.z / 2) + 0.25 * (1 + rho)) / (2 * (1 + 0.25));
}

}  // namespace

void TestPhantoms::valuesAreTheClosedForm_data() {
  QTest::addColumn<QString>("text");
  for (const char* text : {"solid", "sphere", "sphere:33", "opaque-sphere", "soft-sphere", "ramp", "cube",
                           "cube:33", "marschner-lobb"})
    QTest::newRow(text) << QString::fromLatin1(text);
}

void TestPhantoms::valuesAreTheClosedForm() {
  QFETCH(QString, text);
  const auto made = makePhantom(text.toStdString());
  QVERIFY(made.ok());
  const int edge = (*made)->size().x;
  double largest = 0, difference = 0;
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i) {
        const double expected = closedForm(text, {i, j, k}, edge), value = (*made)->value(i, j, k);
        largest = std::max(largest, std::abs(expected));
        difference = std::max(difference, std::abs(value - expected));
      }
  // Values are float32 and both formulas double, so that they may differ by two roundings.
  QVERIFY2(difference <= 1e-7 * largest, qPrintable(QString::number(difference)));
}

void TestPhantoms::wrongTextIsRefusedInASentence_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("mustName");
  const auto row = [](const char* text, const char* mustName) {
    QTest::newRow(*text ? text : "empty") << QString::fromLatin1(text) << QString::fromLatin1(mustName);
  };
  row("", "marschner-lobb");
  row("teapot", "teapot");
  row("spher", "opaque-sphere");
  row("sphere:", "2 to 1024");
  row("sphere:1", "2 to 1024");
  row("sphere:1025", "2 to 1024");
  row("sphere:-5", "2 to 1024");
  row("sphere:64x", "2 to 1024");
  row("sphere:64:64", "2 to 1024");
  row("sphere:99999999999999999999", "2 to 1024");
}

void TestPhantoms::wrongTextIsRefusedInASentence() {
  QFETCH(QString, text);
  QFETCH(QString, mustName);
  const auto made = makePhantom(text.toStdString());
  QVERIFY(!made.ok());
  QVERIFY2(made.message().find(mustName.toStdString()) != std::string::npos, made.message().c_str());
  QVERIFY(made.message().ends_with("."));
  QCOMPARE(phantomHeader(text.toStdString()).message(), made.message());
}

VOLUMEN_TEST(TestPhantoms);
#include "tst_phantoms.moc"
