// Guards slices.md 2, design.md 7: bad LUTs, palettes, overlays and shutters cost only that part, or the
// picture with a sentence, and never the program.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <algorithm>

#include "tests/fixtures/cpu_timer.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

using Edit = std::function<void(DcmDataset&)>;
using Words = std::vector<std::uint16_t>;
Q_DECLARE_METATYPE(Edit)

class TestFrameHostile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pictureIsRefused_data();
  void pictureIsRefused();
  void partIsLeftOut_data();
  void partIsLeftOut();
  void oddNumbersDoNoHarm_data();
  void oddNumbersDoNoHarm();
  void hugeFramesAreRefusedFirst();
};

namespace {

void setLut(DcmDataset& data, const DcmTagKey& sequence, const Words& descriptor, const Words& entries) {
  DcmItem* item = nullptr;
  data.findOrCreateSequenceItem(sequence, item);
  item->putAndInsertUint16Array(DcmTag(DCM_LUTDescriptor, EVR_US), descriptor.data(), descriptor.size());
  item->putAndInsertUint16Array(DcmTag(DCM_LUTData, EVR_OW), entries.data(), entries.size());
}

void setPalette(DcmDataset& data, const Words& descriptor, const Words& entries, Uint16 element) {
  data.putAndInsertString(DCM_PhotometricInterpretation, "PALETTE COLOR");
  for (Uint16 colour = 0; colour < 3; ++colour) {
    data.putAndInsertUint16Array(DcmTag(0x0028, Uint16(0x1101 + colour), EVR_US), descriptor.data(),
                                 descriptor.size());
    data.putAndInsertUint16Array(DcmTag(0x0028, Uint16(element + colour), EVR_OW), entries.data(),
                                 entries.size());
  }
}

void setOverlay(DcmDataset& data, int rows, int columns, std::vector<Sint16> origin, std::size_t bytes,
                int bit = 0) {
  data.putAndInsertUint16(DcmTag(0x6000, 0x0010, EVR_US), Uint16(rows));
  data.putAndInsertUint16(DcmTag(0x6000, 0x0011, EVR_US), Uint16(columns));
  if (!origin.empty())
    data.putAndInsertSint16Array(DcmTag(0x6000, 0x0050, EVR_SS), origin.data(), origin.size());
  data.putAndInsertUint16(DcmTag(0x6000, 0x0102, EVR_US), Uint16(bit));
  const std::vector<Uint8> bits(bytes, 0xff);
  if (bytes) data.putAndInsertUint8Array(DcmTag(0x6000, 0x3000, EVR_OB), bits.data(), bits.size());
}

Edit shutter(std::initializer_list<std::pair<DcmTagKey, std::string>> values) {
  return [values = std::vector(values)](DcmDataset& data) {
    for (const auto& [tag, text] : values) data.putAndInsertOFStringArray(tag, text.c_str());
  };
}

Result<Frame> frameWith(const Edit& edit) {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  DicomPicture picture;
  picture.pixels = {100, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  picture.edit = edit;
  writeDicom(path, picture);
  return frameOf(path);
}

}  // namespace

void TestFrameHostile::pictureIsRefused_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* says, Edit edit) {
    QTest::newRow(name) << edit << QString::fromLatin1(says);
  };
  row("modality LUT: descriptor of two", "missing or too short", [](DcmDataset& d) {
    setLut(d, DCM_ModalityLUTSequence, {256, 0}, Words(256));
  });
  row("modality LUT: data short", "does not hold the 256 entries", [](DcmDataset& d) {
    setLut(d, DCM_ModalityLUTSequence, {256, 0, 16}, Words(12));
  });
  row("modality LUT: data missing", "does not hold the 65536 entries", [](DcmDataset& d) {
    setLut(d, DCM_ModalityLUTSequence, {0, 0, 16}, {});
  });
  row("modality LUT: entries of 40 bits", "entries of 40 bits", [](DcmDataset& d) {
    setLut(d, DCM_ModalityLUTSequence, {2, 0, 40}, {1, 2});
  });
  row("palette short", "does not hold the 256 entries", [](DcmDataset& d) {
    setPalette(d, {256, 0, 16}, Words(255), 0x1201);
  });
  row("palette missing", "missing or too short",
      [](DcmDataset& d) { d.putAndInsertString(DCM_PhotometricInterpretation, "PALETTE COLOR"); });
  row("segments that begin with a slope", "does not hold", [](DcmDataset& d) {
    setPalette(d, {4, 0, 16}, {1, 4, 0x4000}, 0x1221);
  });
  row("segments that repeat themselves", "does not hold", [](DcmDataset& d) {
    setPalette(d, {4, 0, 16}, {2, 60000, 0, 0}, 0x1221);
  });
  row("segments longer than their table", "does not hold", [](DcmDataset& d) {
    setPalette(d, {4, 0, 16}, {0, 1, 7, 1, 65535, 9}, 0x1221);
  });
  row("segments of an unknown kind", "does not hold", [](DcmDataset& d) {
    setPalette(d, {4, 0, 16}, {9, 1, 7, 0}, 0x1221);
  });
  row("bits stored above bits allocated", "BitsStored is 24",
      [](DcmDataset& d) { d.putAndInsertUint16(DCM_BitsStored, 24); });
  row("three samples in a palette", "SamplesPerPixel is 3", [](DcmDataset& d) {
    setPalette(d, {4, 0, 16}, Words(4), 0x1201);
    d.putAndInsertUint16(DCM_SamplesPerPixel, 3);
  });
  row("colours that nobody uses", "colour image (HSV): not supported",
      [](DcmDataset& d) { d.putAndInsertString(DCM_PhotometricInterpretation, "HSV"); });
  row("signed colours", "unsigned", [](DcmDataset& d) {
    d.putAndInsertString(DCM_PhotometricInterpretation, "RGB");
    d.putAndInsertUint16(DCM_SamplesPerPixel, 3);
    d.putAndInsertUint16(DCM_PixelRepresentation, 1);
  });
  row("more colours than bytes", "cut off", [](DcmDataset& d) {
    d.putAndInsertString(DCM_PhotometricInterpretation, "RGB");
    d.putAndInsertUint16(DCM_SamplesPerPixel, 3);
  });
  row("half a pair of pixels", "two pixels at a time", [](DcmDataset& d) {
    d.putAndInsertString(DCM_PhotometricInterpretation, "YBR_FULL_422");
    d.putAndInsertUint16(DCM_SamplesPerPixel, 3);
    d.putAndInsertUint16(DCM_Columns, 3);
  });
}

void TestFrameHostile::pictureIsRefused() {
  QFETCH(Edit, edit);
  QFETCH(QString, says);
  const Result<Frame> frame = frameWith(edit);
  QVERIFY2(!frame.ok(), "shown");
  QVERIFY2(QString::fromStdString(frame.message()).contains(says), frame.message().c_str());
  QVERIFY2(frame.message().ends_with(".") && !frame.message().ends_with(".."), frame.message().c_str());
}

void TestFrameHostile::partIsLeftOut_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* says, Edit edit) {
    QTest::newRow(name) << edit << QString::fromLatin1(says);
  };
  row("VOI LUT short", "A VOI LUT is left out", [](DcmDataset& d) {
    setLut(d, DCM_VOILUTSequence, {256, 0, 16}, Words(3));
  });
  row("overlay larger than its data", "Overlay 1 is left out: its data hold 16 bytes", [](DcmDataset& d) {
    setOverlay(d, 65535, 65535, {1, 1}, 16);
  });
  row("overlay in a bit of the pixels", "nor a bit of its own", [](DcmDataset& d) {
    setOverlay(d, 3, 4, {1, 1}, 0, 3);
  });
  row("overlay in a bit that is not there", "nor a bit of its own", [](DcmDataset& d) {
    setOverlay(d, 3, 4, {1, 1}, 0, 200);
  });
  row("polygon with half a corner", "A shutter is left out: the corners",
      shutter({{DCM_ShutterShape, "POLYGONAL"}, {DCM_VerticesOfThePolygonalShutter, "1\\1\\2\\2\\3\\3\\1"}}));
  std::string corners = "1\\1";
  for (int n = 0; n < 5000; ++n) corners += n % 2 ? "\\1\\3" : "\\3\\1";
  row("polygon of 5001 corners", "more than 4096 corners",
      shutter({{DCM_ShutterShape, "POLYGONAL"}, {DCM_VerticesOfThePolygonalShutter, corners}}));
  row("rectangle with three edges", "an edge of its rectangle",
      shutter({{DCM_ShutterShape, "RECTANGULAR"},
               {DCM_ShutterLeftVerticalEdge, "1"},
               {DCM_ShutterRightVerticalEdge, "2"},
               {DCM_ShutterUpperHorizontalEdge, "1"}}));
  row("circle without radius", "centre or radius",
      shutter({{DCM_ShutterShape, "CIRCULAR"}, {DCM_CenterOfCircularShutter, "1\\1"}}));
  row("shutter of a shape of its own", "its shape is STAR", shutter({{DCM_ShutterShape, "STAR"}}));
}

void TestFrameHostile::partIsLeftOut() {
  QFETCH(Edit, edit);
  QFETCH(QString, says);
  const Result<Frame> frame = frameWith(edit);
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(frame->values[1], 1.f);
  QCOMPARE(frame->warnings.size(), std::size_t(1));
  QVERIFY2(QString::fromStdString(frame->warnings[0]).contains(says), frame->warnings[0].c_str());
  QVERIFY(frame->overlays.empty() && frame->shutter.empty());
}

void TestFrameHostile::oddNumbersDoNoHarm_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<int>("overlayBits");
  QTest::addColumn<int>("hidden");
  const auto row = [](const char* name, int overlayBits, int hidden, Edit edit) {
    QTest::newRow(name) << edit << overlayBits << hidden;
  };
  row("overlay that begins outside", 2, 0, [](DcmDataset& d) {
    setOverlay(d, 3, 4, {-1, -1}, 2);
  });  // two rows and columns outside
  row("overlay far away", 0, 0, [](DcmDataset& d) { setOverlay(d, 3, 4, {-32768, -32768}, 2); });
  row("overlay without origin", 12, 0, [](DcmDataset& d) { setOverlay(d, 3, 4, {}, 2); });
  row("overlay of frames that are not this one", -1, 0, [](DcmDataset& d) {
    setOverlay(d, 3, 4, {1, 1}, 2);
    d.putAndInsertString(DcmTag(0x6000, 0x0015, EVR_IS), "1");
    d.putAndInsertUint16(DcmTag(0x6000, 0x0051, EVR_US), 5);
  });
  row("edges of a rectangle beyond all numbers", -1, 0,
      shutter({{DCM_ShutterShape, "RECTANGULAR"},
               {DCM_ShutterLeftVerticalEdge, "-999999999999"},
               {DCM_ShutterRightVerticalEdge, "999999999999"},
               {DCM_ShutterUpperHorizontalEdge, "-5"},
               {DCM_ShutterLowerHorizontalEdge, "99999999999"}}));
  row("rectangle of nothing", -1, 12,
      shutter({{DCM_ShutterShape, "RECTANGULAR"},
               {DCM_ShutterLeftVerticalEdge, "4"},
               {DCM_ShutterRightVerticalEdge, "1"},
               {DCM_ShutterUpperHorizontalEdge, "1"},
               {DCM_ShutterLowerHorizontalEdge, "3"}}));
  row("circle far away", -1, 12,
      shutter({{DCM_ShutterShape, "CIRCULAR"},
               {DCM_CenterOfCircularShutter, "999999999\\-999999999"},
               {DCM_RadiusOfCircularShutter, "2"}}));
}

void TestFrameHostile::oddNumbersDoNoHarm() {
  QFETCH(Edit, edit);
  QFETCH(int, overlayBits);
  QFETCH(int, hidden);
  const Result<Frame> frame = frameWith(edit);
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QVERIFY2(frame->warnings.empty(), frame->warnings.empty() ? "" : frame->warnings[0].c_str());
  QCOMPARE(int(frame->overlays.size()), overlayBits < 0 ? 0 : 1);
  for (const FrameOverlay& overlay : frame->overlays)
    QCOMPARE(int(std::count(overlay.mask.begin(), overlay.mask.end(), 1)), overlayBits);
  QCOMPARE(int(std::count(frame->shutter.begin(), frame->shutter.end(), 1)), hidden);
}

void TestFrameHostile::hugeFramesAreRefusedFirst() {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  writeDicom(path, {}, "1.2.840.10008.1.2.5");
  std::vector<std::uint8_t> bytes = readAll(path);
  for (const std::uint8_t element : {std::uint8_t(0x10), std::uint8_t(0x11)}) {
    const std::vector<std::uint8_t> tag{0x28, 0, element, 0, 'U', 'S', 2, 0};
    const auto at = std::search(bytes.begin(), bytes.end(), tag.begin(), tag.end());
    QVERIFY(at != bytes.end());
    at[8] = at[9] = 0xff;
  }
  writeAll(path, bytes);
  const CpuTimer timer;
  const Result<Frame> frame = frameOf(path);
  QVERIFY(!frame.ok());
  QVERIFY2(frame.message().find("4294 million pixels; more than 268 million pixels") != std::string::npos,
           frame.message().c_str());
  QVERIFY2(timer.elapsed() < 2000, "slow");
}

VOLUMEN_TEST(TestFrameHostile);
#include "tst_frame_hostile.moc"
