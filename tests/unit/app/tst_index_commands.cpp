// Guards design.md 4 and import.md: the commands of the index as users type them.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "io/export/dicom_series.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

class TestIndexCommands : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void importSaysWhatItDid();
  void importIsJson();
  void listShowsStudies();
  void listShowsSeries();
  void listIsJson();
  void datesAreIso_data();
  void datesAreIso();
  void listIsSafeForATerminal();
  void forgetAndUndo();
  void copiesAreManaged();
  void copiesOfTwoFilesAreRefused();
  void studiesAreOpenedByTheirNames();
  void copiesMoveWithTheirIndex();
  void failures_data();
  void failures();

 private:
  QString at(const char* name) const { return folder_->filePath(QString::fromLatin1(name)); }
  Outcome run(const char* line) const {
    QStringList words;
    for (const QString& word : QString::fromUtf8(line).split(QLatin1Char(' ')))
      words << (word.startsWith(QLatin1String("IN/")) ? at(qPrintable(word.mid(3))) : word);
    if (words.front() != QStringLiteral("info")) words << QStringLiteral("--index") << at("index");
    return runProgram(words);
  }
  std::unique_ptr<QTemporaryDir> folder_;
};

// Makes a study of DICOM files in scans/ and a volume of another format.
void TestIndexCommands::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  QCOMPARE(runProgram({QStringLiteral("convert"), QStringLiteral("phantom:sphere:8"), QStringLiteral("-o"),
                       at("scans/")})
               .status,
           0);
  QCOMPARE(runProgram({QStringLiteral("convert"), QStringLiteral("phantom:sphere:8"), QStringLiteral("-o"),
                       at("ball.nrrd")})
               .status,
           0);
}

void TestIndexCommands::importSaysWhatItDid() {
  const Outcome first = run("import IN/scans IN/ball.nrrd");
  QVERIFY2(first.status == 0, first.err);
  QCOMPARE(first.out, QByteArray("9 files: 9 new, 0 changed, 0 unchanged, 0 gone, 0 refused\n"));
  QCOMPARE(first.err, QByteArray());
  const QDir scans(at("scans"));
  QVERIFY(QFile::copy(scans.filePath(scans.entryList(QDir::Files)[0]), at("scans/bad.dcm")));
  QVERIFY(QFile::resize(at("scans/bad.dcm"), QFile(at("scans/bad.dcm")).size() - 9));
  const Outcome again = run("import IN/scans");
  QCOMPARE(again.status, 3);
  QVERIFY2(again.out.startsWith("9 files: 0 new, 0 changed, 8 unchanged, 0 gone, 1 refused\n  " +
                                at("scans/bad.dcm").toUtf8() + ": "),
           again.out);
}

void TestIndexCommands::importIsJson() {
  const QJsonObject report = QJsonDocument::fromJson(run("import IN/scans --json").out).object();
  QCOMPARE(report[QStringLiteral("new")].toInt(), 8);
  QCOMPARE(report[QStringLiteral("files")].toInt(), 8);
  QCOMPARE(report[QStringLiteral("refused")].toArray().size(), 0);
  QCOMPARE(report[QStringLiteral("cancelled")].toBool(true), false);
}

void TestIndexCommands::listShowsStudies() {
  const Outcome none = run("list");
  QCOMPARE(none.status, 1);
  QVERIFY2(none.out.isEmpty() && none.err.contains("There is no index in"), none.err);
  QVERIFY2(!QDir(at("index")).exists(), "looking makes none");
  run("import IN/scans IN/ball.nrrd");
  const QList<QByteArray> lines = run("list").out.split('\n');
  QCOMPARE(lines.size(), 4);  // heads, two studies, the end
  QVERIFY(lines[0].startsWith("No.  Patient"));
  QCOMPARE(lines[0].indexOf("Modality"),
           lines[1].indexOf("OT") >= 0 ? lines[1].indexOf("OT") : lines[2].indexOf("OT"));
  QVERIFY(run("list ball").out.contains("ball.nrrd"));
  QCOMPARE(run("list BALL nothing").out, QByteArray());
}

void TestIndexCommands::listShowsSeries() {
  run("import IN/scans");
  const QList<QByteArray> lines = run("list --series").out.split('\n');
  QCOMPARE(lines.size(), 3);
  QVERIFY(lines[0].contains("Frames"));
}

void TestIndexCommands::listIsJson() {
  run("import IN/scans");
  const QJsonObject all = QJsonDocument::fromJson(run("list --series --json").out).object();
  const QJsonObject study = all[QStringLiteral("studies")].toArray()[0].toObject();
  QCOMPARE(study[QStringLiteral("images")].toInt(), 8);
  QCOMPARE(study[QStringLiteral("patient")].toObject()[QStringLiteral("name")].toString(),
           QStringLiteral("Volumen^Sample"));
  const QJsonObject series = study[QStringLiteral("series")].toArray()[0].toObject();
  QCOMPARE(series[QStringLiteral("frames")].toInt(), 8);
  QCOMPARE(series[QStringLiteral("isVolume")].toBool(), true);
}

void TestIndexCommands::datesAreIso_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QStringList>("field");
  QTest::addColumn<QString>("date");
  const auto row = [](const char* name, const char* command, const char* field, const char* date) {
    QTest::newRow(name) << QString::fromLatin1(command) << QString::fromLatin1(field).split(QLatin1Char(' '))
                        << QString::fromLatin1(date);
  };
  row("study of info", "info IN/dated --json", "volumes 0 study date", "2026-03-14");
  row("birth of info", "info IN/dated --json", "volumes 0 patient birthDate", "1961-12-05");
  row("study of list", "list --json", "studies 0 date", "2026-03-14");
  row("series of list", "list --series --json", "studies 0 series 0 date", "2026-03-14");
  row("birth of list", "list --json", "studies 0 patient birthDate", "1961-12-05");
}

void TestIndexCommands::datesAreIso() {
  QFETCH(QString, command);
  QFETCH(QStringList, field);
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.modality = "CT";
  tags.patientBirthDate = "19611205", tags.studyDate = "20260314";
  const Result<VolumePtr> volume = makePhantom("sphere:8");
  QVERIFY(volume && writeDicomSeries(**volume, tags, at("dated").toStdString()));
  QCOMPARE(run("import IN/dated").status, 0);
  QJsonValue value = QJsonDocument::fromJson(run(qPrintable(command)).out).object();
  for (const QString& step : field)
    value = value.isArray() ? value.toArray()[step.toInt()] : value.toObject()[step];
  QTEST(value.toString(), "date");
}

void TestIndexCommands::listIsSafeForATerminal() {
  const QString odd = QDir(folder_->path()).filePath(QStringLiteral("a\x1b[31m.nrrd"));
  QVERIFY(QFile::rename(at("ball.nrrd"), odd));
  QCOMPARE(runProgram({QStringLiteral("import"), odd, QStringLiteral("--index"), at("index")}).status, 0);
  const Outcome list = run("list");
  QVERIFY2(list.out.contains("a\\x1b[31m.nrrd") && !list.out.contains('\x1b'), list.out);
}

void TestIndexCommands::forgetAndUndo() {
  run("import IN/scans IN/ball.nrrd");
  const QByteArray before = run("list").out;
  const Outcome forgot = run("forget 1");
  QCOMPARE(forgot.out, QByteArray("Forgot 1 study\n"));
  QCOMPARE(run("list").out.count('\n'), 2);
  QCOMPARE(run("forget 1").status, 1);
  QCOMPARE(run("forget --undo").out, QByteArray("Brought back 1 study\n"));
  QCOMPARE(run("list").out, before);
  QCOMPARE(run("forget --undo").status, 1);
  const QJsonObject all = QJsonDocument::fromJson(run("list --json").out).object();
  for (const QJsonValue& study : all[QStringLiteral("studies")].toArray())
    if (const QString uid = study[QStringLiteral("studyUid")].toString(); !uid.isEmpty())
      QCOMPARE(run(qPrintable(QStringLiteral("forget ") + uid)).status, 0);
  QCOMPARE(run("list").out.count('\n'), 2);
  QVERIFY(QDir(at("scans")).count() > 8);  // no file was deleted
}

void TestIndexCommands::copiesAreManaged() {
  const Outcome copied = run("import IN/scans IN/ball.nrrd --copy");
  QVERIFY2(copied.status == 0 && copied.out.contains(" 9 new"), copied.out + copied.err);
  QVERIFY(QDir(at("scans")).removeRecursively());
  const QJsonObject all = QJsonDocument::fromJson(run("list --json").out).object();
  QCOMPARE(all[QStringLiteral("studies")].toArray().size(), 2);
  for (const QJsonValue& study : all[QStringLiteral("studies")].toArray())
    QCOMPARE(study[QStringLiteral("offline")].toBool(true), false);
  // Existing copies are not copied again.
  QVERIFY(run("import IN/ball.nrrd --copy").out.contains(" 0 new, 0 changed, 1 unchanged"));
  const Outcome info = runProgram({QStringLiteral("info"), at("index/studies"), QStringLiteral("--json")});
  QCOMPARE(QJsonDocument::fromJson(info.out).object()[QStringLiteral("volumes")].toArray().size(), 2);
}

void TestIndexCommands::copiesOfTwoFilesAreRefused() {
  QFile header(at("two.nhdr"));
  QVERIFY(header.open(QIODevice::WriteOnly));
  header.write(
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 1\nspacings: 1 1 1\nencoding: raw\ndata file: "
      "v.raw\n\n");
  header.close();
  QFile data(at("v.raw"));
  QVERIFY(data.open(QIODevice::WriteOnly));
  data.write("abcd");
  data.close();
  const Outcome copied = run("import IN/two.nhdr --copy");
  QVERIFY2(copied.out.contains("another file: import it without copying"), copied.out);
  QVERIFY(run("import IN/two.nhdr").out.contains(" 1 new"));
}

// Opens index:STUDY[/SERIES] from the user's index, by UIDs and numbers.
void TestIndexCommands::studiesAreOpenedByTheirNames() {
  qputenv("XDG_DATA_HOME", folder_->path().toUtf8());
  const QStringList index{QStringLiteral("--index"), at("volumen")};
  const Outcome none = runProgram({QStringLiteral("info"), QStringLiteral("index:1")});
  QVERIFY2(none.status == 1 && none.err.contains("There is no index yet"), none.err);
  QVERIFY(!QDir(at("volumen")).exists());
  QCOMPARE(runProgram(QStringList{QStringLiteral("import"), at("scans"), at("ball.nrrd")} + index).status, 0);
  const Outcome list = runProgram(
      QStringList{QStringLiteral("list"), QStringLiteral("--series"), QStringLiteral("--json")} + index);
  QString study, series, number;
  for (const QJsonValue& s :
       QJsonDocument::fromJson(list.out).object()[QStringLiteral("studies")].toArray()) {
    const QJsonObject first = s[QStringLiteral("series")].toArray()[0].toObject();
    if (first[QStringLiteral("files")].toArray().size() != 8) continue;
    QVERIFY(first[QStringLiteral("files")].toArray()[0].toString().contains(QLatin1String("/scans/slice-")));
    study = s[QStringLiteral("studyUid")].toString();
    series = first[QStringLiteral("seriesUid")].toString();
    number = QString::number(s[QStringLiteral("number")].toInt());
  }
  QVERIFY(!study.isEmpty());
  for (const QString& path :
       {study, number, study + QLatin1Char('/') + series, number + QStringLiteral("/1")}) {
    const Outcome info =
        runProgram({QStringLiteral("info"), QStringLiteral("index:") + path, QStringLiteral("--json")});
    QVERIFY2(info.status == 0, info.err);
    const QJsonArray volumes =
        QJsonDocument::fromJson(info.out).object()[QStringLiteral("volumes")].toArray();
    QCOMPARE(volumes.size(), 1);
  }
  const Outcome slice = runProgram(
      {QStringLiteral("slice"), QStringLiteral("index:") + study, QStringLiteral("-o"), at("s.png")});
  QVERIFY2(slice.status == 0, slice.err);
  const Outcome wrong = runProgram({QStringLiteral("info"), QStringLiteral("index:77")});
  QVERIFY2(wrong.status == 1 && wrong.err.contains("holds no study \"77\""), wrong.err);
  const Outcome noSeries = runProgram({QStringLiteral("info"), QStringLiteral("index:%1/99").arg(study)});
  QVERIFY2(noSeries.status == 1 && noSeries.err.contains(series.toUtf8()), noSeries.err);
}

void TestIndexCommands::copiesMoveWithTheirIndex() {
  QCOMPARE(run("import IN/scans --copy").status, 0);
  QVERIFY(QDir(at("scans")).removeRecursively());
  QVERIFY(QDir().rename(at("index"), at("elsewhere")));
  const Outcome list = runProgram({QStringLiteral("list"), QStringLiteral("--series"),
                                   QStringLiteral("--json"), QStringLiteral("--index"), at("elsewhere")});
  const QJsonObject study =
      QJsonDocument::fromJson(list.out).object()[QStringLiteral("studies")].toArray()[0].toObject();
  QCOMPARE(study[QStringLiteral("offline")].toBool(true), false);
  const QJsonArray files =
      study[QStringLiteral("series")].toArray()[0].toObject()[QStringLiteral("files")].toArray();
  QCOMPARE(files.size(), 8);
  for (const QJsonValue& file : files) {
    QVERIFY2(file.toString().startsWith(at("elsewhere/studies/")), qPrintable(file.toString()));
    QVERIFY(QFile::exists(file.toString()));
  }
}

void TestIndexCommands::failures_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* line, const char* says) {
    QTest::newRow(line) << QString::fromLatin1(line) << QString::fromLatin1(says);
  };
  row("import IN/nowhere", "no such file or folder.");
  row("import phantom:cube", "phantom:cube: phantoms are made, not imported.");
  row("forget 77", "There is no study \"77\" in the index");
}

void TestIndexCommands::failures() {
  QFETCH(QString, line);
  QFETCH(QString, says);
  run("import IN/ball.nrrd");
  const Outcome a = run(qPrintable(line));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.startsWith("volumen: ") && a.err.contains(says.toUtf8()), a.err);
  QCOMPARE(a.err.count('\n'), 1);
}

VOLUMEN_TEST(TestIndexCommands);
#include "tst_index_commands.moc"
