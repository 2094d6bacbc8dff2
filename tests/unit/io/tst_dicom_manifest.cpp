// Guards design.md 7, 10: every DICOM row of the real test data loads as its manifest says, or is refused by
// name.
#include <zlib.h>

#include <QFile>
#include <QRegularExpression>
#include <cmath>
#include <map>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Row = std::map<QString, QString>;

QList<Row> dicomRows() {
  QList<Row> rows;
  QFile file(QString::fromStdString(dataPath("MANIFEST.tsv")));
  if (dataPath().empty() || !file.open(QIODevice::ReadOnly)) return rows;
  const QStringList names = QString::fromUtf8(file.readLine()).trimmed().split(u'\t');
  while (!file.atEnd()) {
    const QStringList cells = QString::fromUtf8(file.readLine()).remove(u'\n').split(u'\t');
    Row row;
    for (qsizetype n = 0; n < std::min(names.size(), cells.size()); ++n) row[names[n]] = cells[n];
    const bool dicom = row[QStringLiteral("kind")].startsWith(QLatin1String("dicom")) ||
                       row[QStringLiteral("path")].startsWith(QLatin1String("dicom"));
    if (dicom) rows.push_back(row);
  }
  return rows;
}

/// Returns why the first file without a volume has none.
std::string firstReason(const Study& study) {
  if (!study.images.empty()) return study.images[0].notVolume;
  return study.refused.empty() ? std::string() : study.refused[0].reason;
}

/// Rows that deviate from the manifest, each with the word that its refusal must contain.
struct Exception {
  const char* id;
  const char* refusalSays;  // reason of a refused file or an image; nullptr for another volume
};
constexpr Exception exceptions[] = {
    {"dicomdirtests:DICOMDIR", nullptr},  // rows of these have no values to compare: see TestDirectory
    {"TINY_ALPHA:DICOMDIR", ""},          // its files have no pixels
    {"_too_short", nullptr},              // all fragments are whole, only the mark after them is missing
    // A gap of 197 mm splits this series in two (design.md 10).
    {"dicomdirtests#4$", nullptr},
    // The stream says unsigned, the file signed. Taken as signed, the 13 bits are Hounsfield units (air
    // -1000, padding -2000). Taken as unsigned, as in this row, padding is brighter than bone.
    {"J2K_pixelrep_mismatch", nullptr},
};

std::vector<double> numbers(const QString& text) {
  std::vector<double> all;
  if (text != QLatin1String("-"))
    for (const QString& word : text.split(u',')) all.push_back(word.toDouble());
  return all;
}

/// Returns `crc32_value` of the data's README: the CRC of the values as little endian int32, or as float32.
QString crcOfValues(const Volume& volume, bool floats) {
  return std::visit(
      [&](const auto& stored) {
        uLong crc = crc32(0, nullptr, 0);
        for (const auto sample : stored) {
          const double value = volume.slope() * double(sample) + volume.intercept();
          const std::int32_t integer = floats ? 0 : std::int32_t(value);
          const float number = float(value);
          crc = crc32(
              crc, reinterpret_cast<const Bytef*>(floats ? static_cast<const void*>(&number) : &integer), 4);
        }
        return QString::number(crc, 16).rightJustified(8, u'0');
      },
      volume.stored());
}

ValueRange rangeOf(const Volume& volume) {
  return std::visit(
      [&](const auto& stored) {
        const auto [low, high] = std::minmax_element(stored.begin(), stored.end());
        const double a = volume.slope() * double(*low) + volume.intercept();
        const double b = volume.slope() * double(*high) + volume.intercept();
        return ValueRange{std::min(a, b), std::max(a, b)};
      },
      volume.stored());
}

/// Allows for the manifest's seven digits. It has directions as written, whereas volumen normalises them.
bool near(double a, double b) { return std::abs(a - b) <= 1e-4 * (1 + std::abs(b)); }

QString geometryDifference(const Row& row, const VoxelGeometry& g) {
  const auto dims = numbers(row.at(QStringLiteral("dims")));
  for (int a = 0; a < 3; ++a)
    if (g.size[a] != int(dims[std::size_t(a)]))
      return QStringLiteral("size along axis %1 is %2").arg(a).arg(g.size[a]);
  const QString uniform = row.at(QStringLiteral("uniform"));
  if (uniform == QLatin1String("no-position")) return g.calibrated ? QStringLiteral("calibrated") : QString();
  if (!g.calibrated) return QStringLiteral("not calibrated");
  const auto spacing = numbers(row.at(QStringLiteral("spacing")));
  const auto origin = numbers(row.at(QStringLiteral("origin_lps")));
  const auto corner = numbers(row.at(QStringLiteral("far_corner_lps")));
  const glm::dvec3 last = g.patientFromVoxel(glm::dvec3(g.size) - 1.0);
  // For a single slice and a sheared stack, the manifest has the distance along the normal.
  const int axes =
      uniform == QLatin1String("single-slice") || uniform.contains(QLatin1String("sheared")) ? 2 : 3;
  for (int a = 0; a < 3; ++a) {
    const std::size_t n = std::size_t(a);
    if (a < axes && !near(g.spacing()[a], spacing[n]))
      return QStringLiteral("spacing %1").arg(g.spacing()[a]);
    if (!near(g.origin[a], origin[n])) return QStringLiteral("origin %1").arg(g.origin[a]);
    if (!near(last[a], corner[n])) return QStringLiteral("far corner %1").arg(last[a]);
  }
  return {};
}

/// Returns how a loaded volume differs from the row; empty if it does not.
QString difference(const Row& row, const Loaded& loaded) {
  const Volume& volume = *loaded.acquired;
  const QString geometry = geometryDifference(row, volume.geometry());
  if (!geometry.isEmpty()) return geometry;
  const ValueRange range = rangeOf(volume);
  const bool lossy = row.at(QStringLiteral("lossy")).startsWith(QLatin1String("lossy"));
  // Decoders of lossy streams differ by 2 stored values (the manifest's tolerance).
  const double slack = lossy ? 2 * volume.slope() : 0;
  const double low = row.at(QStringLiteral("min")).toDouble(),
               high = row.at(QStringLiteral("max")).toDouble();
  if (!near(range.low, low) && std::abs(range.low - low) > slack)
    return QStringLiteral("minimum %1").arg(range.low);
  if (!near(range.high, high) && std::abs(range.high - high) > slack)
    return QStringLiteral("maximum %1").arg(range.high);
  const QString crc = row.at(QStringLiteral("crc32_value"));
  const QString type = row.at(QStringLiteral("hash_type"));
  const bool comparable =
      crc != QLatin1String("-") && !lossy && type != QLatin1String("f8-le");  // kept as float32
  if (comparable && crcOfValues(volume, type == QLatin1String("f4-le")) != crc)
    return QStringLiteral("checksum");
  if (row.at(QStringLiteral("uniform")).startsWith(QLatin1String("no")) && loaded.warnings.empty())
    return QStringLiteral("uneven or without position, and no warning");
  return {};
}

}  // namespace

class TestDicomManifest : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void rowIsWhatTheManifestSays_data();
  void rowIsWhatTheManifestSays();
  void personNamesAreUtf8_data();
  void personNamesAreUtf8();

 private:
  const Study& studyAt(const std::string& path);
  std::map<std::string, Study> studies_;
};

const Study& TestDicomManifest::studyAt(const std::string& path) {
  auto it = studies_.find(path);
  if (it == studies_.end()) {
    Result<Study> study = openStudy(path);
    it = studies_.emplace(path, study.ok() ? *study : Study{}).first;
  }
  return it->second;
}

void TestDicomManifest::rowIsWhatTheManifestSays_data() {
  QTest::addColumn<int>("index");
  const QList<Row> rows = dicomRows();
  for (int n = 0; n < rows.size(); ++n) QTest::newRow(qPrintable(rows[n].at(QStringLiteral("id")))) << n;
  if (rows.isEmpty()) QTest::newRow("no data") << -1;
}

void TestDicomManifest::rowIsWhatTheManifestSays() {
  NEED_DATA(dataPath());
  QFETCH(int, index);
  static const QList<Row> rows = dicomRows();
  const Row& row = rows[index];
  const Study& study = studyAt(dataPath(row.at(QStringLiteral("path")).toStdString()));
  for (const Refused& r : study.refused) QVERIFY2(r.reason.ends_with("."), r.reason.c_str());
  for (const Image& i : study.images) QVERIFY2(i.notVolume.ends_with("."), i.notVolume.c_str());
  QVERIFY(!study.volumes.empty() || !study.images.empty() || !study.refused.empty() || !study.other.empty());
  const QString expect = row.at(QStringLiteral("expect"));
  for (const Exception& e : exceptions) {
    if (!row.at(QStringLiteral("id")).contains(QRegularExpression(QString::fromLatin1(e.id)))) continue;
    if (!e.refusalSays) return;
    QVERIFY(study.volumes.empty());
    if (*e.refusalSays) QVERIFY(firstReason(study).find(e.refusalSays) != std::string::npos);
    return;
  }
  if (expect == QLatin1String("refuse")) {
    QVERIFY(study.volumes.empty());
    return;
  }
  if (expect == QLatin1String("load-colour-or-refuse")) {
    QVERIFY(study.volumes.empty());
    QVERIFY2(study.images.size() == 1, firstReason(study).c_str());
    QVERIFY2(firstReason(study).starts_with("colour image"), firstReason(study).c_str());
    return;
  }
  if (study.volumes.empty() && expect == QLatin1String("load-or-refuse")) return;
  QVERIFY2(!study.volumes.empty(), firstReason(study).c_str());
  // A folder of several volumes has a row for each. One of the volumes must match this row.
  QString why;
  for (const Series& series : study.volumes) {
    const Result<Loaded> loaded = loadSeries(series);
    why = loaded.ok() ? difference(row, *loaded) : QString::fromStdString(loaded.message());
    if (loaded.ok()) QCOMPARE(std::string(loaded->acquired->typeName()), series.valueType);
    if (why.isEmpty() || (!loaded.ok() && expect == QLatin1String("load-or-refuse"))) return;
  }
  QFAIL(qPrintable(why));
}

void TestDicomManifest::personNamesAreUtf8_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("name");
  QFile file(QString::fromStdString(dataPath("CHARSETS.tsv")));
  const bool there = !dataPath().empty() && file.open(QIODevice::ReadOnly);
  while (there && !file.atEnd()) {
    const QStringList cells = QString::fromUtf8(file.readLine()).remove(u'\n').split(u'\t');
    if (cells.size() == 4 && cells[1] == QLatin1String("PatientName"))
      QTest::newRow(qPrintable(cells[0])) << cells[0] << cells[3];
  }
  if (!there) QTest::newRow("no data") << QString() << QString();
}

void TestDicomManifest::personNamesAreUtf8() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  QFETCH(QString, name);
  const Study& study = studyAt(dataPath(path.toStdString()));
  if (study.volumes.empty()) QVERIFY(!study.other.empty());  // files without a picture
  if (study.volumes.empty()) return;
  QString found = QString::fromStdString(study.volumes[0].patientName);
  if (found.endsWith(u'=')) found.chop(1);  // an empty last component group, which the table leaves out
  QCOMPARE(found, name);
}

VOLUMEN_TEST(TestDicomManifest);
#include "tst_dicom_manifest.moc"
