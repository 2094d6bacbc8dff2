// Guards the stamps of `volumen batch`: what is there and still right is skipped and told as before, all else
// is done again, and what no list made stays.
#include <QDateTime>
#include <QScopeGuard>

#include "tests/unit/app/batch_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestBatchStamps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void stampsThatNoLongerHoldAreDoneAgain_data();
  void stampsThatNoLongerHoldAreDoneAgain();
  void exportsAreDoneAgain();
  void anotherKeyGivesOtherNames();
  void otherFilesStay();
  void otherFilesInFoldersStay();
  void filesOfFoldersHaveTheirNames();
  void failuresKeepWhatIsThere();
  void lossesAreToldAgain();
};

namespace {

// A report of a series in the folder "src".
QJsonObject reportPiece(const BatchFolder& folder) {
  const QString source = QStringLiteral("src/");
  runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(source)));
  folder.write(QStringLiteral("roi.json"), R"([{"kind": "length", "points": [[0, 0, 0], [0, 30, 0]]}])");
  return piece(QStringLiteral("export"), QStringLiteral("r.dcm"),
               {{QStringLiteral("path"), source},
                {QStringLiteral("as"), QStringLiteral("sr")},
                {QStringLiteral("roi"), QStringLiteral("roi.json")}});
}

}  // namespace

void TestBatchStamps::stampsThatNoLongerHoldAreDoneAgain_data() {
  QTest::addColumn<QString>("change");
  for (const char* change :
       {"another input", "a newer input", "another scene", "another option", "no output", "half an output",
        "another limit of memory", "another version", "no stamp", "a broken stamp"})
    QTest::newRow(change) << QString::fromLatin1(change);
}

void TestBatchStamps::stampsThatNoLongerHoldAreDoneAgain() {
  QFETCH(QString, change);
  const BatchFolder folder;
  const QString input = QStringLiteral("in.nrrd"), output = QStringLiteral("out.png");
  QCOMPARE(runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(input))).status, 0);
  QCOMPARE(runProgram(QStringLiteral("render %1 --size 32x32 -o %2")
                          .arg(smallHead, folder.at(QStringLiteral("scene.png"))))
               .status,
           0);
  QJsonObject one = smallPicture(output, input);
  one[QStringLiteral("scene")] = QStringLiteral("scene.png");
  folder.write(QStringLiteral("jobs"), listOf({one}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
  const QByteArray before = folder.contents(output);
  const QString stamp = output + QStringLiteral(".volumen-stamp");
  QStringList options;
  if (change == QLatin1String("another input")) {
    QFile::remove(folder.at(input));
    QCOMPARE(runProgram(QStringLiteral("convert phantom:ct-head:24 -o %1").arg(folder.at(input))).status, 0);
  } else if (change == QLatin1String("a newer input")) {
    QFile file(folder.at(input));
    QVERIFY(file.open(QIODevice::ReadWrite));
    QVERIFY(file.setFileTime(QDateTime::currentDateTime().addDays(1), QFileDevice::FileModificationTime));
  } else if (change == QLatin1String("another scene")) {
    QCOMPARE(runProgram(QStringLiteral("render %1 --preset CT-Bone --size 32x32 -o %2")
                            .arg(smallHead, folder.at(QStringLiteral("scene.png"))))
                 .status,
             0);
  } else if (change == QLatin1String("another option")) {
    one[QStringLiteral("size")] = QStringLiteral("33x32");
    folder.write(QStringLiteral("jobs"), listOf({one}));
  } else if (change == QLatin1String("no output")) {
    QVERIFY(QFile::remove(folder.at(output)));
  } else if (change == QLatin1String("half an output")) {
    QVERIFY(QFile::resize(folder.at(output), before.size() / 2));
  } else if (change == QLatin1String("another limit of memory")) {
    NEED_LIMITED_MEMORY();
    options = {QStringLiteral("--max-memory"), QStringLiteral("2G")};
  } else if (change == QLatin1String("another version")) {
    folder.write(stamp, folder.contents(stamp).replace("\"version\":\"", "\"version\":\"0"));
  } else if (change == QLatin1String("no stamp")) {
    QVERIFY(QFile::remove(folder.at(stamp)));
  } else {
    folder.write(stamp, "{\"made\":");
  }
  const Outcome a = folder.batch(options);
  QVERIFY2(a.status == 0, a.out + a.err);
  QCOMPARE(endsIn(a.out), all(1, QStringLiteral("done")));
  const bool isOther = change == QLatin1String("another input") || change == QLatin1String("another scene") ||
                       change == QLatin1String("another option");
  QCOMPARE(folder.contents(output) != before, isOther);
  QCOMPARE(endsIn(folder.batch(options).out), all(1, QStringLiteral("skipped")));
}

// By hand they replace nothing.
void TestBatchStamps::exportsAreDoneAgain() {
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"), listOf({reportPiece(folder)}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
  const QByteArray before = folder.contents(QStringLiteral("r.dcm"));
  folder.write(QStringLiteral("roi.json"), R"([{"kind": "length", "points": [[0, 0, 0], [0, 31.5, 0]]}])");
  QProcess one, two;
  folder.start(one), folder.start(two);
  QVERIFY(one.waitForFinished(120000) && two.waitForFinished(120000));
  QVERIFY2(one.exitCode() == 0 && two.exitCode() == 0,
           one.readAllStandardOutput() + two.readAllStandardOutput());
  QVERIFY(folder.contents(QStringLiteral("r.dcm")) != before);
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
  QCOMPARE(folder.files().size(), 5);
  folder.write(QStringLiteral("roi.json"), "no shapes");
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("failed")));
  QVERIFY(QFile::exists(folder.at(QStringLiteral("r.dcm.volumen-stamp"))));
}

void TestBatchStamps::anotherKeyGivesOtherNames() {
  const BatchFolder folder;
  const QByteArray before = qgetenv("XDG_CONFIG_HOME");
  qputenv("XDG_CONFIG_HOME", folder.at(QStringLiteral("config")).toUtf8());
  const auto back = qScopeGuard(
      [&] { before.isNull() ? qunsetenv("XDG_CONFIG_HOME") : qputenv("XDG_CONFIG_HOME", before); });
  QCOMPARE(
      runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(QStringLiteral("src/")))).status,
      0);
  folder.write(QStringLiteral("jobs"), listOf({piece(QStringLiteral("export"), QStringLiteral("d/"),
                                                     {{QStringLiteral("path"), QStringLiteral("src/")},
                                                      {QStringLiteral("deidentify"), true}})}));
  for (const char* end : {"done", "skipped"})
    QCOMPARE(endsIn(folder.batch().out), all(1, QLatin1String(end)));
  QVERIFY(QFile::remove(folder.at(QStringLiteral("config/volumen/deidentification.key"))));
  for (const char* end : {"done", "skipped"})
    QCOMPARE(endsIn(folder.batch().out), all(1, QLatin1String(end)));
}

void TestBatchStamps::otherFilesStay() {
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"), listOf({reportPiece(folder)}));
  folder.write(QStringLiteral("r.dcm"), "years of work");
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 1);
  QVERIFY2(a.out.contains("is there already, and no list made it"), a.out);
  QCOMPARE(lineIn(a.out, 1)[QStringLiteral("exit")].toInt(), 1);
  QCOMPARE(folder.contents(QStringLiteral("r.dcm")), QByteArray("years of work"));
}

// The folder that a list made is done again, but not over what somebody put into it.
void TestBatchStamps::otherFilesInFoldersStay() {
  const BatchFolder folder;
  const QString notes = QStringLiteral("d/notes.txt");
  folder.write(QStringLiteral("jobs"), listOf({piece(QStringLiteral("convert"), QStringLiteral("d/"))}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  folder.write(notes, "mine");
  const Outcome a = folder.batch();
  QCOMPARE(a.status, 1);
  QVERIFY2(a.out.contains("no list made it or all that it holds"), a.out);
  QCOMPARE(folder.contents(notes), QByteArray("mine"));
  QVERIFY(QFile::remove(folder.at(notes)));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
}

void TestBatchStamps::filesOfFoldersHaveTheirNames() {
  const BatchFolder folder;
  const QString slice = QStringLiteral("d/slice-00001.dcm");
  folder.write(QStringLiteral("jobs"), listOf({piece(QStringLiteral("convert"), QStringLiteral("d/"))}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  QVERIFY(QFile::remove(folder.at(slice)));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  QVERIFY(QFile::exists(folder.at(slice)));
}

void TestBatchStamps::failuresKeepWhatIsThere() {
  const BatchFolder folder;
  const QJsonObject good = smallPicture(QStringLiteral("a.png"));
  QJsonObject bad = good;
  bad[QStringLiteral("size")] = QStringLiteral("many");
  folder.write(QStringLiteral("jobs"), listOf({good}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("done")));
  folder.write(QStringLiteral("jobs"), listOf({bad}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("failed")));
  folder.write(QStringLiteral("jobs"), listOf({good}));
  QCOMPARE(endsIn(folder.batch().out), all(1, QStringLiteral("skipped")));
}

void TestBatchStamps::lossesAreToldAgain() {
  const BatchFolder folder;
  const QString source = QStringLiteral("src/");
  QCOMPARE(runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, folder.at(source))).status, 0);
  QVERIFY(QFile::resize(folder.at(QStringLiteral("src/slice-00005.dcm")), 600));
  folder.write(QStringLiteral("jobs"), listOf({smallPicture(QStringLiteral("a.png"), source)}));
  QJsonArray said;
  for (const char* end : {"done", "skipped"}) {
    const Outcome a = folder.batch();
    QCOMPARE(a.status, 3);
    const QJsonObject line = lineIn(a.out, 1);
    QCOMPARE(line[QStringLiteral("end")].toString(), QString::fromLatin1(end));
    QCOMPARE(line[QStringLiteral("exit")].toInt(), 3);
    if (said.isEmpty()) said = line[QStringLiteral("warnings")].toArray();
    QVERIFY(!said.isEmpty());
    QCOMPARE(line[QStringLiteral("warnings")].toArray(), said);
  }
}

VOLUMEN_TEST(TestBatchStamps);
#include "tst_batch_stamps.moc"
