// Guards import.md, "Safety", for what `volumen export` writes: with bytes or values changed, cut off or
// repeated, it is read or refused with a sentence, in this process, in bounded time. Cases are random from a
// seed: VOLUMEN_RANDOM_CASES=10000 VOLUMEN_RANDOM_SEED=7.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <algorithm>
#include <limits>
#include <map>

#include "io/export/read_segments.h"
#include "io/load.h"
#include "io/paths/open_path.h"
#include "tests/fixtures/cpu_timer.h"
#include "tests/fixtures/mutated.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/io/read_derived.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestMutatedExports : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void theyAreReadOrRefused_data();
  void theyAreReadOrRefused();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  // Exports, and returns the file, of a series the first; empty if that failed.
  QString written(const QString& options) const;
  // Writes a file with values, bytes or both changed.
  bool writeMutant(const QString& file, const QString& to, Chance& chance) const;
  // Reads a file by every door that leads to it. Returns what is wrong; empty if nothing is.
  QString faultOf(const std::string& path) const;

  QTemporaryDir folder_;
  Series source_;
  VoxelGeometry grid_;
  QByteArray uidsOfSource_;
};

namespace {

// Options of export; words in capitals stand for files of the test.
constexpr std::pair<const char*, const char*> writtenAs[] = {
    {"report", "sr --roi SHAPES --segments SEG"},
    {"key images", "ko --images IMAGE"},
    {"presentation", "gsps --roi SHAPES --window 40,400"},
    {"segmentation", "seg --segments SEG"},
    {"structure set", "rtstruct --segments SEG"},
    {"turn, compressed", "sc --size 24x24 --quality draft --turntable 3 --rle"},
    {"document", "pdf --pdf DOCUMENT --title Findings"},
    {"slice", "series --plane coronal --at 0"},
    {"slice in colour", "series --plane coronal --at 0 --overlay SCAN"}};

// Calls `visit` with all elements of an item that hold no others, but for pixels.
template <class Visit>
void forEachLeaf(DcmItem& item, const Visit& visit) {
  constexpr Uint16 pixelGroup = 0x7fe0, fragmentGroup = 0xfffe;
  DcmStack stack;
  while (item.nextObject(stack, OFTrue).good())
    if (auto* element = dynamic_cast<DcmElement*>(stack.top()); element && element->isLeaf() &&
                                                                element->getGTag() != pixelGroup &&
                                                                element->getGTag() != fragmentGroup)
      visit(*element);
}

// Gives new UIDs other names, so that a seed makes the same file in every run.
void renameUids(DcmDataset& data, const QByteArray& ofSource) {
  std::map<std::string, std::string> names;
  forEachLeaf(data, [&](DcmElement& element) {
    OFString uid;
    if (element.ident() != EVR_UI || element.getOFString(uid, 0).bad() || uid.compare(0, 5, "2.25.") != 0)
      return;
    if (ofSource.contains(uid.c_str())) return;
    const auto name = names.emplace(uid.c_str(), "2.25." + std::to_string(1000 + names.size())).first;
    element.putString(name->second.c_str());
  });
}

// Changes a value: nothing, words, numbers out of any range, many of them, or none at all.
void changeValue(DcmElement& element, Chance& chance) {
  static const char* const texts[] = {
      "",       "0",        "-1",  "1e999",    "nan",    "4294967296", "-2147483649",
      "\\\\\\", "1.2.3\\4", "\\0", "CONTAINS", "\x1b$B", "\xff",       "0.0000001\\1\\2\\3\\4\\5\\6\\7\\8"};
  constexpr double numbers[] = {
      0, -1, 65535, 1e30, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  const double number = numbers[chance.below(std::size(numbers))];
  const auto limited = std::clamp(std::isnan(number) ? 7 : number, -1.0, 65535.0);
  const int count = chance.oneIn(2) ? 1 : chance.below(40);
  switch (element.ident()) {
    case EVR_US:
    case EVR_OW:
      element.putUint16Array(std::vector<Uint16>(std::size_t(count), Uint16(limited)).data(),
                             std::uint32_t(count));
      return;
    case EVR_UL:
      element.putUint32Array(std::vector<Uint32>(std::size_t(count), Uint32(limited * 65537)).data(),
                             std::uint32_t(count));
      return;
    case EVR_FL:
      element.putFloat32Array(std::vector<Float32>(std::size_t(count), float(number)).data(),
                              std::uint32_t(count));
      return;
    case EVR_FD:
      element.putFloat64Array(std::vector<Float64>(std::size_t(count), number).data(), std::uint32_t(count));
      return;
    default:
      element.putString(texts[chance.below(std::size(texts))]);
  }
}

// Removes or repeats items of a sequence, or the sequence itself.
void changeItems(DcmItem& data, Chance& chance) {
  std::vector<DcmSequenceOfItems*> all;
  DcmStack stack;
  while (data.nextObject(stack, OFTrue).good())
    if (auto* sequence = dynamic_cast<DcmSequenceOfItems*>(stack.top());
        sequence && sequence->ident() == EVR_SQ)
      all.push_back(sequence);
  if (all.empty()) return;
  DcmSequenceOfItems& sequence = *all[std::size_t(chance.below(int(all.size())))];
  if (sequence.card() == 0) return;
  const auto n = static_cast<unsigned long>(chance.below(int(sequence.card())));
  if (chance.oneIn(3))
    sequence.clear();
  else if (chance.oneIn(2))
    delete sequence.remove(n);
  else
    for (int more = 1 + chance.below(30); more > 0; --more)
      sequence.append(new DcmItem(*sequence.getItem(n)));
}

void changeValues(DcmDataset& data, Chance& chance) {
  for (int changes = 1 + chance.below(4); changes > 0; --changes) {
    if (chance.oneIn(4)) {
      changeItems(data, chance);
      continue;
    }
    std::vector<DcmElement*> all;
    forEachLeaf(data, [&](DcmElement& element) { all.push_back(&element); });
    DcmElement& element = *all[std::size_t(chance.below(int(all.size())))];
    auto* parent = dynamic_cast<DcmItem*>(element.getParent());
    if (chance.oneIn(3) && parent)
      parent->findAndDeleteElement(element.getTag());
    else
      changeValue(element, chance);
  }
}

}  // namespace

void TestMutatedExports::initTestCase() {
  const QString scan = at(QStringLiteral("SCAN")), segments = at(QStringLiteral("SEG"));
  for (const QString& command :
       {QStringLiteral("convert phantom:ct-head:12 -o %1/").arg(scan),
        QStringLiteral("segment %1 --range 200:3000 -o %2.dcm").arg(scan, segments)}) {
    const Outcome done = runProgram(command);
    QVERIFY2(done.status == 0, done.err);
  }
  QVERIFY(QFile::rename(segments + QStringLiteral(".dcm"), segments));
  const Result<Study> study = openStudy(scan.toStdString());
  QVERIFY(study && study->volumes.size() == 1);
  source_ = study->volumes[0];
  grid_ = source_.acquired;
  for (const QString& slice : storedFilesIn(scan)) uidsOfSource_ += contentsOf(slice).left(2000);
  const glm::dvec3 from = grid_.patientFromVoxel({2, 3, 5}), to = grid_.patientFromVoxel({7, 8, 5}),
                   deep = grid_.patientFromVoxel({4, 4, 9});
  const auto point = [](glm::dvec3 p) { return QStringLiteral("[%1,%2,%3]").arg(p.x).arg(p.y).arg(p.z); };
  QFile shapes(at(QStringLiteral("SHAPES"))), document(at(QStringLiteral("DOCUMENT")));
  QVERIFY(shapes.open(QIODevice::WriteOnly) && document.open(QIODevice::WriteOnly));
  shapes.write(QStringLiteral(R"([{"kind": "length", "name": "flat", "points": [%1, %2]},
      {"kind": "length", "name": "deep", "points": [%1, %3]}])")
                   .arg(point(from), point(to), point(deep))
                   .toUtf8());
  document.write("%PDF-1.4\nof a report\n%%EOF\n");
}

void TestMutatedExports::theyAreReadOrRefused_data() {
  QTest::addColumn<QString>("options");
  for (const auto& [what, options] : writtenAs) QTest::newRow(what) << QString::fromLatin1(options);
}

QString TestMutatedExports::faultOf(const std::string& path) const {
  constexpr int mostPixels = 1 << 22, framesRead = 4;
  if (!survives(path)) return QStringLiteral("is neither read nor refused with a sentence");
  const Result<Study> study = openPath(path);
  if (!study) return QStringLiteral("is not opened");
  for (const Image& image : study->images) {
    if (std::int64_t(image.rows) * image.columns > mostPixels) continue;
    for (int frame = 0; frame < std::min(image.frames, framesRead); ++frame)
      if (const auto read = loadFrame(image, frame); !isReadOrRefused(read, path))
        return QString::fromStdString(read.message());
  }
  for (const Series& series : study->volumes)
    if (series.acquired.voxelCount() <= mostPixels)
      if (const auto read = loadSeries(series);
          !read && !QString::fromStdString(read.message()).endsWith(u'.'))
        return QString::fromStdString(read.message());
  const auto segments = readSegments(path, source_, grid_);
  return segments || segments.message().ends_with(".") ? QString()
                                                       : QString::fromStdString(segments.message());
}

QString TestMutatedExports::written(const QString& options) const {
  const QString out = at(QLatin1String(QTest::currentDataTag()) + QStringLiteral(".dcm"));
  QStringList words{QStringLiteral("export"), at(QStringLiteral("SCAN")), QStringLiteral("-o"), out,
                    QStringLiteral("--as")};
  for (const QString& word : options.split(QLatin1Char(' ')))
    words << (word == QLatin1String("IMAGE") ? QString::fromStdString(source_.sopInstanceUids[5])
              : word.front().isUpper()       ? at(word)
                                             : word);
  const Outcome done = runProgram(words);
  if (done.status != 0) qWarning("%s", done.err.constData());
  return QFileInfo(out).isFile() ? out : storedFilesIn(out).value(0);
}

bool TestMutatedExports::writeMutant(const QString& file, const QString& to, Chance& chance) const {
  StoredFile mutant(file);
  DcmDataset& data = *mutant.file.getDataset();
  if (mutant.file.loadAllDataIntoMemory().bad()) return false;
  renameUids(data, uidsOfSource_);
  const int kind = chance.below(3);  // of values, of bytes, of both
  if (kind != 1) changeValues(data, chance);
  if (mutant.file.saveFile(to.toUtf8().constData()).bad()) return false;
  if (kind == 0) return true;
  const QByteArray bytes = mutated(contentsOf(to), contentsOf(at(QStringLiteral("SEG"))), chance);
  QFile changed(to);
  return changed.open(QIODevice::WriteOnly) && changed.write(bytes) == bytes.size();
}

void TestMutatedExports::theyAreReadOrRefused() {
  constexpr double longestMs = 20000;
  QFETCH(QString, options);
  const QString file = written(options), mutant = at(QStringLiteral("mutant.dcm"));
  QVERIFY(!file.isEmpty());
  const bool isDocument = options.startsWith(QLatin1String("pdf"));  // which nothing here reads
  int opened = 0;
  const Seeds seeds = seedsOf(200, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const QString where = QStringLiteral("seed %1: ").arg(seed);
    QVERIFY2(writeMutant(file, mutant, chance), qPrintable(where));
    const CpuTimer timer;
    const QString fault = faultOf(mutant.toStdString());
    QVERIFY2(fault.isEmpty(), qPrintable(where + fault));
    QVERIFY2(timer.elapsed() < longestMs, qPrintable(where + QStringLiteral("slow")));
    const Result<Study> study = openStudy(mutant.toStdString());
    opened += !study->images.empty() || !study->volumes.empty() || !study->derived.empty() || isDocument;
  }
  QVERIFY2(opened >= seeds.count / 4, qPrintable(QString::number(opened)));
}

VOLUMEN_TEST(TestMutatedExports);
#include "tst_mutated_exports.moc"
