// Guards import.md and design.md 4: the paths that commands accept as input and output.
#include <sys/stat.h>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <filesystem>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;
namespace fs = std::filesystem;

class TestPaths : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void cleanup();
  void whatIsNoFileIsASentence_data();
  void whatIsNoFileIsASentence();
  void linksOutAreToldNotFollowed();
  void linksInsideAreFollowed();
  void whatIsNotCompleteIsNotRead_data();
  void whatIsNotCompleteIsNotRead();
  void terminalsGetNoControls();
  void anyBytesNameAnOutput_data();
  void anyBytesNameAnOutput();
  void pipesAreNotReplaced_data();
  void pipesAreNotReplaced();
  void linksStayAndAreWrittenThrough_data();
  void linksStayAndAreWrittenThrough();
  void linksInACircleAreRefused();
  void pathsInJsonCanBeUsedAgain_data();
  void pathsInJsonCanBeUsedAgain();
  void planesOutsideAreRefused_data();
  void planesOutsideAreRefused();
  void packedSamplesAreRefusedByName();

 private:
  std::string at(const char* name) const { return folder_->path().toStdString() + "/" + name; }
  std::unique_ptr<QTemporaryDir> folder_;
};

void TestPaths::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  QCOMPARE(runProgram(QStringLiteral("convert phantom:sphere:8 -o %1/scans/").arg(folder_->path())).status,
           0);
}

// QTemporaryDir cannot remove names that are not UTF-8.
void TestPaths::cleanup() {
  for (const auto& entry : fs::directory_iterator(at(""))) fs::remove_all(entry.path());
}

void TestPaths::whatIsNoFileIsASentence_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("a pipe") << QStringLiteral("IN/pipe") << QByteArray("is a pipe");
  QTest::newRow("a device") << QStringLiteral("/dev/null") << QByteArray("is a device");
  QTest::newRow("an empty folder") << QStringLiteral("IN/empty") << QByteArray("No images found");
}

void TestPaths::whatIsNoFileIsASentence() {
  QFETCH(QString, path);
  QFETCH(QByteArray, says);
  QCOMPARE(mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_directory(at("empty"));
  path.replace(QLatin1String("IN"), folder_->path());
  for (const char* line : {"info %1 --json", "info %1", "convert %1 -o IN/a.nrrd"}) {
    const QString command = QString::fromLatin1(line).arg(path).replace(QLatin1String("IN"), folder_->path());
    const Outcome a = runProgram(command);
    QCOMPARE(a.status, 1);
    QVERIFY2(a.err.startsWith("volumen: ") && a.err.contains(says), a.err);
  }
}

void TestPaths::linksOutAreToldNotFollowed() {
  fs::create_directory_symlink("/", at("scans/disk"));
  const Outcome a = runProgram(QStringLiteral("info %1/scans --json").arg(folder_->path()));
  const QJsonObject found = QJsonDocument::fromJson(a.out).object();
  QCOMPARE(a.status, 0);
  QCOMPARE(found[QLatin1String("volumes")].toArray().size(), 1);
  QVERIFY(found[QLatin1String("other")].toArray().isEmpty());
  const QJsonArray refused = found[QLatin1String("refused")].toArray();
  QCOMPARE(refused.size(), 1);
  QVERIFY(refused[0][QLatin1String("path")].toString().endsWith(QLatin1String("/disk")));
  QVERIFY(refused[0][QLatin1String("reason")].toString().contains(QLatin1String("not followed")));
  QCOMPARE(runProgram(QStringLiteral("convert %1/scans -o %1/a.nrrd").arg(folder_->path())).status, 0);
}

// Follows links to a file anywhere, to a folder below the opened one, and to the opened one itself.
void TestPaths::linksInsideAreFollowed() {
  fs::create_directories(at("linked"));
  fs::rename(at("scans"), at("linked/scans"));
  fs::create_directories(at("elsewhere"));
  fs::rename(at("linked/scans/slice-00003.dcm"), at("elsewhere/file"));
  fs::create_symlink(at("elsewhere/file"), at("linked/scans/slice"));
  fs::create_directory_symlink(at("linked/scans"), at("linked/again"));
  fs::create_directory_symlink(at("linked"), at("link"));
  const Outcome a = runProgram(QStringLiteral("info %1/link --json").arg(folder_->path()));
  const QJsonObject found = QJsonDocument::fromJson(a.out).object();
  QVERIFY(found[QLatin1String("refused")].toArray().isEmpty());
  QCOMPARE(found[QLatin1String("volumes")][0][QLatin1String("dims")], QJsonValue(QJsonArray{8, 8, 8}));
}

void TestPaths::whatIsNotCompleteIsNotRead_data() {
  QTest::addColumn<QString>("moved");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("opened");
  QTest::addColumn<bool>("isRead");
  const QString all = QStringLiteral("scans"), slice = QStringLiteral("scans/slice-00001.dcm"),
                in = QStringLiteral("in"), half = QStringLiteral(".volumen-a1B2c3");
  QTest::newRow("a folder that is not complete") << all << half << in << false;
  QTest::newRow("a file that is not complete") << slice << half << in << false;
  QTest::newRow("a folder that is named itself") << all << half << in + QLatin1Char('/') + half << true;
  QTest::newRow("a longer name") << all << QStringLiteral(".volumen-mine-folder") << in << true;
  QTest::newRow("a shorter name") << slice << QStringLiteral(".volumen-a1B2c") << in << true;
  QTest::newRow("a dash in the name") << slice << QStringLiteral(".volumen-my-own") << in << true;
}

void TestPaths::whatIsNotCompleteIsNotRead() {
  QFETCH(QString, moved);
  QFETCH(QString, name);
  QFETCH(QString, opened);
  QFETCH(bool, isRead);
  const QDir folder(folder_->path());
  QVERIFY(folder.mkdir(QStringLiteral("in")) &&
          QDir().rename(folder.filePath(moved), folder.filePath(QStringLiteral("in/") + name)));
  const Outcome a = runProgram(QStringLiteral("info %1").arg(folder.filePath(opened)));
  QCOMPARE(a.status, isRead ? 0 : 1);
  QCOMPARE(a.err.contains("No images found"), !isRead);
}

void TestPaths::terminalsGetNoControls() {
  const std::string name = "a\x7f\xc2\x9b\xe2\x80\xae.txt";
  QFile file(QFile::decodeName(at("scans/").c_str()) + QString::fromStdString(name));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write("text");
  file.close();
  for (const char* line : {"info %1/scans --json", "info %1/scans --verbose"}) {
    const Outcome a = runProgram(QString::fromLatin1(line).arg(folder_->path()));
    QVERIFY(!a.out.contains('\x7f') && !a.out.contains("\xc2\x9b") && !a.out.contains("\xe2\x80\xae"));
    QVERIFY2(a.out.contains("7f"), a.out);
  }
  const Outcome json = runProgram(QStringLiteral("info %1/scans --json").arg(folder_->path()));
  const QJsonObject found = QJsonDocument::fromJson(json.out).object();
  QVERIFY(found[QLatin1String("other")][0][QLatin1String("path")].toString().endsWith(
      QString::fromStdString(name)));
}

void TestPaths::anyBytesNameAnOutput_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("ending");
  const auto row = [](const char* line, const char* ending) {
    QTest::newRow(line) << QString::fromLatin1(line) << QString::fromLatin1(ending);
  };
  row("render phantom:sphere:8 --size 8x8 -o", ".png");
  row("render phantom:sphere:8 --size 8x8 -o", ".nrrd");
  row("slice phantom:sphere:8 -o", ".png");
  row("convert phantom:sphere:8 -o", ".nii.gz");
  row("convert phantom:sphere:8 -o", "/");
  row("segment phantom:sphere:8 --range 0:9 -o", ".seg.nrrd");
}

// The two names would be equal if every byte that is not UTF-8 were replaced.
void TestPaths::anyBytesNameAnOutput() {
  QFETCH(QString, line);
  QFETCH(QString, ending);
  for (const char* name : {"M\xfcller", "M\xe4ller"}) {
    const std::string path = at(name) + ending.toStdString();
    // QProcess passes names as UTF-8, so the shell makes the bytes.
    std::string escaped;
    for (const unsigned char c : path) {
      char text[8];
      std::snprintf(text, sizeof text, "\\%03o", unsigned(c));
      escaped += text;
    }
    const std::string command =
        "exec " VOLUMEN_PROGRAM " " + line.toStdString() + " \"$(printf '" + escaped + "')\" > /dev/null";
    QCOMPARE(std::system(command.c_str()), 0);
    QVERIFY(fs::exists(path));
  }
  int entries = 0;
  for (const auto& entry : fs::directory_iterator(at("")))
    entries += entry.path().filename().string().starts_with("M") ? 1 : 0;
  QCOMPARE(entries, 2);
}

void TestPaths::pipesAreNotReplaced_data() {
  QTest::addColumn<QString>("line");
  for (const char* line :
       {"convert phantom:sphere:8 -o IN/pipe.nrrd", "slice phantom:sphere:8 -o IN/pipe.png",
        "render phantom:sphere:8 --size 8x8 --stats IN/pipe.json"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestPaths::pipesAreNotReplaced() {
  QFETCH(QString, line);
  for (const char* name : {"pipe.nrrd", "pipe.png", "pipe.json"}) QCOMPARE(mkfifo(at(name).c_str(), 0600), 0);
  const Outcome a = runProgram(line.replace(QLatin1String("IN"), folder_->path()));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("it is a pipe or a device"), a.err);
  for (const char* name : {"pipe.nrrd", "pipe.png", "pipe.json"}) QVERIFY(fs::is_fifo(at(name)));
}

void TestPaths::linksStayAndAreWrittenThrough_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("link");
  QTest::addColumn<QString>("leadsTo");
  QTest::addColumn<bool>("there");
  const auto row = [](const char* line, const char* link, const char* leadsTo) {
    for (const bool there : {false, true})
      QTest::addRow("%s, %s, %s", line, leadsTo, there ? "there" : "not there yet")
          << QString::fromLatin1(line) << QString::fromLatin1(link) << QString::fromLatin1(leadsTo) << there;
  };
  row("convert phantom:sphere:8 -o IN/link.nrrd", "link.nrrd", "other/a.nrrd");
  row("convert phantom:sphere:8 -o IN/link.nrrd", "link.nrrd", "IN/other/a.nrrd");
  row("slice phantom:sphere:8 -o IN/link.png", "link.png", "other/a.png");
  row("render phantom:sphere:8 --size 8x8 -o IN/a.png --stats IN/link.json", "link.json", "other/a.json");
  row("segment phantom:sphere:8 --range 0:9 -o IN/link.stl", "link.stl", "other/a.stl");
  row("segment phantom:sphere:8 --range 0:9 --csv IN/link.csv", "link.csv", "other/a.csv");
  row("convert phantom:sphere:8 -o IN/link/", "link", "other/folder");
}

void TestPaths::linksStayAndAreWrittenThrough() {
  QFETCH(QString, line);
  QFETCH(QString, link);
  QFETCH(QString, leadsTo);
  QFETCH(bool, there);
  const bool isFolder = line.endsWith(QLatin1Char('/'));
  leadsTo.replace(QLatin1String("IN"), folder_->path());
  const fs::path place = at(link.toUtf8().constData()), target = fs::path(at("")) / leadsTo.toStdString();
  fs::create_directory(at("other"));
  if (there && isFolder) fs::create_directory(target);
  if (there && !isFolder) QVERIFY(QFile(QString::fromStdString(target.string())).open(QIODevice::WriteOnly));
  fs::create_symlink(leadsTo.toStdString(), place);
  const Outcome a = runProgram(line.replace(QLatin1String("IN"), folder_->path()));
  QVERIFY2(a.status == 0, a.err);
  QVERIFY(fs::is_symlink(place));
  QVERIFY(!fs::is_symlink(target) && (isFolder ? !fs::is_empty(target) : fs::file_size(target) > 0));
  for (const auto& entry : fs::directory_iterator(at("other")))
    QVERIFY(!entry.path().filename().string().starts_with("."));
}

void TestPaths::linksInACircleAreRefused() {
  fs::create_symlink("b.nrrd", at("a.nrrd"));
  fs::create_symlink("a.nrrd", at("b.nrrd"));
  const Outcome a = runProgram(QStringLiteral("convert phantom:sphere:8 -o %1/a.nrrd").arg(folder_->path()));
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("its links lead in a circle"), a.err);
  QVERIFY(fs::is_symlink(at("a.nrrd")));
}

void TestPaths::pathsInJsonCanBeUsedAgain_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("list");  // array in the JSON
  QTest::newRow("info") << QStringLiteral("info IN --json") << QStringLiteral("volumes");
  QTest::newRow("refused") << QStringLiteral("info IN --json") << QStringLiteral("refused");
  QTest::newRow("import") << QStringLiteral("import IN --index IN --json") << QStringLiteral("refused");
  QTest::newRow("list") << QStringLiteral("list --series --json --index IN") << QStringLiteral("studies");
}

// The name has a Latin-1 byte, a percent sign and a space.
void TestPaths::pathsInJsonCanBeUsedAgain() {
  QFETCH(QString, line);
  QFETCH(QString, list);
  fs::create_directory(at("M\xfcller 5%41"));
  const std::string volume = at("M\xfcller 5%41/a.nrrd"), cut = at("M\xfcller 5%41/cut.nrrd");
  QCOMPARE(runProgram(QStringLiteral("convert phantom:sphere:8 -o %1/a.nrrd").arg(folder_->path())).status,
           0);
  fs::copy(at("a.nrrd"), cut);
  fs::rename(at("a.nrrd"), volume);
  fs::resize_file(cut, 40);
  if (line.startsWith(QLatin1String("list")))
    QCOMPARE(runProgram(QStringLiteral("import %1 --index %1").arg(folder_->path())).status, 3);
  const Outcome a = runProgram(line.replace(QLatin1String("IN"), folder_->path()));
  const QJsonArray found = QJsonDocument::fromJson(a.out)[list].toArray();
  QStringList paths;
  for (const QJsonValue& each : found) {
    paths << each[QStringLiteral("path")].toString();
    for (const QJsonValue& series : each[QStringLiteral("series")].toArray())
      paths << series[QStringLiteral("files")][0].toString();
  }
  const QStringList uris = paths.filter(QStringLiteral("file:///"));
  QVERIFY2(uris.size() == 1, a.out);
  QVERIFY2(uris[0].contains(QStringLiteral("/M%FCller%205%2541/")), qPrintable(uris[0]));
  const Outcome again = runProgram({QStringLiteral("info"), uris[0]});
  const bool isCut = list == QLatin1String("refused");
  QCOMPARE(again.status, isCut ? 1 : 0);
  QVERIFY2(
      (again.out + again.err).contains(isCut ? "cut.nrrd" : "a.nrrd") && !again.err.contains("no such file"),
      again.out + again.err);
}

void TestPaths::planesOutsideAreRefused_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<bool>("inside");
  const auto row = [](const char* options, bool inside) {
    QTest::newRow(options) << QString::fromLatin1(options) << inside;
  };
  row("--at 99999", false);
  row("--at -99999", false);
  row("--plane coronal --at 99999", false);
  row("--centre 0,0,99999", false);
  row("--at 99999 --slab 250000", true);
  row("--centre 99999,0,0 --size 8x8", true);  // beside the volume in its plane
  row("--at 0", true);
}

void TestPaths::planesOutsideAreRefused() {
  QFETCH(QString, options);
  QFETCH(bool, inside);
  const Outcome a =
      runProgram(QStringLiteral("slice phantom:sphere:8 %1 -o %2/a.png").arg(options, folder_->path()));
  QCOMPARE(a.status, inside ? 0 : 1);
  QCOMPARE(fs::exists(at("a.png")), inside);
  QVERIFY2(inside || (a.err.contains("outside of the volume") && a.err.contains(" mm.")), a.err);
}

void TestPaths::packedSamplesAreRefusedByName() {
  QFile file(QString::fromStdString(at("scans/slice-00003.dcm")));
  QVERIFY(file.open(QIODevice::ReadWrite));
  QByteArray bytes = file.readAll();
  const qsizetype allocated = bytes.indexOf(QByteArray("\x28\x00\x00\x01US\x02\x00", 8));
  QVERIFY(allocated > 0);
  bytes[allocated + 8] = 12;
  file.seek(0);
  file.write(bytes);
  file.close();
  const Outcome a = runProgram(QStringLiteral("convert %1/scans -o %1/a.nrrd").arg(folder_->path()));
  QCOMPARE(a.status, 3);
  QVERIFY2(a.err.contains("BitsAllocated is 12") && a.err.contains("slice-00003.dcm"), a.err);
}

VOLUMEN_TEST(TestPaths);
#include "tst_paths.moc"
