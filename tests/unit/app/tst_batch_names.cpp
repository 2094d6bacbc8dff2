// Guards what is read against what is written: `volumen batch`, render and slice replace no source, no list
// and nothing that another piece writes.
#include "tests/unit/app/batch_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestBatchNames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsReadStays_data();
  void whatIsReadStays();
  void tablesReplaceNothing_data();
  void tablesReplaceNothing();
  void surfacesThatCannotMeetMayHaveLikeNames_data();
  void surfacesThatCannotMeetMayHaveLikeNames();
  void foldersThatAreReadStay_data();
  void foldersThatAreReadStay();
  void filesMayHaveOutputsBesideThem();
  void messagesHaveTheNamesThatWereAskedFor_data();
  void messagesHaveTheNamesThatWereAskedFor();
  void whatIsReadStaysByHand_data();
  void whatIsReadStaysByHand();
};

namespace {

const QString firstSlice = QStringLiteral("src/slice-00001.dcm");

// Makes a series in the folder "src", a volume and shapes.
void fillSources(const BatchFolder& folder) {
  for (const QString& name : {QStringLiteral("src/"), QStringLiteral("v.nrrd")})
    QCOMPARE(runProgram(QStringLiteral("convert phantom:ct-head:16 -o %1").arg(folder.at(name))).status, 0);
  folder.write(QStringLiteral("roi.json"), R"([{"kind": "length", "points": [[0, 0, 0], [0, 30, 0]]}])");
  folder.write(QStringLiteral("src/t.csv"), "a,b\n1,2\n");
  QVERIFY(QFile::link(folder.at(firstSlice), folder.at(QStringLiteral("link.nrrd"))));
}

// Returns the bytes of all files that a run must leave as they are.
QByteArray sourceBytes(const BatchFolder& folder) {
  return folder.contents(firstSlice) + folder.contents(QStringLiteral("v.nrrd")) +
         folder.contents(QStringLiteral("roi.json")) + folder.contents(QStringLiteral("src/t.csv")) +
         folder.contents(QStringLiteral("jobs"));
}

}  // namespace

void TestBatchNames::whatIsReadStays_data() {
  QTest::addColumn<QByteArray>("list");
  QTest::addColumn<QByteArray>("said");
  const auto row = [](const char* name, const char* list, const char* said) {
    QTest::newRow(name) << QByteArray(list) << QByteArray(said);
  };
  row("a file of a source folder", R"({"command": "info", "path": "src", "output": "src/slice-00001.dcm"})",
      "Line 1 of the list: it writes src/slice-00001.dcm, in the folder that line 1 reads: choose another "
      "folder.");
  row("a source by another spelling", R"({"command": "info", "path": "v.nrrd", "output": "src/../v.nrrd"})",
      "it writes src/../v.nrrd, which line 1 reads");
  row("a link to a source", R"({"command": "info", "path": "src", "output": "link.nrrd"})",
      "it writes link.nrrd, in the folder that line 1 reads");
  row("a file of an option",
      R"({"command": "measure", "path": "v.nrrd", "roi": "roi.json", "output": "roi.json"})",
      "it writes roi.json, which line 1 reads");
  row("times onto a source",
      R"({"command": "render", "path": "src", "output": "a.png", "stats": "src/slice-00001.dcm"})",
      "it writes src/slice-00001.dcm, in the folder that line 1 reads");
  row("an error map onto a source",
      R"({"command": "render", "path": "src", "output": "a.png", "error-map": "src/slice-00001.dcm"})",
      "it writes src/slice-00001.dcm, in the folder that line 1 reads");
  row("the list", R"({"command": "info", "path": "src", "output": "./jobs"})",
      "it writes ./jobs, which is the list itself");
  row("a source of another line",
      "{\"command\": \"info\", \"path\": \"src\", \"output\": \"v.nrrd\"}\n"
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"b\"}",
      "Line 1 of the list: it writes v.nrrd, which line 2 reads");
  row("a folder that holds a source",
      R"({"command": "convert", "path": "src/slice-00001.dcm", "output": "src/"})",
      "it writes src, the folder of a file that line 1 reads");
  row("a file in a folder of another line",
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"o/a\"}\n"
      "{\"command\": \"convert\", \"path\": \"v.nrrd\", \"output\": \"o/\"}",
      "Line 1 of the list: it writes o/a, in the folder that line 2 writes");
  row("the table of label images",
      "{\"command\": \"segment\", \"path\": \"v.nrrd\", \"range\": \"1:\", \"output\": \"s.nii.gz\"}\n"
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"s.label\"}",
      "Line 2 of the list: it writes s.label, as line 1 does");
  row("a picture of a turn",
      "{\"command\": \"render\", \"path\": \"v.nrrd\", \"turntable\": 3, \"output\": \"t.png\"}\n"
      "{\"command\": \"render\", \"path\": \"v.nrrd\", \"output\": \"t-002.png\"}",
      "Line 2 of the list: it writes t-002.png, as line 1 does");
  row("a surface of a segment of another line",
      "{\"command\": \"segment\", \"path\": \"v.nrrd\", \"recipe\": \"lungs-and-airways\", \"output\": "
      "\"s.stl\"}\n"
      "{\"command\": \"segment\", \"path\": \"v.nrrd\", \"recipe\": \"bone\", \"output\": \"s-Lungs.stl\"}",
      "Line 2 of the list: it writes s-Lungs.stl, as line 1 may do, a file for each segment");
  row("a surface of a file of segments",
      "{\"command\": \"segment\", \"path\": \"v.nrrd\", \"range\": \"1:\", \"output\": \"s-a-1.stl\"}\n"
      "{\"command\": \"export\", \"path\": \"v.nrrd\", \"as\": \"stl\", \"segments\": \"roi.json\", "
      "\"output\": \"./s-a.stl\"}",
      "Line 1 of the list: it writes s-a-1.stl, as line 2 may do, a file for each segment");
  row("a stamp of another line",
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"b\"}\n"
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"b.volumen-stamp\"}",
      "Line 2 of the list: it writes b.volumen-stamp, as line 1 does");
}

void TestBatchNames::whatIsReadStays() {
  QFETCH(QByteArray, list);
  QFETCH(QByteArray, said);
  const BatchFolder folder;
  fillSources(folder);
  folder.write(QStringLiteral("jobs"), list + '\n');
  const QByteArray before = sourceBytes(folder);
  const QStringList files = folder.files();
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains(said) && a.out.isEmpty(), a.err);
  QVERIFY(sourceBytes(folder) == before);
  QCOMPARE(folder.files(), files);
}

void TestBatchNames::tablesReplaceNothing_data() {
  QTest::addColumn<QString>("table");
  QTest::addColumn<QByteArray>("said");
  const auto row = [](const char* table, const char* said) {
    QTest::newRow(table) << QString::fromLatin1(table) << QByteArray(said);
  };
  row("jobs", "which is the list itself");
  row("src/t.csv", "in the folder that line 1 reads: choose another folder.");
  row("src/sub/new.csv", "in the folder that line 1 reads");
  row("a.csv", "which line 1 writes");
  row("a.csv.volumen-stamp", "which line 1 writes");
}

void TestBatchNames::tablesReplaceNothing() {
  QFETCH(QString, table);
  QFETCH(QByteArray, said);
  const BatchFolder folder;
  fillSources(folder);
  folder.write(QStringLiteral("jobs"),
               R"({"command": "segment", "path": "src", "range": "1:", "csv": "a.csv"})"
               "\n");
  const QByteArray before = sourceBytes(folder);
  const Outcome a = folder.batch({QStringLiteral("--gather"), table});
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains("--gather " + table.toLatin1()) && a.err.contains(said) && a.out.isEmpty(), a.err);
  QVERIFY(sourceBytes(folder) == before && !QFile::exists(folder.at(QStringLiteral("a.csv"))));
}

void TestBatchNames::surfacesThatCannotMeetMayHaveLikeNames_data() {
  QTest::addColumn<QJsonObject>("options");
  QTest::addColumn<QString>("other");
  const QString range = QStringLiteral("range"), low = QStringLiteral("200:");
  QTest::newRow("a range is one segment") << QJsonObject{{range, low}} << QStringLiteral("s-2.stl");
  QTest::newRow("so is a recipe of one")
      << QJsonObject{{QStringLiteral("recipe"), QStringLiteral("bone")}} << QStringLiteral("s-2.stl");
  QTest::newRow("one file for all") << QJsonObject{{QStringLiteral("from"), QStringLiteral("v.nrrd")},
                                                   {QStringLiteral("one-file"), true}}
                                    << QStringLiteral("s-2.stl");
  QTest::newRow("another kind of file")
      << QJsonObject{{QStringLiteral("from"), QStringLiteral("v.nrrd")}} << QStringLiteral("s-2.ply");
}

// Pieces may fail, but the list is not refused.
void TestBatchNames::surfacesThatCannotMeetMayHaveLikeNames() {
  QFETCH(QJsonObject, options);
  QFETCH(QString, other);
  const BatchFolder folder;
  fillSources(folder);
  folder.write(
      QStringLiteral("jobs"),
      listOf({piece(QStringLiteral("segment"), QStringLiteral("s.stl"), options),
              piece(QStringLiteral("segment"), other, {{QStringLiteral("range"), QStringLiteral("200:")}})}));
  const Outcome a = folder.batch();
  QVERIFY2(a.status != 2, a.err);
  QCOMPARE(endsIn(a.out)[2], QStringLiteral("done"));
}

void TestBatchNames::foldersThatAreReadStay_data() {
  QTest::addColumn<QByteArray>("list");
  QTest::addColumn<QByteArray>("said");
  const auto row = [](const char* name, const char* list, const char* said) {
    QTest::newRow(name) << QByteArray(list) << QByteArray(said);
  };
  row("a new file", R"({"command": "info", "path": "src", "output": "src/a"})",
      "Line 1 of the list: it writes src/a, in the folder that line 1 reads");
  row("at some depth", R"({"command": "info", "path": "src", "output": "src/a/b/c"})",
      "it writes src/a/b/c, in the folder that line 1 reads");
  row("by another spelling", R"({"command": "info", "path": "./src/", "output": "src/../src/a"})",
      "it writes src/../src/a, in the folder that line 1 reads");
  row("through a link to the folder", R"({"command": "info", "path": "src", "output": "again/a"})",
      "it writes again/a, in the folder that line 1 reads");
  row("a link that leads out of the folder", R"({"command": "info", "path": "src", "output": "src/out"})",
      "it writes src/out, in the folder that line 1 reads");
  row("the folder that the program works in", R"({"command": "info", "path": ".", "output": "a"})",
      "it writes a, in the folder that line 1 reads");
  row("another folder", R"({"command": "convert", "path": "src", "output": "src/o/"})",
      "it writes src/o, in the folder that line 1 reads");
  row("pictures of a turn", R"({"command": "render", "path": "src", "turntable": 2, "output": "src/a.png"})",
      "it writes src/a-000.png, in the folder that line 1 reads");
  row("a table of numbers",
      R"({"command": "segment", "path": "src", "range": "1:", "output": "s.mha", "csv": "src/a.csv"})",
      "it writes src/a.csv, in the folder that line 1 reads");
  row("surfaces", R"({"command": "segment", "path": "src", "from": "v.nrrd", "output": "src/s.stl"})",
      "it writes src/s.stl, in the folder that line 1 reads");
  row("of another line",
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"src/b\"}\n"
      "{\"command\": \"info\", \"path\": \"src\", \"output\": \"a\"}",
      "Line 1 of the list: it writes src/b, in the folder that line 2 reads");
  row("a folder that is not there yet",
      "{\"command\": \"info\", \"path\": \"v.nrrd\", \"output\": \"new/b\"}\n"
      "{\"command\": \"info\", \"path\": \"new\", \"output\": \"a\"}",
      "Line 1 of the list: it writes new/b, in the folder that line 2 reads");
  row("a folder of an option",
      R"({"command": "slice", "path": "v.nrrd", "overlay": "src", "output": "src/a.png"})",
      "Line 1 of the list: it writes src/a.png, in the folder that line 1 reads");
  row("the folder of a DICOMDIR", R"({"command": "info", "path": "disk/DICOMDIR", "output": "disk/a"})",
      "Line 1 of the list: it writes disk/a, in the folder that line 1 reads");
}

// What a piece reads would depend on which other pieces have ended.
void TestBatchNames::foldersThatAreReadStay() {
  QFETCH(QByteArray, list);
  QFETCH(QByteArray, said);
  const BatchFolder folder;
  fillSources(folder);
  QVERIFY(QFile::link(folder.at(QStringLiteral("src")), folder.at(QStringLiteral("again"))));
  folder.write(QStringLiteral("elsewhere"), "old");
  QVERIFY(QFile::link(folder.at(QStringLiteral("elsewhere")), folder.at(QStringLiteral("src/out"))));
  QVERIFY(QDir(folder.at({})).mkdir(QStringLiteral("disk")));
  folder.write(QStringLiteral("disk/DICOMDIR"), QByteArray(128, '\0') + "DICM 1.2.840.10008.1.3.10");
  folder.write(QStringLiteral("jobs"), list);
  const QStringList files = folder.files();
  const QStringList sources = QDir(folder.at(QStringLiteral("src"))).entryList();
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains(said + ": choose another folder.") && a.out.isEmpty(), a.err);
  QCOMPARE(folder.files(), files);
  QCOMPARE(QDir(folder.at(QStringLiteral("src"))).entryList(), sources);
}

// A word that is no path names no folder, even if there is one.
void TestBatchNames::filesMayHaveOutputsBesideThem() {
  const BatchFolder folder;
  fillSources(folder);
  const QString bone = QStringLiteral("bone");
  QVERIFY(QDir(folder.at({})).mkdir(bone));
  folder.write(QStringLiteral("jobs"), listOf({piece(QStringLiteral("info"), QStringLiteral("src/a.txt"),
                                                     {{QStringLiteral("path"), firstSlice}}),
                                               piece(QStringLiteral("segment"), QStringLiteral("bone/b.mha"),
                                                     {{QStringLiteral("recipe"), bone}})}));
  for (const char* end : {"done", "skipped"}) {
    const Outcome a = folder.batch();
    QVERIFY2(a.status == 0, a.out + a.err);
    QCOMPARE(endsIn(a.out), all(2, QString::fromLatin1(end)));
  }
}

void TestBatchNames::messagesHaveTheNamesThatWereAskedFor_data() {
  QTest::addColumn<QString>("output");
  QTest::addColumn<QString>("said");
  QTest::newRow("a surface beside the list") << QStringLiteral("a.stl") << QStringLiteral("a.stl: ");
  QTest::newRow("a surface in a folder") << QStringLiteral("sub/a.stl") << QStringLiteral("sub/a.stl: ");
  QTest::newRow("in a folder whose name is not printed as it is")
      << QStringLiteral("b\u0007l/a.stl") << QStringLiteral("b\\x07l/a.stl: ");
  QTest::newRow("a folder for a surface") << QStringLiteral("o/") << QStringLiteral("o/: the name of this");
}

void TestBatchNames::messagesHaveTheNamesThatWereAskedFor() {
  QFETCH(QString, output);
  QFETCH(QString, said);
  const BatchFolder folder;
  const QString segments = QStringLiteral("s.seg.nrrd");
  QCOMPARE(
      runProgram(QStringLiteral("segment %1 --range 200: -o %2").arg(smallHead, folder.at(segments))).status,
      0);
  for (const QString& sub : {QStringLiteral("sub"), QStringLiteral("b\u0007l")})
    QVERIFY(QDir(folder.at({})).mkdir(sub));
  folder.write(QStringLiteral("jobs"), listOf({piece(QStringLiteral("export"), output,
                                                     {{QStringLiteral("as"), QStringLiteral("stl")},
                                                      {QStringLiteral("segments"), segments}})}));
  const Outcome a = folder.batch();
  const QString first = lineIn(a.out, 1)[QStringLiteral("warnings")].toArray().first().toString();
  QVERIFY2(first.startsWith(said), a.out);
  QVERIFY2(!a.out.contains(".volumen-"), a.out);
}

void TestBatchNames::whatIsReadStaysByHand_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QByteArray>("said");
  const auto row = [](const char* name, const char* command,
                      const char* said = "it is a file that is read; choose another name.") {
    QTest::newRow(name) << QString::fromLatin1(command) << QByteArray(said);
  };
  row("a picture over its volume", "render v.nrrd -o v.nrrd --size 16x16");
  row("times over a source", "render src --stats src/slice-00001.dcm -o a.png --size 16x16");
  row("an error map over a source", "render src --error-map link.nrrd -o a.png --size 16x16");
  row("two outputs that are one", "render v.nrrd --error-map b.nrrd -o ./b.nrrd --size 16x16",
      "another file of this command has this name.");
  row("a slice over its volume", "slice v.nrrd -o src/../v.nrrd");
  row("a slice over a file of its folder", "slice src -o link.nrrd");
  row("a frame over its file", "slice src --plane frame -o link.nrrd");
}

void TestBatchNames::whatIsReadStaysByHand() {
  QFETCH(QString, command);
  QFETCH(QByteArray, said);
  const BatchFolder folder;
  fillSources(folder);
  const QByteArray before = sourceBytes(folder);
  const Outcome a = runProgramIn(folder.at({}), command.split(QLatin1Char(' ')));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains(said), a.err);
  QVERIFY(sourceBytes(folder) == before);
  QVERIFY(!QFile::exists(folder.at(QStringLiteral("a.png"))) &&
          !QFile::exists(folder.at(QStringLiteral("b.nrrd"))));
}

VOLUMEN_TEST(TestBatchNames);
#include "tst_batch_names.moc"
