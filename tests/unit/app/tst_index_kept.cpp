// Guards import.md. An import that finds nothing or a damaged index says so. Its counts add up. Queries do
// not change the index.
#include <sys/stat.h>

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <functional>

#include "tests/fixtures/mount_disk.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

using Spoil = std::function<QByteArray(const QByteArray& whole)>;

class TestIndexKept : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void damagedIndexIsToldAndMendedByImport_data();
  void damagedIndexIsToldAndMendedByImport();
  void readOnlyIndexIsListed();
  void importThatFindsNothingSaysSo_data();
  void importThatFindsNothingSaysSo();
  void countsAddUp_data();
  void countsAddUp();
  void ownFilesArePassedOver();
  void copiesAreTheOwnersAlone();
  void relativeFoldersAreIgnored();

 private:
  void write(const char* name, const QByteArray& bytes) const {
    QFile file(at(name));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
  }
  QString at(const char* name) const { return folder_->filePath(QString::fromLatin1(name)); }
  Outcome run(const char* line) const {
    QStringList words;
    for (const QString& word : QString::fromUtf8(line).split(QLatin1Char(' ')))
      words << (word.startsWith(QLatin1String("IN/")) ? at(qPrintable(word.mid(3))) : word);
    return runProgram(words << QStringLiteral("--index") << at("index"));
  }
  std::unique_ptr<QTemporaryDir> folder_;
};

void TestIndexKept::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  QCOMPARE(runProgram({QStringLiteral("convert"), QStringLiteral("phantom:sphere:8"), QStringLiteral("-o"),
                       at("scans/")})
               .status,
           0);
}

void TestIndexKept::damagedIndexIsToldAndMendedByImport_data() {
  QTest::addColumn<Spoil>("spoil");
  const auto row = [](const char* name, Spoil spoil) { QTest::newRow(name) << spoil; };
  row("garbage", [](const QByteArray&) { return QByteArray(5000, 'x'); });
  row("nothing", [](const QByteArray&) { return QByteArray(); });
  row("half of it", [](const QByteArray& whole) { return whole.first(whole.size() / 2); });
  row("a table of another name",
      [](QByteArray whole) { return whole.replace("TABLE study(", "TABLE studx("); });
  row("a column of another name",
      [](QByteArray whole) { return whole.replace("patient_name TEXT", "patient_nane TEXT"); });
  row("a kind of file that is not known",
      [](QByteArray whole) { return whole.replace(44, 4, QByteArray("\0\0\0\7", 4)); });
  row("a form that is not written", [](QByteArray whole) { return whole.replace(18, 1, "\7"); });
}

void TestIndexKept::damagedIndexIsToldAndMendedByImport() {
  QFETCH(Spoil, spoil);
  run("import IN/scans");
  const QByteArray whole = contentsOf(at("index/index.sqlite")), damaged = spoil(whole);
  QVERIFY(damaged != whole);
  write("index/index.sqlite", damaged);
  const QStringList files = QDir(at("index")).entryList(QDir::Files);
  for (const char* line : {"list", "list --json", "list --series", "forget 1", "forget --undo"}) {
    const Outcome a = run(line);
    QCOMPARE(a.status, 1);
    QVERIFY2(a.err.contains("is damaged: `volumen import PATH` makes it anew.") && a.err.count('\n') == 1,
             a.err);
    QCOMPARE(a.out.isEmpty(), !QByteArray(line).contains("json"));
  }
  const QJsonObject told = QJsonDocument::fromJson(run("list --json").out).object();
  QVERIFY(told[QStringLiteral("problem")].toString().contains(QStringLiteral("is damaged")));
  QCOMPARE(contentsOf(at("index/index.sqlite")), damaged);
  QCOMPARE(QDir(at("index")).entryList(QDir::Files), files);
  const Outcome mended = run("import IN/scans --json");
  QCOMPARE(mended.status, 3);
  QVERIFY2(mended.err.contains("The index was damaged: it was renamed to "), mended.err);
  const QJsonObject report = QJsonDocument::fromJson(mended.out).object();
  QCOMPARE(report[QStringLiteral("new")].toInt(), 8);
  QVERIFY(
      report[QStringLiteral("warnings")][0].toString().startsWith(QStringLiteral("The index was damaged")));
  QCOMPARE(run("list").status, 0);
  QCOMPARE(run("import IN/scans").status, 0);
}

// The index may be on a read-only disk or belong to another user.
void TestIndexKept::readOnlyIndexIsListed() {
  QVERIFY(QDir().mkdir(at("index")));
  const QByteArray folder = at("index").toUtf8();
  MOUNT_DISK(folder.constData(), 0, "size=4m");
  run("import IN/scans");
  const Outcome before = run("list --series");
  mount("tmpfs", folder.constData(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr);
  const Outcome list = run("list --series"), forgot = run("forget 1"), import = run("import IN/scans");
  QCOMPARE(umount(folder.constData()), 0);
  QVERIFY2(list.status == 0 && list.err.isEmpty(), list.err);
  QCOMPARE(list.out, before.out);
  QVERIFY(list.out.contains("Volumen^Sample"));
  QVERIFY2(forgot.status == 1 && forgot.err.contains("it cannot be written"), forgot.err);
  QVERIFY2(import.status == 1 && import.err.contains("Cannot write to the folder"), import.err);
}

void TestIndexKept::importThatFindsNothingSaysSo_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* line, int status, const char* says) {
    QTest::newRow(line) << QString::fromLatin1(line) << status << QString::fromLatin1(says);
  };
  row("import IN/empty", 1, "/empty holds no files: is its disk there?");
  row("import IN/empty --copy", 1, "/empty holds no files: is its disk there?");
  row("import IN/texts", 1, "Nothing was imported: no image was found.");
  row("import IN/texts --copy", 1, "Nothing was imported: no image was found.");
  row("import IN/scans IN/empty", 3, "/empty holds no files: is its disk there?");
  row("import IN/scans IN/empty --copy", 3, "/empty holds no files: is its disk there?");
}

void TestIndexKept::importThatFindsNothingSaysSo() {
  QFETCH(QString, line);
  QFETCH(int, status);
  QFETCH(QString, says);
  QVERIFY(QDir().mkdir(at("empty")) && QDir().mkdir(at("texts")));
  write("texts/a.txt", "text");
  const Outcome a = run(qPrintable(line));
  QCOMPARE(a.status, status);
  QVERIFY2(a.err.startsWith("volumen: ") && a.err.contains(says.toUtf8()), a.err);
}

// Each found file is reported once, in the words of `info`, and again if nothing has changed.
void TestIndexKept::countsAddUp_data() {
  QTest::addColumn<QString>("options");
  QTest::newRow("by reference") << QString();
  QTest::newRow("by copies") << QStringLiteral(" --copy");
}

void TestIndexKept::countsAddUp() {
  QFETCH(QString, options);
  const QByteArray slice = contentsOf(at("scans/slice-00003.dcm"));
  write("scans/slice-00003.dcm", slice.first(slice.size() - 9));  // refused
  write("scans/slice-00004.dcm",
        slice.first(slice.lastIndexOf(QByteArray("\xe0\x7f\x10\x00", 4))));  // no pixels
  write("scans/slice-00099.dcm", "named as the slices are");
  write("scans/notes.txt", "text");
  write("scans/nothing", "");
  QVERIFY(QFile::link(at("nowhere"), at("scans/link")));
  const QJsonObject info =
      QJsonDocument::fromJson(runProgram({QStringLiteral("info"), at("scans"), QStringLiteral("--json")}).out)
          .object();
  const auto pathsIn = [](const QJsonValue& list) {
    QStringList paths;
    for (const QJsonValue& file : list.toArray()) paths << file[QStringLiteral("path")].toString();
    return paths.sort(), paths;
  };
  for (int times = 0; times < 2; ++times) {
    const Outcome a = run(qPrintable(QStringLiteral("import IN/scans --json") + options));
    const QJsonObject report = QJsonDocument::fromJson(a.out).object();
    const auto count = [&](const char* key) { return report[QLatin1String(key)].toInt(); };
    QCOMPARE(pathsIn(report[QStringLiteral("refused")]), pathsIn(info[QStringLiteral("refused")]));
    QCOMPARE(count("notImages"), int(info[QStringLiteral("other")].toArray().size()));
    QCOMPARE(count(times ? "unchanged" : "new"), 6);
    QCOMPARE(count("files"), count("new") + count("changed") + count("unchanged") + count("notImages") +
                                 int(report[QStringLiteral("refused")].toArray().size()));
    QCOMPARE(count("files"), 12);
  }
}

// The index is in the imported folder, as if a whole home folder were imported each night.
void TestIndexKept::ownFilesArePassedOver() {
  const QStringList line{QStringLiteral("import"), at("scans"), QStringLiteral("--index"), at("scans")};
  for (int times = 0; times < 2; ++times) {
    const Outcome a = runProgram(line);
    QVERIFY2(a.status == 0 && a.out.startsWith("8 files: ") && a.out.endsWith(" 0 refused\n"), a.out + a.err);
  }
  QVERIFY(runProgram(line + QStringList{QStringLiteral("--copy")}).out.contains(" 0 refused"));
}

void TestIndexKept::copiesAreTheOwnersAlone() {
  const mode_t before = umask(022);
  const Outcome copied = runProgram({QStringLiteral("import"), at("scans"), QStringLiteral("--copy"),
                                     QStringLiteral("--index"), at("made/here/index")});
  umask(before);
  QCOMPARE(copied.status, 0);
  int folders = 0;
  QDirIterator all(at("made"), QDir::Dirs | QDir::NoDotAndDotDot, QDirIterator::Subdirectories);
  for (; all.hasNext(); ++folders) {
    all.next();
    QVERIFY2(all.fileInfo().permissions() == (QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner |
                                              QFile::ReadUser | QFile::WriteUser | QFile::ExeUser),
             qPrintable(all.filePath()));
  }
  QVERIFY(folders >= 5);
}

// The XDG Base Directory Specification says that relative paths are invalid and ignored.
void TestIndexKept::relativeFoldersAreIgnored() {
  QVERIFY(QDir().mkdir(at("home")));
  const QByteArray home = qgetenv("HOME");
  qputenv("HOME", at("home").toUtf8());
  for (const char* name : {"XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"}) qputenv(name, "relative");
  const Outcome a = runProgramIn(folder_->path(), {QStringLiteral("import"), at("scans")});
  const Outcome info =
      runProgramIn(folder_->path(), {QStringLiteral("info"), QStringLiteral("phantom:ct-head:8")});
  for (const char* name : {"XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"}) qunsetenv(name);
  qputenv("HOME", home);
  QVERIFY2(a.status == 0 && info.status == 0, a.err + info.err);
  QVERIFY(QFile::exists(at("home/.local/share/volumen/index.sqlite")));
  QVERIFY(!QFile::exists(at("relative")));
}

VOLUMEN_TEST(TestIndexKept);
#include "tst_index_kept.moc"
