// Guards design.md 8 (panels write edits of the session, one undo step a gesture) and picture.md 4, 5, 7, 8.
#include <QCheckBox>
#include <QComboBox>
#include <QMenu>
#include <QSlider>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/ui/gestures.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/controller/frame_service.h"
#include "ui/panels/light_presets.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/scene_panels.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/transfer_panel.h"
#include "ui/workspace/camera_moves.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;

namespace {

// A session that shows a ball, and a panel for it.
template <class Panel = QWidget>
struct Shown {
  Session session;
  std::unique_ptr<Panel> panel;

  Shown() : Shown([](Session& of) { return new Panel(of); }) {}
  template <class Make>
  explicit Shown(const Make& make) : panel(make(session)) {
    session.show(tests::ballSeries());
    panel->resize(400, 500);
    panel->show();
  }
  const Scene& scene() const { return session.scene(); }
  int steps() { return session.undoStack().index(); }
  template <class Child>
  Child* child(const char* name) {
    return panel->template findChild<Child*>(QLatin1String(name));
  }
};

// Types a number into a field and confirms it.
void type(QWidget* field, const char* text) {
  field->setFocus();
  QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(field, QLatin1String(text));
  QTest::keyClick(field, Qt::Key_Return);
}

}  // namespace

class TestPanels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pointsAreTyped_data();
  void pointsAreTyped();
  void typedValuesStopAtTheNeighbours();
  void lightsAreAddedSwitchedAndRemoved();
  void aLightStaysWhereItIsWhenItsSpaceChanges();
  void lightPresetsAreValidScenes();
  void materialIsGreyWhereUnlit();
  void aSliderDragIsOneStep();
  void clipSidesPushEachOther();
  void projectionKeepsTheSize();
  void studiesAreListedAndSearched();
};

void TestPanels::pointsAreTyped_data() {
  QTest::addColumn<QString>("field");
  QTest::addColumn<QString>("text");
  QTest::addColumn<double>("value");
  QTest::addColumn<double>("opacity");
  const auto row = [](const char* name, const char* field, const char* text, double value, double opacity) {
    QTest::newRow(name) << QString::fromLatin1(field) << QString::fromLatin1(text) << value << opacity;
  };
  row("value", "pointValue", "512.5", 512.5, 1);
  row("opacity per mm", "pointOpacity", "0.25", 600, 0.25);
  row("half of the light in 1 mm", "pointHalving", "1", 600, 0.5);
  row("half of the light in 10 mm", "pointHalving", "10", 600, 1 - std::pow(0.5, 0.1));
}

void TestPanels::pointsAreTyped() {
  QFETCH(QString, field);
  QFETCH(QString, text);
  QFETCH(double, value);
  QFETCH(double, opacity);
  Shown<TransferPanel> s;
  s.panel->editor()->select(1);
  type(s.child<QWidget>(field.toLatin1().constData()), text.toLatin1().constData());
  const CurvePoint point = s.scene().transferFunction.points[1];
  QCOMPARE(double(point.value), value);
  QVERIFY(std::abs(point.opacity - opacity) < 1e-9);
  QCOMPARE(s.steps(), 1);
  // The other fields follow.
  const double perMm = s.child<QDoubleSpinBox>("pointOpacity")->value();
  QVERIFY(std::abs(perMm - opacity) < 1e-5);
  s.session.undoStack().undo();
  QCOMPARE(s.child<QDoubleSpinBox>("pointValue")->value(), 600.0);
  QCOMPARE(s.child<QDoubleSpinBox>("pointHalving")->text(), QStringLiteral("< 0.01 mm"));
  s.panel->editor()->select(0);
  QCOMPARE(s.child<QDoubleSpinBox>("pointHalving")->text(), QStringLiteral("none"));
  // Without a selected point there are no numbers.
  s.panel->editor()->select(-1);
  for (const char* each : {"pointValue", "pointOpacity", "pointHalving"})
    QCOMPARE(s.child<QDoubleSpinBox>(each)->text(), QString());
}

void TestPanels::typedValuesStopAtTheNeighbours() {
  Shown<TransferPanel> s;
  s.panel->editor()->select(0);
  type(s.child<QWidget>("pointValue"), "5000");
  QCOMPARE(s.scene().transferFunction.points[0].value, 600.f);
  QVERIFY(validateScene(s.scene()).ok());
}

void TestPanels::lightsAreAddedSwitchedAndRemoved() {
  Shown<LightsPanel> s;
  QTest::mouseClick(s.child<QWidget>("addLight"), Qt::LeftButton);
  QCOMPARE(s.scene().lights.size(), std::size_t(2));
  auto* list = s.child<QListWidget>("lightList");
  QCOMPARE(list->currentRow(), 1);
  list->item(0)->setCheckState(Qt::Unchecked);
  QVERIFY(!s.scene().lights[0].on);
  QVERIFY(!s.panel->ball()->lights()[0].on);
  QTest::mouseClick(s.child<QWidget>("removeLight"), Qt::LeftButton);
  QCOMPARE(s.scene().lights.size(), std::size_t(1));
  QVERIFY(!s.scene().lights[0].on);
  QTest::mouseClick(s.child<QWidget>("removeLight"), Qt::LeftButton);
  QVERIFY(s.scene().lights.empty());
  QVERIFY(!s.child<QWidget>("removeLight")->isEnabled());
  QCOMPARE(s.steps(), 4);
  while (s.session.undoStack().canUndo()) s.session.undoStack().undo();
  QCOMPARE(s.scene().lights, std::vector<Light>{Light{}});
}

void TestPanels::aLightStaysWhereItIsWhenItsSpaceChanges() {
  Shown<LightsPanel> s;
  Camera camera = *standardView("left");
  s.session.edit(QStringLiteral("set up"), [&](Scene& scene) {
    scene.camera = camera;
    scene.lights[0].direction = {0.6, 0, 0.8};
  });
  auto* space = s.child<QComboBox>("lightSpace");
  space->setCurrentIndex(1);
  QVERIFY(s.scene().lights[0].space == Space::patient);
  // Seen from the left, the picture's right is the patient's back: (0, 1, 0). The direction to the viewer is
  // left: (1, 0, 0).
  QVERIFY(glm::length(s.scene().lights[0].direction - glm::dvec3(0.8, 0.6, 0)) < 1e-9);
  QVERIFY(glm::length(s.panel->ball()->lights()[0].direction - glm::dvec3(0.6, 0, 0.8)) < 1e-9);
  // When the camera turns, the light stays with the patient. Seen from behind, the patient's left is on the
  // left of the ball.
  s.session.edit(QStringLiteral("turn"), [](Scene& scene) { scene.camera = *standardView("posterior"); });
  QVERIFY(glm::length(s.panel->ball()->lights()[0].direction - glm::dvec3(-0.8, 0, 0.6)) < 1e-9);
  // A light dragged on the ball is stored in patient space.
  LightBall* ball = s.panel->ball();
  tests::drag(ball, ball->positionOf(ball->lights()[0].direction), ball->positionOf({0, 0, 1}));
  QVERIFY(glm::length(s.scene().lights[0].direction - glm::dvec3(0, 1, 0)) < 0.06);
}

void TestPanels::lightPresetsAreValidScenes() {
  QCOMPARE(lightPresets().size(), std::size_t(4));
  for (const LightPreset& preset : lightPresets()) {
    Scene scene;
    scene.lights = preset.lights;
    QVERIFY2(validateScene(scene).ok(), preset.name);
  }
}

void TestPanels::materialIsGreyWhereUnlit() {
  Shown<> s(makeMaterialPanel);
  auto* diffuse = s.child<QDoubleSpinBox>("Diffuse");
  QVERIFY(diffuse->isEnabled());
  QTest::mouseClick(s.child<QCheckBox>("lit"), Qt::LeftButton, {}, QPoint(8, 8));
  QVERIFY(!s.scene().shading.lit);
  QVERIFY(!diffuse->isEnabled());
  s.session.undoStack().undo();
  QVERIFY(diffuse->isEnabled());
  type(diffuse, "1.25");
  QCOMPARE(s.scene().shading.diffuse, 1.25);
}

void TestPanels::aSliderDragIsOneStep() {
  Shown<> s(makeMaterialPanel);
  QSlider* slider = s.child<QDoubleSpinBox>("Ambient")->parentWidget()->findChild<QSlider*>();
  slider->setFocus();
  const int y = slider->height() / 2, x = int(0.2 * slider->width());
  tests::drag(slider, QPointF(x, y), QPointF(0.8 * slider->width(), y));
  QVERIFY(s.scene().shading.ambient > 0.5);
  QCOMPARE(s.steps(), 1);
  tests::drag(slider, QPointF(0.8 * slider->width(), y), QPointF(x, y));
  QCOMPARE(s.steps(), 2);
  s.session.undoStack().undo();
  s.session.undoStack().undo();
  QCOMPARE(s.scene().shading.ambient, Shading{}.ambient);
  QCOMPARE(s.child<QDoubleSpinBox>("Ambient")->value(), Shading{}.ambient);
}

void TestPanels::clipSidesPushEachOther() {
  Shown<> s(makeClipPanel);
  const auto field = [&](const char* name) { return s.child<QWidget>(name)->findChild<QDoubleSpinBox*>(); };
  type(field("clipHigh1"), "30");
  QCOMPARE(s.scene().clip.boxHigh.y, 0.3);
  type(field("clipLow1"), "60");
  QCOMPARE(s.scene().clip.boxLow.y, 0.6);
  QCOMPARE(s.scene().clip.boxHigh.y, 0.6);
  QVERIFY(validateScene(s.scene()).ok());
  QTest::mouseClick(s.child<QWidget>("clipReset"), Qt::LeftButton);
  QVERIFY(s.scene().clip == Clip{});
  QCOMPARE(s.steps(), 3);
}

void TestPanels::projectionKeepsTheSize() {
  Session session;
  session.show(tests::ballSeries());
  const auto inUse = [&] {
    return cameraInUse(session.scene(), session.series()->volume->geometry(), {400, 300});
  };
  const std::unique_ptr<QWidget> panel(makeCameraPanel(session, {inUse, {}, {}}));
  const double before = mmPerPixel(inUse(), {400, 300}, {0, 0, 0});
  panel->findChild<QComboBox*>(QStringLiteral("projection"))->setCurrentIndex(1);
  QVERIFY(inUse().projection == Projection::perspective);
  QVERIFY(std::abs(mmPerPixel(inUse(), {400, 300}, {0, 0, 0}) - before) < 1e-9);
  panel->show();
  type(panel->findChild<QDoubleSpinBox*>(), "60");
  QCOMPARE(inUse().fov, 60.0);
  QVERIFY(std::abs(mmPerPixel(inUse(), {400, 300}, {0, 0, 0}) - before) < 1e-9);
}

void TestPanels::studiesAreListedAndSearched() {
  const auto series = [](const char* name, const char* description) {
    Series made;
    made.id = made.description = description;
    made.format = "DICOM";
    made.patientName = name;
    made.modality = "CT";
    made.studyUid = "1.2.3";
    return made;
  };
  auto study = std::make_shared<Study>();
  study->volumes = {series("Doe^Jane", "Head"), series("Doe^Jane", "Lung"), series("Roe^Rick", "Knee")};
  study->volumes[1].warnings = {Warning("Slices 34-36 missing: 7.5 mm gap filled by interpolation.")};
  study->refused = {{"/data/broken.dcm", "cut off"}};
  OpenStudies studies;
  FrameService frames;
  StudiesPanel panel(studies, frames);
  studies.add(QStringLiteral("/data"), study);
  studies.add(QStringLiteral("/data"), study);  // opened again, but not listed twice
  const auto found = [&](const char* text) {
    return panel.tree()->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive);
  };
  QCOMPARE(panel.tree()->topLevelItemCount(), 3);  // two patients and the unreadable files
  QCOMPARE(found("Doe, Jane").size(), 1);
  QVERIFY(found("CT Lung").value(0)->text(0).startsWith(QStringLiteral("! CT Lung\n1 slice")));
  QVERIFY(found("CT Lung").value(0)->toolTip(0).contains(QStringLiteral("7.5 mm gap")));
  QVERIFY(found("broken.dcm").value(0)->toolTip(0).contains(QStringLiteral("cut off")));
  QTest::keyClicks(panel.findChild<QLineEdit*>(), QStringLiteral("knee"));
  QVERIFY(found("Doe, Jane").value(0)->isHidden());
  QVERIFY(!found("CT Knee").value(0)->isHidden());
}

VOLUMEN_TEST(TestPanels);
#include "tst_panels.moc"
