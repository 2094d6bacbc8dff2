// Guards segment.md, "Read the numbers": table, JSON and CSV have the same columns, in the displayed unit.
// CSV is read back exactly for any segment name, and no name becomes a formula.
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "results/numbers/segment_columns.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentNumbers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void phantomOfTheIbsi();
  void suvHasItsNames();
  void paddingTakesUpNothing();
  void whatThereIsNoneOfIsEmpty_data();
  void whatThereIsNoneOfIsEmpty();
  void csvComesBack();
  void namesAreHarmless_data();
  void namesAreHarmless();
  void jsonHasEachColumn();
  void voxelsAloneHaveNoSurfaces();
  void diametersInASlice();
  void cancelledIsSaid();
};

namespace {

const ValueScale hounsfield{1, "HU", {}};

// The value of each voxel is its index in memory.
VolumePtr countingVolume(const VoxelGeometry& grid) {
  VolumeParts parts;
  parts.geometry = grid;
  std::vector<std::int16_t> values(std::size_t(grid.voxelCount()));
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = std::int16_t(n);
  parts.values = values;
  return volumeFrom(std::move(parts));
}

SegmentReport reportOf(const BitMask& mask, const Volume& volume, bool withPeaks = false,
                       const std::string& name = "One") {
  const Segment segment{.number = 1, .label = name};
  return segmentReports(std::span(&segment, 1), withLabel(LabelMap(mask.geometry()), 1, mask), volume,
                        withPeaks)
      ->front();
}

const SegmentColumn& columnCalled(const char* key) {
  return *std::ranges::find(segmentColumns(), QLatin1String(key),
                            [](const SegmentColumn& c) { return QLatin1String(c.key); });
}

double numberOf(const char* key, const SegmentReport& report, double factor = 1) {
  return segmentNumbers(columnCalled(key), report, factor).at(0);
}

// Returns the records of a text by RFC 4180. Fails on a misplaced quotation mark.
std::vector<QStringList> recordsOf(const QString& text) {
  std::vector<QStringList> records(1);
  QString field;
  bool isQuoted = false;
  for (qsizetype n = 0; n < text.size(); ++n) {
    const QChar c = text[n];
    if (isQuoted && c == QLatin1Char('"') && n + 1 < text.size() && text[n + 1] == QLatin1Char('"')) {
      field += c;
      ++n;
    } else if (c == QLatin1Char('"')) {
      if (!isQuoted && !field.isEmpty()) return {};
      isQuoted = !isQuoted;
    } else if (isQuoted) {
      field += c;
    } else if (c == QLatin1Char(',')) {
      records.back() << std::exchange(field, {});
    } else if (c == QLatin1Char('\r')) {
      if (n + 1 == text.size() || text[++n] != QLatin1Char('\n')) return {};
      records.back() << std::exchange(field, {});
      records.emplace_back();
    } else {
      field += c;
    }
  }
  if (isQuoted || !field.isEmpty() || !records.back().isEmpty()) return {};
  records.pop_back();
  return records;
}

}  // namespace

// FIELD-segment.md 3: 74 voxels of 2 mm have 592 mm^3, and axes by n of 11.33, 9.24 and 8.48 mm.
void TestSegmentNumbers::phantomOfTheIbsi() {
  const BitMask mask = ibsiPhantom();
  const SegmentReport report = reportOf(mask, *countingVolume(mask.geometry()));
  QCOMPARE(numberOf("voxels", report), 74.0);
  QCOMPARE(numberOf("millilitres", report), 0.592);
  QVERIFY(std::abs(numberOf("axisMm", report) - 11.33) < 5e-3);
  QCOMPARE(numberOf("difference", report), numberOf("surfaceMillilitres", report) - 0.592);
  QCOMPARE(columnText(columnCalled("boxLast"), report, 1), QStringLiteral("4, 3, 3"));
  QCOMPARE(columnText(columnCalled("peak"), report, 1), QStringLiteral("-"));
  QCOMPARE(columnHead(columnCalled("areaMm2"), hounsfield), QStringLiteral("Surface area (mm^2)"));
  QCOMPARE(columnHead(columnCalled("mean"), hounsfield), QStringLiteral("Mean (HU)"));
  QCOMPARE(columnHead(columnCalled("mean"), {}), QStringLiteral("Mean"));
}

// A ball of 8 mm has 1000, its surroundings 0. SUV is a quarter of that.
void TestSegmentNumbers::suvHasItsNames() {
  const ValueScale suv{0.25, "SUVbw", {}};
  const VoxelGeometry grid = gridAbout(glm::dmat3(1), 11);
  const BitMask mask = maskOfShape(grid, ball(9)), hot = maskOfShape(grid, ball(8));
  VolumeParts parts;
  parts.geometry = grid;
  std::vector<float> values;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) values.push_back(hot.at({i, j, k}) ? 1000.f : 0.f);
  parts.values = values;
  const SegmentReport report = reportOf(mask, *volumeFrom(std::move(parts)), true);
  const double mean = 1000 * double(hot.count()) / double(mask.count());
  QCOMPARE(numberOf("max", report, suv.factor), 250.0);
  QVERIFY(std::abs(numberOf("mean", report, suv.factor) - mean / 4) < 1e-9);
  QVERIFY(std::abs(numberOf("peak", report, suv.factor) - 250) < 1e-9);
  QVERIFY(std::abs(numberOf("valueTimesMillilitres", report, suv.factor) -
                   mean / 4 * double(mask.count()) / 1000) < 1e-9);
  QCOMPARE(columnHead(columnCalled("max"), suv), QStringLiteral("SUVmax (SUVbw)"));
  QCOMPARE(columnHead(columnCalled("valueTimesMillilitres"), suv), QStringLiteral("TLG (SUVbw ml)"));
}

void TestSegmentNumbers::paddingTakesUpNothing() {
  SegmentReport report;
  report.voxels = 4;
  report.millilitres = 2;
  report.values.voxels = 3;
  report.values.mean = 10;
  QCOMPARE(numberOf("valueTimesMillilitres", report), 15.0);
}

void TestSegmentNumbers::whatThereIsNoneOfIsEmpty_data() {
  QTest::addColumn<int>("voxels");
  QTest::addColumn<bool>("calibrated");
  QTest::addColumn<bool>("padding");
  QTest::newRow("an empty segment") << 0 << true << false;
  QTest::newRow("one voxel") << 1 << true << false;
  QTest::newRow("one voxel of padding") << 1 << true << true;
  QTest::newRow("not calibrated") << 8 << false << false;
}

void TestSegmentNumbers::whatThereIsNoneOfIsEmpty() {
  QFETCH(int, voxels);
  QFETCH(bool, calibrated);
  QFETCH(bool, padding);
  VolumeParts parts;
  parts.geometry.size = {2, 2, 2};
  parts.geometry.calibrated = calibrated;
  parts.values = std::vector<float>{5, std::numeric_limits<float>::quiet_NaN(), 5, 7, 7, 7, 7, 7};
  if (padding) parts.attributes.padding = ValueRange{5, 5};
  std::vector<std::string> warnings;
  const VolumePtr volume = *Volume::make(std::move(parts), warnings);
  BitMask mask(volume->geometry());
  for (int n = 0; n < voxels; ++n) mask.set({n % 2, n / 2 % 2, n / 4});
  const SegmentReport report = reportOf(mask, *volume, true);
  const auto has = [&](const char* key) { return !segmentNumbers(columnCalled(key), report, 1).empty(); };
  QCOMPARE(numberOf("voxels", report), double(voxels));
  QCOMPARE(has("millilitres"), calibrated);
  QCOMPARE(has("longestMm"), calibrated && voxels > 0);
  QCOMPARE(has("mean"), voxels > 0 && !padding);
  QCOMPARE(has("valueTimesMillilitres"), calibrated && voxels > 0 && !padding);
  const auto records = recordsOf(segmentsAsCsv(std::span(&report, 1), hounsfield));
  QCOMPARE(records.size(), std::size_t(2));
  QCOMPARE(records[0].size(), records[1].size());
  for (const QString& field : records[1]) QVERIFY(!field.contains(QStringLiteral("nan")));
}

// Names have any characters, and numbers any size, with seven digits.
void TestSegmentNumbers::csvComesBack() {
  const Seeds seeds = seedsOf(300, 10000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    std::vector<SegmentReport> all(std::size_t(chance.below(4)));
    for (SegmentReport& report : all) {
      const QString letters = QStringLiteral("ab ,\"\r\n\t;=+-@'\u00e4\u9aa8\u05d0");
      QString name;
      for (int n = chance.below(12); n > 0; --n) name += letters[chance.below(int(letters.size()))];
      report.segment.label = name.toStdString();
      report.voxels = chance.below(1 << 30);
      report.map = chance.below(3);
      report.values.voxels = 1;
      report.values.mean = chance.between(-1, 1) * std::pow(10, chance.between(-30, 30));
      if (chance.oneIn(2)) report.form = SegmentForm{.areaMm2 = chance.share(), .centroid = chance.vector()};
    }
    const auto records = recordsOf(segmentsAsCsv(all, hounsfield));
    QCOMPARE(records.size(), all.size() + 1);
    const qsizetype mean = records[0].indexOf(QStringLiteral("Mean (HU)")),
                    x = records[0].indexOf(QStringLiteral("Centroid x (mm)"));
    QVERIFY(mean > 0 && x > 0);
    for (std::size_t n = 0; n < all.size(); ++n) {
      const QStringList& row = records[n + 1];
      QCOMPARE(row.size(), records[0].size());
      const QString name = QString::fromStdString(all[n].segment.label);
      QVERIFY(row[0] == name || row[0] == QLatin1Char('\'') + name);
      QVERIFY(row[0].isEmpty() || !QStringLiteral("=+-@\t\r\n").contains(row[0].front()));
      QCOMPARE(row[1].toInt(), all[n].map + 1);
      QCOMPARE(row[2].toDouble(), double(all[n].voxels));
      const auto isNear = [](double read, double written) {
        return std::abs(read - written) <= 5.1e-7 * std::abs(written);
      };
      QVERIFY(isNear(row[mean].toDouble(), all[n].values.mean));
      QCOMPARE(row[x].isEmpty(), !all[n].form);
      if (all[n].form) QVERIFY(isNear(row[x].toDouble(), all[n].form->centroid.x));
    }
  }
}

void TestSegmentNumbers::namesAreHarmless_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("field");
  QTest::newRow("plain") << QStringLiteral("Bone 2") << QStringLiteral("Bone 2");
  QTest::newRow("a formula") << QStringLiteral("=1+1") << QStringLiteral("'=1+1");
  QTest::newRow("a call") << QStringLiteral("@SUM(A1,A2)") << QStringLiteral("\"'@SUM(A1,A2)\"");
  QTest::newRow("a command") << QStringLiteral("=cmd|'/c calc'!A0") << QStringLiteral("'=cmd|'/c calc'!A0");
  QTest::newRow("plus, minus") << QStringLiteral("-2+3") << QStringLiteral("'-2+3");
  QTest::newRow("quotation marks") << QStringLiteral("a \"b\"") << QStringLiteral("\"a \"\"b\"\"\"");
  QTest::newRow("a line end in front") << QStringLiteral("\r=1") << QStringLiteral("\"'\r=1\"");
}

void TestSegmentNumbers::namesAreHarmless() {
  QFETCH(QString, name);
  QFETCH(QString, field);
  SegmentReport report;
  report.segment.label = name.toStdString();
  const QString text = segmentsAsCsv(std::span(&report, 1), hounsfield);
  const qsizetype row = text.indexOf(QStringLiteral("\r\n")) + 2;
  QVERIFY2(text.mid(row).startsWith(field + QLatin1Char(',')), qPrintable(text.mid(row)));
}

void TestSegmentNumbers::jsonHasEachColumn() {
  const BitMask mask = ibsiPhantom();
  std::vector<SegmentReport> all{reportOf(mask, *countingVolume(mask.geometry()))};
  all.emplace_back();
  all.back().segment.label = "Nothing";
  all.back().map = 1;
  const auto json = segmentsJson(all, 2);
  QCOMPARE(json.size(), std::size_t(2));
  for (const SegmentColumn& column : segmentColumns()) {
    const std::vector<double> numbers = segmentNumbers(column, all[0], 2);
    const auto& found = json[0].at(column.key);
    if (numbers.empty()) {
      QVERIFY2(found.is_null(), column.key);
    } else if (column.parts.empty()) {
      QCOMPARE(found.get<double>(), numbers[0]);
    } else {
      QCOMPARE(numbers.size(), column.parts.size());
      QVERIFY2(found.get<std::vector<double>>() == numbers, column.key);
    }
  }
  const ValueCounts& counts = all[0].values.histogram;
  QVERIFY(json[0]["histogram"]["counts"].get<std::vector<std::int64_t>>() == counts.counts);
  QCOMPARE(json[0]["histogram"]["from"].get<double>(), 2 * counts.low);
  QCOMPARE(json[0]["histogram"]["width"].get<double>(), 2 * counts.width);
  QVERIFY(!counts.counts.empty() && json[1]["histogram"].is_null());
  QVERIFY(json[0]["voxels"].is_number_integer() && json[0]["boxLast"][0].is_number_integer());
  QVERIFY(json[0]["category"].is_null() && json[1]["mean"].is_null() && json[1]["centroid"].is_null());
  QCOMPARE(json[1]["name"].get<std::string>(), std::string("Nothing"));
  QVERIFY(json[0]["map"] == 1 && json[1]["map"] == 2);
}

// Numbers that need surfaces are left out and give no columns. All others are the same.
void TestSegmentNumbers::voxelsAloneHaveNoSurfaces() {
  const BitMask mask = ibsiPhantom();
  const VolumePtr volume = countingVolume(mask.geometry());
  const Segment segment{.number = 1, .label = "One"};
  const LabelMap labels = withLabel(LabelMap(mask.geometry()), 1, mask);
  auto all = *voxelReports(std::span(&segment, 1), labels, *volume);
  const SegmentReport whole = reportOf(mask, *volume, true);
  const std::vector<QLatin1String> ofSurfaces{QLatin1String("surfaceMillilitres"),
                                              QLatin1String("difference"),
                                              QLatin1String("areaMm2"),
                                              QLatin1String("longestMm"),
                                              QLatin1String("longestFrom"),
                                              QLatin1String("longestTo"),
                                              QLatin1String("peak")};
  for (const SegmentColumn& column : segmentColumns()) {
    const bool isLeftOut = std::ranges::count(ofSurfaces, QLatin1String(column.key)) > 0;
    QVERIFY2(segmentNumbers(column, all[0], 1) ==
                 (isLeftOut ? std::vector<double>() : segmentNumbers(column, whole, 1)),
             column.key);
  }
  QVERIFY(addSurfaces(all, labels, *volume, true));
  QCOMPARE(segmentsAsCsv(all, hounsfield), segmentsAsCsv(std::span(&whole, 1), hounsfield));
}

// RECIST diameters of 74 voxels of 2 mm in slices of 5 x 4 pixels.
void TestSegmentNumbers::diametersInASlice() {
  const BitMask mask = ibsiPhantom();
  const SegmentReport report = reportOf(mask, *countingVolume(mask.geometry()));
  QCOMPARE(numberOf("inPlaneSlice", report), 0.0);
  // From (-1/2, 0) to (4 1/2, 3): 5 and 3 pixels.
  QVERIFY(std::abs(numberOf("inPlaneMm", report) - 2 * std::sqrt(34.0)) < 1e-12);
  QVERIFY(numberOf("perpendicularMm", report) > 8 && numberOf("perpendicularMm", report) < 10);
  QCOMPARE(columnHead(columnCalled("inPlaneMm"), hounsfield),
           QStringLiteral("Longest in-plane diameter (mm)"));
}

void TestSegmentNumbers::cancelledIsSaid() {
  const BitMask mask = ibsiPhantom();
  const Segment segment{.number = 1};
  const LabelMap labels = withLabel(LabelMap(mask.geometry()), 1, mask);
  CancelToken cancel;
  std::size_t told = 0;
  const auto progress = [&](const Segment&, std::size_t done) { told += done + 1; };
  QVERIFY(
      segmentReports(std::span(&segment, 1), labels, *countingVolume(mask.geometry()), true, cancel, progress)
          .ok());
  QCOMPARE(told, std::size_t(1));
  cancel.cancel();
  QVERIFY(
      !segmentReports(std::span(&segment, 1), labels, *countingVolume(mask.geometry()), true, cancel).ok());
}

VOLUMEN_TEST(TestSegmentNumbers);
#include "tst_segment_numbers.moc"
