#include "ui/panels/scene_panels.h"

#include <QGridLayout>

#include "results/text/text.h"
#include "ui/panels/sources.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/clip_box.h"

namespace volumen {

namespace {

// Returns the camera of the scene. Edits begin with the camera in use.
Source<Camera> cameraSource(Session& session, const std::function<Camera()>& inUse) {
  Source<Scene> scene = sceneSource(session);
  return {.edit =
              [&session, scene, inUse](const QString& what, const std::function<void(Camera&)>& change) {
                if (!session.series()) return;
                Camera camera = inUse();
                change(camera);
                scene.edit(what, [&](Scene& s) { s.camera = camera; });
              },
          .done = scene.done,
          .follow =
              [scene](QObject* owner, const Follower<Camera>& show) {
                scene.follow(owner, [show](const Scene& s) { show(s.camera.value_or(Camera{})); });
              }};
}

Lens<Camera, int> projectionOfCamera() {
  return {[](const Camera& camera) { return camera.projection == Projection::parallel ? 0 : 1; },
          [](Camera& camera, int n) {
            camera = withProjection(camera, n == 0 ? Projection::parallel : Projection::perspective);
          }};
}

// Converts via parallel projection, so that the size at the target stays the same.
Lens<Camera, double> fieldOfView() {
  return {[](const Camera& camera) { return camera.fov; },
          [](Camera& camera, double degrees) {
            Camera parallel = withProjection(camera, Projection::parallel);
            parallel.fov = degrees;
            camera = withProjection(parallel, Projection::perspective);
          }};
}

Lens<Scene, double> clipPercent(int axis, bool high) {
  return {[=](const Scene& s) { return 100 * (high ? s.clip.boxHigh : s.clip.boxLow)[axis]; },
          [=](Scene& s, double percent) { moveClipFace(s.clip, axis, high, percent / 100); }};
}

// Names a side of the volume's box by the patient's side that is nearest, such as "Right edge". Names it by
// its axis if directions are unknown.
QString sideName(const LoadedSeriesPtr& series, int axis, bool high) {
  if (!series || !series->volume->geometry().calibrated)
    return (high ? tr("%1 end") : tr("%1 start")).arg(QStringLiteral("IJK").mid(axis, 1));
  const glm::dvec3 along = series->volume->geometry().patientFromVoxelStep[axis];
  const QString words =
      QString::fromStdString(sideWords(high ? along : -along)).section(QLatin1Char('-'), 0, 0);
  return tr("%1 edge").arg(words.left(1).toUpper() + words.mid(1));
}

}  // namespace

QWidget* makeCameraPanel(Session& session, const CameraInView& view) {
  auto* panel = new QWidget;
  const Source<Camera> camera = cameraSource(session, view.inUse);
  auto* fov = new NumberRow(tr("Field of view"),
                            {.low = 5, .high = 120, .decimals = 0, .suffix = QStringLiteral("\u00b0")});
  auto* views = new QGridLayout;
  views->setSpacing(4);
  for (int n = 0; n < int(standardViewNames().size()); ++n) {
    const QString name = QString::fromStdString(standardViewNames()[n]);
    views->addWidget(
        buttonOf<QPushButton>(QStringLiteral("camera-") + name, name.left(1).toUpper() + name.mid(1),
                              [view, name] { view.show(name); }),
        n / 2, n % 2);
  }
  stack(panel,
        {camera.bind(choiceField({QStringLiteral("projection"), tr("Projection")},
                                 {tr("Parallel"), tr("Perspective")}),
                     tr("Projection"), projectionOfCamera()),
         camera.bind(fov, tr("Field of view"), fieldOfView()),
         views,
         buttonOf<QPushButton>(QString(), tr("Reset view"), view.reset),
         {}},
        8);
  camera.follow(panel, [panel, fov, &session](const Camera& now) {
    fov->setEnabled(now.projection == Projection::perspective);
    panel->setEnabled(session.series() != nullptr);
  });
  return panel;
}

QWidget* makeClipPanel(Session& session) {
  auto* panel = new QWidget;
  const Source<Scene> scene = sceneSource(session);
  std::vector<LayoutPart> parts;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      auto* row =
          new NumberRow(sideName({}, axis, high), {.low = 0, .high = 100, .decimals = 1, .suffix = tr(" %")});
      row->setObjectName(
          QStringLiteral("clip%1%2").arg(high ? QStringLiteral("High") : QStringLiteral("Low")).arg(axis));
      parts.push_back(scene.bind(row, tr("Clip"), clipPercent(axis, high)));
      scene.follow(row, [row, axis, high, &session](const Scene&) {
        row->setName(sideName(session.series(), axis, high));
      });
    }
  parts.push_back(buttonOf<QPushButton>(QStringLiteral("clipReset"), tr("Reset clipping"), [&session] {
    session.edit(tr("Reset clipping"), [](Scene& s) { s.clip = {}; });
  }));
  parts.push_back({});
  stack(panel, parts, 8);
  return panel;
}

QWidget* makeMaterialPanel(Session& session) {
  const Source<Scene> scene = sceneSource(session);
  const auto number = [&](const QString& name, const NumberFormat& format, double Shading::*member) {
    return scene.bind(new NumberRow(name, format), name, at(&Scene::shading, member));
  };
  auto *panel = new QWidget, *rows = new QWidget;
  stack(rows, {number(tr("Ambient"), {.high = 1}, &Shading::ambient),
               number(tr("Diffuse"), {.high = 2}, &Shading::diffuse),
               number(tr("Specular"), {.high = 2}, &Shading::specular),
               number(tr("Shininess"), {.low = 1, .high = 10000, .decimals = 0, .logarithmic = true},
                      &Shading::shininess),
               scene.bind(choiceField({QStringLiteral("sides"), tr("Lit sides of a surface")},
                                      {tr("Two-sided lighting"), tr("One-sided lighting")}),
                          tr("Lit sides"), among(at(&Scene::shading, &Shading::sides), {2, 1}))});
  stack(panel,
        {scene.bind(flagField({QStringLiteral("lit"), tr("Lighting"),
                               tr("Without it, only colour and opacity are drawn.")}),
                    tr("Lighting"), at(&Scene::shading, &Shading::lit)),
         rows,
         {}},
        8);
  scene.follow(rows, [rows](const Scene& s) { rows->setEnabled(s.shading.lit); });
  return panel;
}

}  // namespace volumen
