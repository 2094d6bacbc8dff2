// Guards import.md: a file beside the files of a series that may belong to it is a loss, whatever it
// contains. A file that is no slice by its name and kind is none. The index reports the same losses as the
// folder.
#include <sys/stat.h>

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <functional>
#include <utility>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

/// Changes the file of a slice.
using Change = std::function<void(const QString& path)>;

void overwrite(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  QCOMPARE(file.write(bytes), bytes.size());
}

QByteArray gzipped(const QByteArray& bytes) {
  QTemporaryDir folder;
  const QString plain = folder.filePath(QStringLiteral("x"));
  overwrite(plain, bytes);
  return QProcess::execute(QStringLiteral("gzip"), {plain}) == 0 ? contentsOf(plain + QStringLiteral(".gz"))
                                                                 : QByteArray();
}

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestPossibleLosses : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void whatMayBeASliceIsALoss_data();
  void whatMayBeASliceIsALoss();
  void neighboursAreNone_data();
  void neighboursAreNone();
  void theIndexKnowsOfThem_data();
  void theIndexKnowsOfThem();
  void theIndexForgetsWhatIsRepaired();
  void whatADirectoryListsIsMissed();

 private:
  QString at(const QString& name) const { return folder_->filePath(name); }
  QString slice() const { return at(QStringLiteral("scans/slice-00005.dcm")); }
  static Outcome convert(const QString& path, const QString& output, bool strict = false) {
    QStringList words{QStringLiteral("convert"), path, QStringLiteral("-o"), output};
    if (strict) words << QStringLiteral("--strict");
    return runProgram(words);
  }
  QStringList unread(const QString& path) const {
    const QByteArray json = runProgram({QStringLiteral("info"), path, QStringLiteral("--json")}).out;
    QStringList names;
    for (const auto& file :
         QJsonDocument::fromJson(json)[QLatin1String("volumes")][0][QLatin1String("unread")].toArray())
      names << file.toObject()[QLatin1String("path")].toString().section(QLatin1Char('/'), -1);
    return names;
  }
  std::unique_ptr<QTemporaryDir> folder_;
};

void TestPossibleLosses::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  qputenv("XDG_DATA_HOME", at(QStringLiteral("data")).toUtf8());
  QCOMPARE(convert(QStringLiteral("phantom:sphere:8"), at(QStringLiteral("scans/"))).status, 0);
}

namespace {

void addChanges() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("name");
  const auto row = [](const char* title, const Change& change, const char* name = "slice-00005.dcm") {
    QTest::newRow(title) << change << QString::fromLatin1(name);
  };
  row("cut off", [](const QString& path) { QVERIFY(QFile::resize(path, 1100)); });
  row("a link to nothing", [](const QString& path) {
    QVERIFY(QFile::remove(path) && QFile::link(QStringLiteral("../.git/annex/SHA256E-s1"), path));
  });
  row("a link to itself",
      [](const QString& path) { QVERIFY(QFile::remove(path) && QFile::link(path, path)); });
  row("a pipe", [](const QString& path) {
    QVERIFY(QFile::remove(path));
    QCOMPARE(mkfifo(path.toUtf8().constData(), 0600), 0);
  });
  row(
      "compressed",
      [](const QString& path) {
        overwrite(path + QStringLiteral(".gz"), gzipped(contentsOf(path)));
        QVERIFY(QFile::remove(path));
      },
      "slice-00005.dcm.gz");
  row("zeros", [](const QString& path) { overwrite(path, QByteArray(contentsOf(path).size(), 0)); });
  row("a damaged beginning",
      [](const QString& path) { overwrite(path, contentsOf(path).replace(0, 512, QByteArray(512, 0))); });
  row("a pointer of git-lfs", [](const QString& path) {
    overwrite(path, "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n");
  });
  row(
      "another number, without a suffix",
      [](const QString& path) {
        const QDir folder = QFileInfo(path).dir();
        for (const QFileInfo& file : folder.entryInfoList(QDir::Files))
          QVERIFY(QFile::rename(file.filePath(), folder.filePath(file.completeBaseName())));
        overwrite(path.chopped(4), "nothing");
      },
      "slice-00005");
}

}  // namespace

void TestPossibleLosses::whatMayBeASliceIsALoss_data() { addChanges(); }

void TestPossibleLosses::whatMayBeASliceIsALoss() {
  QFETCH(Change, change);
  QFETCH(QString, name);
  change(slice());
  const QString scans = at(QStringLiteral("scans")), out = at(QStringLiteral("a.nrrd"));
  const Outcome strict = convert(scans, out, true);
  QVERIFY2(strict.status == 1 && strict.err.contains(name.toUtf8()), strict.err);
  QVERIFY(!QFile::exists(out));
  const Outcome a = convert(scans, out);
  QVERIFY2(a.status == 3 && a.err.contains(name.toUtf8()) && !a.err.contains("missing"), a.err);
  QCOMPARE(unread(scans), QStringList{name});
  const QByteArray told =
      runProgram({QStringLiteral("info"), scans, QStringLiteral("--verbose")}).out.split('!').value(1);
  QVERIFY2(told.contains(name.toUtf8()), told);
}

void TestPossibleLosses::neighboursAreNone_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"README.txt", "slice-00005.png", "slice-00005.txt", "._slice-00005.dcm",
                           "Thumbs.db", "VERSION", "sub/notes.dcm"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

void TestPossibleLosses::neighboursAreNone() {
  QFETCH(QString, name);
  QVERIFY(QDir().mkpath(at(QStringLiteral("scans/sub"))));
  overwrite(at(QStringLiteral("scans/") + name), "This is no picture.");
  const Outcome a = convert(at(QStringLiteral("scans")), at(QStringLiteral("a.nrrd")), true);
  QVERIFY2(a.status == 0 && a.err.isEmpty(), a.err);
}

void TestPossibleLosses::theIndexKnowsOfThem_data() { addChanges(); }

void TestPossibleLosses::theIndexKnowsOfThem() {
  QFETCH(Change, change);
  QFETCH(QString, name);
  change(slice());
  for (int times = 0; times < 2; ++times) {
    const Outcome in = runProgram({QStringLiteral("import"), at(QStringLiteral("scans"))});
    QVERIFY2(in.status == 3 && in.out.contains(name.toUtf8()), in.err + in.out);
    const QString path = QStringLiteral("index:1"), out = at(QStringLiteral("a.nrrd"));
    const Outcome strict = convert(path, out, true);
    QVERIFY2(strict.status == 1 && strict.err.contains(name.toUtf8()), strict.err);
    QVERIFY(!QFile::exists(out));
    QCOMPARE(convert(path, out).status, 3);
    QVERIFY(QFile::remove(out));
    QCOMPARE(unread(path), QStringList{name});
    const QByteArray list = runProgram(QStringLiteral("list --series --json")).out;
    QVERIFY2(list.contains("could not be read"), list);
  }
}

void TestPossibleLosses::theIndexForgetsWhatIsRepaired() {
  const QByteArray whole = contentsOf(slice());
  QVERIFY(QFile::remove(slice()) && QFile::link(QStringLiteral("nowhere"), slice()));
  QCOMPARE(runProgram({QStringLiteral("import"), at(QStringLiteral("scans"))}).status, 3);
  QVERIFY(QFile::remove(slice()));
  overwrite(slice(), whole);
  const Outcome in = runProgram({QStringLiteral("import"), at(QStringLiteral("scans"))});
  QVERIFY2(in.status == 0 && in.out.contains("1 new"), in.out + in.err);
  const Outcome a = convert(QStringLiteral("index:1"), at(QStringLiteral("a.nrrd")), true);
  QVERIFY2(a.status == 0 && a.err.isEmpty(), a.err);
}

void TestPossibleLosses::whatADirectoryListsIsMissed() {
  NEED_DATA(dataPath());
  const QDir from(QString::fromStdString(dataPath("field-cases/c34-dicomdir-lower-case")));
  QDir to(at(QStringLiteral("disc")));
  QStringList slices;
  QDirIterator files(from.path(), QDir::Files, QDirIterator::Subdirectories);
  while (files.hasNext()) {
    const QString name = from.relativeFilePath(files.next());
    QVERIFY(QDir().mkpath(QFileInfo(to.filePath(name)).path()));
    QVERIFY(QFile::copy(from.filePath(name), to.filePath(name)));
    if (!name.startsWith(QLatin1String("dicomdir"))) slices << name;
  }
  slices.sort();
  for (const QString& path : {to.path(), to.filePath(QStringLiteral("dicomdir"))})
    QCOMPARE(convert(path, at(QStringLiteral("a.nrrd")), true).status, 0);
  QVERIFY(QFile::remove(to.filePath(slices.at(2))));
  for (const QString& path : {to.path(), to.filePath(QStringLiteral("dicomdir"))}) {
    const Outcome strict = convert(path, at(QStringLiteral("b.nrrd")), true);
    QVERIFY2(strict.status == 1 && strict.err.contains("dicomdir lists it, and it is not there"), strict.err);
    QCOMPARE(convert(path, at(QStringLiteral("a.nrrd"))).status, 3);
    QCOMPARE(unread(path).size(), 1);
  }
}

VOLUMEN_TEST(TestPossibleLosses);
#include "tst_possible_losses.moc"
