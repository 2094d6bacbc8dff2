// Guards design.md 4 (command line: results on stdout, the rest on stderr, exit status) and 8 (segment).
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "io/export/seg_nrrd.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void labelsAndMeasuresARange_data();
  void labelsAndMeasuresARange();
  void writtenFileHoldsTheLabels();
  void textForPeople();
  void emptyRangeIsDoneAndSaid();
  void filesAreConverted_data();
  void filesAreConverted();
  void aFileOfAnotherGridIsBroughtToThisOne();
  void overlapsStayOverlaps();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();
  void failureLeavesNoFile();
  void nothingIsWrittenOver_data();
  void nothingIsWrittenOver();
  void segmentsOfAFileMayReplaceIt_data();
  void segmentsOfAFileMayReplaceIt();
  void segmentsWithoutAColourGetTheNextOfTheTen_data();
  void segmentsWithoutAColourGetTheNextOfTheTen();
  void aNumberThatIsTooLargeIsNamed();
  void surfacesAreReducedOnRequest();
  void surfacesOfAllStandInOneFileOnRequest();
};

namespace {

Outcome runSegment(const QStringList& arguments) {
  return runProgram(QStringList{QStringLiteral("segment")} + arguments);
}

// The one segment that there is.
QJsonObject only(const QJsonObject& all) {
  const QJsonArray segments = all[QStringLiteral("segments")].toArray();
  return segments.size() == 1 ? segments[0].toObject() : QJsonObject();
}

QStringList words(const char* text) { return QString::fromLatin1(text).split(QLatin1Char(' ')); }

}  // namespace

void TestSegmentCommand::labelsAndMeasuresARange_data() {
  // The phantom `ramp` has the value i, 1 mm voxels: a plane of N x N voxels for each value.
  QTest::addColumn<QString>("range");
  QTest::addColumn<int>("first");
  QTest::addColumn<int>("last");
  QTest::newRow("closed at both ends") << "3:5" << 3 << 5;
  QTest::newRow("one value") << "7:7" << 7 << 7;
  QTest::newRow("fractions") << "2.5:5.5" << 3 << 5;
  QTest::newRow("from below") << ":2" << 0 << 2;
  QTest::newRow("to the top") << "14:" << 14 << 15;
  QTest::newRow("negative end") << "-10:1" << 0 << 1;
  QTest::newRow("exponent") << "1e0:2e0" << 1 << 2;
}

void TestSegmentCommand::labelsAndMeasuresARange() {
  QFETCH(QString, range);
  QFETCH(int, first);
  QFETCH(int, last);
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.seg.nrrd"));
  const Outcome done =
      runSegment(words("phantom:ramp:16 --json --range") << range << QStringLiteral("-o") << file);
  QCOMPARE(done.status, 0);
  const QJsonObject all = QJsonDocument::fromJson(done.out).object();
  const int voxels = (last - first + 1) * 16 * 16;
  const QJsonObject segment = only(all);
  QCOMPARE(segment[QStringLiteral("voxels")].toInt(), voxels);
  QCOMPARE(segment[QStringLiteral("map")].toInt(), 1);
  QCOMPARE(segment[QStringLiteral("millilitres")].toDouble(), voxels / 1000.0);
  QCOMPARE(segment[QStringLiteral("min")].toDouble(), double(first));
  QCOMPARE(segment[QStringLiteral("max")].toDouble(), double(last));
  QCOMPARE(segment[QStringLiteral("mean")].toDouble(), (first + last) / 2.0);
  QCOMPARE(all[QStringLiteral("files")].toArray(), QJsonArray{file});
  const QJsonObject step = all[QStringLiteral("recipe")][QStringLiteral("steps")].toArray()[0].toObject();
  QCOMPARE(step.contains(QStringLiteral("low")), !range.startsWith(QLatin1Char(':')));
  QCOMPARE(step.contains(QStringLiteral("high")), !range.endsWith(QLatin1Char(':')));
}

void TestSegmentCommand::writtenFileHoldsTheLabels() {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.seg.nrrd"));
  QCOMPARE(runSegment(words("phantom:ramp:8 --range 2:3 -o") << file).status, 0);
  const auto study = openStudy(file.toStdString());
  QVERIFY(study.ok() && study->volumes.size() == 1);
  const VolumePtr labels = loadSeries(study->volumes[0])->drawn;
  const auto phantom = openStudy("phantom:ramp:8");
  QVERIFY(labels->geometry() == loadSeries(phantom->volumes[0])->drawn->geometry());
  for (int i = 0; i < 8; ++i) QCOMPARE(labels->value(i, 5, 6), i == 2 || i == 3 ? 1.f : 0.f);
}

void TestSegmentCommand::textForPeople() {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.seg.nrrd"));
  const Outcome done = runSegment(words("phantom:ramp:8 --range 2:3 -o") << file);
  const QStringList lines = QString::fromUtf8(done.out).split(QLatin1Char('\n'));
  QCOMPARE(lines.size(), 4);
  QCOMPARE(lines[0].simplified(),
           QStringLiteral("segment voxels ml ml, surface cm^2 longest, mm mean SD min max"));
  QVERIFY2(lines[1].simplified().startsWith(QStringLiteral("Range 2:3 128 0.128 ")), qPrintable(lines[1]));
  QVERIFY2(lines[1].simplified().endsWith(QStringLiteral(" 2.5 0.5 2 3")), qPrintable(lines[1]));
  QCOMPARE(lines[2], QStringLiteral("file: ") + file);
  QCOMPARE(done.err, QByteArray());
}

void TestSegmentCommand::emptyRangeIsDoneAndSaid() {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.seg.nrrd"));
  const Outcome done = runSegment(words("phantom:ramp:8 --json --range 100:200 -o") << file);
  QCOMPARE(done.status, 0);
  const QJsonObject all = QJsonDocument::fromJson(done.out).object();
  QCOMPARE(only(all)[QStringLiteral("voxels")].toInt(-1), 0);
  QVERIFY(only(all)[QStringLiteral("mean")].isNull());
  QVERIFY(done.err.contains("Range 100:200: no voxel is in it."));
  QVERIFY(QFile::exists(file));
}

void TestSegmentCommand::filesAreConverted_data() {
  QTest::addColumn<QString>("ending");
  for (const char* ending : {".seg.nrrd", ".nii.gz", ".mha"})
    QTest::newRow(ending) << QString::fromLatin1(ending);
}

// There and back: the voxels, the name and the colour are the same, and so is the file.
void TestSegmentCommand::filesAreConverted() {
  QFETCH(QString, ending);
  const QTemporaryDir folder;
  const QString first = folder.filePath(QStringLiteral("a.seg.nrrd")),
                there = folder.filePath(QStringLiteral("there") + ending),
                back = folder.filePath(QStringLiteral("back.seg.nrrd"));
  const Outcome made = runSegment(words("phantom:ramp:16 --range 3:5 --json -o") << first);
  QCOMPARE(made.status, 0);
  const auto convert = [](const QString& from, const QString& to) {
    return runSegment(words("phantom:ramp:16 --json --from") << from << QStringLiteral("-o") << to);
  };
  const Outcome gone = convert(first, there);
  QVERIFY2(gone.status == 0 && gone.err.isEmpty(), gone.err.constData());
  const Outcome came = convert(there, back);
  QVERIFY2(came.status == 0 && came.err.isEmpty(), came.err.constData());
  const QJsonObject before = QJsonDocument::fromJson(made.out).object(),
                    after = QJsonDocument::fromJson(came.out).object();
  QCOMPARE(after[QStringLiteral("from")].toString(), there);
  QVERIFY(!after.contains(QStringLiteral("recipe")));
  QCOMPARE(after[QStringLiteral("segments")], before[QStringLiteral("segments")]);
  QFile a(first), b(back);
  QVERIFY(a.open(QIODevice::ReadOnly) && b.open(QIODevice::ReadOnly));
  QCOMPARE(b.readAll(), a.readAll());
}

// The phantom is about the origin: a plane of 8 x 8 voxels of the middle ones is 8 of those of 16.
void TestSegmentCommand::aFileOfAnotherGridIsBroughtToThisOne() {
  const QTemporaryDir folder;
  const QString large = folder.filePath(QStringLiteral("large.seg.nrrd")),
                small = folder.filePath(QStringLiteral("small.seg.nrrd"));
  QCOMPARE(runSegment(words("phantom:ramp:16 --range 6:7 -o") << large).status, 0);
  const Outcome done =
      runSegment(words("phantom:ramp:8 --json --from") << large << QStringLiteral("-o") << small);
  QCOMPARE(done.status, 0);
  QCOMPARE(only(QJsonDocument::fromJson(done.out).object())[QStringLiteral("voxels")].toInt(), 2 * 8 * 8);
  QVERIFY2(done.err.contains("another grid (16 x 16 x 16 voxels)") &&
               done.err.contains("0.512 ml became 0.128 ml") &&
               done.err.contains("0.384 ml of the segments lie outside"),
           done.err.constData());
}

// Two layers that hold the same voxels.
void TestSegmentCommand::overlapsStayOverlaps() {
  const QTemporaryDir folder;
  const auto path = [&](const char* name) { return folder.filePath(QLatin1String(name)); };
  const VoxelGeometry grid = loadSeries(openStudy("phantom:ramp:8")->volumes[0])->drawn->geometry();
  DenseLabels all{grid, std::vector<std::uint8_t>(512, 1)};
  const Segmented layer{{{.number = 1, .label = "a"}}, LabelMap(all)};
  const std::vector<Segmented> layers{layer, {{{.number = 1, .label = "b"}}, LabelMap(all)}};
  QVERIFY(writeSegNrrd(layers, path("in.seg.nrrd").toStdString()));
  const auto convert = [&](const char* to) {
    return runSegment(words("phantom:ramp:8 --json --from")
                      << path("in.seg.nrrd") << QStringLiteral("-o") << path(to) << QStringLiteral("--csv")
                      << path("numbers.csv"));
  };
  const Outcome done = convert("out.seg.nrrd");
  QVERIFY2(done.status == 0, done.err.constData());
  const QJsonArray segments =
      QJsonDocument::fromJson(done.out).object()[QStringLiteral("segments")].toArray();
  QCOMPARE(segments.size(), 2);
  for (const QJsonValue& segment : segments) QCOMPARE(segment[QStringLiteral("voxels")].toInt(), 512);
  for (const int n : {0, 1}) QCOMPARE(segments[n][QStringLiteral("map")].toInt(), n + 1);
  const QByteArray csv = contentsOf(path("numbers.csv"));
  QVERIFY2(csv.startsWith("Name,Map,Voxels,") && csv.contains("\na,1,512,") && csv.contains("\nb,2,512,"),
           csv.constData());
  QCOMPARE(readSegNrrd(path("out.seg.nrrd").toStdString())->maps.size(), std::size_t(2));
  const Outcome refused = convert("out.nii.gz");
  QCOMPARE(refused.status, 1);
  QVERIFY2(refused.err.contains("in several maps"), refused.err.constData());
  QVERIFY(!QFile::exists(path("out.nii.gz")));
}

void TestSegmentCommand::wrongUsageIsRefused_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const char* arguments, const char* sentence) {
    QTest::newRow(name) << words(arguments) << QString::fromLatin1(sentence);
  };
  row("neither range nor recipe", "phantom:ramp:8 -o a.seg.nrrd",
      "one of --range LOW:HIGH, --recipe NAME and --from FILE");
  row("both", "phantom:ramp:8 --range 1:2 --recipe bone -o a.seg.nrrd",
      "one of --range LOW:HIGH, --recipe NAME and --from FILE");
  row("a range and a file", "phantom:ramp:8 --range 1:2 --from a.seg.nrrd -o b.seg.nrrd",
      "one of --range LOW:HIGH, --recipe NAME and --from FILE");
  row("a file without the table", "phantom:ramp:8 --from a.seg.nrrd --remove-table -o b.seg.nrrd",
      "--remove-table goes with --range and --recipe");
  row("a recipe that is misspelled", "phantom:ramp:8 --recipe bones -o a.stl", "did you mean \"bone\"?");
  row("no output", "phantom:ramp:8 --range 1:2", "Missing -o FILE");
  row("no path", "--range 1:2 -o a.seg.nrrd", "PATH");
  row("one number", "phantom:ramp:8 --range 12 -o a.seg.nrrd", "is not LOW:HIGH");
  row("only a colon", "phantom:ramp:8 --range : -o a.seg.nrrd", "is not LOW:HIGH");
  row("upside down", "phantom:ramp:8 --range 5:1 -o a.seg.nrrd", "\"5:1\" is not");
  row("words", "phantom:ramp:8 --range bone:skin -o a.seg.nrrd", "is not LOW:HIGH");
  row("fewer triangles of no surface", "phantom:ramp:8 --range 1:2 --reduce 0.1 -o a.seg.nrrd",
      "--reduce goes with surfaces");
  row("one file of no surface", "phantom:ramp:8 --range 1:2 --one-file -o a.seg.nrrd",
      "--one-file goes with surfaces");
  row("a reduction of nothing", "phantom:ramp:8 --range 1:2 --reduce 0 -o a.stl", "--reduce");
  row("nan", "phantom:ramp:8 --range nan:1 -o a.seg.nrrd", "is not LOW:HIGH");
  row("unit behind it", "phantom:ramp:8 --range 1:2HU -o a.seg.nrrd", "is not LOW:HIGH");
  row("another format", "phantom:ramp:8 --range 1:2 -o a.xyz",
      "segments are written as .seg.nrrd, .dcm, .stl");
}

void TestSegmentCommand::wrongUsageIsRefused() {
  QFETCH(QStringList, arguments);
  QFETCH(QString, sentence);
  const Outcome done = runSegment(arguments);
  QCOMPARE(done.status, 2);
  QVERIFY2(done.err.contains(sentence.toUtf8()), done.err.constData());
  QVERIFY(done.out.isEmpty());
}

void TestSegmentCommand::failureLeavesNoFile() {
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.seg.nrrd"));
  const Outcome missing = runSegment(words("no-such-file.dcm --range 1:2 -o") << file);
  QCOMPARE(missing.status, 1);
  QVERIFY(missing.err.contains("no-such-file.dcm"));
  QVERIFY(!QFile::exists(file));
  const Outcome noRecipe = runSegment(words("phantom:ramp:8 --recipe none/mine.json -o") << file);
  QCOMPARE(noRecipe.status, 1);
  QVERIFY(noRecipe.err.contains("none/mine.json cannot be read"));
  QVERIFY(!QFile::exists(file));
  const Outcome noSegments = runSegment(words("phantom:ramp:8 --from none.seg.nrrd -o") << file);
  QCOMPARE(noSegments.status, 1);
  QVERIFY(noSegments.err.contains("none.seg.nrrd is no file that can be read"));
  QVERIFY(!QFile::exists(file));
  const Outcome noSeries = runSegment(words("phantom:ramp:8 --series 9 --range 1:2 -o") << file);
  QCOMPARE(noSeries.status, 1);
  const Outcome noFolder = runSegment(words("phantom:ramp:8 --range 1:2 -o")
                                      << folder.filePath(QStringLiteral("none/a.seg.nrrd")));
  QCOMPARE(noFolder.status, 1);
  QVERIFY(noFolder.err.contains("none/a.seg.nrrd") && noFolder.out.isEmpty());
}

namespace {

// Names and contents.
QMap<QString, QByteArray> allFilesIn(const QString& folder) {
  QMap<QString, QByteArray> files;
  for (const QString& name : QDir(folder).entryList(QDir::Files | QDir::Hidden))
    files[name] = contentsOf(folder + QLatin1Char('/') + name);
  return files;
}

void writeBytes(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

// Two segments of the ramp.
QByteArray twoSegments(const QByteArray& second) {
  return R"({"volumenRecipe": 1, "segments": [{"name": "x/A"}, {"name": ")" + second +
         R"("}], "steps": [{"step": "range", "segment": "x/A", "high": 3}, {"step": "range", "segment": ")" +
         second + R"(", "low": 5}]})";
}

}  // namespace

void TestSegmentCommand::nothingIsWrittenOver_data() {
  QTest::addColumn<QString>("arguments");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const char* arguments, const char* sentence) {
    QTest::newRow(name) << QString::fromLatin1(arguments) << QString::fromLatin1(sentence);
  };
  const char *const twice = "another file of this command has this name", *const read =
                                                                              "it is a file that is read";
  row("the numbers over the segments", "scan.mha --range 2:3 -o a.seg.nrrd --csv a.seg.nrrd", twice);
  row("by another spelling", "scan.mha --range 2:3 -o a.seg.nrrd --csv ./folder/../a.seg.nrrd", twice);
  row("by a link", "scan.mha --range 2:3 -o old.seg.nrrd --csv link.csv", twice);
  row("over the table of names", "scan.mha --range 2:3 -o a.nii.gz --csv a.label", twice);
  row("over one of the surfaces", "scan.mha --recipe two.json -o a.stl --csv a-B.stl", twice);
  row("a surface where a folder is", "scan.mha --recipe two.json -o b.stl", "b-B.stl: it is a folder");
  row("the numbers over the recipe", "scan.mha --recipe two.json -o a.seg.nrrd --csv two.json", read);
  row("the numbers over the segments that are read",
      "scan.mha --from old.seg.nrrd -o a.mha --csv old.seg.nrrd", read);
  row("the numbers over the series", "scan.mha --range 2:3 -o a.seg.nrrd --csv scan.mha", read);
  row("segments over the series", "scan.mha --range 2:3 -o scan.mha", read);
  row("the numbers over the table of names", "scan.mha --from lab.mha -o a.seg.nrrd --csv lab.label", read);
  row("the numbers over it, the labels replaced", "scan.mha --from lab.mha -o lab.mha --csv lab.label",
      twice);
  row("a table over that of other labels", "scan.mha --from lab.mha -o lab.nii.gz", read);
}

void TestSegmentCommand::nothingIsWrittenOver() {
  QFETCH(QString, arguments);
  QFETCH(QString, sentence);
  const QTemporaryDir folder;
  const auto path = [&](const char* name) { return folder.filePath(QLatin1String(name)); };
  QCOMPARE(runProgram({QStringLiteral("convert"), QStringLiteral("phantom:ramp:8"), QStringLiteral("-o"),
                       path("scan.mha")})
               .status,
           0);
  QCOMPARE(runSegment(words("phantom:ramp:8 --range 2:3 -o") << path("old.seg.nrrd")).status, 0);
  writeBytes(path("two.json"), twoSegments("B"));
  QCOMPARE(runSegment(words("phantom:ramp:8 --range 2:3 -o") << path("lab.mha")).status, 0);
  QVERIFY(QFile::link(path("old.seg.nrrd"), path("link.csv")));
  QVERIFY(QDir(folder.path()).mkdir(QStringLiteral("folder")) &&
          QDir(folder.path()).mkdir(QStringLiteral("b-B.stl")));
  const QMap<QString, QByteArray> before = allFilesIn(folder.path());
  QCOMPARE(before.size(), 6);
  const Outcome done = runProgramIn(folder.path(), words("segment") + arguments.split(QLatin1Char(' ')));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence.toUtf8()) && done.out.isEmpty(), done.err.constData());
  QVERIFY(allFilesIn(folder.path()) == before);
}

void TestSegmentCommand::segmentsOfAFileMayReplaceIt_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("segments") << QStringLiteral("a.seg.nrrd");
  QTest::newRow("labels and their table") << QStringLiteral("a.mha");
}

void TestSegmentCommand::segmentsOfAFileMayReplaceIt() {
  QFETCH(QString, name);
  const QTemporaryDir folder;
  const QString file = folder.filePath(name);
  QCOMPARE(runSegment(words("phantom:ramp:8 --range 2:3 -o") << file).status, 0);
  const QByteArray before = contentsOf(file);
  const Outcome done = runSegment(words("phantom:ramp:8 --from") << file << QStringLiteral("-o") << file);
  QVERIFY2(done.status == 0, done.err.constData());
  QCOMPARE(contentsOf(file), before);
}

void TestSegmentCommand::segmentsWithoutAColourGetTheNextOfTheTen_data() {
  QTest::addColumn<QString>("how");
  QTest::newRow("a recipe") << QStringLiteral("--recipe two.json");
  QTest::newRow("labels without a table") << QStringLiteral("--from lab.nii.gz");
}

// Two segments: 60, 180, 75 and 255, 225, 25 of 255.
void TestSegmentCommand::segmentsWithoutAColourGetTheNextOfTheTen() {
  QFETCH(QString, how);
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("a.seg.nrrd"));
  writeBytes(folder.filePath(QStringLiteral("two.json")), twoSegments("B"));
  QCOMPARE(
      runProgramIn(folder.path(), words("segment phantom:ramp:8 --recipe two.json -o lab.nii.gz")).status, 0);
  QVERIFY(QFile::remove(folder.filePath(QStringLiteral("lab.label"))));
  const Outcome done = runProgramIn(
      folder.path(), words("segment phantom:ramp:8 -o a.seg.nrrd") + how.split(QLatin1Char(' ')));
  QVERIFY2(done.status == 0, done.err.constData());
  const auto read = readSegNrrd(file.toStdString());
  QVERIFY(read && read->maps.size() == 1 && read->maps[0].segments.size() == 2);
  QVERIFY(read->maps[0].segments[0].colour == glm::u8vec3(60, 180, 75));
  QVERIFY(read->maps[0].segments[1].colour == glm::u8vec3(255, 225, 25));
}

void TestSegmentCommand::aNumberThatIsTooLargeIsNamed() {
  const QTemporaryDir folder;
  writeBytes(folder.filePath(QStringLiteral("big.json")),
             R"({"volumenRecipe": 1, "segments": [{"name": "A"}],
 "steps": [{"step": "range", "segment": "A", "low": 1e400}]})");
  const Outcome done =
      runProgramIn(folder.path(), words("segment phantom:ramp:8 --recipe big.json -o a.seg.nrrd"));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains("big.json: Not JSON at line 2, column 57: steps[0].low is too large."),
           done.err.constData());
}

// A binary STL has 84 bytes, and 50 a triangle.
void TestSegmentCommand::surfacesAreReducedOnRequest() {
  const QTemporaryDir folder;
  const QString all = folder.filePath(QStringLiteral("all.stl")),
                fewer = folder.filePath(QStringLiteral("fewer.stl"));
  const auto made = [](const QString& more, const QString& path) {
    return runSegment(words("phantom:sphere:32 --range 1:") + more.split(QLatin1Char(' '), Qt::SkipEmptyParts)
                      << QStringLiteral("-o") << path);
  };
  const Outcome whole = made({}, all), reduced = made(QStringLiteral("--reduce 0.3"), fewer);
  QVERIFY2(whole.status == 0 && !whole.err.contains("reduced"), whole.err.constData());
  QVERIFY2(reduced.status == 0, reduced.err.constData());
  const auto triangles = [](const QString& path) { return (contentsOf(path).size() - 84) / 50; };
  QVERIFY(triangles(fewer) > 20 && triangles(fewer) < triangles(all) / 2);
  const QByteArray told = "reduced from " + QByteArray::number(triangles(all)) + " triangles and ";
  QVERIFY2(reduced.err.contains(told) && reduced.err.contains(" mm off them."), reduced.err.constData());
}

void TestSegmentCommand::surfacesOfAllStandInOneFileOnRequest() {
  const QTemporaryDir folder;
  const QString recipe = folder.filePath(QStringLiteral("two.json")),
                file = folder.filePath(QStringLiteral("a.stl"));
  writeBytes(recipe, twoSegments("B"));
  const auto made = [&](const QStringList& more) {
    return runSegment(words("phantom:ramp:8 --recipe") << recipe << QStringLiteral("-o") << file << more);
  };
  const auto triangles = [](const QString& path) { return (contentsOf(path).size() - 84) / 50; };
  QCOMPARE(made({}).status, 0);
  QVERIFY(!QFile::exists(file));
  qsizetype apart = 0;
  for (const QString& each : QDir(folder.path()).entryList({QStringLiteral("a-*.stl")}))
    apart += triangles(folder.filePath(each));
  const Outcome together = made({QStringLiteral("--one-file")});
  QVERIFY2(together.status == 0, together.err.constData());
  QVERIFY(apart > 0);
  QCOMPARE(triangles(file), apart);
  QVERIFY2(together.err.contains("a.stl: B: "), together.err.constData());
}

VOLUMEN_TEST(TestSegmentCommand);
#include "tst_segment_command.moc"
