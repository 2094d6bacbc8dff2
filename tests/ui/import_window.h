#pragma once

#include <QTemporaryDir>
#include <functional>
#include <vector>

#include "io/export/seg_nrrd.h"
#include "tests/ui/paint_window.h"

namespace volumen::tests {

/// A window with hollowBalls(), and a folder for the import and export of segments.
struct ImportWindow : PaintWindow {
  QTemporaryDir folder;

  QString at(const char* name) const { return folder.filePath(QLatin1String(name)); }
  /// Returns the banner's text; empty if there is no banner.
  QString told() { return child<Banner>("banner")->isVisible() ? said() : QString(); }
  bool pushed(const char* button) { return SegmentWindow::press(button); }
  void startImport(const QString& path) {
    child<QAction>("importSegments")->trigger();
    answer(*this, "segmentImportDialog", path);
  }
  bool import(const QString& path) {
    startImport(path);
    return idle();
  }
  bool exportTo(const QString& path) {
    child<QAction>("exportSegments")->trigger();
    answer(*this, "segmentDialog", path);
    return idle() && QFile::exists(path);
  }
  bool removeAll() {
    while (count() > 0)
      if (!pushed("segmentRemove")) return false;
    return true;
  }
  /// Returns labels of the series' voxels, computed from their patient positions.
  LabelMap labelsBy(const std::function<int(glm::dvec3 pPatient)>& labelOf) {
    LabelEdit edit{LabelMap(grid())};
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) edit.set({i, j, k}, std::uint8_t(labelOf(glm::dvec3(i, j, k) - 19.5)));
    return edit.done();
  }
  /// Writes a segmentation of one layer with these labels. Returns its path, or an empty one if it fails.
  QString file(const char* name, const std::vector<Segment>& segments,
               const std::function<int(glm::dvec3 pPatient)>& labelOf) {
    return writeSegNrrd(labelsBy(labelOf), segments, at(name).toStdString()) ? at(name) : QString();
  }
};

}  // namespace volumen::tests
