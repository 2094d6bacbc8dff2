// Guards slices.md 2 and 3 on synthetic files: windows, VOI LUTs, polarity, pixel sizes, shutters and
// functional groups.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <cmath>

#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

using Edit = std::function<void(DcmDataset&)>;
using Words = std::vector<std::uint16_t>;
using Texts = std::vector<std::pair<DcmTagKey, std::string>>;
Q_DECLARE_METATYPE(Edit)
Q_DECLARE_METATYPE(Texts)

class TestFrameGreys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void polarityIsTurnedOnce_data();
  void polarityIsTurnedOnce();
  void windows_data();
  void windows();
  void windowsOfFloatsAreExact();
  void rangeOfTheFrameWithoutPadding();
  void voiLuts_data();
  void voiLuts();
  void modalityLutStandsInForTheRescale();
  void framesHaveTheirOwnGroups();
  void sizesOfPixels_data();
  void sizesOfPixels();
  void shutters_data();
  void shutters();
};

namespace {

Edit texts(const Texts& values) {
  return [=](DcmDataset& data) {
    for (const auto& [tag, text] : values) data.putAndInsertOFStringArray(tag, text.c_str());
  };
}

Result<Frame> frameWith(const Edit& edit, DicomPicture picture = {}, int n = 0) {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  picture.edit = edit;
  writeDicom(path, picture);
  return frameOf(path, n);
}

void setLut(DcmItem& data, const DcmTagKey& sequence, const Words& descriptor, const Words& entries) {
  DcmItem* item = nullptr;
  data.findOrCreateSequenceItem(sequence, item, -2);
  item->putAndInsertUint16Array(DcmTag(DCM_LUTDescriptor, EVR_US), descriptor.data(), descriptor.size());
  item->putAndInsertUint16Array(DcmTag(DCM_LUTData, EVR_OW), entries.data(), entries.size());
  item->putAndInsertString(DCM_LUTExplanation, "LUT");
}

}  // namespace

void TestFrameGreys::polarityIsTurnedOnce_data() {
  QTest::addColumn<Texts>("values");
  QTest::addColumn<bool>("inverted");
  const auto row = [](const char* photometric, const char* shape, bool inverted) {
    QTest::addRow("%s %s", photometric, shape)
        << Texts{{DCM_PhotometricInterpretation, photometric}, {DCM_PresentationLUTShape, shape}} << inverted;
  };
  row("MONOCHROME2", "", false);
  row("MONOCHROME1", "", true);
  row("MONOCHROME2", "IDENTITY", false);
  row("MONOCHROME2", "INVERSE", true);
  row("MONOCHROME1", "INVERSE", true);
}

void TestFrameGreys::polarityIsTurnedOnce() {
  QFETCH(Texts, values);
  QFETCH(bool, inverted);
  const Result<Frame> frame = frameWith(texts(values));
  QVERIFY(frame.ok());
  QCOMPARE(frame->greys[0].mapping.inverted, inverted);
}

void TestFrameGreys::windows_data() {
  QTest::addColumn<Texts>("values");
  QTest::addColumn<QStringList>("found");
  const auto row = [](const char* name, Texts values, const char* found) {
    QTest::newRow(name) << values << QString::fromLatin1(found).split(u'|');
  };
  const DcmTagKey centre = DCM_WindowCenter, width = DCM_WindowWidth, function = DCM_VOILUTFunction,
                  name = DCM_WindowCenterWidthExplanation;
  row("one", {{centre, "40"}, {width, "400"}}, "0: 40/400 ");
  row("two with names", {{centre, "40\\-600"}, {width, "400\\1500"}, {name, "soft\\lung"}},
      "0: 40/400 soft|0: -600/1500 lung");
  row("fewer names than windows", {{centre, "40\\-600"}, {width, "400\\1500"}, {name, "soft"}},
      "0: 40/400 soft|0: -600/1500 ");
  row("LINEAR_EXACT", {{centre, "40"}, {width, "400"}, {function, "LINEAR_EXACT"}}, "1: 40/400 ");
  row("SIGMOID", {{centre, "40"}, {width, "400"}, {function, "SIGMOID"}}, "2: 40/400 ");
  row("narrower than LINEAR knows", {{centre, "0.5"}, {width, "0.25"}}, "1: 0.5/0.25 ");
  row("without width", {{centre, "40\\50"}, {width, "0\\100"}}, "0: 50/100 ");
}

void TestFrameGreys::windows() {
  QFETCH(Texts, values);
  QFETCH(QStringList, found);
  const Result<Frame> frame = frameWith(texts(values));
  QVERIFY(frame.ok());
  QStringList greys;
  for (const NamedGrey& grey : frame->greys)
    greys << QStringLiteral("%1: %2/%3 %4")
                 .arg(int(grey.mapping.function))
                 .arg(grey.mapping.window.centre)
                 .arg(grey.mapping.window.width)
                 .arg(QString::fromStdString(grey.name));
  QCOMPARE(greys, found);
}

void TestFrameGreys::windowsOfFloatsAreExact() {
  const Result<Frame> frame = frameWith([](DcmDataset& d) {
    d.findAndDeleteElement(DCM_PixelData);
    const std::vector<Float32> values(12, 0.25f);
    d.putAndInsertFloat32Array(DCM_FloatPixelData, values.data(), values.size());
    d.putAndInsertString(DCM_WindowCenter, "0");
    d.putAndInsertString(DCM_WindowWidth, "2");
  });
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(frame->values[0], 0.25f);
  QCOMPARE(frame->greys[0].mapping, (GreyMapping{{0, 2}, WindowFunction::linearExact, {}, false}));
}

void TestFrameGreys::rangeOfTheFrameWithoutPadding() {
  DicomPicture picture;
  picture.columns = 50;
  picture.rows = 42;
  for (int n = 0; n < 2000; ++n) picture.pixels.push_back(std::uint16_t(n));
  picture.pixels.resize(2100, 60000);  // padding
  const Result<Frame> frame =
      frameWith([](DcmDataset& d) { d.putAndInsertUint16(DCM_PixelPaddingValue, 60000); }, picture);
  QVERIFY(frame.ok() && frame->greys.size() == 1);
  QCOMPARE(*frame->padding, (ValueRange{60000, 60000}));
  // 0.1 % of 2000 values are 2, so that the window is from the second value, 1, to the 1998th, 1997.
  QCOMPARE(frame->greys[0].mapping.window, (Window{999, 1996}));
  QCOMPARE(frame->greys[0].mapping.function, WindowFunction::linearExact);
}

void TestFrameGreys::voiLuts_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<double>("first");
  QTest::addColumn<QList<double>>("ends");
  const auto row = [](
                       const char* name, Words descriptor, Words entries, double first, QList<double> ends,
                       Edit more = [](DcmDataset&) {}) {
    QTest::newRow(name) << Edit([=](DcmDataset& d) {
      more(d);
      setLut(d, DCM_VOILUTSequence, descriptor, entries);
    }) << first << ends;
  };
  row("12 bits", {3, 100, 12}, {0, 2000, 4095}, 100, {0, 1});
  row("8 bits, a word each", {2, 0, 8}, {51, 255}, 0, {0.2, 1});
  row("8 bits, two a word", {4, 0, 8}, {0x0033, 0xff66}, 0, {0.2, 1});
  row("entry above its bits", {2, 0, 8}, {0, 700}, 0, {0, 1});
  row("unsigned pixels: first from 0", {2, 0xfc00, 16}, {0, 65535}, 64512, {0, 1});
  row("signed pixels: first below 0", {2, 0xfc00, 16}, {0, 65535}, -1024, {0, 1},
      [](DcmDataset& d) { d.putAndInsertUint16(DCM_PixelRepresentation, 1); });
  row("values below 0: first below 0", {2, 0xfc00, 16}, {0, 65535}, -1024, {0, 1},
      [](DcmDataset& d) { d.putAndInsertString(DCM_RescaleIntercept, "-1024"); });
  Words all(65536, 7);
  all.back() = 65535;
  row("0 entries are 65536", {0, 0, 16}, all, 0, {7 / 65535.0, 1});
}

void TestFrameGreys::voiLuts() {
  QFETCH(Edit, edit);
  QFETCH(double, first);
  QFETCH(QList<double>, ends);
  const Result<Frame> frame = frameWith(edit);
  QVERIFY2(frame.ok() && frame->warnings.empty(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(frame->greys.size(), std::size_t(1));
  QCOMPARE(frame->greys[0].name, std::string("LUT"));
  const GreyTable& table = frame->greys[0].mapping.table;
  QCOMPARE(table.first, first);
  // Entries are float32.
  QVERIFY(std::abs(double(table.grey.front()) - ends[0]) < 1e-7);
  QVERIFY(std::abs(double(table.grey.back()) - ends[1]) < 1e-7);
}

void TestFrameGreys::modalityLutStandsInForTheRescale() {
  DicomPicture picture;
  picture.columns = 5;
  picture.rows = 1;
  picture.pixels = {0, 9, 10, 11, 500};
  const Result<Frame> frame = frameWith(
      [](DcmDataset& d) {
        d.putAndInsertString(DCM_RescaleSlope, "3");
        setLut(d, DCM_ModalityLUTSequence, {3, 9, 16}, {70, 80, 1000});
      },
      picture);
  QVERIFY(frame.ok());
  QCOMPARE(frame->values.floats(), (std::vector<float>{70, 70, 80, 1000, 1000}));
  QCOMPARE(frame->unit, std::string());
}

void TestFrameGreys::framesHaveTheirOwnGroups() {
  const Edit edit = [](DcmDataset& d) {
    d.putAndInsertString(DCM_NumberOfFrames, "2");
    const std::vector<Uint16> pixels(24, 10);
    d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    for (int n = 0; n < 2; ++n) {
      DcmItem *frame = nullptr, *group = nullptr;
      d.findOrCreateSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, -2);
      frame->findOrCreateSequenceItem(DCM_PixelValueTransformationSequence, group);
      group->putAndInsertString(DCM_RescaleSlope, n ? "5" : "2");
      group->putAndInsertString(DCM_RescaleIntercept, "1");
      frame->findOrCreateSequenceItem(DCM_FrameVOILUTSequence, group);
      group->putAndInsertString(DCM_WindowCenter, n ? "50" : "20");
      group->putAndInsertString(DCM_WindowWidth, "100");
    }
    DcmItem *shared = nullptr, *measures = nullptr;
    d.findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
    shared->findOrCreateSequenceItem(DCM_PixelMeasuresSequence, measures);
    measures->putAndInsertString(DCM_PixelSpacing, "0.25\\0.5");
  };
  for (int n = 0; n < 2; ++n) {
    const Result<Frame> frame = frameWith(edit, {}, n);
    QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
    QCOMPARE(frame->values[0], n ? 51.f : 21.f);
    QCOMPARE(frame->greys[0].mapping.window.centre, n ? 50.0 : 20.0);
    QCOMPARE(frame->pixel, (PixelSize{{0.5, 0.25}, PixelSizeKind::patient}));
  }
}

void TestFrameGreys::sizesOfPixels_data() {
  QTest::addColumn<QString>("modality");
  QTest::addColumn<QString>("spacing");
  QTest::addColumn<Texts>("values");
  QTest::addColumn<PixelSizeKind>("kind");
  QTest::addColumn<QPointF>("mm");
  using K = PixelSizeKind;
  const auto row = [](const char* name, const char* modality, const char* spacing, Texts values, K kind,
                      QPointF mm) {
    QTest::newRow(name) << QString::fromLatin1(modality) << QString::fromLatin1(spacing) << values << kind
                        << mm;
  };
  const DcmTagKey imager = DCM_ImagerPixelSpacing, type = DCM_PixelSpacingCalibrationType,
                  factor = DCM_EstimatedRadiographicMagnificationFactor;
  row("CT: in the patient, rows first", "CT", "0.5\\0.7", {}, K::patient, {0.7, 0.5});
  row("geometry", "DX", "0.2\\0.2", {{imager, "0.3\\0.3"}, {type, "GEOMETRY"}}, K::magnified, {0.2, 0.2});
  row("fiducial", "DX", "0.2\\0.2", {{imager, "0.2\\0.2"}, {type, "FIDUCIAL"}}, K::calibrated, {0.2, 0.2});
  row("both, different", "DX", "0.2\\0.2", {{imager, "0.3\\0.3"}}, K::unstated, {0.2, 0.2});
  row("both, equal", "CR", "0.2\\0.2", {{imager, "0.2\\0.2"}}, K::atDetector, {0.2, 0.2});
  row("detector alone", "MG", "", {{imager, "0.1\\0.2"}}, K::atDetector, {0.2, 0.1});
  row("detector and factor", "MG", "", {{imager, "0.1\\0.2"}, {factor, "2"}}, K::magnified, {0.1, 0.05});
  row("factor of 1", "MG", "", {{imager, "0.1\\0.1"}, {factor, "1"}}, K::atDetector, {0.1, 0.1});
  row("factor by distances", "XA", "",
      {{imager, "0.3\\0.3"}, {DCM_DistanceSourceToDetector, "1000"}, {DCM_DistanceSourceToPatient, "500"}},
      K::magnified, {0.15, 0.15});
  row("distances that make it smaller", "XA", "",
      {{imager, "0.3\\0.3"}, {DCM_DistanceSourceToDetector, "500"}, {DCM_DistanceSourceToPatient, "1000"}},
      K::atDetector, {0.3, 0.3});
  row("film", "OT", "", {{DCM_NominalScannedPixelSpacing, "0.1\\0.1"}}, K::filmScan, {0.1, 0.1});
  row("shape alone", "US", "", {{DCM_PixelAspectRatio, "2\\1"}}, K::unknown, {1, 2});
  row("no mm of a whole ultrasound picture", "US", "0.5\\0.7", {}, K::unknown, {0.7, 0.5});
  row("no numbers", "US", "", {{DCM_PixelAspectRatio, "0\\0"}}, K::unknown, {1, 1});
  row("nothing", "US", "", {}, K::unknown, {1, 1});
  row("shape beside a size does not count", "CT", "0.5\\0.5", {{DCM_PixelAspectRatio, "2\\1"}}, K::patient,
      {0.5, 0.5});
}

void TestFrameGreys::sizesOfPixels() {
  QFETCH(QString, modality);
  QFETCH(QString, spacing);
  QFETCH(Texts, values);
  QFETCH(PixelSizeKind, kind);
  QFETCH(QPointF, mm);
  DicomPicture picture;
  picture.spacing = spacing.toStdString();
  if (modality == QLatin1String("US")) picture.orientation.clear();
  values.emplace_back(DCM_Modality, modality.toStdString());
  const Result<Frame> frame = frameWith(texts(values), picture);
  QVERIFY(frame.ok());
  QCOMPARE(frame->pixel.kind, kind);
  QVERIFY(std::abs(frame->pixel.mm.x - mm.x()) < 1e-12 && std::abs(frame->pixel.mm.y - mm.y()) < 1e-12);
}

void TestFrameGreys::shutters_data() {
  QTest::addColumn<Texts>("values");
  QTest::addColumn<QStringList>("rows");
  const auto row = [](const char* name, Texts values, const char* rows) {
    QTest::newRow(name) << values << QString::fromLatin1(rows).split(u' ');
  };
  const Texts rectangle{{DCM_ShutterShape, "RECTANGULAR"},
                        {DCM_ShutterLeftVerticalEdge, "2"},
                        {DCM_ShutterRightVerticalEdge, "4"},
                        {DCM_ShutterUpperHorizontalEdge, "2"},
                        {DCM_ShutterLowerHorizontalEdge, "3"}};
  row("rectangle: edges are free, counted from 1", rectangle, "##### #...# #...# ##### #####");
  row("circle",
      {{DCM_ShutterShape, "CIRCULAR"},
       {DCM_CenterOfCircularShutter, "3\\3"},
       {DCM_RadiusOfCircularShutter, "2"}},
      "##.## #...# ..... #...# ##.##");
  row("circle of pixels twice as high",
      {{DCM_ShutterShape, "CIRCULAR"},
       {DCM_CenterOfCircularShutter, "3\\3"},
       {DCM_RadiusOfCircularShutter, "2"},
       {DCM_PixelAspectRatio, "2\\1"}},
      "##### ##.## ..... ##.## #####");
  row("polygon: row, column",
      {{DCM_ShutterShape, "POLYGONAL"}, {DCM_VerticesOfThePolygonalShutter, "0\\0\\0\\6\\6\\0"}},
      "..... ....# ...## ..### .####");
  row("polygon of the rectangle's corners",
      {{DCM_ShutterShape, "POLYGONAL"}, {DCM_VerticesOfThePolygonalShutter, "2\\2\\2\\4\\3\\4\\3\\2"}},
      "##### #...# #...# ##### #####");
  Texts both = rectangle;
  both[0].second = "RECTANGULAR\\CIRCULAR";
  both.insert(both.end(), {{DCM_CenterOfCircularShutter, "3\\3"}, {DCM_RadiusOfCircularShutter, "1"}});
  row("several: what all leave free", both, "##### ##.## #...# ##### #####");
}

void TestFrameGreys::shutters() {
  QFETCH(Texts, values);
  QFETCH(QStringList, rows);
  DicomPicture picture;
  picture.columns = picture.rows = 5;
  picture.spacing = "";
  const Result<Frame> frame = frameWith(texts(values), picture);
  QVERIFY(frame.ok() && frame->warnings.empty());
  QString found;
  for (const std::uint8_t hidden : frame->shutter) found += QLatin1Char(hidden ? '#' : '.');
  QCOMPARE(found, rows.join(QString()));
}

VOLUMEN_TEST(TestFrameGreys);
#include "tst_frame_greys.moc"
