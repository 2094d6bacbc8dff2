// Guards design.md 7, 10: every NRRD, NIfTI and MetaImage file of the real test data loads as its manifest
// says.
#include <zlib.h>

#include <QFile>
#include <cmath>
#include <limits>
#include <map>

#include "io/files/image_file.h"
#include "io/study/series.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Row = std::map<QByteArray, QByteArray>;

QList<Row> manifest() {
  QList<Row> rows;
  QFile file(QString::fromStdString(dataPath("MANIFEST.tsv")));
  if (dataPath().empty() || !file.open(QIODevice::ReadOnly)) return rows;
  const QList<QByteArray> names = file.readLine().trimmed().split('\t');
  while (!file.atEnd()) {
    const QList<QByteArray> cells = file.readLine().split('\t');
    Row row;
    for (qsizetype n = 0; n < names.size() && n < cells.size(); ++n) row[names[n]] = cells[n];
    if (row["kind"] == "nrrd" || row["kind"] == "nifti" || row["kind"] == "metaimage") rows.push_back(row);
  }
  return rows;
}

std::vector<double> numbers(const QByteArray& text) {
  std::vector<double> all;
  if (text != "-")
    for (const QByteArray& word : text.split(',')) all.push_back(word.toDouble());
  return all;
}

// The manifest's facts of a file, over all its volumes, the last axis slowest.
struct Facts {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  uLong crc = crc32(0, nullptr, 0);

  void add(const Volume& volume, bool floats) {
    std::visit(
        [&](const auto& values) {
          for (const auto stored : values) {
            const double real = volume.slope() * double(stored) + volume.intercept();
            low = std::min(low, real);
            high = std::max(high, real);
            const std::int32_t integer = std::int32_t(stored);
            const float number = float(stored);
            crc = floats ? crc32(crc, reinterpret_cast<const Bytef*>(&number), 4)
                         : crc32(crc, reinterpret_cast<const Bytef*>(&integer), 4);
          }
        },
        volume.stored());
  }
};

// Allows for the manifest's seven digits, which put lengths off by at most 1e-4 mm.
bool near(double a, double b) { return std::abs(a - b) <= 1e-4 * (1 + std::abs(b)); }

}  // namespace

class TestFilesManifest : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void fileIsWhatTheManifestSays_data();
  void fileIsWhatTheManifestSays();

 private:
  void geometryMatches(const Row& row, const VoxelGeometry& g);
};

void TestFilesManifest::fileIsWhatTheManifestSays_data() {
  QTest::addColumn<int>("index");
  const QList<Row> rows = manifest();
  for (int n = 0; n < rows.size(); ++n) QTest::newRow(Row(rows[n])["id"].constData()) << n;
  if (rows.isEmpty()) QTest::newRow("no data") << -1;
}

void TestFilesManifest::geometryMatches(const Row& row, const VoxelGeometry& g) {
  const auto spacing = numbers(row.at("spacing")), origin = numbers(row.at("origin_lps")),
             far = numbers(row.at("far_corner_lps"));
  QCOMPARE(g.calibrated, !spacing.empty());
  for (std::size_t a = 0; a < std::min<std::size_t>(3, spacing.size()); ++a)
    QVERIFY2(near(g.spacing()[int(a)], spacing[a]), "spacing");
  const glm::dvec3 last = g.patientFromVoxel(glm::dvec3(g.size) - 1.0);
  for (std::size_t a = 0; a < origin.size(); ++a) {
    QVERIFY2(near(g.origin[int(a)], origin[a]), "origin");
    QVERIFY2(near(last[int(a)], far[a]), "far corner");
  }
}

void TestFilesManifest::fileIsWhatTheManifestSays() {
  NEED_DATA(dataPath());
  QFETCH(int, index);
  Row row = manifest()[index];
  const std::string path = dataPath(row["path"].toStdString());
  const Result<std::vector<Series>> found = readImageFileHeaders(path);
  if (row["expect"] != "load") {
    QVERIFY2(!found.ok(), "was to be refused");
    QVERIFY2(found.message().size() > path.size(), found.message().c_str());
    return;
  }
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QVERIFY(looksLikeImageFile(path));

  // If the first axis is a vector or list, each entry is a volume, and the file interleaves them.
  const bool interleaved = row["notes"].startsWith("first axis is a");
  std::vector<double> sizes = numbers(row["dims"]);
  if (interleaved) std::rotate(sizes.begin(), sizes.begin() + 1, sizes.end());
  double volumes = 1;
  for (std::size_t a = 3; a < sizes.size(); ++a) volumes *= sizes[a];
  sizes.resize(3, 1);
  QCOMPARE(double(found->size()), volumes);
  Facts facts;
  const bool floats = row["hash_type"] == "f4-le";
  for (const Series& series : *found) {
    const Result<Loaded> loaded = loadImageFile(series);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    const Volume& volume = *loaded->acquired;
    QCOMPARE(std::string(volume.typeName()), series.valueType);
    QCOMPARE(volume.geometry(), series.acquired);
    for (int a = 0; a < 3; ++a) QCOMPARE(double(volume.size()[a]), sizes[std::size_t(a)]);
    geometryMatches(row, volume.geometry());
    facts.add(volume, floats);
  }
  const double low = row["min"].toDouble(), high = row["max"].toDouble();
  QVERIFY2(std::abs(facts.low - low) <= 1e-5 * (1 + std::abs(low)), std::to_string(facts.low).c_str());
  QVERIFY2(std::abs(facts.high - high) <= 1e-5 * (1 + std::abs(high)), std::to_string(facts.high).c_str());
  // Doubles become float32 and non-finite values are replaced, so that their bytes differ from the file's.
  const bool sameBytes = row["hash_type"] != "f8-le" && !row["notes"].contains("not finite") && !interleaved;
  if (sameBytes) QCOMPARE(QByteArray::number(facts.crc, 16).rightJustified(8, '0'), row["crc32_stored"]);
}

VOLUMEN_TEST(TestFilesManifest);
#include "tst_files_manifest.moc"
