// Guards slices.md 2: values and colours of every picture of the real test data equal those of DCMTK's own
// reader. DCMTK has its own parser, rescale, palettes and colour conversion. Colours also equal those of the
// manifest's readers.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmimage/diregist.h>
#include <dcmtk/dcmimgle/dcmimage.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <zlib.h>

#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFramePixels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void pixelsAreThoseOfDcmtk_data();
  void pixelsAreThoseOfDcmtk();
  void coloursAreThoseOfTheManifest_data();
  void coloursAreThoseOfTheManifest();
  void mostPicturesWereCompared();

 private:
  int compared_ = 0;
};

namespace {

/// A file as read by DCMTK.
struct Peer {
  DcmFileFormat file;
  std::unique_ptr<DicomImage> image;  ///< null if DCMTK cannot decode it
  bool hasLut = false;
};

/// Returns a number of frame `n`, from its functional groups if it has them.
double numberOf(DcmDataset& data, std::size_t n, const DcmTagKey& tag, double ifAbsent) {
  double found = 0;
  DcmItem* groups = nullptr;
  const bool hasGroups =
      data.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, groups, long(n)).good();
  if (hasGroups && groups->findAndGetFloat64(tag, found, 0, OFTrue).good()) return found;
  return data.findAndGetFloat64(tag, found, 0, OFTrue).good() ? found : ifAbsent;
}

std::unique_ptr<Peer> peerOf(const std::string& path) {
  auto peer = std::make_unique<Peer>();
  if (peer->file.loadFile(path.c_str()).bad()) return peer;
  DcmDataset& data = *peer->file.getDataset();
  if (!data.tagExists(DCM_PixelData)) return peer;
  peer->hasLut = data.tagExists(DCM_ModalityLUTSequence);
  const unsigned long flags = peer->hasLut ? 0 : CIF_IgnoreModalityTransformation;
  if (data.chooseRepresentation(EXS_LittleEndianExplicit, nullptr).bad()) return peer;
  peer->image = std::make_unique<DicomImage>(&data, EXS_LittleEndianExplicit, flags);
  if (peer->image->getStatus() != EIS_Normal) peer->image.reset();
  return peer;
}

template <class T>
std::vector<double> asDoubles(const void* data, std::size_t first, std::size_t count) {
  const T* values = static_cast<const T*>(data) + first;
  return {values, values + count};
}

/// Returns the values of frame `n` of a grey picture.
std::vector<double> valuesOf(Peer& peer, std::size_t n) {
  DcmDataset& data = *peer.file.getDataset();
  const std::size_t count = peer.image->getWidth() * peer.image->getHeight();
  const DiPixel* pixels = peer.image->getInterData();
  std::vector<double> values;
  switch (pixels->getRepresentation()) {
    case EPR_Uint8:
      values = asDoubles<Uint8>(pixels->getData(), n * count, count);
      break;
    case EPR_Sint8:
      values = asDoubles<Sint8>(pixels->getData(), n * count, count);
      break;
    case EPR_Uint16:
      values = asDoubles<Uint16>(pixels->getData(), n * count, count);
      break;
    case EPR_Sint16:
      values = asDoubles<Sint16>(pixels->getData(), n * count, count);
      break;
    case EPR_Uint32:
      values = asDoubles<Uint32>(pixels->getData(), n * count, count);
      break;
    case EPR_Sint32:
      values = asDoubles<Sint32>(pixels->getData(), n * count, count);
      break;
  }
  if (peer.hasLut) return values;
  const double slope = numberOf(data, n, DCM_DoseGridScaling, numberOf(data, n, DCM_RescaleSlope, 1));
  const double intercept = numberOf(data, n, DCM_RescaleIntercept, 0);
  for (double& v : values) v = double(float(slope * v + intercept));
  return values;
}

/// Returns the largest difference; infinite if the sizes differ.
template <class A, class B>
double largestDifference(const std::vector<A>& a, const B* b, std::size_t count) {
  if (a.size() != count) return HUGE_VAL;
  double largest = 0;
  for (std::size_t n = 0; n < count; ++n) largest = std::max(largest, std::abs(double(a[n]) - double(b[n])));
  return largest;
}

}  // namespace

void TestFramePixels::initTestCase() {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  DJDecoderRegistration::registerCodecs();
  DJLSDecoderRegistration::registerCodecs();
  DcmRLEDecoderRegistration::registerCodecs();
}

// The slices of a mosaic are its tiles, row by row.
void compareTiles(Peer& peer, const std::function<Result<Frame>(int)>& tile) {
  const std::vector<double> whole = valuesOf(peer, 0);
  const std::size_t width = peer.image->getWidth();
  for (const int n : {0, 1, 7}) {
    const Result<Frame> frame = tile(n);
    QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
    const std::size_t columns = std::size_t(frame->size.x), rows = std::size_t(frame->size.y),
                      across = width / columns;
    QVERIFY(across > 1 && width % columns == 0);
    const std::size_t left = std::size_t(n) % across * columns, top = std::size_t(n) / across * rows;
    for (std::size_t y = 0; y < rows; ++y)
      for (std::size_t x = 0; x < columns; ++x)
        if (frame->values[y * columns + x] != whole[(top + y) * width + left + x])
          QFAIL(qPrintable(QStringLiteral("tile %1, pixel %2, %3").arg(n).arg(x).arg(y)));
  }
}

void TestFramePixels::pixelsAreThoseOfDcmtk_data() {
  QTest::addColumn<QString>("path");
  // DCMTK shows these 32-bit samples wrongly. The manifest's values cover them.
  static const QRegularExpression wrong(QStringLiteral("rtdose_(rle|expb)"));
  const QString root = QString::fromStdString(dataPath());
  for (const char* folder : {"dicom-2d", "dicom-pydicom", "dicom-ts-cornerstone", "dicom-geometry", "pet-ct"})
    for (QDirIterator it(root + QLatin1Char('/') + QLatin1String(folder), QDir::Files,
                         QDirIterator::Subdirectories);
         !root.isEmpty() && it.hasNext();) {
      const QString path = it.next();
      if (!path.contains(wrong)) QTest::newRow(qPrintable(path.mid(root.size() + 1))) << path;
    }
  if (root.isEmpty()) QTest::newRow("no data") << QString();
}

void TestFramePixels::pixelsAreThoseOfDcmtk() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  const Result<Study> study = openStudy(path.toStdString());
  QVERIFY(study.ok());
  if (study->images.empty() && study->volumes.empty()) return;
  const auto frameInFile = [&](int n) -> Result<Frame> {
    if (!study->images.empty()) return loadFrame(study->images[0], n);
    for (const Series& series : study->volumes) {  // their frames are in slice order
      const auto at = std::find(series.frames.begin(), series.frames.end(), n);
      if (at != series.frames.end()) return loadFrame(series, int(at - series.frames.begin()));
    }
    return Error{"no such frame"};
  };
  const Result<Frame> first = frameInFile(0);
  const auto peer = peerOf(path.toStdString());
  if (!peer->image) return;
  QVERIFY2(first.ok(), first.ok() ? "" : first.message().c_str());
  static const QRegularExpression mosaic(QStringLiteral("mosaic|mr-12bit/"));
  if (path.contains(mosaic)) return compareTiles(*peer, frameInFile);
  const std::size_t pixels = first->values.size() + first->rgb.size() / 3;
  QCOMPARE(pixels, std::size_t(peer->image->getWidth() * peer->image->getHeight()));
  const int last = int(peer->image->getFrameCount()) - 1;
  for (const int n : std::set{0, last}) {
    const Result<Frame> frame = n == 0 ? first : frameInFile(n);
    QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
    QCOMPARE(frame->colour(), !peer->image->isMonochrome());
    double off = 0, allowed = 0;
    if (frame->colour()) {
      const void* rgb = peer->image->getOutputData(8, (unsigned long)n, 0);
      QVERIFY(rgb);
      // DCMTK converts luminance and colour differences to RGB in fixed point, volumen in double.
      allowed = study->images[0].photometric.starts_with("YBR_FULL") ? 2 : 0;
      off = largestDifference(frame->rgb, static_cast<const Uint8*>(rgb), 3 * pixels);
    } else {
      const std::vector<double> values = valuesOf(*peer, std::size_t(n));
      off = largestDifference(frame->values.floats(), values.data(), values.size());
    }
    QVERIFY2(off <= allowed, qPrintable(QString::number(off)));
    ++compared_;
  }
}

void TestFramePixels::coloursAreThoseOfTheManifest_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("crc");
  QFile file(QString::fromStdString(dataPath("MANIFEST.tsv")));
  if (dataPath().empty() || !file.open(QIODevice::ReadOnly)) {
    QTest::newRow("no data") << QString() << QString();
    return;
  }
  const QStringList names = QString::fromUtf8(file.readLine()).trimmed().split(u'\t');
  const auto column = [&](const char* name) { return names.indexOf(QLatin1String(name)); };
  while (!file.atEnd()) {
    const QStringList cells = QString::fromUtf8(file.readLine()).remove(u'\n').split(u'\t');
    if (cells.value(column("hash_type")) != QLatin1String("u1-interleaved-RGB")) continue;
    if (cells.value(column("lossy")) != QLatin1String("no")) continue;
    // This row took the padding of 27 bytes in big endian words for the last pixel's byte.
    if (cells.value(column("id")).contains(QLatin1String("small_odd_big_endian"))) continue;
    QTest::newRow(qPrintable(cells.value(column("id"))))
        << cells.value(column("path")) << cells.value(column("crc32_stored"));
  }
}

void TestFramePixels::coloursAreThoseOfTheManifest() {
  NEED_DATA(dataPath());
  QFETCH(QString, path);
  QFETCH(QString, crc);
  const std::string file = dataPath(path.toStdString());
  const Result<Study> study = openStudy(file);
  QVERIFY(study.ok() && study->images.size() == 1);
  uLong sum = crc32(0, nullptr, 0);
  for (int n = 0; n < study->images[0].frames; ++n) {
    const Result<Frame> frame = loadFrame(study->images[0], n);
    QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
    sum = crc32(sum, frame->rgb.data(), uInt(frame->rgb.size()));
  }
  QCOMPARE(QString::number(sum, 16).rightJustified(8, u'0'), crc);
}

void TestFramePixels::mostPicturesWereCompared() {
  NEED_DATA(dataPath());
  // 494 pictures were compared when this bound was set. DCMTK reads no JPEG 2000, and some files hold no
  // picture.
  QVERIFY2(compared_ > 450, qPrintable(QString::number(compared_)));
}

VOLUMEN_TEST(TestFramePixels);
#include "tst_frame_pixels.moc"
