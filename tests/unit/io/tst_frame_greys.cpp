// Guards io/frames.h, loadFrameGreys(): size, mapping, greys and size of pixels are those of loadFrame(),
// also where they follow from values; values are left out.
#include <QTemporaryDir>
#include <algorithm>
#include <set>

#include "io/frames.h"
#include "io/open.h"
#include "io/study/frame_series.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/real_volume.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFrameGreys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyAreThoseOfTheFrames_data();
  void theyAreThoseOfTheFrames();
  void damagedFilesAreNamed();
};

namespace {

// Returns what differs between a frame and the same without values; empty: nothing.
QString differenceOf(const Frame& whole, const Frame& greys) {
  if (greys.size != whole.size) return QStringLiteral("size");
  if (greys.pixel != whole.pixel) return QStringLiteral("size of pixels");
  if (greys.mapping != whole.mapping) return QStringLiteral("mapping");
  if (greys.unit != whole.unit) return QStringLiteral("unit");
  const auto same = [](const NamedGrey& a, const NamedGrey& b) {
    return a.name == b.name && a.mapping == b.mapping && a.ofValues == b.ofValues;
  };
  if (!std::ranges::equal(greys.greys, whole.greys, same)) return QStringLiteral("greys");
  if (!greys.values.empty() || greys.colour()) return QStringLiteral("values are there");
  return {};
}

}  // namespace

void TestFrameGreys::theyAreThoseOfTheFrames_data() {
  QTest::addColumn<QString>("path");
  for (const char* path : {"dicom-2d", "dicom-pydicom", "dicom-geometry", "pet-ct", "field-cases",
                           "field-cases-2", "ct-chest-lidc0314-138"})
    QTest::newRow(path) << QString::fromStdString(dataPath(path));
}

void TestFrameGreys::theyAreThoseOfTheFrames() {
  QFETCH(QString, path);
  NEED_DATA(path.toStdString());
  const Result<Study> study = openStudy(path.toStdString());
  QVERIFY2(study, study ? "" : study.message().c_str());
  std::vector<Series> all = frameSeries(*study);
  all.insert(all.end(), study->volumes.begin(), study->volumes.end());
  int compared = 0;
  for (const Series& series : all) {
    if (series.format != "DICOM") continue;
    const int last = frameCount(series) - 1;
    if (last < 0) continue;
    const std::set<int> chosen{0, last / 3, last / 2, last};
    const std::vector<int> indices(chosen.begin(), chosen.end());
    const auto greys = loadFrameGreys(series, indices);
    for (std::size_t n = 0; n < indices.size(); ++n) {
      const Result<Frame> whole = loadFrame(series, indices[n]);
      if (!greys) {
        QVERIFY2(!whole || n > 0, qPrintable(QString::fromStdString(series.path)));
        break;
      }
      if (!whole) continue;  // its pixels are damaged
      const QString difference = differenceOf(*whole, (*greys)[n]);
      QVERIFY2(difference.isEmpty(), qPrintable(QString::fromStdString(series.path) + difference));
      ++compared;
    }
  }
  QVERIFY(compared > 0);
}

void TestFrameGreys::damagedFilesAreNamed() {
  const QTemporaryDir folder;
  const std::string path = folder.path().toStdString();
  for (int n = 0; n < 3; ++n)
    writeDicom(path + "/" + std::to_string(n), {.instance = n + 1, .position = {0, 0, n}, .pixels = {7}});
  const Result<Study> study = openStudy(path);
  QVERIFY(study && study->volumes.size() == 1);
  writeAll(path + "/1", {1, 2, 3});
  const auto greys = loadFrameGreys(study->volumes[0], {0, 1, 2});
  QVERIFY(!greys && greys.message().find(path + "/1") != std::string::npos);
  QVERIFY(!loadFrameGreys(study->volumes[0], {3}));
}

VOLUMEN_TEST(TestFrameGreys);
#include "tst_frame_greys.moc"
