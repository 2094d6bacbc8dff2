// Guards PS3.15 E on every DICOM file of the real data: attributes, bytes, references, pixels and the checks
// of dciodvfy. DCMTK reads the files.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <QDirIterator>
#include <QJsonArray>
#include <QJsonDocument>
#include <QRegularExpression>
#include <map>
#include <set>

#include "io/deidentify/profile.h"
#include "tests/fixtures/dciodvfy.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/deidentify/exported.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDeidentifiedData : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void noAttributeStaysThatTheTableRemoves();
  void noOriginalIsInTheBytes();
  void referencesAndPixelsAreTheSame();
  void noClassLacksMoreThanBefore();

 private:
  struct Pair {
    QString source, copy;
  };
  Exported exported_;
  std::vector<Pair> pairs_;
};

namespace {

// Returns true for values that are so long that other values do not contain them by chance.
bool isTelling(const std::string& value) {
  return value.size() >= 6 && value.find_first_not_of("0. -") != std::string::npos;
}

// Returns true for values that copies may hold whatever their sources hold.
bool isOurs(const std::string& value) {
  return value.starts_with("1.2.840.10008.") || value == "DEIDENTIFIED" || value == "REMOVED" ||
         value == "19000101";
}

std::uint32_t tagOf(const DcmElement& e) { return std::uint32_t(e.getGTag()) << 16 | e.getETag(); }

std::set<std::string> valuesOf(DcmElement& e) {
  OFString all;
  std::set<std::string> values;
  if (e.isLeaf() && e.getLength() < 10000 && e.getOFStringArray(all).good())
    for (const QByteArray& value : QByteArray(all.c_str(), qsizetype(all.size())).split('\\'))
      values.insert(value.trimmed().toStdString());
  return values;
}

// Returns the fragments of compressed pixels, each from its first scan or tile on. Comments stand before
// that.
QByteArrayList scansOf(DcmPixelSequence& fragments) {
  QByteArrayList scans;
  for (unsigned long n = 1; n < fragments.card(); ++n) {
    DcmPixelItem* item = nullptr;
    Uint8* bytes = nullptr;
    if (fragments.getItem(item, n).bad() || item->getUint8Array(bytes).bad() || !bytes) continue;
    const QByteArray all(reinterpret_cast<const char*>(bytes), qsizetype(item->getLength()));
    const bool isJpeg = all.startsWith("\xff\xd8"), isJpeg2000 = all.startsWith("\xff\x4f");
    const qsizetype scan = isJpeg ? all.indexOf("\xff\xda") : isJpeg2000 ? all.indexOf("\xff\x90") : 0;
    scans << QByteArray::number(all.size()) << all.mid(std::max(qsizetype(0), scan));
  }
  return scans;
}

// Returns native pixels without the unused bits and the bytes behind the last pixel.
QByteArray valuesOfPixels(DcmDataset& data, DcmPixelData& pixels) {
  const auto number = [&](const DcmTagKey& tag) {
    Uint16 value = 0;
    data.findAndGetUint16(tag, value);
    return std::uint32_t(value);
  };
  Sint32 frames = 1;
  data.findAndGetSint32(DCM_NumberOfFrames, frames);
  const std::uint32_t allocated = number(DCM_BitsAllocated), stored = number(DCM_BitsStored);
  const std::uint64_t bits = std::uint64_t(std::max(frames, 1)) * number(DCM_Rows) * number(DCM_Columns) *
                             number(DCM_SamplesPerPixel) * allocated;
  QByteArray values;
  Uint8* bytes = nullptr;
  Uint16* words = nullptr;
  if (pixels.getUint16Array(words).good() && words) {
    values = QByteArray(reinterpret_cast<const char*>(words), qsizetype(pixels.getLength()));
    const std::uint32_t highBit = number(DCM_HighBit);
    const bool hasUnused = allocated == 16 && stored > 0 && stored < 16 && highBit + 1 >= stored;
    const std::uint32_t used = hasUnused ? ((1u << stored) - 1) << (highBit + 1 - stored) : 0xffff;
    for (qsizetype n = 0; n + 1 < values.size(); n += 2)
      values[n] = char(values[n] & used), values[n + 1] = char(values[n + 1] & used >> 8);
  } else if (pixels.getUint8Array(bytes).good() && bytes) {
    values = QByteArray(reinterpret_cast<const char*>(bytes), qsizetype(pixels.getLength()));
  }
  return values.left(qsizetype(bits / 8));
}

// Returns the pixels of a data set without what is cleared beside them.
QByteArrayList pixelsAlone(DcmDataset& data) {
  DcmElement* element = nullptr;
  if (data.findAndGetElement(DCM_PixelData, element).bad()) return {};
  auto* const pixels = dynamic_cast<DcmPixelData*>(element);
  if (!pixels) return {};
  E_TransferSyntax syntax = EXS_Unknown;
  const DcmRepresentationParameter* parameter = nullptr;
  DcmPixelSequence* fragments = nullptr;
  pixels->getOriginalRepresentationKey(syntax, parameter);
  if (pixels->getEncapsulatedRepresentation(syntax, parameter, fragments).good() && fragments)
    return scansOf(*fragments);
  return {valuesOfPixels(data, *pixels)};
}

bool isText(DcmElement& e) {
  switch (e.ident()) {
    case EVR_PN:
    case EVR_LO:
    case EVR_SH:
    case EVR_LT:
    case EVR_ST:
    case EVR_UT:
    case EVR_UC:
    case EVR_DA:
    case EVR_DT:
    case EVR_UI:
    case EVR_AE:
      return true;
    default:
      return false;
  }
}

}  // namespace

void TestDeidentifiedData::initTestCase() {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  const std::string data = dataPath();
  NEED_DATA(data);
  const Outcome outcome = exported_.run(QString::fromStdString(data), {QStringLiteral("--json")});
  QCOMPARE(outcome.status, 3);  // some of the data are damaged on purpose
  const QJsonDocument report = QJsonDocument::fromJson(outcome.out);
  QVERIFY2(report[QStringLiteral("written")].toInt() > 1200, outcome.out.left(2000).constData());
  QVERIFY(report[QStringLiteral("leftOut")].toArray().size() < 120);
  std::map<std::string, QString> copies;
  for (const QString& copy : copiesIn(exported_.folder())) {
    const auto file = readWithDcmtk(copy);
    QVERIFY2(file, qPrintable(copy));
    copies[textOf(*file->getDataset(), DCM_SOPInstanceUID)] = copy;
  }
  // If several files have one UID, their order decides which is copied.
  std::multimap<std::string, QString> sources;
  for (QDirIterator all(QString::fromStdString(data), QDir::Files, QDirIterator::Subdirectories);
       all.hasNext();) {
    const QString source = all.next();
    if (const auto file = readWithDcmtk(source))
      sources.emplace(exported_.uid(textOf(*file->getDataset(), DCM_SOPInstanceUID)), source);
  }
  for (const auto& [uid, source] : sources)
    if (sources.count(uid) == 1 && copies.contains(uid)) pairs_.push_back({source, copies[uid]});
  QVERIFY(pairs_.size() > 1200);
}

void TestDeidentifiedData::noAttributeStaysThatTheTableRemoves() {
  const ConfidentialityProfile profile({});
  for (const Pair& pair : pairs_) {
    const auto file = readWithDcmtk(pair.copy);
    QStringList stays;
    forAllElements(*file->getDataset(), [&](DcmElement& e) {
      const std::uint32_t tag = tagOf(e);
      if (e.getGTag() % 2 == 1 || profile.actionOf(tag, false) == ProfileAction::remove)
        stays << QString::fromLatin1(DcmTag(e.getTag()).getTagName());
    });
    QVERIFY2(stays.isEmpty(),
             qPrintable(pair.source + QStringLiteral(": ") + stays.join(QStringLiteral(", "))));
  }
}

// A copy may still contain a value that another attribute has and keeps.
void TestDeidentifiedData::noOriginalIsInTheBytes() {
  const ConfidentialityProfile profile({});
  for (const Pair& pair : pairs_) {
    const auto file = readWithDcmtk(pair.source);
    std::set<std::string> removed, kept;
    forAllElements(*file->getDataset(), [&](DcmElement& e) {
      const bool isKept = e.getGTag() % 2 == 0 && profile.actionOf(tagOf(e), false) == ProfileAction::keep;
      if (!isKept && !isText(e)) return;
      (isKept ? kept : removed).merge(valuesOf(e));
    });
    const auto copy = readWithDcmtk(pair.copy);
    copy->getDataset()->findAndDeleteElement(DCM_PixelData);
    std::string left;
    forAllElements(*copy->getDataset(), [&](DcmElement& e) {
      for (const std::string& value : valuesOf(e)) left += value + "\n";
    });
    for (const std::string& value : removed) {
      const bool isInKept =
          std::ranges::any_of(kept, [&](const std::string& k) { return k.find(value) != std::string::npos; });
      if (!isTelling(value) || isInKept || isOurs(value)) continue;
      QVERIFY2(left.find(value) == std::string::npos, (pair.source.toStdString() + ": " + value).c_str());
    }
  }
}

void TestDeidentifiedData::referencesAndPixelsAreTheSame() {
  for (const Pair& pair : pairs_) {
    const auto before = readWithDcmtk(pair.source), after = readWithDcmtk(pair.copy);
    QVERIFY2(pixelsAlone(*before->getDataset()) == pixelsAlone(*after->getDataset()),
             qPrintable(pair.source));
    std::set<std::string> known;
    forAllElements(*before->getDataset(), [&](DcmElement& e) {
      if (e.ident() == EVR_UI || e.ident() == EVR_UN)
        for (const std::string& uid : valuesOf(e)) known.insert(uid), known.insert(exported_.uid(uid));
    });
    forAllElements(*after->getDataset(), [&](DcmElement& e) {
      if (e.ident() != EVR_UI) return;
      for (const std::string& uid : valuesOf(e)) QVERIFY2(known.contains(uid), qPrintable(pair.source));
    });
  }
}

void TestDeidentifiedData::noClassLacksMoreThanBefore() {
  NEED_DCIODVFY();
  // Removes the values from errors, as they differ between source and copy.
  const auto errorsOf = [](const QString& path) {
    static const QRegularExpression values(QStringLiteral("<[^>]*>|[0-9]+(\\.[0-9]+){2,}"));
    std::multiset<QString> errors;
    for (QString error : dciodvfyErrors(path)) errors.insert(error.remove(values));
    return errors;
  };
  std::set<std::string> series;
  QStringList more;
  for (const Pair& pair : pairs_) {
    const auto file = readWithDcmtk(pair.source);
    if (!series.insert(textOf(*file->getDataset(), DCM_SeriesInstanceUID)).second) continue;
    const std::multiset<QString> before = errorsOf(pair.source);
    const bool couldNotBeRead = std::ranges::any_of(
        before, [](const QString& e) { return e.contains(QLatin1String("read failed")); });
    if (couldNotBeRead) continue;
    for (const QString& error : errorsOf(pair.copy))
      if (!before.contains(error)) more << pair.source + QStringLiteral(": ") + error;
  }
  QVERIFY2(more.isEmpty(), qPrintable(more.join(QLatin1Char('\n'))));
}

VOLUMEN_TEST(TestDeidentifiedData);
#include "tst_deidentified_data.moc"
