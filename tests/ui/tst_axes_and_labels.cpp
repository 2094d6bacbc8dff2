// Guards long and short axis, the cardiothoracic ratio and spine labels, by real mouse and key events.
#include <QLineEdit>
#include <cmath>

#include "results/text/measured_text.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/session_json.h"
#include "viewer/measure/lengths.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

namespace {

double angleBetweenLines(const Shape& shape) { return *angleOf(shape.points, true); }
double lengthOfLine(const Shape& shape, std::size_t n) {
  return glm::length(shape.points[2 * n + 1] - shape.points[2 * n]);
}

struct LabelWindow : MeasureWindow {
  void click(QPoint at) { QTest::mouseClick(view(), Qt::LeftButton, {}, at); }
  QLineEdit* field() {
    for (auto* field : view()->findChildren<QLineEdit*>(QStringLiteral("measurementName")))
      if (field->isVisible()) return field;
    return nullptr;
  }
  QStringList names() {
    QStringList names;
    for (const Measurement& m : all()) names << QString::fromStdString(m.shape.name);
    return names;
  }
};

}  // namespace

class TestAxesAndLabels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theShortAxisStandsAcross();
  void axesStayAtRightAngles();
  void widthsOfTheChestAreLevel();
  void labelsFollowEachOther();
  void labelsBeginWhereOneTypes();
  void aSessionKeepsThem();
};

// The short axis is perpendicular wherever the hand goes: from a press at (90, 40) to a release off the
// perpendicular.
void TestAxesAndLabels::theShortAxisStandsAcross() {
  MeasureWindow w;
  const int steps = w.session().undoStack().index();
  w.draw(bidirectional, {{50, 60}, {130, 100}, {90, 40}, {100, 130}});
  QCOMPARE(w.all().size(), std::size_t(1));
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  const Shape shape = w.last().shape;
  QVERIFY(std::abs(angleBetweenLines(shape) - 90) < 1e-6);
  const double mm = w.view()->plane()->mmPerPixel;
  QVERIFY(std::abs(lengthOfLine(shape, 0) - std::hypot(80, 40) * mm) < 1e-9);
  // (10, 90) projected on (-40, 80)/sqrt(8000).
  QVERIFY(std::abs(lengthOfLine(shape, 1) - 6800 / std::sqrt(8000.0) * mm) < 1e-9);
  QVERIFY(glm::length(shape.points[2] - w.patient({90, 40})) < 1e-9);
  const QString text = w.drawn(w.last().id).text.value(0);
  QCOMPARE(text, measuredLines(shape, w.measured(w.last())).value(0));
  QVERIFY2(text.contains(QStringLiteral(" \u00d7 ")) && text.endsWith(QStringLiteral(" mm\u00b2)")),
           qPrintable(text));
  w.undo();
  QVERIFY(w.all().empty());
}

void TestAxesAndLabels::axesStayAtRightAngles() {
  MeasureWindow w;
  w.draw(bidirectional, placesOf(bidirectional));
  const Measurement first = w.last();
  QCOMPARE(w.drawn(first.id).handles.size(), std::size_t(4));
  // If an end of the long axis is dragged, the short axis turns with it.
  drag(w.view(), {140, 60}, {120, 120});
  const Shape turned = w.last().shape;
  QVERIFY(glm::length(turned.points[0] - first.shape.points[0]) < 1e-9);
  QVERIFY(glm::length(turned.points[1] - w.patient({120, 120})) < 1e-9);
  QVERIFY(std::abs(angleBetweenLines(turned) - 90) < 1e-6);
  QVERIFY(std::abs(lengthOfLine(turned, 1) - lengthOfLine(first.shape, 1)) < 1e-9);
  w.undo();
  QVERIFY(w.last() == first);
  // If an end of the short axis is dragged along the long axis, the short axis moves as a whole.
  drag(w.view(), {100, 90}, {110, 110});
  const Shape longer = w.last().shape;
  QVERIFY(longer.points[0] == first.shape.points[0] && longer.points[1] == first.shape.points[1]);
  QVERIFY(glm::length(longer.points[3] - w.patient({110, 110})) < 1e-9);
  QVERIFY(glm::length(longer.points[2] - w.patient({110, 40})) < 1e-9);
  w.undo();
  QVERIFY(w.last() == first);
}

void TestAxesAndLabels::widthsOfTheChestAreLevel() {
  MeasureWindow w;
  w.draw(cardiothoracic, {{80, 90}, {130, 99}, {60, 110}, {160, 102}});
  const Measurement first = w.last();
  const double mm = w.view()->plane()->mmPerPixel;
  QVERIFY(glm::length(first.shape.points[1] - w.patient({130, 90})) < 1e-9);
  QVERIFY(glm::length(first.shape.points[3] - w.patient({160, 110})) < 1e-9);
  QVERIFY(std::abs(w.measured(first)->number - 0.5) < 1e-9);
  QVERIFY(std::abs(w.measured(first)->lines->second - 100 * mm) < 1e-9);
  QCOMPARE(w.drawn(first.id).text.value(0), QStringLiteral("Ratio 0.50"));
  drag(w.view(), {160, 110}, {180, 125});
  const Shape after = w.last().shape;
  QVERIFY(glm::length(after.points[3] - w.patient({180, 125})) < 1e-9);
  QVERIFY(glm::length(after.points[2] - w.patient({60, 125})) < 1e-9);
  QVERIFY(after.points[0] == first.shape.points[0]);
  w.undo();
  QVERIFY(w.last() == first);
}

// Each label is one undo step, and the tool stays until Esc.
void TestAxesAndLabels::labelsFollowEachOther() {
  LabelWindow w;
  w.choose(label);
  const int steps = w.session().undoStack().index();
  w.click({100, 50});
  QVERIFY2(w.field(), "the first one asks where to begin");
  QCOMPARE(w.field()->text(), QStringLiteral("C7"));
  QTest::keyClick(w.field(), Qt::Key_Return);
  w.click({102, 80});
  QVERIFY2(!w.field(), "the others do not");
  w.click({104, 110});
  QCOMPARE(w.names(), QStringList({QStringLiteral("C7"), QStringLiteral("T1"), QStringLiteral("T2")}));
  QCOMPARE(w.session().undoStack().index(), steps + 3);
  QCOMPARE(w.drawn(w.last().id).text, QStringList(QStringLiteral("T2")));
  QVERIFY(glm::length(w.last().shape.points[0] - w.patient({104, 110})) < 1e-9);
  w.undo();
  QCOMPARE(w.names(), QStringList({QStringLiteral("C7"), QStringLiteral("T1")}));
  w.view()->setFocus();
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(!w.window.views()->tool().measuring);
}

void TestAxesAndLabels::labelsBeginWhereOneTypes() {
  LabelWindow w;
  w.choose(label);
  w.click({100, 150});
  QVERIFY(w.field());
  QTest::keyClicks(w.field(), QStringLiteral("L5"));  // all of it is selected
  QTest::keyClick(w.field(), Qt::Key_Return);
  QCOMPARE(w.names(), QStringList(QStringLiteral("L5")));
  w.click({100, 170});
  QCOMPARE(w.names().last(), QStringLiteral("S1"));
  // After renaming the last label, the next one continues from the new name.
  renameMeasurement(w.session(), w.last().id, QStringLiteral("L4"));
  w.click({100, 120});
  QCOMPARE(w.names().last(), QStringLiteral("L3"));
}

void TestAxesAndLabels::aSessionKeepsThem() {
  LabelWindow w;
  w.draw(bidirectional, {{50, 60}, {130, 100}, {90, 40}, {100, 130}});
  w.draw(cardiothoracic, placesOf(cardiothoracic));
  w.choose(label);
  w.click({30, 150});
  const Workspace now = w.session().workspace();
  const auto text = sessionToJson(now, {}, {});
  QVERIFY(text.ok());
  const auto series = now.series.begin()->second.series;
  const auto again = sessionFromJson(*text, [&](const SavedSeries&) { return series; });
  QVERIFY2(again.ok(), again.ok() ? "" : again.message().c_str());
  QVERIFY(again->workspace.measurements == now.measurements);
}

VOLUMEN_TEST(TestAxesAndLabels);
#include "tst_axes_and_labels.moc"
