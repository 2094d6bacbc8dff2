#pragma once

#include <QFile>
#include <QMenu>

#include "io/files/preset_files.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/journey.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/hanging_protocol.h"

namespace volumen::tests {

inline constexpr ViewId firstCell = firstComparedId;

/// A window that applies hanging protocols to what it opens.
struct HangingWindow : Journey {
  using Journey::Journey;

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  const Series* in(int cell) { return seriesIn(workspace(), firstCell + cell); }
  FrameView* frameView(int cell) { return window.views()->viewAs<FrameView>(firstCell + cell); }
  ProjectionView projection(int cell) {
    const SeriesPicture picture = pictureIn(workspace(), firstCell + cell);
    return picture ? projectionOf(*picture.series, picture.frame) : ProjectionView();
  }
  QString told(int cell) {
    const ProjectionView view = projection(cell);
    return in(cell) ? QString::fromStdString(view.laterality + " " + view.viewPosition) : QString();
  }
  /// Waits until the frames of all cells are there, equally large and at the edges.
  bool facesEachOther(int cells) {
    return QTest::qWaitFor(
        [&] {
          for (int n = 0; n < cells; ++n) {
            const FrameView* view = frameView(n);
            if (!view || !view->isVisible() || !view->frame() || !view->plane()) return false;
            if (view->frame()->key.series != view->state().series) return false;
            if (view->frame()->key.index != flatLookOf(view->state()).frame) return false;
            if (std::abs(view->plane()->mmPerPixel / frameView(0)->plane()->mmPerPixel - 1) > 1e-6)
              return false;
            if (wallOff(n) >= 0.5) return false;
          }
          return true;
        },
        longest);
  }
  /// Returns the distance of the chest wall's outermost pixel edge from the inner edge of its cell, pixels.
  double wallOff(int cell) {
    const FrameView* view = frameView(cell);
    const VoxelGeometry& geometry = view->frame()->geometry();
    const bool rowsLeadToIt = view->frame()->rowSide == "P";
    const double i = rowsLeadToIt ? geometry.size.x - 0.5 : -0.5;
    const double middle = (geometry.size.y - 1) / 2.0;
    const double x = view->plane()->pixelFromPatient(geometry.patientFromVoxel({i, middle, 0})).x;
    return std::abs(x - (projection(cell).laterality == "R" ? view->plane()->size.x : 0));
  }
  bool isHungInFour() {
    return QTest::qWaitFor([&] { return workspace().layout == Layout::four; }, longest) && facesEachOther(4);
  }
  /// Opens files after choosing a grid by hand.
  bool opensIntoAChosenGrid(const QString& path) {
    session().change(QStringLiteral("Layout"), withLayout(workspace(), Layout::two));
    window.open({path});
    const bool isOpen = QTest::qWaitFor([&] { return in(0) != nullptr; }, longest);
    QTest::qWait(100);
    return isOpen;
  }
  QStringList offered() {
    auto* menu = child<QMenu>("protocolMenu");
    menu->popup({10, 10});
    QStringList names;
    for (const QAction* action : menu->actions())
      if (action->isCheckable()) names << action->text();
    menu->close();
    return names;
  }
  QString complaint() { return child<Banner>("banner")->sentence(); }
};

struct WrittenMammograms {
  Mammograms data;
  const bool isWritten = data.write();
};

/// Shows opened mammograms.
struct MammogramsWindow : WrittenMammograms, HangingWindow {
  MammogramsWindow() : HangingWindow({data.folder.path()}) {}
  bool isOpen() { return isWritten && isHungInFour(); }
};

/// Opens both studies and shows the later one.
struct TwoDaysWindow : HangingWindow {
  explicit TwoDaysWindow(const TwoDays& days) : HangingWindow(QStringList{days.now, days.before}) {}
  bool isOpen() {
    return QTest::qWaitFor([&] { return window.document().open.volumes().size() == 2 && session().series(); },
                           longest);
  }
  bool showsInCell(int cell, const char* day) {
    return QTest::qWaitFor(
        [&] {
          const LoadedSeriesPtr shown = session().seriesOf(firstCell + cell);
          return shown && shown->series.studyDate == day;
        },
        longest);
  }
};

/// Returns a protocol that shows any series twice.
inline HangingProtocol twoOfAny() {
  HangingProtocol mine;
  mine.name = "Mine", mine.series.resize(1), mine.cells.resize(2);
  mine.series[0].name = "any";
  for (ProtocolCell& cell : mine.cells) cell.series = "any";
  return mine;
}

inline void removeOwnProtocols() {
  for (const PresetFile& file : readPresetFiles(protocolFolder()))
    QFile::remove(QString::fromStdString(file.path));
}

}  // namespace volumen::tests
