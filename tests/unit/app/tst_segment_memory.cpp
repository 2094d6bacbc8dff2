// Guards that what `segment` takes grows with the voxels alone: not with the number of segments, and with few
// bytes a voxel where everything grows from seeds.
#include <QFile>
#include <QTemporaryDir>
#include <random>

#include "io/worker/sandbox.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

constexpr int edge = 200, voxels = edge * edge * edge, greys = 1000;

}  // namespace

class TestSegmentMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void bytesOfAVoxel_data();
  void bytesOfAVoxel();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  double peakOf(const QStringList& steps, int segments);

  QTemporaryDir folder_;
};

// Noise has the most components, surface voxels and runs.
void TestSegmentMemory::initTestCase() {
  if (volumen::worker::sanitized) QSKIP("sanitizers take memory of their own");
  QFile volume(at("noise.nrrd"));
  QVERIFY(volume.open(QIODevice::WriteOnly));
  volume.write(
      "NRRD0004\ntype: unsigned short\ndimension: 3\nspace: left-posterior-superior\nsizes: 200 200 200\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\nendian: little\n\n");
  std::minstd_rand random(1);
  std::vector<quint16> values(voxels);
  for (quint16& value : values) value = quint16(random() % greys);
  volume.write(reinterpret_cast<const char*>(values.data()), voxels * qint64(sizeof(quint16)));
}

// Returns the peak memory of a recipe with these steps in bytes a voxel; -1 if it failed.
double TestSegmentMemory::peakOf(const QStringList& steps, int segments) {
  QStringList names;
  for (int n = 0; n < segments; ++n) names << QStringLiteral(R"({"name": "P%1"})").arg(n);
  QFile recipe(at("recipe.json"));
  if (!recipe.open(QIODevice::WriteOnly)) return -1;
  recipe.write(QStringLiteral(R"({"volumenRecipe": 1, "name": "Noise", "segments": [%1], "steps": [%2]})")
                   .arg(names.join(QLatin1Char(',')), steps.join(QLatin1Char(',')))
                   .toUtf8());
  recipe.close();
  const MeasuredOutcome run =
      runMeasured({"segment", at("noise.nrrd").toStdString(), "--recipe", at("recipe.json").toStdString(),
                   "-o", at("out.seg.nrrd").toStdString()});
  return run.status == 0 ? run.peakMebibytes * (1 << 20) / voxels : -1;
}

void TestSegmentMemory::bytesOfAVoxel_data() {
  QTest::addColumn<int>("segments");
  QTest::addColumn<bool>("grows");
  QTest::addColumn<double>("most");  // beyond two segments of one grey value each
  // The first row takes 3 bytes; the second takes 11 to 14, which differs from run to run.
  QTest::newRow("twenty segments of all voxels") << 20 << false << 6.;
  QTest::newRow("two segments grown everywhere") << 2 << true << 18.;
}

void TestSegmentMemory::bytesOfAVoxel() {
  QFETCH(int, segments);
  QFETCH(bool, grows);
  QFETCH(double, most);
  const auto range = [](int n, int low, int high) {
    return QStringLiteral(R"({"step": "range", "segment": "P%1", "low": %2, "high": %3})")
        .arg(n)
        .arg(low)
        .arg(high);
  };
  const QStringList seeds{range(0, 0, 0), range(1, 500, 500)};
  const double plain = peakOf(seeds, 2);
  QStringList steps = seeds;
  if (grows) {
    steps << QStringLiteral(R"({"step": "growFromSeeds", "segment": "P0", "with": ["P1"]})");
  } else {
    steps.clear();
    for (int n = 0; n < segments; ++n)
      steps << range(n, greys * n / segments, greys * (n + 1) / segments - 1);
  }
  const double peak = peakOf(steps, segments);
  QVERIFY2(plain > 0 && peak > 0, "segment failed");
  QVERIFY2(peak - plain < most, QByteArray::number(peak - plain) + " bytes a voxel");
}

VOLUMEN_TEST(TestSegmentMemory);
#include "tst_segment_memory.moc"
