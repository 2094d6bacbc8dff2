// Guards design.md 7: a Siemens mosaic is a volume whose tiles are placed by the CSA header, in either order.
// Facts that the header lacks are not guessed.
#include <cstring>

#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Bytes = std::vector<Uint8>;

void addNumber(Bytes& to, std::uint32_t n) {
  for (int shift : {0, 8, 16, 24}) to.push_back(Uint8(n >> shift));
}

// Adds a field of a CSA header with its values. In the first version, lengths are larger by `firstItems`.
void addField(Bytes& to, const std::string& name, const std::vector<std::string>& values, bool second,
              std::uint32_t firstItems) {
  Bytes head(64);
  std::copy(name.begin(), name.end(), head.begin());
  to.insert(to.end(), head.begin(), head.end());
  addNumber(to, std::uint32_t(values.size()));
  addNumber(to, 0x00005346);  // "FS"
  addNumber(to, 0);
  addNumber(to, std::uint32_t(values.size()));
  addNumber(to, 77);
  for (const std::string& value : values) {
    const std::uint32_t length = std::uint32_t(value.size()) + 1;
    addNumber(to, second ? length : length + firstItems);
    for (int n = 0; n < 3; ++n) addNumber(to, length);
    to.insert(to.end(), value.begin(), value.end());
    to.resize(to.size() + 1);
    while (to.size() % 4) to.push_back(0);
  }
}

Bytes csaHeader(const std::vector<std::string>& normal, const std::string& count, bool second = true) {
  Bytes bytes;
  if (second) bytes = {'S', 'V', '1', '0', 4, 3, 2, 1};
  addNumber(bytes, 3);
  addNumber(bytes, 77);
  addField(bytes, "EchoLinePosition", {"32"}, second, 1);
  addField(bytes, "NumberOfImagesInMosaic", {count}, second, 1);
  addField(bytes, "SliceNormalVector", normal, second, 1);
  return bytes;
}

// Returns 5 slices of 2 x 2 pixels in a picture of 6 x 6. Tile n holds n.
DicomPicture mosaic(const Bytes& csa) {
  DicomPicture p;
  p.columns = p.rows = 6;
  p.spacing = "2\\2";
  p.position = {100, 200, 300};
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) p.pixels.push_back(std::uint16_t(y / 2 * 3 + x / 2));
  p.edit = [csa](DcmDataset& data) {
    data.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\M\\MOSAIC");
    data.putAndInsertString(DCM_SpacingBetweenSlices, "3");
    data.putAndInsertString(DcmTag(0x0029, 0x0010, EVR_LO), "SIEMENS CSA HEADER");
    if (!csa.empty())
      data.putAndInsertUint8Array(DcmTag(0x0029, 0x1010, EVR_OB), csa.data(), csa.size() / 2 * 2);
  };
  return p;
}

}  // namespace

class TestMosaic : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void tilesAreSlices_data();
  void tilesAreSlices();
  void tilesAreFrames();
  void timeSeriesIsOneVolumeAFile();
  void filesOfOneNumberAreVolumes_data();
  void filesOfOneNumberAreVolumes();
  void unknownPlacesAreAPicture_data();
  void unknownPlacesAreAPicture();
  void everyCutOfTheHeaderEndsWell();
};

void TestMosaic::tilesAreSlices_data() {
  QTest::addColumn<QByteArray>("normal");
  QTest::addColumn<bool>("second");
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<double>("originZ");
  const QList<float> up{0, 1, 2, 3, 4}, down{4, 3, 2, 1, 0};
  QTest::newRow("first tile is first along the normal") << QByteArray("1") << true << up << 300.0;
  QTest::newRow("first tile is last along the normal") << QByteArray("-1") << true << down << 288.0;
  QTest::newRow("first version of the header") << QByteArray("1") << false << up << 300.0;
}

void TestMosaic::tilesAreSlices() {
  QFETCH(QByteArray, normal);
  QFETCH(bool, second);
  QFETCH(QList<float>, values);
  QFETCH(double, originZ);
  const DicomFolder folder;
  folder.add("m", mosaic(csaHeader({"0", "0", normal.toStdString()}, "5", second)));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const VoxelGeometry& g = study.volumes[0].acquired;
  QCOMPARE(g.size, glm::ivec3(2, 2, 5));
  QCOMPARE(g.spacing(), glm::dvec3(2, 2, 3));
  // The picture's position is that of a slice as large as the whole picture, 6 pixels wide and not 2.
  QCOMPARE(g.origin, glm::dvec3(104, 204, originZ));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  const std::vector<float> first = firstOfEachSlice(*loaded->acquired);
  QCOMPARE(QList<float>(first.begin(), first.end()), values);
  for (int k = 0; k < 5; ++k) QCOMPARE(loaded->acquired->value(1, 1, k), values[k]);
}

void TestMosaic::tilesAreFrames() {
  const DicomFolder folder;
  folder.add("m", mosaic(csaHeader({"0", "0", "1"}, "5")), "1.2.840.10008.1.2.4.70");
  const Study study = folder.open();
  const auto loaded = loadSeries(study.volumes.at(0));
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 1, 2, 3, 4}));
}

void TestMosaic::timeSeriesIsOneVolumeAFile() {
  const DicomFolder folder;
  for (int n = 1; n <= 3; ++n) {
    DicomPicture p = mosaic(csaHeader({"0", "0", "1"}, "5"));
    p.instance = n;
    p.edit = [edit = p.edit, n](DcmDataset& data) {
      edit(data);
      data.putAndInsertString(DCM_AcquisitionNumber, QByteArray::number(n).constData());
    };
    folder.add(numbered("m", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(3));
  for (std::size_t n = 0; n < 3; ++n) {
    QCOMPARE(study.volumes[n].acquired.size, glm::ivec3(2, 2, 5));
    QCOMPARE(study.volumes[n].timePoint, std::to_string(n + 1));
    QCOMPARE(study.volumes[n].files[0], folder.path(numbered("m", int(n) + 1)));
  }
}

void TestMosaic::filesOfOneNumberAreVolumes_data() {
  QTest::addColumn<double>("offMm");  // offset of each from the previous one, along the normal
  QTest::newRow("at one place") << 0.0;
  QTest::newRow("moved with the patient") << 0.2;
  QTest::newRow("half a slice apart") << 1.5;
}

// Only the files separate them, even if they are copies of one acquisition.
void TestMosaic::filesOfOneNumberAreVolumes() {
  QFETCH(double, offMm);
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) {
    DicomPicture p = mosaic(csaHeader({"0", "0", "1"}, "5"));
    p.position.z += n * offMm;
    for (std::uint16_t& pixel : p.pixels) pixel = std::uint16_t(pixel + 10 * (n % 2));
    folder.add(numbered("m", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(3));
  for (std::size_t n = 0; n < 3; ++n) {
    const Series& s = study.volumes[n];
    QCOMPARE(s.files[0], folder.path(numbered("m", int(n))));
    QCOMPARE(s.acquired.size, glm::ivec3(2, 2, 5));
    QCOMPARE(s.label, std::to_string(n + 1) + " of 3");
    QVERIFY(s.warnings.empty());
    const auto loaded = loadSeries(s);
    QVERIFY(loaded.ok());
    const float first = 10.f * float(n % 2);
    QCOMPARE(firstOfEachSlice(*loaded->acquired),
             (std::vector<float>{first, first + 1, first + 2, first + 3, first + 4}));
  }
}

void TestMosaic::unknownPlacesAreAPicture_data() {
  QTest::addColumn<QByteArray>("csa");
  QTest::addColumn<QByteArray>("spacing");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* title, const Bytes& csa, const char* spacing, const char* says) {
    QTest::newRow(title) << QByteArray(reinterpret_cast<const char*>(csa.data()), qsizetype(csa.size()))
                         << QByteArray(spacing) << QByteArray(says);
  };
  row("no CSA header", {}, "3", "no CSA header");
  row("no number of slices", csaHeader({"0", "0", "1"}, "x"), "3", "of how many slices");
  row("no slices", csaHeader({"0", "0", "1"}, "0"), "3", "of how many slices");
  row("2^31 slices", csaHeader({"0", "0", "1"}, "2147483648"), "3", "of how many slices");
  row("no normal", csaHeader({"0"}, "5"), "3", "no normal");
  row("a normal in the plane", csaHeader({"1", "0", "0"}, "5"), "3", "not that of the picture");
  row("a normal that is no number", csaHeader({"nan", "0", "1"}, "5"), "3", "no normal");
  row("tiles that do not fit", csaHeader({"0", "0", "1"}, "10"), "3", "do not hold its 10 slices");
  row("no distance of the slices", csaHeader({"0", "0", "1"}, "5"), "", "SpacingBetweenSlices");
  row("a distance of 0", csaHeader({"0", "0", "1"}, "5"), "0", "SpacingBetweenSlices");
}

void TestMosaic::unknownPlacesAreAPicture() {
  QFETCH(QByteArray, csa);
  QFETCH(QByteArray, spacing);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  DicomPicture p = mosaic(Bytes(csa.begin(), csa.end()));
  p.edit = [edit = p.edit, spacing](DcmDataset& data) {
    edit(data);
    data.putAndInsertString(DCM_SpacingBetweenSlices, spacing.constData());
  };
  folder.add("m", p);
  const Study study = folder.open();
  QVERIFY(study.volumes.empty());
  QCOMPARE(study.images.size(), std::size_t(1));
  const std::string& why = study.images[0].notVolume;
  QVERIFY2(why.starts_with("Siemens mosaic"), why.c_str());
  QVERIFY2(why.find(says.toStdString()) != std::string::npos, why.c_str());
  QCOMPARE(study.images[0].columns, 6);
}

void TestMosaic::everyCutOfTheHeaderEndsWell() {
  const Bytes whole = csaHeader({"0", "0", "1"}, "5");
  const DicomFolder folder;
  std::size_t pictures = 0;
  for (std::size_t length = 2; length < whole.size(); length += 10) {
    folder.add("m", mosaic(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(length))));
    const Study study = folder.open();
    QCOMPARE(study.volumes.size() + study.images.size(), std::size_t(1));
    pictures += study.images.size();
  }
  QVERIFY(pictures > 10);
}

VOLUMEN_TEST(TestMosaic);
#include "tst_mosaic.moc"
