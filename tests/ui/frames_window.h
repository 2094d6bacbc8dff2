#pragma once

#include <QDir>
#include <QTreeWidget>
#include <cmath>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

inline QString dataFile(const char* name) {
  return QString::fromStdString(dataPath("dicom-2d") + "/" + name);
}

inline constexpr const char* clipFile = "us-cine-aspect-regions.dcm";

// A window that opens test files.
struct Frames : Journey {
  explicit Frames(const std::vector<const char*>& files) {
    window.resize(1440, 900);
    QStringList paths;
    for (const char* file : files) paths << dataFile(file);
    window.open(paths);
  }

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FlatView* view(ViewId id = axialViewId) { return window.views()->viewAs<FlatView>(id); }
  QTreeWidget* tree() { return child<QTreeWidget>("studyTree"); }
  QTreeWidgetItem* item(const char* text) {
    return tree()->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive).value(0);
  }
  FlatLook look(ViewId id = axialViewId) { return flatLookOf(workspace().view(id)); }

  // Returns whether the frame of the workspace comes on screen.
  bool shows(ViewId id = axialViewId) {
    const auto isThere = [&] {
      const FlatView* v = view(id);
      return v && v->isVisible() && frameIn(v) && frameIn(v)->key.series == v->state().series &&
             frameIn(v)->key.index == look(id).frame && !v->picture().isNull();
    };
    return QTest::qWaitFor(isThere, longest);
  }
  // Does `act` and waits for its picture.
  bool after(const std::function<void()>& act, ViewId id = axialViewId) {
    QSignalSpy shown(view(id), &FlatView::settled);
    act();
    return !shown.isEmpty() || shown.wait(longest);
  }
  bool press(Qt::Key key, ViewId id = axialViewId) {
    return after([&] { QTest::keyClick(view(id), key); }, id);
  }
  // Returns the colour on screen of a pixel of the frame. The pixel is centred and enlarged to one screen
  // pixel.
  QRgb seen(int column, int row, ViewId id = axialViewId) {
    FlatView* v = view(id);
    const VoxelGeometry& geometry = frameIn(v)->geometry();
    const SlicePlane whole = *v->plane();
    const glm::dvec3 p = geometry.patientFromVoxel({column, row, 0}), from = p - geometry.centre();
    const glm::dvec3 spacing = geometry.spacing();
    const double mm = std::min(spacing.x, spacing.y);
    const glm::dvec2 half = glm::dvec2(whole.size) / 2.0;
    const glm::dvec2 toCentre = half - glm::floor(half) - 0.5;
    FlatLook now = look(id);
    now.zoom *= whole.mmPerPixel / mm;
    now.panMm = glm::dvec2(glm::dot(from, whole.right), glm::dot(from, whole.down)) + toCentre * mm;
    const auto zoomed = [&] {
      session().change(QStringLiteral("test"),
                       [&](Workspace& w) { w.editView(id).flats.editOrAdd(v->state().series) = now; });
    };
    const bool isThere = std::abs(now.zoom / look(id).zoom - 1) < 1e-12 && now.panMm == look(id).panMm;
    if (!isThere && !after(zoomed, id)) return 0;
    const glm::dvec2 at = v->plane()->pixelFromPatient(p);
    return v->picture().pixel(int(at.x), int(at.y));
  }
  // Returns what the status line says about a pixel under the cursor.
  QString said(int column, int row) {
    FlatView* v = view();
    QString text;
    const auto listening = QObject::connect(v, &View::hovered, v, [&](const QString& t) { text = t; });
    const glm::dvec2 at =
        v->plane()->pixelFromPatient(frameIn(v)->geometry().patientFromVoxel({column, row, 0}));
    hover(v, QPointF(at.x, at.y) / v->devicePixelRatioF());
    QObject::disconnect(listening);
    return text;
  }
  void choose(const char* text) {
    QTest::mouseClick(tree()->viewport(), Qt::LeftButton, {}, tree()->visualItemRect(item(text)).center());
  }
};

}  // namespace volumen::tests

#define NEED_FILES()                               \
  NEED_DATA(volumen::tests::dataPath("dicom-2d")); \
  QVERIFY(QDir(QString::fromStdString(volumen::tests::dataPath("dicom-2d"))).exists())
