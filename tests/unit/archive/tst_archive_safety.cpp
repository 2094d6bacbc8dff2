// Guards what is sent by DIMSE: the bytes of a data set as they lie in its file, in any transfer syntax, and
// nothing else; files that are damaged or made to do harm are refused in a sentence. What failed or was
// interrupted is told.
#include <signal.h>

#include <QElapsedTimer>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QStandardPaths>
#include <QTcpServer>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/taking_peer.h"
#include "tests/unit/archive/web_peer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveSafety : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void bytesAreSentAsTheyLieInTheFile_data();
  void bytesAreSentAsTheyLieInTheFile();
  void whatAPeerDoesNotTakeIsConverted_data();
  void whatAPeerDoesNotTakeIsConverted();
  void whatCannotBeReadIsRefused_data();
  void whatCannotBeReadIsRefused();
  void failuresAreInTheJson_data();
  void failuresAreInTheJson();
  void anInterruptedFetchSaysWhatIsKept();
  void aPortThatAMuteProgramHoldsIsFoundOut();
  void whatAReceiverFilesIsFetched();
  void hostileAnswersTakeLittleMemory_data();
  void hostileAnswersTakeLittleMemory();

 private:
  QString convertedBy(const char* tool, const QStringList& options);
  QString fileOf(const QByteArray& bytes);
  QString listOf(int port, const QByteArray& more = {});
  Outcome send(const TakingPeer& peer, const QString& path);
  QString moveListOf(const QrPeer& peer) {
    return listOf(peer.port(), R"(, "listen": {"port": )" + QByteArray::number(peer.ourPort()) + '}');
  }
  Outcome fetch(const QrPeer& peer, const QString& index);

  QTemporaryDir folder_;
  QString plain_;  // Explicit VR Little Endian
  int files_ = 0;
};

namespace {

constexpr const char *explicitLittle = "1.2.840.10008.1.2.1", *jpegLs = "1.2.840.10008.1.2.4.80";

QByteArray behindMeta(const QByteArray& file) { return file.mid(beginOfData(file)); }

// Sequences (0022,0011) within each other, in front of (0028,0002), behind all UIDs.
QByteArray nested(QByteArray file, int depth) {
  const QByteArray begin("\x22\0\x11\0SQ\0\0\xff\xff\xff\xff\xfe\xff\0\xe0\xff\xff\xff\xff", 20);
  const QByteArray end("\xfe\xff\x0d\xe0\0\0\0\0\xfe\xff\xdd\xe0\0\0\0\0", 16);
  return file.insert(file.indexOf(QByteArray("\x28\0\2\0US", 6)),
                     begin.repeated(depth) + end.repeated(depth));
}

QByteArray trailingPadding() {
  return QByteArray("\xfc\xff\xfc\xffOB\0\0\x40\0\0\0", 12) + QByteArray(64, '\0');
}

// Overwrites the end of the code stream, but for the last 16 bytes of the file.
QByteArray damaged(QByteArray file) {
  const qsizetype stream = file.lastIndexOf(QByteArray("\xff\xd8\xff", 3));
  const qsizetype count = (file.size() - 16 - stream) / 2;
  return file.replace(file.size() - 16 - count, count, QByteArray(count, '\xff'));
}

}  // namespace

void TestArchiveSafety::initTestCase() {
  if (QStandardPaths::findExecutable(QStringLiteral("dcmcjpls")).isEmpty())
    QSKIP("dcmcjpls is not installed (package dcmtk)");
  plain_ = writeArchived(folder_.path(), archivedStudies[0], 1);
}

QString TestArchiveSafety::convertedBy(const char* tool, const QStringList& options) {
  const QString path = folder_.filePath(QStringLiteral("%1.dcm").arg(++files_));
  return QProcess::execute(QLatin1String(tool), options + QStringList{plain_, path}) == 0 ? path : QString();
}

QString TestArchiveSafety::fileOf(const QByteArray& bytes) {
  const QString path = folder_.filePath(QStringLiteral("%1.dcm").arg(++files_));
  QFile file(path);
  return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() ? path : QString();
}

// A list of archives with one, "to".
QString TestArchiveSafety::listOf(int port, const QByteArray& more) {
  return fileOf(R"({"archives": [{"name": "to", "kind": "dimse", "host": "127.0.0.1", "port": )" +
                QByteArray::number(port) + R"(, "calledAe": "ARCH"}])" + more + '}');
}

Outcome TestArchiveSafety::send(const TakingPeer& peer, const QString& path) {
  return runProgram({QStringLiteral("archive"), QStringLiteral("send"), QStringLiteral("to"), path,
                     QStringLiteral("--archives"), listOf(peer.port()), QStringLiteral("--json")});
}

// Fetches the study of plain_ into an index, by C-MOVE.
Outcome TestArchiveSafety::fetch(const QrPeer& peer, const QString& index) {
  return runProgram({QStringLiteral("archive"), QStringLiteral("fetch"), QStringLiteral("to"),
                     QLatin1String(archivedStudies[0].uid), QStringLiteral("--archives"), moveListOf(peer),
                     QStringLiteral("--index"), folder_.filePath(index)});
}

void TestArchiveSafety::bytesAreSentAsTheyLieInTheFile_data() {
  QTest::addColumn<QByteArray>("file");
  QTest::addColumn<QByteArray>("sent");
  const auto row = [](const char* name, const QByteArray& file) {
    QTest::newRow(name) << file << behindMeta(file);
  };
  const QByteArray plain = contentsOf(plain_), packed = contentsOf(convertedBy("dcmcjpls", {}));
  row("Explicit VR Little Endian", plain);
  row("Implicit VR Little Endian", contentsOf(convertedBy("dcmconv", {QStringLiteral("+ti")})));
  row("Explicit VR Big Endian", contentsOf(convertedBy("dcmconv", {QStringLiteral("+tb")})));
  row("JPEG-LS", packed);
  row("group lengths and delimiters stay",
      contentsOf(convertedBy("dcmconv", {QStringLiteral("+g"), QStringLiteral("-e")})));
  row("a syntax that DCMTK does not know (HTJ2K)", renamed(packed, jpegLs, "1.2.840.10008.1.2.4.201"));
  row("named Implicit, encoded Explicit", renamed(plain, explicitLittle, "1.2.840.10008.1.2"));
  QTest::newRow("zeros behind it are not sent") << packed + QByteArray(77, '\0') << behindMeta(packed);
  QTest::newRow("DataSetTrailingPadding is not sent") << plain + trailingPadding() << behindMeta(plain);
  // Its length may be odd; a message's is even (PS3.5 A.5).
  const QByteArray deflated = contentsOf(convertedBy("dcmconv", {QStringLiteral("+td")}));
  QByteArray even = behindMeta(deflated);
  if (even.size() % 2) even += '\0';
  QTest::newRow("deflated") << deflated << even;
}

void TestArchiveSafety::bytesAreSentAsTheyLieInTheFile() {
  QFETCH(QByteArray, file);
  QFETCH(QByteArray, sent);
  QVERIFY(sent.size() > 100);
  const TakingPeer peer;
  const Outcome outcome = send(peer, fileOf(file));
  QVERIFY2(outcome.status == 0, outcome.err);
  QCOMPARE(peer.dataSets(), QByteArrayList{sent});
}

void TestArchiveSafety::whatAPeerDoesNotTakeIsConverted_data() {
  QTest::addColumn<QString>("path");
  QTest::newRow("JPEG-LS") << convertedBy("dcmcjpls", {});
  QTest::newRow("RLE") << convertedBy("dcmcrle", {});
  QTest::newRow("JPEG lossless") << convertedBy("dcmcjpeg", {});
  QTest::newRow("deflated") << convertedBy("dcmconv", {QStringLiteral("+td")});
  QTest::newRow("Implicit VR Little Endian") << convertedBy("dcmconv", {QStringLiteral("+ti")});
  QTest::newRow("Explicit VR Big Endian") << convertedBy("dcmconv", {QStringLiteral("+tb")});
}

void TestArchiveSafety::whatAPeerDoesNotTakeIsConverted() {
  QFETCH(QString, path);
  const TakingPeer peer({explicitLittle});
  const Outcome outcome = send(peer, path);
  QVERIFY2(outcome.status == 0, outcome.err);
  QCOMPARE(peer.dataSets().size(), 1);
  const QByteArray plain = contentsOf(plain_);
  const Instance arrived = instanceIn(fileOf(plain.left(beginOfData(plain)) + peer.dataSets().first()));
  QVERIFY(!arrived.pixels.empty());
  QVERIFY(arrived == instanceIn(plain_));
}

void TestArchiveSafety::whatCannotBeReadIsRefused_data() {
  QTest::addColumn<QByteArray>("file");
  QTest::addColumn<QString>("reason");
  const QByteArray plain = contentsOf(plain_), packed = contentsOf(convertedBy("dcmcjpls", {}));
  QTest::newRow("sequences that are nested 200,000 times")
      << nested(plain, 200000) << QStringLiteral("nested deeper than 64 levels");
  QTest::newRow("pixels that are cut off") << plain.chopped(6) << QStringLiteral("its pixels are cut off");
  QTest::newRow("compressed pixels that are cut off") << packed.chopped(12) << QStringLiteral("cut off");
  QTest::newRow("text behind the pixels") << packed + "and what else I have to say"
                                          << QStringLiteral("something else than elements behind its pixels");
  QTest::newRow("compressed pixels named uncompressed")
      << renamed(packed, jpegLs, explicitLittle) << QStringLiteral("its pixels are compressed, but");
  QTest::newRow("a code stream that is no picture, where only others are taken")
      << damaged(packed) << QStringLiteral("and it cannot be decompressed");
}

void TestArchiveSafety::whatCannotBeReadIsRefused() {
  QFETCH(QByteArray, file);
  QFETCH(QString, reason);
  const TakingPeer peer({explicitLittle});
  const Outcome outcome = send(peer, fileOf(file));
  QCOMPARE(outcome.status, 1);
  const QJsonObject told = QJsonDocument::fromJson(outcome.out).object();
  const QString why = told[u"failed"][0][u"reason"].toString();
  QVERIFY2(why.contains(reason), qPrintable(why));
  QVERIFY(peer.dataSets().isEmpty());
}

void TestArchiveSafety::failuresAreInTheJson_data() {
  QTest::addColumn<QStringList>("words");
  QTest::addColumn<QString>("empty");  // what a script reads of an empty result
  const QString none = QStringLiteral("none");
  QTest::newRow("query") << QStringList{QStringLiteral("query"), none} << QStringLiteral("studies");
  QTest::newRow("fetch") << QStringList{QStringLiteral("fetch"), none, QStringLiteral("1.2")}
                         << QStringLiteral("fetched");
  QTest::newRow("send") << QStringList{QStringLiteral("send"), none, folder_.path()}
                        << QStringLiteral("sent");
}

void TestArchiveSafety::failuresAreInTheJson() {
  QFETCH(QStringList, words);
  QFETCH(QString, empty);
  const Outcome outcome = runProgram(
      QStringList{QStringLiteral("archive")} + words +
      QStringList{QStringLiteral("--archives"), fileOf(R"({"archives": []})"), QStringLiteral("--json")});
  QCOMPARE(outcome.status, 1);
  const QJsonObject told = QJsonDocument::fromJson(outcome.out).object();
  QVERIFY(told.contains(empty));
  QVERIFY(told[u"problem"].toString().startsWith(u"No archive is set up"));
  QCOMPARE(outcome.err, "volumen: " + told[u"problem"].toString().toUtf8() + '\n');
}

void TestArchiveSafety::anInterruptedFetchSaysWhatIsKept() {
  std::atomic<bool> isConnected{false};
  const FakePeer mute([&](QTcpSocket& socket) {
    isConnected = true;
    socket.waitForDisconnected(20000);
  });
  QProcess process;
  process.start(QStringLiteral(VOLUMEN_PROGRAM),
                {QStringLiteral("archive"), QStringLiteral("fetch"), QStringLiteral("to"),
                 QStringLiteral("1.2"), QStringLiteral("--archives"), listOf(mute.port()),
                 QStringLiteral("-o"), folder_.filePath(QStringLiteral("interrupted"))});
  QTRY_VERIFY_WITH_TIMEOUT(isConnected, 20000);
  ::kill(pid_t(process.processId()), SIGINT);
  QVERIFY(process.waitForFinished(20000));
  QCOMPARE(
      process.readAllStandardError(),
      QByteArray("volumen: Interrupted; images that came whole are kept, and the next fetch goes on from "
                 "there.\n"));
}

// The archive would wait for 30 s for each series.
void TestArchiveSafety::aPortThatAMuteProgramHoldsIsFoundOut() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  QrPeer peer;
  peer.add({plain_});
  QVERIFY(peer.start({QStringLiteral("--disable-get")}));
  QTcpServer mute;
  QVERIFY(mute.listen(QHostAddress::LocalHost, quint16(peer.ourPort())));
  QElapsedTimer since;
  since.start();
  const Outcome outcome = fetch(peer, QStringLiteral("mute"));
  QCOMPARE(outcome.status, 1);
  QVERIFY2(outcome.err.contains("is in use"), outcome.err);
  QVERIFY(since.elapsed() < 25000);
}

// A program that receives already files what the archive sends to its port.
void TestArchiveSafety::whatAReceiverFilesIsFetched() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  QrPeer peer;
  peer.add({plain_});
  QVERIFY(peer.start({QStringLiteral("--disable-get")}));
  QProcess receiver;
  receiver.start(QStringLiteral(VOLUMEN_PROGRAM),
                 {QStringLiteral("archive"), QStringLiteral("receive"), QStringLiteral("--archives"),
                  moveListOf(peer), QStringLiteral("--index"), folder_.filePath(QStringLiteral("both"))});
  QVERIFY(receiver.waitForStarted() && listensAt(peer.ourPort()));
  const Outcome outcome = fetch(peer, QStringLiteral("both"));
  QVERIFY2(outcome.status == 0, outcome.err);
  QVERIFY2(outcome.out.startsWith("Fetched 1 of 1 images"), outcome.out);
  receiver.terminate();
  QVERIFY(receiver.waitForFinished(20000));
}

void TestArchiveSafety::hostileAnswersTakeLittleMemory_data() {
  QTest::addColumn<QByteArray>("begin");
  QTest::addColumn<QByteArray>("part");  // repeated up to 31 MB
  QTest::addColumn<QByteArray>("end");
  const QByteArray open = R"([{"00100020": {"vr": "LO", "Value": [)", close = "0]}}]";
  QTest::newRow("millions of numbers") << open << QByteArray("1,") << close;
  QTest::newRow("millions of objects") << open << QByteArray("{},") << close;
  QTest::newRow("millions of attributes")
      << QByteArray("[{") << QByteArray(R"("a":1,)") << QByteArray(R"("b":1}])");
  QTest::newRow("millions of answers") << QByteArray("[") << QByteArray("{},") << QByteArray("{}]");
  QTest::newRow("one long text") << QByteArray(R"([{"00100020": {"vr": "LO", "Value": [")")
                                 << QByteArray("aa") << QByteArray(R"("]}}])");
}

void TestArchiveSafety::hostileAnswersTakeLittleMemory() {
  QFETCH(QByteArray, begin);
  QFETCH(QByteArray, part);
  QFETCH(QByteArray, end);
  constexpr int bytes = 31'000'000;
  const QByteArray page = begin + part.repeated(bytes / int(part.size())) + end;
  const HttpPeer peer([&](const HttpRequest& request) {
    const bool isFirst = !request.query.contains("offset=") || request.query.contains("offset=0");
    return httpAnswer("200 OK", "application/dicom+json", isFirst ? page : QByteArray("[]"));
  });
  const QString list =
      fileOf(R"({"archives": [{"name": "to", "kind": "dicomweb", "url": ")" + peer.url() + "\"}]}");
  const MeasuredOutcome outcome =
      runMeasured({"archive", "query", "to", "--archives", list.toStdString(), "--json"});
  QCOMPARE(outcome.status, 0);
#ifndef __SANITIZE_ADDRESS__  // AddressSanitizer keeps freed memory
  QVERIFY2(outcome.peakMebibytes < 512, qPrintable(QString::number(outcome.peakMebibytes)));
#endif
}

VOLUMEN_TEST(TestArchiveSafety);
#include "tst_archive_safety.moc"
