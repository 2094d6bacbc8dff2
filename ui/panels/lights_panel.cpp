#include "ui/panels/lights_panel.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QMenu>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <glm/geometric.hpp>

#include "ui/panels/light_presets.h"

namespace volumen {

namespace {

constexpr int mostLights = 64;  // limit of picture.md 8
constexpr int tallest = 220;    // height of ball and list, pixels

// Convert between camera space (picture.md 7: right, up, towards the viewer) and patient space.
glm::dvec3 toPatient(const CameraAxes& axes, glm::dvec3 d) {
  return d.x * axes.right + d.y * axes.up - d.z * axes.direction;
}
glm::dvec3 toCamera(const CameraAxes& axes, glm::dvec3 d) {
  return {glm::dot(d, axes.right), glm::dot(d, axes.up), -glm::dot(d, axes.direction)};
}

}  // namespace

LightsPanel::LightsPanel(Session& session, QWidget* parent)
    : QWidget(parent), session_(session), ball_(new LightBall) {
  ball_->setObjectName(QStringLiteral("lightBall"));
  auto* top = new QHBoxLayout;
  top->addWidget(ball_, 1);
  top->addWidget(makeList(), 1);
  ball_->setMaximumHeight(tallest);
  list_->setMaximumHeight(tallest);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addLayout(top);
  column->addWidget(makeFields());
  connectBall();
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.scene.lights != after.scene.lights || before.scene.camera != after.scene.camera) showLights();
  });
  showLights();
}

QWidget* LightsPanel::makeList() {
  auto* box = new QWidget;
  list_ = new QListWidget;
  list_->setObjectName(QStringLiteral("lightList"));
  list_->setAccessibleName(tr("Lights"));
  list_->setMinimumSize(60, 60);
  add_ = new QToolButton;
  add_->setObjectName(QStringLiteral("addLight"));
  add_->setText(tr("Add"));
  remove_ = new QToolButton;
  remove_->setObjectName(QStringLiteral("removeLight"));
  remove_->setText(tr("Remove"));
  auto* presets = new QToolButton;
  presets->setObjectName(QStringLiteral("lightPresets"));
  presets->setText(tr("Presets"));
  presets->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(presets);
  for (const LightPreset& preset : lightPresets()) {
    const QString name = QCoreApplication::translate("lights", preset.name);
    menu->addAction(name, this, [this, &preset, name] {
      session_.edit(tr("Lights: %1").arg(name), [&](Scene& s) { s.lights = preset.lights; });
    });
  }
  presets->setMenu(menu);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(4);
  for (QToolButton* button : {add_, remove_, presets}) buttons->addWidget(button);
  buttons->addStretch();
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(list_, 1);
  column->addLayout(buttons);
  connect(add_, &QToolButton::clicked, this, &LightsPanel::addLight);
  connect(remove_, &QToolButton::clicked, this, &LightsPanel::removeLight);
  connect(list_, &QListWidget::currentRowChanged, ball_, &LightBall::select);
  connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    const int n = list_->row(item);
    const bool on = item->checkState() == Qt::Checked;
    session_.edit(on ? tr("Light on") : tr("Light off"), [&](Scene& s) { s.lights[n].on = on; });
  });
  return box;
}

QWidget* LightsPanel::makeFields() {
  fields_ = new QWidget;
  colour_ = new ColourButton(tr("Light colour"));
  colour_->setObjectName(QStringLiteral("lightColour"));
  intensity_ = new NumberRow(tr("Intensity"), {.low = 0, .high = 2, .decimals = 2});
  space_ = new QComboBox;
  space_->setObjectName(QStringLiteral("lightSpace"));
  space_->setAccessibleName(tr("Light attached to"));
  space_->addItems({tr("Moves with the camera"), tr("Fixed to the patient")});
  auto* row = new QHBoxLayout;
  row->addWidget(space_, 1);
  row->addWidget(colour_);
  auto* column = new QVBoxLayout(fields_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(intensity_);
  column->addLayout(row);
  connect(intensity_, &NumberRow::valueEdited, this, [this](double v) {
    changeSelected(tr("Light intensity"), [&](Light& light) { light.intensity = v; });
  });
  connect(colour_, &ColourButton::colourEdited, this, [this](glm::dvec3 c) {
    changeSelected(tr("Light colour"), [&](Light& light) { light.colour = c; });
  });
  connect(intensity_, &NumberRow::gestureFinished, this, [this] { session_.endGesture(); });
  connect(colour_, &ColourButton::gestureFinished, this, [this] { session_.endGesture(); });
  connect(space_, &QComboBox::activated, this, [this](int n) {
    changeSelected(tr("Light attached to"), [&](Light& light) {
      const Space space = n == 0 ? Space::camera : Space::patient;
      if (light.space == space) return;
      light.space = space;  // the light stays where it is
      light.direction = n == 0 ? toCamera(axes(), light.direction) : toPatient(axes(), light.direction);
    });
    session_.endGesture();
  });
  return fields_;
}

void LightsPanel::connectBall() {
  connect(ball_, &LightBall::selectionChanged, this, [this](int n) {
    const QSignalBlocker quiet(list_);
    list_->setCurrentRow(n);
    showSelected();
  });
  connect(ball_, &LightBall::directionEdited, this, [this](int, glm::dvec3 direction) {
    changeSelected(tr("Move light"), [&](Light& light) {
      light.direction = light.space == Space::camera ? direction : toPatient(axes(), direction);
    });
  });
  connect(ball_, &LightBall::gestureFinished, this, [this] { session_.endGesture(); });
}

CameraAxes LightsPanel::axes() const { return cameraAxes(session_.scene().camera.value_or(Camera{})); }

void LightsPanel::showLights() {
  const auto& lights = session_.scene().lights;
  std::vector<BallLight> shown;
  for (const Light& light : lights) {
    const glm::dvec3 d = glm::normalize(light.direction);
    shown.push_back(
        {light.space == Space::camera ? d : toCamera(axes(), d), light.colour, light.intensity, light.on});
  }
  const QSignalBlocker quiet(list_);
  while (list_->count() > int(lights.size())) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < int(lights.size())) list_->addItem(tr("Light %1").arg(list_->count() + 1));
  for (int n = 0; n < list_->count(); ++n) {
    list_->item(n)->setFlags(list_->item(n)->flags() | Qt::ItemIsUserCheckable);
    list_->item(n)->setCheckState(lights[n].on ? Qt::Checked : Qt::Unchecked);
  }
  ball_->setLights(std::move(shown));
  if (ball_->selected() < 0 && !lights.empty()) ball_->select(0);
  list_->setCurrentRow(ball_->selected());
  add_->setEnabled(lights.size() < mostLights);
  showSelected();
}

void LightsPanel::showSelected() {
  const auto& lights = session_.scene().lights;
  const int n = ball_->selected();
  const bool any = n >= 0 && n < int(lights.size());
  fields_->setEnabled(any);
  remove_->setEnabled(any);
  if (!any) return;
  colour_->setColour(lights[n].colour);
  intensity_->setValue(lights[n].intensity);
  space_->setCurrentIndex(lights[n].space == Space::camera ? 0 : 1);
}

void LightsPanel::changeSelected(const QString& what, const std::function<void(Light&)>& change) {
  const int n = ball_->selected();
  if (n < 0) return;
  session_.edit(
      what, [&](Scene& s) { change(s.lights[n]); }, what + QString::number(n));
}

void LightsPanel::addLight() {
  Light light;
  light.direction = {0.6, 0.6, 0.8};
  light.intensity = 0.5;
  session_.edit(tr("Add light"), [&](Scene& s) { s.lights.push_back(light); });
  ball_->select(int(session_.scene().lights.size()) - 1);
}

void LightsPanel::removeLight() {
  const int n = ball_->selected();
  session_.edit(tr("Remove light"), [&](Scene& s) { s.lights.erase(s.lights.begin() + n); });
}

}  // namespace volumen
