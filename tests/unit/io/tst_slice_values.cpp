// Guards import.md: each slice states the meaning of its values: padding, rescale, mappings.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/export/dicom_series.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSliceValues : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void paddingIsThatOfEachSlice_data();
  void paddingIsThatOfEachSlice();
  void copiesKeepPadding_data();
  void copiesKeepPadding();
  void mappingsHoldWhereTheyAreValid_data();
  void mappingsHoldWhereTheyAreValid();
  void slicesWithoutRescaleAreLeftOut_data();
  void slicesWithoutRescaleAreLeftOut();
};

namespace {

void text(DcmItem& d, const DcmTagKey& tag, const QByteArray& value) {
  d.putAndInsertString(tag, value.constData());
}

void word(DcmItem& d, const DcmTagKey& tag, int value, bool isSigned) {
  if (isSigned)
    d.putAndInsertSint16(DcmTag(tag, EVR_SS), Sint16(value));
  else
    d.putAndInsertUint16(DcmTag(tag, EVR_US), Uint16(value));
}

/// Three slices, half of each padding. The rest has value 100.
struct Padded {
  QList<int> padding, paddingEnd, stored;  // one a slice; empty if PixelPaddingValue is missing
  QList<QByteArray> slopes;
  QByteArray intercept = "0";
  bool isSigned = true;
};

Study studyOf(const DicomFolder& folder, const Padded& made) {
  for (int k = 0; k < 3; ++k) {
    DicomPicture p = sliceAt(k, k);
    p.isSigned = made.isSigned;
    p.pixels.assign(12, std::uint16_t(made.stored[k]));
    std::fill_n(p.pixels.begin() + 6, 6, std::uint16_t(100));
    p.edit = [&, k](DcmDataset& d) {
      if (k < made.padding.size()) word(d, DCM_PixelPaddingValue, made.padding[k], made.isSigned);
      if (k < made.paddingEnd.size()) word(d, DCM_PixelPaddingRangeLimit, made.paddingEnd[k], made.isSigned);
      text(d, DCM_RescaleSlope, made.slopes[k]);
      text(d, DCM_RescaleIntercept, made.intercept);
    };
    folder.add(numbered("s", k), p);
  }
  return folder.open();
}

/// A mapping by `slope` of the stored values `first` to `last`. A single one may omit where it is valid.
struct Mapping {
  double slope = 1;
  int first = 0, last = 65535;
  bool saysWhere = true;
};

void addMapping(DcmItem& d, const Mapping& mapping) {
  DcmItem *item = nullptr, *unit = nullptr;
  d.findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, item, -2);
  item->putAndInsertFloat64(DCM_RealWorldValueSlope, mapping.slope);
  item->putAndInsertFloat64(DCM_RealWorldValueIntercept, 0);
  if (mapping.saysWhere) {
    word(*item, DCM_RealWorldValueFirstValueMapped, mapping.first, false);
    word(*item, DCM_RealWorldValueLastValueMapped, mapping.last, false);
  }
  item->findOrCreateSequenceItem(DCM_MeasurementUnitsCodeSequence, unit);
  text(*unit, DCM_CodeValue, "ms");
  text(*unit, DCM_CodingSchemeDesignator, "UCUM");
}

}  // namespace

Q_DECLARE_METATYPE(Padded)
Q_DECLARE_METATYPE(QList<Mapping>)

void TestSliceValues::paddingIsThatOfEachSlice_data() {
  QTest::addColumn<Padded>("made");
  QTest::addColumn<QList<double>>("padded");  // value of each slice's padding
  QTest::addColumn<QList<double>>("others");  // value of other voxels
  QTest::addColumn<QList<bool>>("isPadding");
  const QList<bool> all{true, true, true};
  const QList<QByteArray> alike{"1", "1", "1"}, growing{"1", "2", "3"};
  const QList<int> same{-2000, -2000, -2000};
  QTest::newRow("alike") << Padded{same, {}, same, alike} << QList<double>{-2000, -2000, -2000}
                         << QList<double>{100, 100, 100} << all;
  QTest::newRow("slopes differ") << Padded{same, {}, same, growing} << QList<double>{-6000, -6000, -6000}
                                 << QList<double>{100, 200, 300} << all;
  const QList<int> other{-2000, -2000, -1500};
  QTest::newRow("values differ") << Padded{other, {}, other, alike} << QList<double>{-2000, -2000, -2000}
                                 << QList<double>{100, 100, 100} << all;
  QTest::newRow("a value where others pad")
      << Padded{{-32768, -2000, -2000}, {}, other, alike} << QList<double>{-2000, -32768, -1500}
      << QList<double>{100, 100, 100} << QList<bool>{false, true, false};
  const QList<int> from{5000, 5000, 5000}, to{5004, 5004, 5004};
  const double high = double(float(0.1 * 5004 - 1024)), value = double(float(0.1 * 100 - 1024));
  QTest::newRow("the end of a range")
      << Padded{from, to, to, {"0.1", "0.1", "0.1"}, "-1024", false} << QList<double>{high, high, high}
      << QList<double>{value, value, value} << all;
  QTest::newRow("a negative slope") << Padded{same, {}, same, {"-1", "-2", "-3"}}
                                    << QList<double>{2000, 2000, 2000} << QList<double>{-100, -200, -300}
                                    << all;
}

void TestSliceValues::paddingIsThatOfEachSlice() {
  QFETCH(Padded, made);
  QFETCH(QList<double>, padded);
  QFETCH(QList<double>, others);
  QFETCH(QList<bool>, isPadding);
  const DicomFolder folder;
  const Study study = studyOf(folder, made);
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  const Volume& volume = *loaded->acquired;
  const auto padding = volume.attributes().padding;
  QVERIFY(padding);
  for (int k = 0; k < 3; ++k) {
    QCOMPARE(double(volume.value(0, 0, k)), padded[k]);
    QCOMPARE(double(volume.value(3, 2, k)), others[k]);
    QCOMPARE(padded[k] >= padding->low && padded[k] <= padding->high, isPadding[k]);
    QVERIFY(others[k] < padding->low || others[k] > padding->high);
  }
}

void TestSliceValues::copiesKeepPadding_data() {
  QTest::addColumn<QList<QByteArray>>("slopes");
  QTest::newRow("all can have the lowest") << QList<QByteArray>{"1", "2", "4"};
  QTest::newRow("not all can") << QList<QByteArray>{"0.123", "0.271", "0.319"};
}

void TestSliceValues::copiesKeepPadding() {
  QFETCH(QList<QByteArray>, slopes);
  const QList<int> padding{-2000, -2000, -2000};
  const DicomFolder folder;
  const Study study = studyOf(folder, {padding, {}, padding, slopes});
  const auto loaded = loadSeries(study.volumes.at(0));
  QVERIFY(loaded.ok());
  const std::string copy = folder.path("copy/");
  const auto tags = readDicomTags(study.volumes[0], *loaded);
  QVERIFY(tags.ok());
  const auto written = writeDicomSeries(*loaded->acquired, *tags, copy);
  QVERIFY2(written.ok(), written.ok() ? "" : written.message().c_str());
  const auto copied = openStudy(copy);
  QVERIFY(copied.ok() && copied->volumes.size() == 1);
  const auto again = loadSeries(copied->volumes[0]);
  QVERIFY(again.ok());
  const auto range = again->acquired->attributes().padding;
  QVERIFY(range);
  for (int k = 0; k < 3; ++k) {
    const double padded = double(again->acquired->value(0, 0, k));
    QVERIFY(padded >= range->low && padded <= range->high);
    QCOMPARE(again->acquired->value(3, 2, k), loaded->acquired->value(3, 2, k));
  }
}

void TestSliceValues::mappingsHoldWhereTheyAreValid_data() {
  QTest::addColumn<QList<Mapping>>("mappings");
  QTest::addColumn<double>("value");  // real value of the stored value 50
  const auto row = [](const char* name, const QList<Mapping>& mappings, double value) {
    QTest::newRow(name) << mappings << value;
  };
  row("it does not say where", {{2, 0, 0, false}}, 100);
  row("everywhere", {{2}}, 100);
  row("in a part", {{2, 0, 39}}, 50);
  row("two parts", {{0.5, 0, 39}, {10, 40, 65535}}, 50);
  row("two parts, turned round", {{10, 40, 65535}, {0.5, 0, 39}}, 50);
  row("the second everywhere", {{0.5, 0, 39}, {10}}, 500);
}

void TestSliceValues::mappingsHoldWhereTheyAreValid() {
  QFETCH(QList<Mapping>, mappings);
  QFETCH(double, value);
  const DicomFolder folder;
  DicomPicture p = sliceAt(0, 50);
  p.edit = [&](DcmDataset& d) {
    text(d, DCM_Modality, "MR");
    for (const Mapping& mapping : mappings) addMapping(d, mapping);
  };
  folder.add("s", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  const auto loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  QCOMPARE(double(loaded->acquired->value(0, 0, 0)), value);
  QCOMPARE(series.unit, std::string(value == 50 ? "" : "ms"));
  QCOMPARE(warns(series.warnings, "not valid for all stored values"), value == 50);
}

void TestSliceValues::slicesWithoutRescaleAreLeftOut_data() {
  QTest::addColumn<QByteArray>("intercept");
  QTest::addColumn<int>("slices");
  QTest::newRow("the others have one") << QByteArray("-1024") << 3;
  QTest::newRow("theirs changes nothing") << QByteArray("0") << 4;
}

void TestSliceValues::slicesWithoutRescaleAreLeftOut() {
  QFETCH(QByteArray, intercept);
  QFETCH(int, slices);
  const DicomFolder folder;
  for (int k = 0; k < 4; ++k) {
    DicomPicture p = sliceAt(2 * k, 1000 + k);
    p.isRescaled = k != 1;
    p.edit = [&, k](DcmDataset& d) {
      if (k == 1) return;
      text(d, DCM_RescaleSlope, "1");
      text(d, DCM_RescaleIntercept, intercept);
    };
    folder.add(numbered("s", k), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.acquired.size.z, slices);
  QCOMPARE(int(series.unread.size()), 4 - slices);
  if (slices == 4) return;
  QCOMPARE(series.unread[0].path, folder.path("s1"));
  QVERIFY(warns(series.warnings, "Slice s1 could not be read and was interpolated: it gives no rescale"));
  const auto loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->drawn), (std::vector<float>{-24, -23, -22, -21}));
}

VOLUMEN_TEST(TestSliceValues);
#include "tst_slice_values.moc"
