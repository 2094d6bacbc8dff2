// Guards design.md 7 and import.md: multi-frame pictures whose geometry is shared, numbered or missing, that
// are mapped to real world values, or spread over files. Also guards the names of volumes at one position.
#include "io/frames.h"
#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int frames = 4;

// Returns an enhanced picture of 4 frames without positions. Frame n has value n.
DicomPicture enhanced(const std::function<void(DcmDataset&)>& edit) {
  DicomPicture p;
  p.orientation = p.spacing = "";
  p.edit = [edit](DcmDataset& data) {
    makeFrames(data, frames);
    data.findAndDeleteElement(DCM_ImagePositionPatient);
    edit(data);
  };
  return p;
}

void sharePlane(DcmDataset& data) {
  group(data, -1, DCM_PlaneOrientationSequence)
      .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
  group(data, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "0.5\\0.7");
}

void sharePosition(DcmDataset& data) {
  group(data, -1, DCM_PlanePositionSequence).putAndInsertString(DCM_ImagePositionPatient, "1\\2\\3");
}

void shareDistance(DcmDataset& data) {
  group(data, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_SpacingBetweenSlices, "2.5");
}

// Gives frame n the number 4 - n.
void numberBackwards(DcmDataset& data) {
  for (int n = 0; n < frames; ++n)
    group(data, n, DCM_FrameContentSequence)
        .putAndInsertUint32(DCM_InStackPositionNumber, Uint32(frames - n));
}

void placeAt(DcmDataset& data, int frame, double z) {
  group(data, frame, DCM_PlanePositionSequence)
      .putAndInsertString(DCM_ImagePositionPatient, ("0\\0\\" + QByteArray::number(z)).constData());
}

void addDimension(DcmDataset& data, int n, const DcmTagKey& pointer) {
  DcmItem* item = nullptr;
  data.findOrCreateSequenceItem(DCM_DimensionIndexSequence, item, n);
  item->putAndInsertTagKey(DCM_DimensionIndexPointer, pointer);
}

}  // namespace

class TestMultiframe : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void framesAreStacked_data();
  void framesAreStacked();
  void framesWithoutOrderAreAnImage_data();
  void framesWithoutOrderAreAnImage();
  void whatNoGroupSaysTheDataSetSays_data();
  void whatNoGroupSaysTheDataSetSays();
  void dimensionsTellVolumesApart();
  void realWorldValuesStandInForARescale_data();
  void realWorldValuesStandInForARescale();
  void partsOfAConcatenationAreOneVolume_data();
  void partsOfAConcatenationAreOneVolume();
  void volumesAreNamedByWhatVaries_data();
  void volumesAreNamedByWhatVaries();
};

using Edit = std::function<void(DcmDataset&)>;
Q_DECLARE_METATYPE(Edit)

void TestMultiframe::framesAreStacked_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<double>("distance");  // 0 if not calibrated
  QTest::addColumn<QByteArray>("warning");
  const QList<float> forward{0, 1, 2, 3}, backward{3, 2, 1, 0};
  QTest::newRow("one position, numbers and their distance")
      << Edit([](DcmDataset& d) { sharePlane(d), sharePosition(d), shareDistance(d), numberBackwards(d); })
      << backward << 2.5 << QByteArray("placed 2.5 mm apart by their number");
  QTest::newRow("one position and numbers without a distance")
      << Edit([](DcmDataset& d) { sharePlane(d), sharePosition(d), numberBackwards(d); }) << backward << 0.0
      << QByteArray("stacked by their number");
  QTest::newRow("numbers alone") << Edit(numberBackwards) << backward << 0.0 << QByteArray("Not calibrated");
  QTest::newRow("a dimension along the stack") << Edit([](DcmDataset& d) {
    addDimension(d, 0, DCM_ImagePositionPatient);
    for (int n = 0; n < frames; ++n)
      group(d, n, DCM_FrameContentSequence).putAndInsertUint32(DCM_DimensionIndexValues, Uint32(frames - n));
  }) << backward << 0.0 << QByteArray("stacked by their number");
  QTest::newRow("called a volume, with a distance") << Edit([](DcmDataset& d) {
    d.putAndInsertString(DCM_VolumetricProperties, "VOLUME");
    d.putAndInsertString(DCM_SpacingBetweenSlices, "1.2");
  }) << forward << 0.0 << QByteArray("stacked in their order");
}

void TestMultiframe::framesAreStacked() {
  QFETCH(Edit, edit);
  QFETCH(QList<float>, values);
  QFETCH(double, distance);
  QFETCH(QByteArray, warning);
  const DicomFolder folder;
  folder.add("f", enhanced(edit));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.acquired.size, glm::ivec3(4, 3, 4));
  QCOMPARE(series.acquired.calibrated, distance > 0);
  if (distance > 0) QCOMPARE(series.acquired.spacing().z, distance);
  if (distance > 0) QCOMPARE(series.acquired.origin, glm::dvec3(1, 2, 3));
  QVERIFY(warns(series.warnings, warning.toStdString()));
  const auto loaded = loadSeries(series);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  const std::vector<float> first = firstOfEachSlice(*loaded->acquired);
  QCOMPARE(QList<float>(first.begin(), first.end()), values);
}

void TestMultiframe::framesWithoutOrderAreAnImage_data() {
  QTest::addColumn<Edit>("edit");
  QTest::newRow("nothing is said") << Edit([](DcmDataset&) {});
  QTest::newRow("one position for all") << Edit([](DcmDataset& d) { sharePlane(d), sharePosition(d); });
  QTest::newRow("a volume without a distance")
      << Edit([](DcmDataset& d) { d.putAndInsertString(DCM_VolumetricProperties, "VOLUME"); });
  QTest::newRow("a distance, but no volume") << Edit([](DcmDataset& d) {
    d.putAndInsertString(DCM_VolumetricProperties, "MIXED");
    d.putAndInsertString(DCM_SpacingBetweenSlices, "1.2");
  });
  QTest::newRow("some frames without a position") << Edit([](DcmDataset& d) {
    sharePlane(d);
    for (int n = 0; n < frames; ++n) group(d, n, DCM_FrameContentSequence);
    placeAt(d, 1, 5);
  });
}

void TestMultiframe::framesWithoutOrderAreAnImage() {
  QFETCH(Edit, edit);
  const DicomFolder folder;
  folder.add("f", enhanced(edit));
  const Study study = folder.open();
  QVERIFY(study.volumes.empty());
  QCOMPARE(study.images.size(), std::size_t(1));
  QCOMPARE(study.images[0].notVolume,
           std::string("several frames without a position each: cannot be shown in 3D."));
  QCOMPARE(study.images[0].frames, frames);
}

void TestMultiframe::whatNoGroupSaysTheDataSetSays_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QList<float>>("values");
  const QList<float> stored{0, 1, 2, 3};
  const auto groups = [](DcmDataset& d) {
    sharePlane(d);
    for (int n = 0; n < frames; ++n) placeAt(d, n, 2 * n);
  };
  QTest::newRow("rescale") << Edit([groups](DcmDataset& d) {
    groups(d);
    d.putAndInsertString(DCM_RescaleSlope, "10");
    d.putAndInsertString(DCM_RescaleIntercept, "-5");
  }) << QList<float>{-5, 5, 15, 25};
  QTest::newRow("rescale, which a group says otherwise") << Edit([groups](DcmDataset& d) {
    groups(d);
    d.putAndInsertString(DCM_RescaleSlope, "10");
    DcmItem& item = group(d, -1, DCM_PixelValueTransformationSequence);
    item.putAndInsertString(DCM_RescaleSlope, "2");
    item.putAndInsertString(DCM_RescaleIntercept, "0");
  }) << QList<float>{0, 2, 4, 6};
  QTest::newRow("pixel spacing") << Edit([](DcmDataset& d) {
    group(d, -1, DCM_PlaneOrientationSequence)
        .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
    for (int n = 0; n < frames; ++n) placeAt(d, n, 2 * n);
    d.putAndInsertString(DCM_PixelSpacing, "0.5\\0.7");
  }) << stored;
  QTest::newRow("orientation") << Edit([](DcmDataset& d) {
    group(d, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "0.5\\0.7");
    for (int n = 0; n < frames; ++n) placeAt(d, n, 2 * n);
    d.putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
  }) << stored;
}

// Covers multi-frame secondary captures (PS3.3 C.8.6.3), in the volume and in the frame as acquired.
void TestMultiframe::whatNoGroupSaysTheDataSetSays() {
  QFETCH(Edit, edit);
  QFETCH(QList<float>, values);
  const DicomFolder folder;
  folder.add("f", enhanced(edit));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.acquired.size, glm::ivec3(4, 3, 4));
  QCOMPARE(series.acquired.spacing(), glm::dvec3(0.7, 0.5, 2));
  const auto loaded = loadSeries(series);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  const std::vector<float> first = firstOfEachSlice(*loaded->acquired);
  QCOMPARE(QList<float>(first.begin(), first.end()), values);
  const auto frame = loadFrame(series, 3);
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(frame->values[0], values[3]);
}

// Each of two positions has two pictures that only a dimension separates.
void TestMultiframe::dimensionsTellVolumesApart() {
  const DicomFolder folder;
  folder.add("f", enhanced([](DcmDataset& data) {
               sharePlane(data);
               addDimension(data, 0, DCM_StackID);
               addDimension(data, 1, DCM_InStackPositionNumber);
               for (int n = 0; n < frames; ++n) {
                 placeAt(data, n, n / 2);
                 const Uint32 indices[] = {Uint32(1 + n % 2), Uint32(1 + n / 2)};
                 group(data, n, DCM_FrameContentSequence)
                     .putAndInsertUint32Array(DCM_DimensionIndexValues, indices, 2);
               }
             }));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  QCOMPARE(study.volumes[0].label, std::string("dimension 1"));
  QCOMPARE(study.volumes[1].label, std::string("dimension 2"));
  const auto loaded = loadSeries(study.volumes[1]);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{1, 3}));
}

void TestMultiframe::realWorldValuesStandInForARescale_data() {
  QTest::addColumn<bool>("withRescale");
  QTest::addColumn<QByteArray>("unitCode");
  QTest::addColumn<float>("value");
  QTest::addColumn<QByteArray>("unit");
  QTest::newRow("without a rescale") << false << QByteArray("Bq/ml") << 13.f << QByteArray("Bq/ml");
  QTest::newRow("another unit") << false << QByteArray("mm2/s") << 13.f << QByteArray("mm2/s");
  QTest::newRow("the rescale is there") << true << QByteArray("Bq/ml") << 20.f << QByteArray();
}

void TestMultiframe::realWorldValuesStandInForARescale() {
  QFETCH(bool, withRescale);
  QFETCH(QByteArray, unitCode);
  QFETCH(float, value);
  QFETCH(QByteArray, unit);
  const DicomFolder folder;
  DicomPicture p = sliceAt(0, 5);
  p.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_Modality, "MR");
    if (withRescale) data.putAndInsertString(DCM_RescaleSlope, "4");
    if (withRescale) data.putAndInsertString(DCM_RescaleIntercept, "0");
    DcmItem *mapping = nullptr, *code = nullptr;
    data.findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, mapping);
    mapping->putAndInsertFloat64(DCM_RealWorldValueSlope, 2);
    mapping->putAndInsertFloat64(DCM_RealWorldValueIntercept, 3);
    mapping->findOrCreateSequenceItem(DCM_MeasurementUnitsCodeSequence, code);
    code->putAndInsertString(DCM_CodeValue, unitCode.constData());
  };
  folder.add("s", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].unit, unit.toStdString());
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(loaded->acquired->value(0, 0, 0), value);
}

void TestMultiframe::partsOfAConcatenationAreOneVolume_data() {
  QTest::addColumn<int>("parts");
  QTest::addColumn<bool>("warned");
  QTest::newRow("all parts") << 2 << false;
  QTest::newRow("a part is missing") << 3 << true;
}

void TestMultiframe::partsOfAConcatenationAreOneVolume() {
  QFETCH(int, parts);
  QFETCH(bool, warned);
  const DicomFolder folder;
  for (int part = 1; part <= 2; ++part)
    folder.add(numbered("part", 9 - part), enhanced([&](DcmDataset& data) {
                 sharePlane(data);
                 data.putAndInsertString(DCM_ConcatenationUID, "1.2.3");
                 data.putAndInsertUint16(DCM_InConcatenationNumber, Uint16(part));
                 data.putAndInsertUint16(DCM_InConcatenationTotalNumber, Uint16(parts));
                 data.putAndInsertUint32(DCM_ConcatenationFrameOffsetNumber, Uint32((part - 1) * frames));
                 for (int n = 0; n < frames; ++n) placeAt(data, n, (part - 1) * frames + n);
               }));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].acquired.size.z, 2 * frames);
  QCOMPARE(warns(study.volumes[0].warnings, "parts of this concatenation"), warned);
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 1, 2, 3, 0, 1, 2, 3}));
}

void TestMultiframe::volumesAreNamedByWhatVaries_data() {
  using Vary = std::function<void(DcmDataset&, int)>;
  QTest::addColumn<QList<Edit>>("edits");
  QTest::addColumn<QStringList>("names");  // timePoint|bValue|label
  const auto row = [](const char* title, const Vary& vary, const QStringList& names) {
    QList<Edit> edits;
    for (int n = 0; n < 3; ++n) edits << [vary, n](DcmDataset& data) { vary(data, n); };
    QTest::newRow(title) << edits << names;
  };
  const auto text = [](const DcmTagKey& tag, QByteArrayList values) {
    return [tag, values](DcmDataset& data, int n) { data.putAndInsertString(tag, values[n].constData()); };
  };
  row("time points", text(DCM_TemporalPositionIdentifier, {"1", "2", "3"}),
      {QStringLiteral("1||"), QStringLiteral("2||"), QStringLiteral("3||")});
  row("acquisitions", text(DCM_AcquisitionNumber, {"7", "8", "9"}),
      {QStringLiteral("7||"), QStringLiteral("8||"), QStringLiteral("9||")});
  row("kinds of picture",
      text(DCM_ImageType, {"ORIGINAL\\PRIMARY\\M", "ORIGINAL\\PRIMARY\\P", "ORIGINAL\\PRIMARY\\R"}),
      {QStringLiteral("||M"), QStringLiteral("||P"), QStringLiteral("||R")});
  row("trigger times", text(DCM_TriggerTime, {"10", "20.5", "30"}),
      {QStringLiteral("||trigger 10 ms"), QStringLiteral("||trigger 20.5 ms"),
       QStringLiteral("||trigger 30 ms")});
  row("nothing", [](DcmDataset&, int) {},
      {QStringLiteral("||1 of 3"), QStringLiteral("||2 of 3"), QStringLiteral("||3 of 3")});
}

void TestMultiframe::volumesAreNamedByWhatVaries() {
  QFETCH(QList<Edit>, edits);
  QFETCH(QStringList, names);
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n)
    for (int z = 0; z < 2; ++z) {
      DicomPicture p = sliceAt(z, 0);
      p.instance = 10 * n + z;
      p.edit = edits[n];
      folder.add(numbered("s", 10 * n + z), p);
    }
  QStringList found;
  for (const Series& s : folder.open().volumes)
    found << QString::fromStdString(s.timePoint + "|" + s.bValue + "|" + s.label);
  QCOMPARE(found, names);
}

VOLUMEN_TEST(TestMultiframe);
#include "tst_multiframe.moc"
