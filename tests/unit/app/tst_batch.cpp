// Guards `volumen batch`: every piece of a list is done as by hand, in one of any number of programs.
#include <QElapsedTimer>
#include <QRandomGenerator>

#include "tests/unit/app/batch_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestBatch : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void badListsAreRefusedAtOnce_data();
  void badListsAreRefusedAtOnce();
  void badUseIsSaid_data();
  void badUseIsSaid();
  void everyCommandIsDoneAsByHand();
  void whatIsWrittenToStdoutIsNoTable();
  void onlyWarningsAreToldAsSuch_data();
  void onlyWarningsAreToldAsSuch();
  void shardsDoEachPieceOnce();
  void slurmTasksAreShards_data();
  void slurmTasksAreShards();
  void manyShardsTakeNoTime();
  void pathsMayBeginWithADash();
  void tablesAreGathered();
};

void TestBatch::badListsAreRefusedAtOnce_data() {
  QTest::addColumn<QByteArray>("line");
  QTest::addColumn<QByteArray>("said");
  const auto row = [](const char* name, const char* line, const char* said) {
    QTest::newRow(name) << QByteArray(line) << QByteArray(said);
  };
  row("no JSON", "render a", "it is no JSON object");
  row("no object", "[1]", "it is no JSON object");
  row("no command", R"({"path": "a", "output": "b"})", "\"command\" is none of render");
  row("a command of another kind", R"({"command": "open", "path": "a", "output": "b"})",
      "\"command\" is none of");
  row("no path", R"({"command": "render", "output": "b"})", "\"path\" is missing");
  row("an empty path", R"({"command": "render", "path": "", "output": "b"})", "\"path\" is not a text");
  row("several paths", R"({"command": "measure", "path": ["a", "b"], "output": "b"})",
      "\"path\" is not a text");
  row("a NUL in a path", R"({"command": "info", "path": "a\u0000b", "output": "b"})",
      "\"path\" holds the character NUL");
  row("a NUL in a list", R"({"command": "render", "path": "a", "output": "b", "size": ["1\u0000"]})",
      "\"size\" holds the character NUL");
  row("an empty output", R"({"command": "info", "path": "a", "output": ""})", "\"output\" is not a text");
  row("a list as output", R"({"command": "info", "path": "a", "output": []})", "\"output\" is not a text");
  row("the root as output", R"({"command": "convert", "path": "a", "output": "/"})",
      "\"output\" is not the name of a file");
  const QByteArray deep = QByteArray(1000000, '[') + QByteArray(1000000, ']');
  QTest::newRow("deep lists")
      << QByteArray(R"({"command": "render", "path": "a", "output": "b", "series": )" + deep + '}')
      << QByteArray("\"series\" holds a list in a list");
  row("help", R"({"command": "info", "path": "a", "output": "b", "help": true})",
      "--help is no part of a piece of work");
  row("a list of presets", R"({"command": "render", "path": "a", "output": "b", "list-presets": true})",
      "--list-presets is no part of a piece of work");
  row("true where a value is needed", R"({"command": "render", "path": "a", "output": "b", "size": true})",
      "\"size\" needs a value");
  row("a value of a flag", R"({"command": "info", "path": "a", "output": "b", "json": "yes"})",
      "\"json\" is a flag");
  row("a key that is there twice", R"({"command": "info", "path": "a", "path": "c", "output": "b"})",
      "\"path\" is there twice");
  row("no output", R"({"command": "render", "path": "a"})", "\"output\" is missing");
  row("an unknown option", R"({"command": "render", "path": "a", "output": "b", "colour": 1})",
      "volumen render has no option --colour");
  row("no value", R"({"command": "render", "path": "a", "output": "b", "size": null})",
      "\"size\" is neither");
  row("a list of lists", R"({"command": "render", "path": "a", "output": "b", "size": [[1]]})",
      "\"size\" holds a list in a list");
  row("an archive as output", R"({"command": "render", "path": "a", "output": "archive:x"})",
      "a piece of work is written to a file");
  row("an output of another line", R"({"command": "render", "path": "a", "output": "./first.png"})",
      "it writes ./first.png, as line 1 does");
}

void TestBatch::badListsAreRefusedAtOnce() {
  QFETCH(QByteArray, line);
  QFETCH(QByteArray, said);
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"),
               listOf({smallPicture(QStringLiteral("first.png"))}) + "\n# words\n" + line);
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains("Line 4 of the list: " + said) && a.out.isEmpty(), a.err);
  QCOMPARE(folder.files(), QStringList{QStringLiteral("jobs")});
}

void TestBatch::badUseIsSaid_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QByteArray>("said");
  const auto row = [](const char* options, const char* said) {
    QTest::newRow(options) << QString::fromLatin1(options) << QByteArray(said);
  };
  row("batch", "Give a list of work");
  row("batch nowhere", "nowhere");
  row("batch - --shard 0/3", "--shard is I/N");
  row("batch - --shard 4/3", "--shard is I/N");
  row("batch - --shard 2", "--shard is I/N");
  row("batch - --shard 1/3x", "--shard is I/N");
  row("batch - --shard 1/2 --gather a.csv", "--gather joins what all shards made");
  row("batch - --shard 1/1000001", "--shard has 1000001 parts: give at most 1000000.");
  row("batch - --max-memory much", "--max-memory");
  row("batch - --max-memory 63M", "--max-memory: a process needs 64M or more.");
  row("batch - --max-memory 0", "--max-memory: a process needs 64M or more.");
  row("batch - --max-memory -1", "--max-memory");
  row("batch --do render", "give both");
  row("batch - --from-index ct --do render", "Give a list of work, or");
}

void TestBatch::badUseIsSaid() {
  QFETCH(QString, options);
  QFETCH(QByteArray, said);
  const Outcome a = runProgram(options);
  QVERIFY(a.status == 1 || a.status == 2);
  QVERIFY2(a.err.contains(said) && a.out.isEmpty(), a.err);
}

void TestBatch::everyCommandIsDoneAsByHand() {
  const BatchFolder folder;
  const auto set = [](const char* name, const QJsonValue& value) {
    return QJsonObject{{QString::fromLatin1(name), value}};
  };
  folder.write(QStringLiteral("roi.json"), R"([{"kind": "length", "points": [[0, 0, 0], [0, 30, 0]]}])");
  const QString roi = QStringLiteral("roi.json");
  const QList<std::pair<QJsonObject, QString>> rows = {
      {smallPicture(QStringLiteral("a.png")), QStringLiteral("render %1 --size 32x32 -o %2a.png")},
      {piece(QStringLiteral("slice"), QStringLiteral("b.png"), set("plane", QStringLiteral("coronal"))),
       QStringLiteral("slice %1 --plane coronal -o %2b.png")},
      {piece(QStringLiteral("segment"), QStringLiteral("c.stl"), set("recipe", QStringLiteral("bone"))),
       QStringLiteral("segment %1 --recipe bone -o %2c.stl")},
      {piece(QStringLiteral("convert"), QStringLiteral("d.nrrd")), QStringLiteral("convert %1 -o %2d.nrrd")},
      {piece(QStringLiteral("info"), QStringLiteral("e.json"), set("json", true)),
       QStringLiteral("info %1 --json")},
      {piece(QStringLiteral("measure"), QStringLiteral("f.json"), {{QStringLiteral("roi"), roi}}),
       QStringLiteral("measure %1 --roi %2roi.json")},
      {piece(QStringLiteral("export"), QStringLiteral("g.png"),
             {{QStringLiteral("as"), QStringLiteral("apng")},
              {QStringLiteral("turntable"), 3},
              {QStringLiteral("size"), QStringLiteral("32x32")}}),
       QStringLiteral("export %1 --as apng --turntable 3 --size 32x32 -o %2g.png")}};
  QList<QJsonObject> pieces;
  for (const auto& [one, hand] : rows) pieces << one;
  folder.write(QStringLiteral("jobs"), listOf(pieces));
  const Outcome a = folder.batch();
  QVERIFY2(a.status == 0, a.out + a.err);
  QCOMPARE(endsIn(a.out), all(int(rows.size()), QStringLiteral("done")));
  const QJsonObject first = lineIn(a.out, 1);
  QVERIFY(first[QStringLiteral("seconds")].toDouble() > 0);
  QVERIFY(first[QStringLiteral("peakMebibytes")].toInt() > 10);
  QVERIFY(first[QStringLiteral("error")].isObject());
  const QTemporaryDir byHand;
  QVERIFY(QFile::copy(folder.at(roi), byHand.filePath(roi)));
  for (const auto& [one, hand] : rows) {
    const QString name = one[QStringLiteral("output")].toString();
    const Outcome b = runProgram(hand.arg(smallHead, byHand.path() + QLatin1Char('/')));
    QVERIFY2(b.status == 0, b.err);
    QVERIFY2(folder.contents(name) ==
                 (name.endsWith(QLatin1String(".json")) ? b.out : contentsOf(byHand.filePath(name))),
             qPrintable(name));
  }
  const Outcome again = folder.batch();
  QVERIFY2(again.status == 0, again.err);
  QCOMPARE(endsIn(again.out), all(int(rows.size()), QStringLiteral("skipped")));
}

void TestBatch::whatIsWrittenToStdoutIsNoTable() {
  const BatchFolder folder;
  const QString segments = folder.at(QStringLiteral("s.seg.nrrd"));
  QCOMPARE(runProgram(QStringLiteral("segment %1 --range 200: -o %2").arg(smallHead, segments)).status, 0);
  const QJsonObject one =
      piece(QStringLiteral("measure"), QStringLiteral("a.json"),
            {{QStringLiteral("segments"), segments}, {QStringLiteral("csv"), QStringLiteral("a.csv")}});
  folder.write(QStringLiteral("jobs"), listOf({one}));
  const Outcome a = folder.batch();
  QVERIFY2(a.status == 0, a.out + a.err);
  QVERIFY(folder.contents(QStringLiteral("a.json")).startsWith('{'));
  QVERIFY(folder.contents(QStringLiteral("a.csv")).startsWith("Name,"));
}

void TestBatch::onlyWarningsAreToldAsSuch_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QJsonObject>("options");
  QTest::addColumn<QStringList>("said");
  const QString size = QStringLiteral("size"), scene = QStringLiteral("print-scene");
  QTest::newRow("names and the plan beside a scene")
      << QStringLiteral("render")
      << QJsonObject{{size, QStringLiteral("32x32")}, {scene, true}, {QStringLiteral("explain"), true}}
      << QStringList();
  QTest::newRow("the name beside a plane")
      << QStringLiteral("slice") << QJsonObject{{QStringLiteral("print-plane"), true}} << QStringList();
  QTest::newRow("all lines of what went wrong")
      << QStringLiteral("render")
      << QJsonObject{{size, QStringLiteral("32x32")}, {scene, true}, {QStringLiteral("quality"), 7}}
      << QStringList{QStringLiteral("--quality"), QStringLiteral("See `volumen render --help`.")};
}

void TestBatch::onlyWarningsAreToldAsSuch() {
  QFETCH(QString, command);
  QFETCH(QJsonObject, options);
  QFETCH(QStringList, said);
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"), listOf({piece(command, QStringLiteral("a.png"), options)}));
  QStringList told;
  for (int n = 0; n < 2; ++n) {  // then from the stamp
    told.clear();
    const Outcome a = folder.batch();
    for (const QJsonValue& one : lineIn(a.out, 1)[QStringLiteral("warnings")].toArray())
      told << one.toString();
    QCOMPARE(told.size(), said.size());
    QCOMPARE(a.status, said.isEmpty() ? 0 : 1);
  }
  for (qsizetype n = 0; n < said.size(); ++n)
    QVERIFY2(told[n].startsWith(said[n]), qPrintable(told.join(QLatin1Char('\n'))));
}

void TestBatch::shardsDoEachPieceOnce() {
  QRandomGenerator random(75);
  const int cases = qEnvironmentVariableIntValue("VOLUMEN_RANDOM_CASES");
  for (int n = 0; n < std::max(2, cases); ++n) {
    const BatchFolder folder;
    QList<QJsonObject> pieces;
    const int count = 1 + int(random.bounded(9)), shards = 1 + int(random.bounded(5));
    for (int k = 0; k < count; ++k)
      pieces << piece(
          QStringLiteral("info"), QStringLiteral("%1.txt").arg(k),
          {{QStringLiteral("path"), QStringLiteral("phantom:ct-head:%1").arg(16 + random.bounded(3))}});
    folder.write(QStringLiteral("jobs"), listOf(pieces));
    QMap<int, int> done;
    int most = 0;
    for (int shard = 1; shard <= shards; ++shard) {
      const Outcome a =
          folder.batch({QStringLiteral("--shard"), QStringLiteral("%1/%2").arg(shard).arg(shards)});
      QVERIFY2(a.status == 0, a.err);
      const QMap<int, QString> ends = endsIn(a.out);
      most = std::max(most, int(ends.size()));
      for (const int line : ends.keys()) QVERIFY(++done[line] == 1 && ends[line] == QLatin1String("done"));
    }
    QCOMPARE(done.size(), count);
    QVERIFY(most < 2 * ((count + shards - 1) / shards));
  }
}

void TestBatch::manyShardsTakeNoTime() {
  const BatchFolder folder;
  QByteArray list;
  for (int n = 0; n < 5000; ++n)
    list += "{\"command\":\"info\",\"path\":\"p" + QByteArray::number(n) + "\",\"output\":\"" +
            QByteArray::number(n) + ".txt\"}\n";
  folder.write(QStringLiteral("jobs"), list);
  QElapsedTimer timer;
  timer.start();
  const Outcome a = folder.batch({QStringLiteral("--shard"), QStringLiteral("1000000/1000000")});
  QVERIFY2(a.status == 0 && a.out.isEmpty(), a.err);
  QVERIFY2(timer.elapsed() < 20000, qPrintable(QString::number(timer.elapsed())));
}

void TestBatch::pathsMayBeginWithADash() {
  const BatchFolder folder;
  const QString volume = QStringLiteral("-v.nrrd");
  QCOMPARE(runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(volume))).status, 0);
  folder.write(QStringLiteral("jobs"), listOf({smallPicture(QStringLiteral("a.png"), volume)}));
  const Outcome a = folder.batch();
  QVERIFY2(a.status == 0, a.out + a.err);
}

void TestBatch::slurmTasksAreShards_data() {
  QTest::addColumn<QByteArrayList>("values");  // ID, COUNT, MIN, STEP
  QTest::addColumn<int>("line");               // 0: refused
  const auto row = [](const char* name, const QByteArrayList& values, int line) {
    QTest::newRow(name) << values << line;
  };
  row("from 0", {"2", "3", "0", "1"}, 3);
  row("from 1", {"1", "3", "1", "1"}, 1);
  row("by steps", {"25", "3", "5", "10"}, 3);
  row("with gaps", {"7", "2", "3", "1"}, 0);
}

void TestBatch::slurmTasksAreShards() {
  QFETCH(QByteArrayList, values);
  QFETCH(int, line);
  const BatchFolder folder;
  QList<QJsonObject> pieces;
  for (int k = 0; k < 3; ++k)
    pieces << piece(QStringLiteral("info"), QStringLiteral("%1.txt").arg(k),
                    {{QStringLiteral("path"), QStringLiteral("phantom:ct-head:%1").arg(16 + k)}});
  folder.write(QStringLiteral("jobs"), listOf(pieces));
  const char* const names[] = {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
                               "SLURM_ARRAY_TASK_STEP"};
  for (int n = 0; n < 4; ++n) qputenv(names[n], values[n]);
  const Outcome a = folder.batch();
  for (const char* name : names) qunsetenv(name);
  QCOMPARE(a.status, line == 0 ? 2 : 0);
  if (line == 0) QVERIFY2(a.err.contains("have gaps"), a.err);
  if (line > 0) QCOMPARE(endsIn(a.out).keys(), QList<int>{line});
}

void TestBatch::tablesAreGathered() {
  const BatchFolder folder;
  QJsonObject one =
      piece(QStringLiteral("segment"), {}, {{QStringLiteral("recipe"), QStringLiteral("bone")}});
  one.remove(QStringLiteral("output"));
  QList<QJsonObject> pieces;
  for (const QString& size : {QStringLiteral("24"), QStringLiteral("32")}) {
    one[QStringLiteral("path")] = QStringLiteral("phantom:ct-head:") + size;
    one[QStringLiteral("csv")] = size + QStringLiteral(".csv");
    pieces << one;
  }
  one[QStringLiteral("path")] = QStringLiteral("missing");
  one[QStringLiteral("csv")] = QStringLiteral("no.csv");
  folder.write(QStringLiteral("jobs"), listOf(pieces << one));
  const Outcome a = folder.batch({QStringLiteral("--gather"), QStringLiteral("all.csv")});
  QCOMPARE(a.status, 1);
  const QByteArrayList rows = folder.contents(QStringLiteral("all.csv")).trimmed().split('\n');
  QCOMPARE(rows.size(), 3);
  QVERIFY(rows[0].startsWith("line,path,file,"));
  for (int n = 0; n < 2; ++n) {
    const QByteArray table = folder.contents(n == 0 ? QStringLiteral("24.csv") : QStringLiteral("32.csv"));
    QCOMPARE(rows[0], "line,path,file," + table.split('\n')[0].trimmed());
    QVERIFY2(rows[n + 1].endsWith(table.split('\n')[1].trimmed()), rows[n + 1]);
    QVERIFY(rows[n + 1].startsWith(QByteArray::number(n + 1) + ",phantom:ct-head:"));
  }
}

VOLUMEN_TEST(TestBatch);
#include "tst_batch.moc"
