// Guards design.md 4 (convert: values and geometry exact), design.md 10 (picture files) and picture.md 6
// (8-bit pictures).
#include <QDir>
#include <QImage>
#include <QTemporaryDir>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "io/files/image_file.h"
#include "io/files/nrrd.h"
#include "io/files/picture_file.h"
#include "io/files/write_volume.h"
#include "io/study/series.h"
#include "tests/unit/suite.h"

using namespace volumen;

namespace {

const glm::ivec3 gridSize(7, 5, 3);

template <class T>
VoxelValues wholeRange() {
  std::mt19937 random(1);
  std::vector<T> values(std::size_t(gridSize.x * gridSize.y * gridSize.z));
  for (T& v : values) v = T(random());
  values[0] = std::numeric_limits<T>::lowest();
  values[1] = std::numeric_limits<T>::max();
  return values;
}

VoxelValues floats() {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> range(-2e3f, 2e3f);
  std::vector<float> values(std::size_t(gridSize.x * gridSize.y * gridSize.z));
  for (float& v : values) v = range(random);
  values[0] = 1e-30f;
  values[1] = -1e30f;
  return values;
}

VolumePtr makeVolume(const glm::dmat3& steps, VoxelValues values, double slope, double intercept) {
  VolumeParts parts;
  parts.geometry.size = gridSize;
  parts.geometry.patientFromVoxelStep = steps;
  parts.geometry.origin = {-123.456789012345, 17.1, 1000.0 / 3};
  parts.values = std::move(values);
  parts.slope = slope;
  parts.intercept = intercept;
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

const char* const endings[] = {".nrrd", ".nii.gz", ".mha"};

Picture makePicture(bool transparent) {
  Picture picture;
  picture.size = {5, 3};
  picture.transparent = transparent;
  for (int n = 0; n < 4 * 5 * 3; ++n)
    picture.rgba.push_back(n % 4 == 3 ? (transparent ? 0.5f : 1.0f) : float(n) / 130);
  return picture;
}

}  // namespace

class TestFilesWrite : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void geometryComesBack_data();
  void geometryComesBack();
  void qformStaysWhereRoundingShears_data();
  void qformStaysWhereRoundingShears();
  void valuesComeBack_data();
  void valuesComeBack();
  void uncalibratedStaysSo();
  void keyValuesComeBack();
  void failuresLeaveNothing();
  void cancelledLeavesTheOldFile();
  void pngHoldsBytesAndText_data();
  void pngHoldsBytesAndText();
  void pictureFloatsComeBack_data();
  void pictureFloatsComeBack();

 private:
  QTemporaryDir folder_;
  std::string file(const std::string& name) const {
    return folder_.filePath(QString::fromStdString(name)).toStdString();
  }
  VolumePtr writtenAndRead(const Volume& volume, const std::string& name);
};

VolumePtr TestFilesWrite::writtenAndRead(const Volume& volume, const std::string& name) {
  const Status written = writeVolume(volume, file(name));
  if (!written) qWarning("%s", written.message().c_str());
  const auto found = readImageFileHeaders(file(name));
  if (!written || !found || found->size() != 1) return nullptr;
  const auto loaded = loadImageFile((*found)[0]);
  return loaded ? loaded->acquired : nullptr;
}

void TestFilesWrite::geometryComesBack_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<QString>("ending");
  const char* const names[] = {"anisotropic", "oblique", "sheared", "left-handed", "left-handed oblique"};
  for (int kind = 0; kind < 5; ++kind)
    for (const char* ending : endings)
      QTest::addRow("%s%s", names[kind], ending) << kind << QString::fromLatin1(ending);
}

void TestFilesWrite::geometryComesBack() {
  QFETCH(int, kind);
  QFETCH(QString, ending);
  const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, -0.3)), v = glm::normalize(glm::cross(u, {0, 0.1, 1})),
                   w = glm::cross(u, v);
  const glm::dmat3 steps[] = {{{0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 2.5}},
                              {u * 0.6, v * 0.61, w * 1.7},
                              {{1, 0, 0}, {0, 1, 0}, {0, 0.5, 2}},
                              {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              {u * 0.6, v * 0.61, w * -1.7}};
  const VolumePtr volume = makeVolume(steps[kind], wholeRange<std::uint8_t>(), 1, 0);
  const VolumePtr back = writtenAndRead(*volume, "geometry" + ending.toStdString());
  QVERIFY(back);
  const VoxelGeometry &a = volume->geometry(), &b = back->geometry();
  QCOMPARE(b.size, a.size);
  // NRRD keeps doubles. MetaImage splits them into length and direction (an ulp or two), and NIfTI has
  // float32.
  const double bound = ending == QStringLiteral(".nrrd")  ? 0
                       : ending == QStringLiteral(".mha") ? 1e-15
                                                          : 1e-7;
  QVERIFY(glm::length(a.origin - b.origin) <= bound * glm::length(a.origin));
  for (int n = 0; n < 3; ++n)
    QVERIFY(glm::length(a.patientFromVoxelStep[n] - b.patientFromVoxelStep[n]) <=
            bound * glm::length(a.patientFromVoxelStep[n]));
}

void TestFilesWrite::qformStaysWhereRoundingShears_data() {
  QTest::addColumn<double>("shear");
  QTest::addColumn<bool>("kept");
  QTest::newRow("none") << 0.0 << true;
  QTest::newRow("decimals of a file") << 1e-5 << true;
  QTest::newRow("a tilt of 0.06 degrees") << 1e-3 << false;
}

// sform and qform are both written. Readers that use the qform see the same geometry to 1/10,000.
void TestFilesWrite::qformStaysWhereRoundingShears() {
  QFETCH(double, shear);
  QFETCH(bool, kept);
  VoxelGeometry g;
  g.patientFromVoxelStep = glm::dmat3({1, 0, 0}, {shear, 1, 0}, {0, shear, 2});
  const Result<std::string> header = niftiHeader(g, SampleType::uint8, 1, 0);
  QVERIFY(header);
  std::int16_t qform = 0, sform = 0;
  std::memcpy(&qform, header->data() + 252, 2);
  std::memcpy(&sform, header->data() + 254, 2);
  QCOMPARE(qform > 0, kept);
  QVERIFY(sform > 0);
  float x = 0;
  std::memcpy(&x, header->data() + 280 + 4, 4);
  QCOMPARE(x, float(-shear));
}

void TestFilesWrite::valuesComeBack_data() {
  QTest::addColumn<int>("type");
  QTest::addColumn<double>("slope");
  QTest::addColumn<double>("intercept");
  QTest::addColumn<QString>("ending");
  const char* const names[] = {"uint8", "int16", "uint16", "float32"};
  const std::pair<double, double> rescales[] = {{1, 0},    {1, -1024}, {1, 0.5},
                                                {0.1, -3}, {-2, 100},  {0.25, 0.5}};
  for (int type = 0; type < 4; ++type)
    for (const auto& [slope, intercept] : rescales)
      for (const char* ending : endings)
        if (type < 3 || slope == 1)
          QTest::addRow("%s * %g + %g %s", names[type], slope, intercept, ending)
              << type << slope << intercept << QString::fromLatin1(ending);
}

void TestFilesWrite::valuesComeBack() {
  QFETCH(int, type);
  QFETCH(double, slope);
  QFETCH(double, intercept);
  QFETCH(QString, ending);
  VoxelValues values[] = {wholeRange<std::uint8_t>(), wholeRange<std::int16_t>(), wholeRange<std::uint16_t>(),
                          floats()};
  const VolumePtr volume = makeVolume(glm::dmat3(1), values[type], slope, intercept);
  const VolumePtr back = writtenAndRead(*volume, "values" + ending.toStdString());
  QVERIFY(back);
  for (std::size_t n = 0; n < std::size_t(volume->geometry().voxelCount()); ++n)
    QCOMPARE(back->valueAt(n), volume->valueAt(n));
  const bool plain = slope == 1 && intercept == 0;
  const bool keptByNifti = ending == QStringLiteral(".nii.gz") && slope != 0.1;
  if (plain || (type < 3 && keptByNifti)) QCOMPARE(back->typeName(), volume->typeName());
}

void TestFilesWrite::uncalibratedStaysSo() {
  VolumeParts parts;
  parts.geometry.size = gridSize;
  parts.geometry.calibrated = false;
  parts.values = wholeRange<std::uint8_t>();
  std::vector<std::string> warnings;
  const VolumePtr volume = *Volume::make(std::move(parts), warnings);
  for (const char* ending : {".nrrd", ".mha"}) {
    const VolumePtr back = writtenAndRead(*volume, std::string("uncalibrated") + ending);
    QVERIFY(back);
    QCOMPARE(back->geometry(), volume->geometry());
  }
}

void TestFilesWrite::keyValuesComeBack() {
  const VolumePtr volume = makeVolume(glm::dmat3(1), wholeRange<std::uint8_t>(), 1, 0);
  const std::string value = "bone: \"cortical\" := C:\\new\nsecond line";
  QVERIFY(writeNrrd(*volume, file("segments.seg.nrrd"), {{"Segment0_Name", value}}).ok());
  const auto header = readNrrdFields(file("segments.seg.nrrd"));
  QVERIFY(header.ok());
  QCOMPARE(header->keyValues.at("Segment0_Name"), value);
  QVERIFY(readImageFileHeaders(file("segments.seg.nrrd")).ok());
}

void TestFilesWrite::failuresLeaveNothing() {
  const VolumePtr volume = makeVolume(glm::dmat3(1), wholeRange<std::uint8_t>(), 1, 0);
  const QTemporaryDir empty;
  const std::string inside = empty.path().toStdString();
  for (const std::string& path : {inside + "/none/v.nrrd", inside + "/v.dat", inside + "/none/v.mha"}) {
    const Status status = writeVolume(*volume, path);
    QVERIFY(!status.ok());
    QVERIFY2(status.message().find(path) != std::string::npos, status.message().c_str());
  }
  QVERIFY(QDir(empty.path()).isEmpty());
}

void TestFilesWrite::cancelledLeavesTheOldFile() {
  const VolumePtr volume = makeVolume(glm::dmat3(1), wholeRange<std::uint8_t>(), 1, 0);
  const QTemporaryDir own;
  const std::string path = own.filePath(QStringLiteral("v.nrrd")).toStdString();
  QVERIFY(writeVolume(*volume, path).ok());
  const VolumePtr other = makeVolume(glm::dmat3(2), wholeRange<std::int16_t>(), 1, 0);
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(!writeVolume(*other, path, {}, cancel).ok());
  const auto found = readImageFileHeaders(path);
  QVERIFY(found.ok());
  QCOMPARE((*found)[0].valueType, std::string("uint8"));
  QCOMPARE(QDir(own.path()).entryList(QDir::Files | QDir::Hidden).size(), 1);
}

void TestFilesWrite::pngHoldsBytesAndText_data() {
  QTest::addColumn<bool>("transparent");
  QTest::newRow("opaque") << false;
  QTest::newRow("transparent") << true;
}

void TestFilesWrite::pngHoldsBytesAndText() {
  QFETCH(bool, transparent);
  const Picture picture = makePicture(transparent);
  QVERIFY(writePng(picture, file("p.png"), {{"scene", "{\"µ\": 1}"}, {"level", "standard"}}).ok());
  const QImage image(QString::fromStdString(file("p.png")));
  QCOMPARE(image.size(), QSize(5, 3));
  QCOMPARE(image.hasAlphaChannel(), transparent);
  QCOMPARE(image.text(QStringLiteral("scene")), QStringLiteral("{\"µ\": 1}"));
  QCOMPARE(image.text(QStringLiteral("level")), QStringLiteral("standard"));
  const std::vector<std::uint8_t> bytes = toBytes(picture);
  const int channels = transparent ? 4 : 3;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      const std::uint8_t* p = &bytes[std::size_t(channels * (5 * y + x))];
      QCOMPARE(image.pixelColor(x, y), QColor(p[0], p[1], p[2], transparent ? p[3] : 255));
    }
}

void TestFilesWrite::pictureFloatsComeBack_data() { pngHoldsBytesAndText_data(); }

void TestFilesWrite::pictureFloatsComeBack() {
  QFETCH(bool, transparent);
  const Picture picture = makePicture(transparent);
  QVERIFY(writePictureNrrd(picture, file("p.nrrd")).ok());
  const Result<Picture> back = readPictureNrrd(file("p.nrrd"));
  QVERIFY(back.ok());
  QVERIFY(*back == picture);
  // The file is not a volume.
  const auto asVolume = readImageFileHeaders(file("p.nrrd"));
  QVERIFY(!asVolume.ok());
  QVERIFY(asVolume.message().find("colour image") != std::string::npos);
}

VOLUMEN_TEST(TestFilesWrite);
#include "tst_files_write.moc"
