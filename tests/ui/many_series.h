#pragma once

#include <QTemporaryDir>
#include <QTimer>
#include <QTreeWidget>
#include <algorithm>
#include <fstream>

#include "tests/ui/journey.h"

namespace volumen::tests {

/// Returns a line of /proc/self/status in bytes, such as "VmRSS:".
inline std::size_t statusOf(const std::string& name) {
  std::ifstream file("/proc/self/status");
  std::string word;
  std::size_t kB = 0;
  while (file >> word)
    if (word == name && file >> kB) return kB << 10;
  return 0;
}

/// A folder of series of one size that differ. Each has a sixteenth of the voxels of a CT of 300 slices, or
/// with VOLUMEN_FULL_SIZE as many (6 GB in all), and budgets follow.
class ManySeries {
 public:
  static constexpr int most = 40;

  explicit ManySeries(int count = most) {
    for (int n = 0; n < count; ++n) write(n);
  }
  QString folder() const { return dir_.path(); }
  static bool isFull() { return qEnvironmentVariableIsSet("VOLUMEN_FULL_SIZE"); }
  static glm::ivec3 size() { return isFull() ? glm::ivec3(512, 512, 300) : glm::ivec3(256, 256, 75); }
  static std::size_t budget() { return (std::size_t(2) << 30) / (isFull() ? 1 : 16); }
  static std::size_t valueBytes() { return std::size_t(2) * size().x * size().y * size().z; }
  static QString name(int n) { return QStringLiteral("series-%1").arg(n, 2, 10, QLatin1Char('0')); }

 private:
  // A ball with a core that is brighter from series to series.
  void write(int n) const {
    const glm::ivec3 s = size();
    std::ofstream file(dir_.filePath(name(n) + QStringLiteral(".nrrd")).toStdString(), std::ios::binary);
    file << "NRRD0005\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: " << s.x << ' '
         << s.y << ' ' << s.z << "\nspace directions: (0.7,0,0) (0,0.7,0) (0,0,1)\nspace origin: (0,0,0)\n"
         << "endian: little\nencoding: raw\n\n";
    std::vector<std::int16_t> row(static_cast<std::size_t>(s.x));
    for (int k = 0; k < s.z; ++k)
      for (int j = 0; j < s.y; ++j) {
        for (int i = 0; i < s.x; ++i) {
          const glm::dvec3 p = 2. * glm::dvec3(i, j, k) / glm::dvec3(s) - 1.;
          const double r = p.x * p.x + p.y * p.y + p.z * p.z;
          row[std::size_t(i)] = std::int16_t(r > 0.8   ? -1000
                                             : r > 0.3 ? 40 + (i * 7 + j * 3 + k) % 20
                                                       : 500 + 5 * n);
        }
        file.write(reinterpret_cast<const char*>(row.data()), std::streamsize(row.size() * 2));
      }
  }

  QTemporaryDir dir_;
};

/// A window on such a folder, in planes and 3D, that watches what its pool counts and what the process takes.
struct ManyWindow : Journey {
  std::size_t mostCounted = 0;

  ManyWindow() {
    openAlone(false);
    connectWatch();
  }
  ~ManyWindow() { openAlone(); }

  SeriesPool& pool() { return window.session().pool(); }
  QTreeWidget* tree() { return child<QTreeWidget>("studyTree"); }
  /// Clicks on a series in the list.
  void press(int n) {
    const auto items = tree()->findItems(ManySeries::name(n), Qt::MatchContains | Qt::MatchRecursive);
    QVERIFY(!items.isEmpty());
    tree()->scrollToItem(items[0]);
    QTest::mouseClick(tree()->viewport(), Qt::LeftButton, {}, tree()->visualItemRect(items[0]).center());
  }
  /// The same; returns its picture in 3D at rest.
  QImage click(int n) {
    return after([&] { press(n); });
  }
  /// The most that the process took since the window was there.
  static std::size_t peakRss() { return statusOf("VmHWM:"); }

 private:
  void connectWatch() {
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    QObject::connect(&timer_, &QTimer::timeout,
                     [this] { mostCounted = std::max(mostCounted, pool().counted()); });
    timer_.start(1);
  }
  QTimer timer_;
};

}  // namespace volumen::tests
