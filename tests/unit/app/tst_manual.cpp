// Guards design.md 4: the manual page and each --help describe the real options, and their examples run.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

const char* const commands[] = {
    "open",          "render",       "slice",           "info",         "import",
    "list",          "archive",      "archive list",    "archive test", "archive query",
    "archive fetch", "archive keep", "archive receive", "forget",       "convert",
    "export",        "segment",      "compare",         "measure",      "accuracy",
    "bench",         "batch"};

/// Returns the manual page without markup.
QString manual() {
  QString text = QString::fromUtf8(contentsOf(QStringLiteral(VOLUMEN_SOURCE_DIR "/resources/man/volumen.1")));
  text.remove(QRegularExpression(QStringLiteral("\\\\f[BIR]")));
  return text.replace(QLatin1String("\\-"), QLatin1String("-"));
}

QString helpOf(const QString& command) {
  return QString::fromUtf8(
      runProgram(command.split(QLatin1Char(' ')) + QStringList{QStringLiteral("--help")}).out);
}

/// Returns the options of a help text with their values: "-o,--output FILE", "--view anterior|posterior|...".
QStringList optionsIn(const QString& help) {
  QStringList options;
  // The description follows the option after two spaces or a line break.
  const QRegularExpression option(QStringLiteral("^  (-\\S+( \\S+)*)(  |$)"),
                                  QRegularExpression::MultilineOption);
  for (auto it = option.globalMatch(help); it.hasNext();) options << it.next().captured(1);
  return options;
}

QStringList examplesIn(const QString& text) {
  QStringList examples;
  const qsizetype from = text.lastIndexOf(QRegularExpression(QStringLiteral("Examples:|\\.SH EXAMPLES")));
  const QRegularExpression line(QStringLiteral("^ *volumen (.*)$"), QRegularExpression::MultilineOption);
  if (from < 0) return examples;
  for (auto it = line.globalMatch(text, from); it.hasNext();) examples << it.next().captured(1);
  return examples;
}

QStringList keysOf(const QJsonValue& value) {
  QStringList keys;
  if (value.isArray())
    for (const QJsonValue& element : value.toArray()) keys << keysOf(element);
  for (const QString& key : value.toObject().keys()) keys << key << keysOf(value.toObject()[key]);
  return keys;
}

}  // namespace

class TestManual : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void manualHasEveryOption_data();
  void manualHasEveryOption();
  void manualHasNoOtherOption();
  void manualHasTheFieldsOfAScene();
  void helpEndsWithTwoExamples_data();
  void helpEndsWithTwoExamples();
  void examplesRun_data();
  void examplesRun();

 private:
  QTemporaryDir folder_;
  QrPeer peer_;
};

/// Makes the files that examples name: a study in scans/, scene.json, shapes.json, bone.png (a picture that
/// holds a scene), segments in first.seg.nrrd and second.seg.nrrd. The index has two studies, of which the
/// second is forgotten. If dcmqrscp is installed, an archive called main has study 1.2.3, which is then
/// fetched.
void TestManual::initTestCase() {
  const auto made = [&](const char* line) {
    return runProgram(QString::fromLatin1(line).replace(QLatin1String("IN"), folder_.path())).status;
  };
  QCOMPARE(made("convert phantom:ct-head:24 -o IN/scans/"), 0);
  QCOMPARE(made("render phantom:ct-head:24 --size 16x16 -o IN/bone.png"), 0);
  QCOMPARE(made("convert phantom:ct-head:24 -o IN/chest.nii.gz"), 0);
  QCOMPARE(made("segment phantom:ct-head:24 --range 200: -o IN/first.seg.nrrd"), 0);
  QCOMPARE(made("segment phantom:ct-head:24 --range 300: -o IN/second.seg.nrrd"), 0);
  qputenv("XDG_DATA_HOME", folder_.filePath(QStringLiteral("data")).toUtf8());
  QCOMPARE(made("import IN/scans/"), 0);
  QCOMPARE(made("import IN/chest.nii.gz"), 0);
  QCOMPARE(made("forget 2"), 0);
  const auto write = [&](const char* name, const QByteArray& text) {
    QFile file(folder_.filePath(QLatin1String(name)));
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size();
  };
  QVERIFY(write("scene.json", "{}") && write("jobs.jsonl", ""));
  QVERIFY(write("shapes.json", R"([{"kind": "length", "points": [[0, 0, 0], [10, 0, 0]]}])"));
  qputenv("XDG_CONFIG_HOME", folder_.path().toUtf8());
  QVERIFY(QDir(folder_.path()).mkdir(QStringLiteral("volumen")));
  DicomPicture picture{.seriesUid = "1.2.3.1"};
  picture.edit = [](DcmDataset& data) { data.putAndInsertString(DCM_StudyInstanceUID, "1.2.3"); };
  const QString archived = folder_.filePath(QStringLiteral("archived.dcm"));
  writeDicom(archived.toStdString(), picture);
  peer_.add({archived});
  if (QrPeer::isInstalled()) QVERIFY(peer_.start());
  const QByteArray archives =
      R"({"archives": [{"name": "main", "kind": "dimse", "host": "localhost", "port": )" +
      QByteArray::number(peer_.port()) + R"(, "calledAe": "ARCH"}]})";
  QVERIFY(write("archives.json", archives) && write("volumen/archives.json", archives));
  if (QrPeer::isInstalled()) QCOMPARE(made("archive fetch main 1.2.3"), 0);
}

void TestManual::manualHasEveryOption_data() {
  QTest::addColumn<QString>("help");
  QTest::newRow("volumen") << QString::fromUtf8(runProgram(QStringLiteral("--help")).out);
  for (const char* command : commands) QTest::newRow(command) << helpOf(QString::fromLatin1(command));
}

void TestManual::manualHasEveryOption() {
  QFETCH(QString, help);
  const QStringList options = optionsIn(help);
  QVERIFY(!options.isEmpty());
  const QString page = manual();
  for (const QString& option : options)
    QVERIFY2(page.contains(QLatin1Char(' ') + option + QLatin1Char('\n')), qPrintable(option));
}

void TestManual::manualHasNoOtherOption() {
  // --in-process is for debugging, so no help shows it.
  QString helps =
      QStringLiteral("--in-process") + QString::fromUtf8(runProgram(QStringLiteral("--help")).out);
  for (const char* command : commands) {
    helps += helpOf(QString::fromLatin1(command));
    QVERIFY2(manual().contains(QStringLiteral(".SS ") + QLatin1String(command)), command);
  }
  const QRegularExpression option(QStringLiteral("--[a-z][a-z-]+"));
  const QString page = manual();
  for (auto it = option.globalMatch(page); it.hasNext();) {
    const QString name = it.next().captured();
    QVERIFY2(helps.contains(name), qPrintable(name));
  }
}

void TestManual::manualHasTheFieldsOfAScene() {
  const Outcome a =
      runProgram(QStringLiteral("render phantom:ct-head:24 --preset CT-MIP --size 8x8 --print-scene"));
  const QStringList fields = keysOf(QJsonDocument::fromJson(a.out).object());
  QVERIFY(fields.size() > 30);
  const QString page = manual();
  const QString scene = page.mid(page.indexOf(QLatin1String(".SH SCENE FILE")));
  for (const QString& field : fields)
    QVERIFY2(scene.contains(QRegularExpression(QStringLiteral("\\b%1\\b").arg(field))), qPrintable(field));
}

void TestManual::helpEndsWithTwoExamples_data() { manualHasEveryOption_data(); }

void TestManual::helpEndsWithTwoExamples() {
  QFETCH(QString, help);
  QCOMPARE(examplesIn(help).size(), 2);
}

void TestManual::examplesRun_data() {
  QTest::addColumn<QString>("line");
  QStringList all =
      examplesIn(manual()) + examplesIn(QString::fromUtf8(runProgram(QStringLiteral("--help")).out));
  for (const char* command : commands) all << examplesIn(helpOf(QString::fromLatin1(command)));
  all.removeDuplicates();
  for (const QString& line : all) QTest::newRow(qPrintable(line)) << line;
}

// Runs examples in a folder with their files, at sizes that draw at once. There is no display for those that
// open the window, and nothing to listen at for those that receive.
void TestManual::examplesRun() {
  QFETCH(QString, line);
  QStringList words = QProcess::splitCommand(line);
  if (words[0] == QLatin1String("archive") && !QrPeer::isInstalled())
    QSKIP("dcmqrscp is not installed (package dcmtk)");
  const bool opens = words[0] == QLatin1String("open") || words.size() == 1;
  if (words[0] == QLatin1String("render") || words[0] == QLatin1String("bench"))
    words << QStringLiteral("--threads") << QStringLiteral("2");
  if (words[0] == QLatin1String("accuracy") && !words.contains(QLatin1String("--knob")))
    words << QStringLiteral("--knob") << QStringLiteral("step") << QStringLiteral("--size")
          << QStringLiteral("32x32") << QStringLiteral("--frames") << QStringLiteral("1");
  const bool receives = words.contains(QLatin1String("receive"));
  const Outcome a = runProgramIn(folder_.path(), words);
  QVERIFY2(a.status == (opens || receives ? 1 : 0), a.err);
  QCOMPARE(a.err.contains("No display"), opens);
  QCOMPARE(a.err.contains("does not say where to listen"), receives);
}

VOLUMEN_TEST(TestManual);
#include "tst_manual.moc"
