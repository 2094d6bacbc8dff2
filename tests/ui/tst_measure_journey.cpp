// Guards measuring on a chest CT: lengths, angles and regions in three planes of a large window. No
// measurement text covers a shape.
#include <QDockWidget>
#include <QLineEdit>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

class TestMeasureJourney : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aChest();
};

namespace {

// A shape to draw. Its points are fractions of a view's width and height.
struct Stroke {
  ShapeKind kind;
  ViewId view;
  std::vector<QPointF> parts;
};

const Stroke strokes[] = {
    {length, axialViewId, {{0.30, 0.42}, {0.44, 0.52}}},
    {ellipse, axialViewId, {{0.57, 0.40}, {0.66, 0.52}}},
    {angle, axialViewId, {{0.42, 0.72}, {0.50, 0.62}, {0.60, 0.74}}},
    {probe, axialViewId, {{0.36, 0.62}}},
    {length, coronalViewId, {{0.32, 0.80}, {0.68, 0.80}}},
    {cobb, coronalViewId, {{0.46, 0.22}, {0.54, 0.24}, {0.45, 0.60}, {0.55, 0.57}}},
    {freehand, coronalViewId, {{0.30, 0.40}, {0.36, 0.34}, {0.41, 0.42}, {0.38, 0.55}, {0.31, 0.53}}},
    {polyline, sagittalViewId, {{0.62, 0.25}, {0.66, 0.40}, {0.65, 0.55}, {0.60, 0.72}}},
    {rectangle, sagittalViewId, {{0.36, 0.42}, {0.48, 0.52}}},
    {arrow, sagittalViewId, {{0.42, 0.30}, {0.30, 0.22}}},
};

}  // namespace

void TestMeasureJourney::aChest() {
  const std::string chest = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(chest);
  Journey opened({QString::fromStdString(chest)});
  QVERIFY(opened.settle());
  MeasureWindow w(opened.window.session().series());
  w.window.resize(1440, 900);
  QCoreApplication::processEvents();
  for (const Stroke& stroke : strokes) {
    const QSize size = w.view(stroke.view)->size();
    std::vector<QPointF> places;
    for (const QPointF part : stroke.parts)
      places.emplace_back(int(part.x() * size.width()), int(part.y() * size.height()));
    w.draw(stroke.kind, places, stroke.view);
    auto* field = w.view(stroke.view)->findChild<QLineEdit*>(QStringLiteral("measurementName"));
    if (!field || !field->isVisible()) continue;
    QTest::keyClicks(field, QStringLiteral("hilum"));
    QTest::keyClick(field, Qt::Key_Return);
  }
  QCOMPARE(w.all().size(), std::size(strokes));
  w.session().select(w.all()[1].id);
  w.child<QDockWidget>("measurementsDock")->raise();
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    const std::vector<DrawnMeasurement> drawn = w.view(id)->drawnMeasurements();
    for (const DrawnMeasurement& text : drawn)
      for (const DrawnMeasurement& shape : drawn)
        for (const QPolygonF& line : shape.lines)
          for (const QPointF p : line) QVERIFY(!text.textRect.contains(p));
  }
  for (const auto& [size, name] :
       {std::pair(QSize(1440, 900), "measurements"), {QSize(1040, 680), "measurements-small"}}) {
    w.window.resize(size);
    for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId})
      QVERIFY(QTest::qWaitFor([&] { return w.view(id)->picture().size() == w.view(id)->pixels(); }, longest));
    w.shot(name);
  }
}

VOLUMEN_TEST(TestMeasureJourney);
#include "tst_measure_journey.moc"
