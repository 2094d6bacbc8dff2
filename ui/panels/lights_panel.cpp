#include "ui/panels/lights_panel.h"

#include <QCoreApplication>
#include <QMenu>
#include <QSignalBlocker>
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
    : QWidget(parent), session_(session), ball_(new LightBall), list_(new QListWidget), fields_(new QWidget) {
  ball_->setObjectName(QStringLiteral("lightBall"));
  ball_->setMaximumHeight(tallest);
  list_->setMaximumHeight(tallest);
  makeFields();
  stack(this, {lineOf({{ball_, 1}, {makeList(), 1}}, -1), fields_}, 8, -1);
  connectBall();
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.scene.lights != after.scene.lights || before.scene.camera != after.scene.camera) showLights();
  });
  showLights();
}

QWidget* LightsPanel::makeList() {
  auto* box = new QWidget;
  list_->setObjectName(QStringLiteral("lightList"));
  list_->setAccessibleName(tr("Lights"));
  list_->setMinimumSize(60, 60);
  add_ = buttonOf(QStringLiteral("addLight"), tr("Add"), [this] { addLight(); });
  remove_ = buttonOf(QStringLiteral("removeLight"), tr("Remove"), [this] { removeLight(); });
  auto* presets = buttonOf(QStringLiteral("lightPresets"), tr("Presets"));
  presets->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(presets);
  for (const LightPreset& preset : lightPresets()) {
    const QString name = QCoreApplication::translate("lights", preset.name);
    menu->addAction(name, this, [this, &preset, name] {
      session_.edit(tr("Lights: %1").arg(name), [&](Scene& s) { s.lights = preset.lights; });
    });
  }
  presets->setMenu(menu);
  stack(box, {{list_, 1}, lineOf({add_, remove_, presets, {}})}, 0, -1);
  connect(list_, &QListWidget::currentRowChanged, ball_, &LightBall::select);
  connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    const int n = list_->row(item);
    const bool on = item->checkState() == Qt::Checked;
    session_.edit(on ? tr("Light on") : tr("Light off"), [&](Scene& s) { s.lights[n].on = on; });
  });
  return box;
}

void LightsPanel::makeFields() {
  const Source<Light> light{
      .edit = [this](const QString& what, const auto& change) { changeSelected(what, change); },
      .done = [this] { session_.endGesture(); },
      .follow = [this](QObject*, const Follower<Light>& show) { followers_.push_back(show); }};
  const Lens<Light, int> attachedTo{[](const Light& l) { return l.space == Space::camera ? 0 : 1; },
                                    [this](Light& l, int n) {
                                      const Space space = n == 0 ? Space::camera : Space::patient;
                                      if (l.space == space) return;
                                      l.space = space;  // the light stays where it is
                                      l.direction = (n == 0 ? toCamera : toPatient)(axes(), l.direction);
                                    }};
  auto* colour = new ColourButton(tr("Light colour"));
  colour->setObjectName(QStringLiteral("lightColour"));
  stack(fields_, {light.bind(new NumberRow(tr("Intensity"), {.high = 2}), tr("Light intensity"),
                             at(&Light::intensity)),
                  lineOf({{light.bind(choiceField({QStringLiteral("lightSpace"), tr("Light attached to")},
                                                  {tr("Moves with the camera"), tr("Fixed to the patient")}),
                                      tr("Light attached to"), attachedTo),
                           1},
                          light.bind(colour, tr("Light colour"), at(&Light::colour))})});
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
  for (const auto& show : followers_) show(lights[std::size_t(n)]);
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
