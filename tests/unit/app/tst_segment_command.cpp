// Guards design.md 4 (command line: results on stdout, the rest on stderr, exit status) and 8 (segment).
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/app/segment_case.h"
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
  void numbersAreToldWithoutAFile();
  void valuesOfPetAreSaidToBeInTheUnitOfTheFile_data();
  void valuesOfPetAreSaidToBeInTheUnitOfTheFile();
  void emptyRangeIsDoneAndSaid();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();
  void failureLeavesNoFile();
  void whatIsWrongInARecipeIsNamed_data();
  void whatIsWrongInARecipeIsNamed();
};

void TestSegmentCommand::labelsAndMeasuresARange_data() {
  // The phantom `ramp` has the value i and voxels of 1 mm, so each value fills a plane of N x N voxels.
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
  QCOMPARE(lines[0].simplified(), QStringLiteral("segment voxels ml mean SD min max"));
  QVERIFY2(lines[1].simplified().startsWith(QStringLiteral("Range 2:3 128 0.128 ")), qPrintable(lines[1]));
  QVERIFY2(lines[1].simplified().endsWith(QStringLiteral(" 2.5 0.5 2 3")), qPrintable(lines[1]));
  QCOMPARE(lines[2], QStringLiteral("file: ") + file);
  QCOMPARE(done.err, QByteArray());
}

void TestSegmentCommand::numbersAreToldWithoutAFile() {
  const QTemporaryDir folder;
  const QString csv = folder.filePath(QStringLiteral("a.csv"));
  const Outcome text = runSegment(words("phantom:ramp:8 --range 2:3"));
  QCOMPARE(text.status, 0);
  QVERIFY(text.out.contains("Range 2:3") && !text.out.contains("file:") && text.err.isEmpty());
  QCOMPARE(QString::fromUtf8(text.out).section(QLatin1Char('\n'), 0, 0).simplified(),
           QStringLiteral("segment voxels ml ml, surface cm^2 longest, mm mean SD min max"));
  const Outcome json = runSegment(words("phantom:ramp:8 --range 2:3 --json"));
  const QJsonObject all = QJsonDocument::fromJson(json.out).object();
  QCOMPARE(only(all)[QStringLiteral("voxels")].toInt(), 128);
  QVERIFY(all[QStringLiteral("files")].toArray().isEmpty());
  QCOMPARE(runSegment(words("phantom:ramp:8 --range 2:3 --csv") << csv).status, 0);
  QCOMPARE(allFilesIn(folder.path()).keys(), QStringList{QStringLiteral("a.csv")});
  QVERIFY(contentsOf(csv).contains("Range 2:3,1,128,"));
  QVERIFY2(contentsOf(csv).contains(",range high 3 low 2"), contentsOf(csv).constData());  // "Made by"
}

void TestSegmentCommand::valuesOfPetAreSaidToBeInTheUnitOfTheFile_data() {
  QTest::addColumn<QString>("steps");
  QTest::addColumn<bool>("isSaid");
  QTest::newRow("a range") << R"({"step": "range", "segment": "A", "low": 1000})" << true;
  QTest::newRow("the value of a lesion, left out")
      << R"({"step": "invert", "segment": "B"}, {"step": "lesion", "segment": "A", "in": "B", "by": "value"})"
      << true;
  QTest::newRow("a segment of that name")
      << R"({"step": "invert", "segment": "value"}, {"step": "copy", "segment": "A", "other": "value"})"
      << false;
  QTest::newRow("a share")
      << R"({"step": "invert", "segment": "B"}, {"step": "lesion", "segment": "A", "in": "B"})" << false;
}

void TestSegmentCommand::valuesOfPetAreSaidToBeInTheUnitOfTheFile() {
  QFETCH(QString, steps);
  QFETCH(bool, isSaid);
  const QString pet = QString::fromStdString(dataPath("field-cases/c28-suv-bqml"));
  NEED_DATA(pet.toStdString());
  const QTemporaryDir folder;
  const QString recipe = folder.filePath(QStringLiteral("r.json"));
  writeBytes(recipe, QStringLiteral(R"({"volumenRecipe": 1, "segments": [{"name": "A"}], "steps": [%1]})")
                         .arg(steps)
                         .toUtf8());
  const Outcome done = runSegment({pet, QStringLiteral("--recipe"), recipe, QStringLiteral("--json")});
  QCOMPARE(done.status, 0);
  const QJsonObject all = QJsonDocument::fromJson(done.out).object();
  QCOMPARE(all[QStringLiteral("unit")].toString(), QStringLiteral("SUVbw"));
  QCOMPARE(all[QStringLiteral("recipeUnit")].toString(), QStringLiteral("Bq/ml"));
  QCOMPARE(done.err.contains("are in Bq/ml, the unit of the file; numbers are told in SUVbw."), isSaid);
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
  row("fewer triangles of no file", "phantom:ramp:8 --range 1:2 --reduce 1", "--reduce goes with surfaces");
  row("surfaces in no file", "phantom:ramp:8 --range 1:2 --one-file", "--one-file goes with surfaces");
  row("no path", "--range 1:2 -o a.seg.nrrd", "PATH");
  row("one number", "phantom:ramp:8 --range 12 -o a.seg.nrrd", "is not LOW:HIGH");
  row("only a colon", "phantom:ramp:8 --range : -o a.seg.nrrd", "is not LOW:HIGH");
  row("upside down", "phantom:ramp:8 --range 5:1 -o a.seg.nrrd", "\"5:1\" is not");
  row("words", "phantom:ramp:8 --range bone:skin -o a.seg.nrrd", "is not LOW:HIGH");
  row("fewer triangles of no surface", "phantom:ramp:8 --range 1:2 --reduce 0.1 -o a.seg.nrrd",
      "--reduce goes with surfaces");
  row("the largest part of no surface", "phantom:ramp:8 --range 1:2 --largest-part -o a.seg.nrrd",
      "--largest-part goes with surfaces");
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
  QVERIFY(noSegments.err.contains("none.seg.nrrd does not exist"));
  QVERIFY(!QFile::exists(file));
  const Outcome noSeries = runSegment(words("phantom:ramp:8 --series 9 --range 1:2 -o") << file);
  QCOMPARE(noSeries.status, 1);
  const Outcome noFolder = runSegment(words("phantom:ramp:8 --range 1:2 -o")
                                      << folder.filePath(QStringLiteral("none/a.seg.nrrd")));
  QCOMPARE(noFolder.status, 1);
  QVERIFY(noFolder.err.contains("none/a.seg.nrrd") && noFolder.out.isEmpty());
}

void TestSegmentCommand::whatIsWrongInARecipeIsNamed_data() {
  QTest::addColumn<QByteArray>("steps");
  QTest::addColumn<QByteArray>("sentence");
  QTest::newRow("a number that is too large")
      << QByteArray(R"({"step": "range", "segment": "A", "low": 1e400})")
      << QByteArray("mine.json: Not JSON at line 2, column 57: steps[0].low is too large.");
  QTest::newRow("a mistyped segment")
      << QByteArray(R"({"step": "range", "segment": "A"}, {"step": "grow", "segment": "a"})")
      << QByteArray(R"(mine.json: steps[1].segment "a" is made by no step before "grow": "A" is.)");
  QTest::newRow("an outline of two places")
      << QByteArray(R"({"step": "range", "segment": "A"}, {"step": "scissors", "segment": "A",
                        "outline": [[0, 0, 0], [1, 1, 1]], "sight": [[0, 0, 0], [0, 0, 1]]})")
      << QByteArray("Mine: Step 2, scissors: outline must be three places or more.");
}

void TestSegmentCommand::whatIsWrongInARecipeIsNamed() {
  QFETCH(QByteArray, steps);
  QFETCH(QByteArray, sentence);
  const QTemporaryDir folder;
  writeBytes(folder.filePath(QStringLiteral("mine.json")),
             R"({"volumenRecipe": 1, "name": "Mine", "segments": [{"name": "A"}],
 "steps": [)" + steps +
                 "]}");
  const Outcome done =
      runProgramIn(folder.path(), words("segment phantom:ramp:8 --recipe mine.json -o a.seg.nrrd"));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence), done.err.constData());
  QVERIFY(!QFile::exists(folder.filePath(QStringLiteral("a.seg.nrrd"))));
}

VOLUMEN_TEST(TestSegmentCommand);
#include "tst_segment_command.moc"
