// Guards import.md: every command names unreadable parts of its series in words, in the picture's text and in
// JSON. It does not call them missing, and its exit status reports the loss.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

constexpr int slices = 26;

QString sliceName(int n) { return QStringLiteral("slice-%1.dcm").arg(n, 5, 10, QLatin1Char('0')); }

QJsonObject jsonOf(const QByteArray& text) { return QJsonDocument::fromJson(text).object(); }

}  // namespace

class TestLosses : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init();
  void everyCommandNamesThem_data();
  void everyCommandNamesThem();
  void atEveryPlace_data();
  void atEveryPlace();
  void pictureAndJsonHoldThem();
  void whatIsMissingIsStillMissing();
  void oneCount();
  void othersLossesAreNotTold();
  void framesTellThem();
  void wholeSeriesEndWithNothingToSay();

 private:
  QString at(const QString& name) const { return folder_->filePath(name); }
  QStringList words(const char* line) const {
    QStringList all;
    for (const QString& word : QString::fromLatin1(line).split(QLatin1Char(' ')))
      all << (word.startsWith(QLatin1String("IN/")) ? at(word.mid(3)) : word);
    return all;
  }
  void cut(int slice, qint64 bytes) const {
    QFile file(at(QStringLiteral("scans/") + sliceName(slice)));
    QVERIFY(file.resize(bytes));
  }
  QJsonObject volume() const {
    return jsonOf(runProgram(words("info IN/scans --json --values")).out)[QLatin1String("volumes")]
        .toArray()[0]
        .toObject();
  }

  QTemporaryDir whole_;
  std::unique_ptr<QTemporaryDir> folder_;
};

void TestLosses::initTestCase() {
  const QStringList made{QStringLiteral("convert"), QStringLiteral("phantom:ct-head:24"),
                         QStringLiteral("-o"), whole_.filePath(QStringLiteral("scans/"))};
  QCOMPARE(runProgram(made).status, 0);
}

void TestLosses::init() {
  folder_ = std::make_unique<QTemporaryDir>();
  QVERIFY(QDir().mkpath(at(QStringLiteral("scans"))));
  for (const QFileInfo& file : QDir(whole_.filePath(QStringLiteral("scans"))).entryInfoList(QDir::Files))
    QVERIFY(QFile::copy(file.filePath(), at(QStringLiteral("scans/") + file.fileName())));
  QFile shapes(at(QStringLiteral("shapes.json")));
  QVERIFY(shapes.open(QIODevice::WriteOnly));
  shapes.write("[]");
}

void TestLosses::everyCommandNamesThem_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<QString>("written");  // this output does not exist with --strict
  const auto row = [](const char* line, const char* written = "") {
    QTest::newRow(line) << QString::fromLatin1(line) << QString::fromLatin1(written);
  };
  row("convert IN/scans -o IN/a.nrrd", "a.nrrd");
  row("convert IN/scans -o IN/copy/", "copy");
  row("render IN/scans --size 16x16 -o IN/a.png", "a.png");
  row("slice IN/scans -o IN/a.png", "a.png");
  row("slice IN/scans --plane frame --index 2 -o IN/a.png", "a.png");
  row("segment IN/scans --range 0:100 -o IN/a.seg.nrrd", "a.seg.nrrd");
  row("measure IN/scans --roi IN/shapes.json");
  row("bench IN/scans --views 1 --rounds 1 --size 16x16");
}

void TestLosses::everyCommandNamesThem() {
  QFETCH(QString, line);
  QFETCH(QString, written);
  for (const int slice : {1, 5, 6, 12, slices}) cut(slice, 1100);
  const Outcome strict = runProgram(words(qPrintable(line + QStringLiteral(" --strict"))));
  QCOMPARE(strict.status, 1);
  QVERIFY2(strict.err.contains("--strict") && strict.out.isEmpty(), strict.err);
  QVERIFY(written.isEmpty() || !QFileInfo::exists(at(written)));
  const Outcome a = runProgram(words(qPrintable(line)));
  QVERIFY2(a.status == 3, a.err);
  for (const int slice : {1, 5, 6, 12, slices}) {
    QVERIFY2(a.err.contains(sliceName(slice).toUtf8()), a.err);
    QVERIFY2(strict.err.contains(sliceName(slice).toUtf8()), strict.err);
  }
  QVERIFY2(!a.err.contains("missing"), a.err);
  QVERIFY(written.isEmpty() || QFileInfo::exists(at(written)));
}

void TestLosses::atEveryPlace_data() {
  QTest::addColumn<int>("slice");
  QTest::addColumn<int>("bytes");
  for (const int slice : {1, 2, 12, slices - 1, slices})
    for (const int bytes : {0, 60, 131, 140, 300, 500, 700, 900, 1100})
      QTest::addRow("slice %d of %d bytes", slice, bytes) << slice << bytes;
}

void TestLosses::atEveryPlace() {
  QFETCH(int, slice);
  QFETCH(int, bytes);
  cut(slice, bytes);
  const Outcome a = runProgram(words("convert IN/scans -o IN/a.nrrd"));
  QVERIFY2(a.status == 3, a.err);
  QVERIFY2(a.err.contains(sliceName(slice).toUtf8()), a.err);
  QVERIFY2(!a.err.contains("missing"), a.err);
  const QJsonObject found = volume();
  const QJsonArray unread = found[QLatin1String("unread")].toArray();
  QCOMPARE(unread.size(), 1);
  QVERIFY(unread[0][QLatin1String("path")].toString().endsWith(sliceName(slice)));
  QVERIFY(!unread[0][QLatin1String("reason")].toString().isEmpty());
  const bool inside = slice > 1 && slice < slices;
  QCOMPARE(found[QLatin1String("regular")][QLatin1String("interpolatedSlices")].toInt(), inside ? 1 : 0);
}

void TestLosses::pictureAndJsonHoldThem() {
  cut(12, 1100);
  QCOMPARE(runProgram(words("render IN/scans --size 16x16 --stats IN/s.json -o IN/a.png")).status, 3);
  QCOMPARE(runProgram(words("slice IN/scans -o IN/b.png")).status, 3);
  for (const char* name : {"a.png", "b.png"}) {
    const QString text = QImage(at(QLatin1String(name))).text(QStringLiteral("volumen-warnings"));
    QVERIFY2(text.contains(QLatin1String("unread: ")) && text.contains(sliceName(12)), qPrintable(text));
  }
  const QByteArray segmented =
      runProgram(words("segment IN/scans --range 0:100 --json -o IN/a.seg.nrrd")).out;
  const QByteArray measured = runProgram(words("measure IN/scans --roi IN/shapes.json")).out;
  for (const QByteArray& json : {contentsOf(at(QStringLiteral("s.json"))), segmented, measured}) {
    const QJsonObject all = jsonOf(json);
    QCOMPARE(all[QLatin1String("unread")].toArray().size(), 1);
    QVERIFY(all[QLatin1String("warnings")].toArray()[0].toString().contains(sliceName(12)));
  }
  QCOMPARE(volume()[QLatin1String("warningKinds")].toArray(), QJsonArray{QStringLiteral("unread")});
}

// Two slices are missing, one of them because its file is damaged.
void TestLosses::whatIsMissingIsStillMissing() {
  cut(12, 1100);
  QVERIFY(QFile::remove(at(QStringLiteral("scans/") + sliceName(6))));
  const Outcome a = runProgram(words("convert IN/scans -o IN/a.nrrd"));
  QCOMPARE(a.status, 3);
  QVERIFY2(a.err.contains("2 slices are missing") && a.err.contains(sliceName(12).toUtf8()), a.err);
  QVERIFY(QFile::remove(at(QStringLiteral("scans/") + sliceName(12))));
  const Outcome gone = runProgram(words("convert IN/scans -o IN/a.nrrd"));
  QVERIFY2(gone.status == 0 && gone.err.contains("2 slices are missing"), gone.err);
}

void TestLosses::oneCount() {
  cut(12, 1100);
  const Outcome a = runProgram(words("convert IN/scans -o IN/a.nrrd"));
  QVERIFY2(a.err.contains("was interpolated") && a.err.contains("1 of them interpolated"), a.err);
}

// A damaged slice of another series in the same folder is a loss of that series.
void TestLosses::othersLossesAreNotTold() {
  QCOMPARE(runProgram(words("convert phantom:sphere:8 -o IN/others/")).status, 0);
  for (const QFileInfo& file : QDir(at(QStringLiteral("others"))).entryInfoList(QDir::Files))
    QVERIFY(QFile::copy(file.filePath(), at(QStringLiteral("scans/other-") + file.fileName())));
  QFile other(at(QStringLiteral("scans/other-") + sliceName(4)));
  QVERIFY(other.resize(other.size() - 40));
  const Outcome a = runProgram(words("convert IN/scans -o IN/a.nrrd"));
  QVERIFY2(a.status == 0 && !a.err.contains("could not be read"), a.err);
  QVERIFY(other.resize(200));  // now it could belong to either
  const Outcome b = runProgram(words("convert IN/scans -o IN/a.nrrd"));
  QVERIFY2(b.status == 3 && b.err.contains("beside the files of this series"), b.err);
}

void TestLosses::framesTellThem() {
  cut(12, 1100);
  const Outcome a = runProgram(words("slice IN/scans --plane frame -o IN/a.png"));
  QVERIFY2(a.status == 3 && a.err.contains(sliceName(12).toUtf8()), a.err);
}

void TestLosses::wholeSeriesEndWithNothingToSay() {
  const Outcome a = runProgram(words("convert IN/scans --strict -o IN/a.nrrd"));
  QCOMPARE(a.status, 0);
  QCOMPARE(a.err, QByteArray());
  QVERIFY(volume()[QLatin1String("unread")].toArray().isEmpty());
}

VOLUMEN_TEST(TestLosses);
#include "tst_losses.moc"
