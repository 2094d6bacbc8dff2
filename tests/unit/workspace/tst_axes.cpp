// Guards how axes and widths follow a dragged handle in any direction, and the order of labels.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/unit/suite.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/spine_labels.h"

using namespace volumen;
using glm::dvec3;
using volumen::tests::Chance;

class TestAxes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void axesFollowAHandle_data();
  void axesFollowAHandle();
  void widthsFollowAHandle_data();
  void widthsFollowAHandle();
  void whatHasNoLengthIsLeftAlone();
  void labelsComeInOrder_data();
  void labelsComeInOrder();
};

namespace {

void addUnits() {
  QTest::addColumn<dvec3>("unit");
  QTest::newRow("mm") << dvec3(1);
  QTest::newRow("pixels of a frame") << dvec3(0.3, 0.2, 1);
}

// Returns four points of two perpendicular lines in a plane, with lengths measured in `unit`.
std::vector<dvec3> axesBy(Chance& chance, dvec3 unit) {
  const double turn = chance.between(0, 6.28);
  const dvec3 u(std::cos(turn), std::sin(turn), 0), v(-u.y, u.x, 0);
  const dvec3 a = 40.0 * dvec3(chance.share(), chance.share(), 0);
  const double length = chance.between(10, 60), share = chance.between(-0.2, 1.2);
  const dvec3 foot = a + share * length * u;
  std::vector<dvec3> points{a, a + length * u, foot - chance.between(1, 20) * v,
                            foot + chance.between(1, 20) * v};
  for (dvec3& p : points) p /= unit;
  return points;
}

}  // namespace

void TestAxes::axesFollowAHandle_data() { addUnits(); }

void TestAxes::axesFollowAHandle() {
  QFETCH(dvec3, unit);
  Chance chance(17);
  for (int n = 0; n < 300; ++n) {
    Shape shape{ShapeKind::bidirectional, "", axesBy(chance, unit), {}, {}, {}};
    const auto handle = std::size_t(chance.below(4));
    const dvec3 place = shape.points[handle] + dvec3(chance.between(-20, 20), chance.between(-20, 20), 0);
    const Shape moved = withHandleAt(shape, handle, place, unit);
    const auto mm = [&](const Shape& of, std::size_t from, std::size_t to) {
      return (of.points[to] - of.points[from]) * unit;
    };
    const dvec3 axis = mm(moved, 0, 1), across = mm(moved, 2, 3);
    QVERIFY(glm::length(moved.points[handle] - place) < 1e-9);
    QVERIFY(std::abs(glm::dot(glm::normalize(axis), glm::normalize(across))) < 1e-9);
    if (handle > 1) {
      QVERIFY(glm::length(moved.points[0] - shape.points[0]) +
                  glm::length(moved.points[1] - shape.points[1]) <
              1e-9);
      continue;
    }
    QVERIFY(glm::length(moved.points[handle ^ 1u] - shape.points[handle ^ 1u]) < 1e-9);
    QVERIFY(std::abs(glm::length(across) - glm::length(mm(shape, 2, 3))) < 1e-9);
    // Position of the crossing on the long axis, as a share of its length.
    const auto share = [&](const Shape& of) {
      return glm::dot(mm(of, 0, 2), mm(of, 0, 1)) / glm::dot(mm(of, 0, 1), mm(of, 0, 1));
    };
    QVERIFY(std::abs(share(moved) - share(shape)) < 1e-9);
  }
}

void TestAxes::widthsFollowAHandle_data() { addUnits(); }

void TestAxes::widthsFollowAHandle() {
  QFETCH(dvec3, unit);
  Chance chance(19);
  for (int n = 0; n < 300; ++n) {
    Shape shape{ShapeKind::cardiothoracic, "", axesBy(chance, unit), {}, {}, {}};
    const auto handle = std::size_t(chance.below(4)), other = handle ^ 1u;
    const dvec3 line = glm::normalize((shape.points[other] - shape.points[handle]) * unit);
    const dvec3 place = shape.points[handle] + dvec3(chance.between(-3, 3), chance.between(-3, 3), 0);
    const Shape moved = withHandleAt(shape, handle, place, unit);
    QVERIFY(glm::length(moved.points[handle] - place) < 1e-9);
    const dvec3 after = (moved.points[other] - moved.points[handle]) * unit;
    QVERIFY(glm::length(glm::cross(line, after)) < 1e-9);
    // The other end moves only perpendicular to the line.
    QVERIFY(std::abs(glm::dot((moved.points[other] - shape.points[other]) * unit, line)) < 1e-9);
    for (std::size_t k = 0; k < 4; ++k)
      if (k / 2 != handle / 2) QVERIFY(glm::length(moved.points[k] - shape.points[k]) < 1e-9);
  }
}

void TestAxes::whatHasNoLengthIsLeftAlone() {
  const dvec3 a(1, 2, 3);
  for (const ShapeKind kind : {ShapeKind::bidirectional, ShapeKind::cardiothoracic})
    for (std::size_t handle = 0; handle < 4; ++handle) {
      const Shape moved = withHandleAt(Shape{kind, "", {a, a, a, a}, {}, {}, {}}, handle, a + dvec3(1, 1, 0));
      for (const dvec3 p : moved.points)
        for (int axis = 0; axis < 3; ++axis) QVERIFY(std::isfinite(p[axis]));
    }
  // The long axis is never reduced to zero length.
  const Shape axes{ShapeKind::bidirectional, "", {a, a + dvec3(4, 0, 0), a, a + dvec3(0, 2, 0)}, {}, {}, {}};
  QVERIFY(withHandleAt(axes, 1, a) == axes);
}

void TestAxes::labelsComeInOrder_data() {
  QTest::addColumn<QStringList>("names");
  QTest::addColumn<QString>("next");
  const auto row = [](const char* names, const char* next) {
    QTest::newRow(*names ? names : "none yet")
        << QString::fromLatin1(names).split(QLatin1Char(' '), Qt::SkipEmptyParts)
        << QString::fromLatin1(next);
  };
  row("", "C7");
  row("C1", "C2");
  row("C7", "T1");
  row("T12", "L1");
  row("L5", "S1");
  row("S5", "");
  row("L5 L4", "L3");
  row("T1 C7", "C6");
  row("C2 C1", "");
  row("L4 L5", "S1");
  row("L2 L4", "L5");
  row("Th5", "Th6");
  row("R9", "R10");
  row("nodule", "");
  row("R99999999999", "");
  row("R2147483647", "");
}

void TestAxes::labelsComeInOrder() {
  QFETCH(QStringList, names);
  QFETCH(QString, next);
  Workspace workspace;
  const SeriesKey spine{"spine", "1"}, other{"other", "2"};
  int id = 0;
  for (const QString& name : names)
    workspace.measurements.push_back(
        {++id, spine, Shape{ShapeKind::label, name.toStdString(), {{0, 0, 0}}, {}, {}, {}}, {}});
  // Labels of another series and shapes that are no labels do not count.
  workspace.measurements.push_back({++id, other, Shape{ShapeKind::label, "L1", {{0, 0, 0}}, {}, {}, {}}, {}});
  workspace.measurements.push_back({++id, spine, Shape{ShapeKind::probe, "T3", {{0, 0, 0}}, {}, {}, {}}, {}});
  QCOMPARE(QString::fromStdString(nextLabel(workspace, spine)), next);
}

VOLUMEN_TEST(TestAxes);
#include "tst_axes.moc"
