#pragma once

#include <QSlider>
#include <QTemporaryDir>
#include <fstream>

#include "tests/ui/journey.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

/// A window that shows such a file in planes.
struct Perfusion : Journey {
  static constexpr int edge = 16;  ///< voxels
  static constexpr int steps = 4;  ///< time points

  explicit Perfusion(const QString& path) {
    openAlone(false);
    window.open({path});
  }
  ~Perfusion() { openAlone(); }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FlatView* view(ViewId id = axialViewId) { return window.views()->viewAs<FlatView>(id); }
  bool opened() {
    return QTest::qWaitFor([&] { return session().series() && view() && view()->isVisible(); }, longest);
  }
  /// Waits until the volume on screen has this value in its middle.
  bool shows(int value) {
    return QTest::qWaitFor(
        [&] {
          const LoadedSeriesPtr shown = session().seriesOf(axialViewId);
          return shown && shown->volume->value(edge / 2, edge / 2, edge / 2) == value;
        },
        longest);
  }
  QSlider* slider(ViewId id = axialViewId) { return view(id)->findChild<QSlider*>(); }
  void key(int code) { QTest::keyClick(view(), Qt::Key(code)); }
  QString corner() { return view()->overlays().topRight.join(QLatin1Char('\n')); }
};

/// Writes an NRRD file of Perfusion::steps volumes. Volume n has the value 100 n everywhere except in a
/// border of 0.
inline QString fourVolumes(const QTemporaryDir& folder) {
  const QString path = folder.filePath(QStringLiteral("perfusion.nrrd"));
  std::ofstream file(path.toStdString(), std::ios::binary);
  file << "NRRD0005\ntype: int16\ndimension: 4\nspace: left-posterior-superior\nsizes: " << Perfusion::edge
       << ' ' << Perfusion::edge << ' ' << Perfusion::edge << ' ' << Perfusion::steps
       << "\nspace directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\nspace origin: "
          "(0,0,0)\nendian: little\nencoding: raw\n\n";
  for (int n = 1; n <= Perfusion::steps; ++n)
    for (int k = 0; k < Perfusion::edge; ++k)
      for (int j = 0; j < Perfusion::edge; ++j)
        for (int i = 0; i < Perfusion::edge; ++i) {
          const bool inside = std::min({i, j, k}) > 2 && std::max({i, j, k}) < Perfusion::edge - 3;
          const auto value = std::int16_t(inside ? 100 * n : 0);
          file.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
  return path;
}

}  // namespace volumen::tests
