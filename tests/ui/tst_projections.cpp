// Guards design.md 8 (projections in the window): the mode, the window set by drag, by typing, by name and on
// the histogram, and units.
#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <cmath>

#include "tests/ui/gestures.h"
#include "tests/ui/scene_session.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/panels/transfer_panel.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/curve_editor.h"
#include "ui/workspace/windows.h"

using namespace volumen;

namespace {

std::shared_ptr<LoadedSeries> projectedSeries(const char* modality, const char* unit) {
  auto series = std::make_shared<LoadedSeries>(*tests::ballSeries());
  series->series.modality = modality;
  series->series.unit = unit;
  series->window = {500, 800};
  series->valueSpread = 1000;
  return series;
}

struct Shown : tests::SceneSession {
  VolumeView view{session, scenes, drawService};
  TransferPanel panel{session};

  explicit Shown(const char* modality = "MR", const char* unit = "", Mode mode = Mode::mip) {
    auto series = projectedSeries(modality, unit);
    series->firstScene.mode = mode;
    session.show(series);
    view.resize(400, 300);
    view.show();
    panel.resize(340, 400);
    panel.show();
  }
  template <class Child>
  Child* child(const char* name) {
    return panel.findChild<Child*>(QLatin1String(name));
  }
  Window window() const { return windowInUse(session.scene(), *session.series()); }
  void type(const char* field, const char* text) {
    auto* line = child<QDoubleSpinBox>(field)->findChild<QLineEdit*>();
    line->selectAll();
    QTest::keyClicks(line, QLatin1String(text));
    QTest::keyClick(line, Qt::Key_Return);
  }
};

bool near(const Window& a, const Window& b) {
  return std::abs(a.centre - b.centre) < 0.01 && std::abs(a.width - b.width) < 0.01;
}

}  // namespace

class TestProjections : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theModeIsChosenInTheWindow();
  void aDragMovesTheWindow_data();
  void aDragMovesTheWindow();
  void theWindowIsTyped();
  void theWindowIsChosenByName();
  void theHistogramSaysWindowAndItsEndsAreDragged();
  void invertedEndsStayInverted();
  void unitsAreThoseOfTheSeries_data();
  void unitsAreThoseOfTheSeries();
};

void TestProjections::theModeIsChosenInTheWindow() {
  Shown w("CT", "HU", Mode::composite);
  auto* mode = w.child<QComboBox>("mode");
  QVERIFY(mode && mode->isVisible());
  mode->setFocus();
  QTest::keyClick(mode, Qt::Key_Down);
  QCOMPARE(w.session.scene().mode, Mode::mip);
  QVERIFY2(near(w.window(), {700, 1800}), "one that suits a projection of CT");
  QVERIFY(w.child<QDoubleSpinBox>("windowWidth")->isVisible());
  QVERIFY(!w.child<QDoubleSpinBox>("pointOpacity")->isVisible());
  QTest::keyClick(mode, Qt::Key_Down);
  QCOMPARE(w.session.scene().mode, Mode::minip);
  QTest::keyClick(mode, Qt::Key_Down);
  QCOMPARE(w.session.scene().mode, Mode::average);
  for (int n = 0; n < 3; ++n) w.session.undoStack().undo();
  QCOMPARE(w.session.scene().mode, Mode::composite);
  QCOMPARE(mode->currentText(), QStringLiteral("3D"));
  QVERIFY(w.child<QDoubleSpinBox>("pointOpacity")->isVisible());
}

void TestProjections::aDragMovesTheWindow_data() {
  QTest::addColumn<QString>("modality");
  QTest::addColumn<QPoint>("by");
  QTest::addColumn<int>("keys");
  QTest::addColumn<double>("centre");
  QTest::addColumn<double>("width");
  // The window is 500 / 800 at the press, and a pixel is 10.
  QTest::newRow("right widens") << "MR" << QPoint(20, 0) << 0 << 500. << 1000.;
  QTest::newRow("up shows lower values") << "MR" << QPoint(0, -20) << 0 << 300. << 800.;
  QTest::newRow("Shift is fine") << "MR" << QPoint(20, -20) << int(Qt::ShiftModifier) << 460. << 840.;
  QTest::newRow("Ctrl is fast") << "MR" << QPoint(8, 0) << int(Qt::ControlModifier) << 500. << 1200.;
  QTest::newRow("never nothing") << "MR" << QPoint(-150, 0) << 0 << 500. << 0.25;
  QTest::newRow("the lower end of PET stays") << "PT" << QPoint(0, -40) << 0 << 300. << 400.;
}

void TestProjections::aDragMovesTheWindow() {
  QFETCH(QString, modality);
  QFETCH(QPoint, by);
  QFETCH(int, keys);
  QFETCH(double, centre);
  QFETCH(double, width);
  Shown w(modality.toLatin1().constData());
  w.view.setTool(toolNamed("curve"));
  const QPointF from(200, 150);
  tests::drag(&w.view, from, from + QPointF(by), Qt::LeftButton, Qt::KeyboardModifiers(keys));
  QVERIFY2(near(w.window(), {centre, width}),
           qPrintable(QStringLiteral("%1 / %2").arg(w.window().width).arg(w.window().centre)));
  QCOMPARE(w.session.undoStack().count(), 1);
  w.session.undoStack().undo();
  QVERIFY(!w.session.scene().window);
}

void TestProjections::theWindowIsTyped() {
  Shown w;
  w.type("windowCentre", "250");
  w.type("windowWidth", "90");
  QVERIFY(near(w.window(), {250, 90}));
  QTest::mouseClick(w.child<QCheckBox>("windowInverted"), Qt::LeftButton, {}, QPoint(8, 8));
  QVERIFY(near(w.window(), {250, -90}));
  QCOMPARE(w.session.undoStack().count(), 3);
  w.session.undoStack().undo();
  QVERIFY(!w.child<QCheckBox>("windowInverted")->isChecked());
}

void TestProjections::theWindowIsChosenByName() {
  Shown w("CT", "HU");
  auto* choice = w.child<QComboBox>("windowChoice");
  QCOMPARE(choice->currentText(), QStringLiteral("Automatic"));
  choice->setFocus();
  QTest::keyClicks(choice, QStringLiteral("Lung"));
  QVERIFY(near(w.window(), {-600, 1500}));
  QCOMPARE(choice->currentText(), QStringLiteral("Lung (1500 / -600)"));
  w.type("windowWidth", "1400");
  QCOMPARE(choice->currentIndex(), -1);
  Shown mr;
  QCOMPARE(mr.child<QComboBox>("windowChoice")->count(), 1);
}

void TestProjections::theHistogramSaysWindowAndItsEndsAreDragged() {
  Shown w;
  CurveEditor* editor = w.panel.editor();
  QCOMPARE(editor->axisName(), QStringLiteral("Brightness"));
  QCOMPARE(int(editor->curve().points.size()), 2);
  const QPointF end = editor->positionOf(1), to(editor->valueAxis().pixelOf(700), end.y() + 30);
  tests::drag(editor, end, to);
  QVERIFY(std::abs(w.window().centre - 400) < 5 && std::abs(w.window().width - 600) < 10);
  QCOMPARE(w.session.undoStack().count(), 1);
  QCOMPARE(editor->curve().points[1].opacity, 1.0);
  const TransferFunction before = editor->curve();
  QTest::mouseDClick(editor, Qt::LeftButton, {}, editor->rect().center());
  QTest::mouseClick(editor, Qt::RightButton, {}, editor->positionOf(0).toPoint());
  QVERIFY2(editor->curve() == before, "a window has two ends");
  QVERIFY2(w.session.scene().transferFunction == w.session.series()->firstScene.transferFunction,
           "the curve of 3D is another matter");
}

void TestProjections::invertedEndsStayInverted() {
  Shown w;
  w.session.edit(QStringLiteral("inverted"), [](Scene& s) { s.window = Window{500, -800}; });
  CurveEditor* editor = w.panel.editor();
  QCOMPARE(editor->curve().points[0].opacity, 1.0);
  tests::drag(editor, editor->positionOf(1), {editor->valueAxis().pixelOf(700), editor->positionOf(1).y()});
  QVERIFY(w.window().width < -590 && w.window().width > -610);
  w.view.setTool(toolNamed("curve"));
  tests::drag(&w.view, {200, 150}, {220, 150});
  QVERIFY(w.window().width < -700);
}

void TestProjections::unitsAreThoseOfTheSeries_data() {
  QTest::addColumn<QString>("modality");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<QString>("suffix");
  QTest::newRow("MR has none") << "MR"
                               << ""
                               << "";
  QTest::newRow("PET") << "PT"
                       << "Bq/ml"
                       << " Bq/ml";
  QTest::newRow("CT") << "CT"
                      << "HU"
                      << " HU";
}

void TestProjections::unitsAreThoseOfTheSeries() {
  QFETCH(QString, modality);
  QFETCH(QString, unit);
  QFETCH(QString, suffix);
  Shown w("CT", "HU", Mode::composite);
  auto* value = w.child<QDoubleSpinBox>("pointValue");
  w.child<CurveEditor>("curveEditor")->select(0);  // without a selected point the field is empty
  QCOMPARE(value->suffix(), QStringLiteral(" HU"));
  w.session.show(projectedSeries(modality.toLatin1().constData(), unit.toLatin1().constData()));
  w.child<CurveEditor>("curveEditor")->select(0);
  QCOMPARE(value->suffix(), suffix);
  QCOMPARE(w.child<QDoubleSpinBox>("windowCentre")->suffix(), suffix);
}

VOLUMEN_TEST(TestProjections);
#include "tst_projections.moc"
