// Guards design.md 8 (segment): files read and written, segments of other formats and grids, files that are
// never overwritten, and surfaces.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "io/export/seg_nrrd.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/app/segment_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void filesAreConverted_data();
  void filesAreConverted();
  void aFileOfAnotherGridIsBroughtToThisOne();
  void overlapsStayOverlaps();
  void namesThatTheFileCannotHoldAreTold_data();
  void namesThatTheFileCannotHoldAreTold();
  void nothingIsWrittenOver_data();
  void nothingIsWrittenOver();
  void segmentsOfAFileMayReplaceIt_data();
  void segmentsOfAFileMayReplaceIt();
  void segmentsWithoutAColourGetTheNextOfTheTen_data();
  void segmentsWithoutAColourGetTheNextOfTheTen();
  void surfacesAreReducedOnRequest();
  void surfacesOfAllStandInOneFileOnRequest();
  void crumbsAreNoPartsOfAPrint_data();
  void crumbsAreNoPartsOfAPrint();
};

namespace {

// Returns a recipe for two segments of the ramp.
QByteArray twoSegments(const QByteArray& second) {
  return R"({"volumenRecipe": 1, "segments": [{"name": "x/A"}, {"name": ")" + second +
         R"("}], "steps": [{"step": "range", "segment": "x/A", "high": 3}, {"step": "range", "segment": ")" +
         second + R"(", "low": 5}]})";
}

}  // namespace

void TestSegmentFiles::filesAreConverted_data() {
  QTest::addColumn<QString>("ending");
  for (const char* ending : {".seg.nrrd", ".nii.gz", ".mha"})
    QTest::newRow(ending) << QString::fromLatin1(ending);
}

// A round trip keeps voxels, name, colour and the file itself.
void TestSegmentFiles::filesAreConverted() {
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

// The phantom is centred on the origin. A plane of 8 x 8 voxels in the middle corresponds to 8 x 8 of the 16
// x 16.
void TestSegmentFiles::aFileOfAnotherGridIsBroughtToThisOne() {
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

// Two layers hold the same voxels.
void TestSegmentFiles::overlapsStayOverlaps() {
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

void TestSegmentFiles::namesThatTheFileCannotHoldAreTold_data() {
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QString>("file");
  QTest::addColumn<QByteArray>("told");
  const auto row = [](const char* what, const char* name, const char* file, const char* told) {
    QTest::newRow(what) << QByteArray(name) << QString::fromLatin1(file) << QByteArray(told);
  };
  row("a quotation mark", R"(5\" bone)", "a.nii.gz", "5' bone.");
  row("a line end", R"(a\nb)", "a.mha", "a b.");
  row("a tab", R"(a\tb)", "a.nii.gz", "a b.");
  row("a plain name", "a b", "a.mha", "");
  row("a file that holds any", R"(5\" bone)", "a.seg.nrrd", "");
}

void TestSegmentFiles::namesThatTheFileCannotHoldAreTold() {
  QFETCH(QByteArray, name);
  QFETCH(QString, file);
  QFETCH(QByteArray, told);
  const QTemporaryDir folder;
  writeBytes(folder.filePath(QStringLiteral("two.json")), twoSegments(name));
  const Outcome done =
      runProgramIn(folder.path(), words("segment phantom:ramp:16 --recipe two.json -o") << file);
  QVERIFY2(done.status == 0, done.err.constData());
  const QByteArray sentence = "Names in a.label have one line without quotation marks: " + told;
  QVERIFY2(done.err.contains(sentence) != told.isEmpty(), done.err.constData());
}

void TestSegmentFiles::nothingIsWrittenOver_data() {
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

void TestSegmentFiles::nothingIsWrittenOver() {
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

void TestSegmentFiles::segmentsOfAFileMayReplaceIt_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("segments") << QStringLiteral("a.seg.nrrd");
  QTest::newRow("labels and their table") << QStringLiteral("a.mha");
}

void TestSegmentFiles::segmentsOfAFileMayReplaceIt() {
  QFETCH(QString, name);
  const QTemporaryDir folder;
  const QString file = folder.filePath(name);
  QCOMPARE(runSegment(words("phantom:ramp:8 --range 2:3 -o") << file).status, 0);
  const QByteArray before = contentsOf(file);
  const Outcome done = runSegment(words("phantom:ramp:8 --from") << file << QStringLiteral("-o") << file);
  QVERIFY2(done.status == 0, done.err.constData());
  QCOMPARE(contentsOf(file), before);
}

void TestSegmentFiles::segmentsWithoutAColourGetTheNextOfTheTen_data() {
  QTest::addColumn<QString>("how");
  QTest::newRow("a recipe") << QStringLiteral("--recipe two.json");
  QTest::newRow("labels without a table") << QStringLiteral("--from lab.nii.gz");
}

// The two segments have the colours 60, 180, 75 and 255, 225, 25 of 255.
void TestSegmentFiles::segmentsWithoutAColourGetTheNextOfTheTen() {
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

// A binary STL has 84 bytes plus 50 per triangle.
void TestSegmentFiles::surfacesAreReducedOnRequest() {
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

void TestSegmentFiles::surfacesOfAllStandInOneFileOnRequest() {
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

void TestSegmentFiles::crumbsAreNoPartsOfAPrint_data() {
  QTest::addColumn<QStringList>("options");
  QTest::addColumn<int>("shells");
  const QString cases = QString::fromStdString(dataPath("segment-cases/crumbs"));
  QTest::newRow("counted by corners, which surfaces part")
      << QStringList{QStringLiteral("--recipe"), cases + QStringLiteral("/recipe.json")} << 1;
  const QStringList range{QStringLiteral("--range"), QStringLiteral("500:")};
  QTest::newRow("all voxels") << range << 2;
  QTest::newRow("their largest part") << (range + QStringList{QStringLiteral("--largest-part")}) << 1;
}

void TestSegmentFiles::crumbsAreNoPartsOfAPrint() {
  QFETCH(QStringList, options);
  QFETCH(int, shells);
  const std::string block = dataPath("segment-cases/crumbs/block.nrrd");
  NEED_DATA(block);
  const QTemporaryDir folder;
  const Outcome done =
      runSegment(QStringList{QString::fromStdString(block)} + options +
                 QStringList{QStringLiteral("-o"), folder.filePath(QStringLiteral("a.stl"))});
  QVERIFY2(done.status == 0, done.err.constData());
  const QByteArray told =
      shells == 1 ? QByteArray("1 closed shell.") : QByteArray("2 closed shells; the largest");
  QVERIFY2(done.err.contains(told), done.err.constData());
}

VOLUMEN_TEST(TestSegmentFiles);
#include "tst_segment_files.moc"
