// Guards `volumen archive receive`: what peers send is kept whole, as they sent it and once; whom it answers;
// and that peers which are silent, lie or break off harm nobody else.
#include <signal.h>
#include <sys/resource.h>

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <QDirIterator>
#include <QElapsedTimer>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTcpServer>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QtEndian>
#include <memory>

#include "io/archive/offered_contexts.h"
#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveReceive : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void instancesAreKeptAsSent_data();
  void instancesAreKeptAsSent();
  void allClassesButOtherServicesAreStored_data();
  void allClassesButOtherServicesAreStored();
  void onlyThoseWhoMayAreAnswered_data();
  void onlyThoseWhoMayAreAnswered();
  void aMutePeerKeepsNobodyWaiting();
  void peersThatLieAreCutOff_data();
  void peersThatLieAreCutOff();
  void aBrokenTransferLeavesNothing();
  void peersAtOnceLoseNothing();
  void anInstanceIsKeptOnce();
  void instancesThatCannotBeFiledAreRefused_data();
  void instancesThatCannotBeFiledAreRefused();
  void namesFromPeersAreNoPaths();
  void aFullDiskIsTold();
  void tooManyAssociationsAreRejected();
  void whatCameIsInTheIndex();
  void eachInstanceIsALineOfJson();
  void whatHindersListeningIsExplained();

 private:
  QString in(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  QString write(const char* name, const char* study, const char* instance, const char* patient = "DOE^JANE",
                int side = 4) const;

  QTemporaryDir folder_;
};

namespace {

// Runs a program of DCMTK. Returns its exit status.
int statusOfPeer(const QString& program, const QStringList& arguments) {
  QProcess process;
  process.setStandardOutputFile(QProcess::nullDevice());
  process.setStandardErrorFile(QProcess::nullDevice());
  process.start(program, arguments);
  return process.waitForFinished(60000) && process.exitStatus() == QProcess::NormalExit ? process.exitCode()
                                                                                        : -1;
}

// `volumen archive receive` while it runs.
class Receiver {
 public:
  /// `fields` are further ones of "listen". `mostBytes`: largest file that it may write, if not 0.
  explicit Receiver(const QByteArray& fields = {}, rlim_t mostBytes = 0) : port_(freePort()) {
    QFile list(folder_.filePath(QStringLiteral("archives.json")));
    if (!list.open(QIODevice::WriteOnly)) return;
    list.write("{\"listen\": {\"port\": " + QByteArray::number(port_) + fields + "}}");
    if (mostBytes > 0)
      process_.setChildProcessModifier(
          [limit = rlimit{mostBytes, mostBytes}] { setrlimit(RLIMIT_FSIZE, &limit); });
  }
  ~Receiver() {
    process_.kill();
    process_.waitForFinished();
  }

  /// Starts it with a folder or an index and waits until it listens.
  bool start(const QStringList& more = {}) {
    const QStringList to =
        more.contains(QLatin1String("--index")) ? QStringList() : QStringList{QStringLiteral("-o"), output()};
    process_.start(
        QStringLiteral(VOLUMEN_PROGRAM),
        QStringList{QStringLiteral("archive"), QStringLiteral("receive"), QStringLiteral("--archives"),
                    folder_.filePath(QStringLiteral("archives.json"))} +
            to + more);
    return process_.waitForStarted() && listensAt(port_);
  }
  int port() const { return port_; }
  QString output() const { return folder_.filePath(QStringLiteral("received")); }
  QStringList files() const {
    QStringList files;
    for (QDirIterator all(output(), QDir::Files | QDir::Hidden, QDirIterator::Subdirectories); all.hasNext();)
      files << all.next();
    return files;
  }
  /// Sends files by storescu.
  int send(const QStringList& files, const QStringList& options = {}) const {
    return statusOfPeer(QStringLiteral("storescu"), options + address() + files);
  }
  int echo(const QStringList& options = {}) const {
    return statusOfPeer(QStringLiteral("echoscu"), options + address());
  }
  QStringList address() const {
    return {QStringLiteral("-aec"), QStringLiteral("VOLUMEN"), QStringLiteral("127.0.0.1"),
            QString::number(port_)};
  }
  /// Ends it by Ctrl-C. Returns its output; empty if it ends in another way.
  QByteArray interrupted() {
    ::kill(pid_t(process_.processId()), SIGINT);
    if (!process_.waitForFinished(30000) || process_.exitStatus() != QProcess::CrashExit ||
        process_.exitCode() != SIGINT)
      return {};
    return process_.readAllStandardOutput();
  }

 private:
  QTemporaryDir folder_;
  QProcess process_;
  const int port_;
};

// The bytes behind the file meta information (PS3.10 7.1), which begins with its length.
QByteArray dataSetIn(const QString& path) {
  const QByteArray bytes = contentsOf(path);
  constexpr qsizetype lengthAt = 140, metaAt = 144;
  if (bytes.size() < metaAt) return {};
  return bytes.mid(metaAt + qsizetype(qFromLittleEndian<quint32>(bytes.constData() + lengthAt)));
}

// Parts of PDUs (PS3.8 9.3) and commands (PS3.7 E) by hand, for peers that break the rules.
template <class T>
QByteArray bigEndian(T value) {
  char bytes[sizeof(T)];
  qToBigEndian(value, bytes);
  return {bytes, sizeof(T)};
}
template <class T>
QByteArray littleEndian(T value) {
  char bytes[sizeof(T)];
  qToLittleEndian(value, bytes);
  return {bytes, sizeof(T)};
}
QByteArray pduItem(char type, const QByteArray& value) {
  return QByteArray(1, type) + '\0' + bigEndian(quint16(value.size())) + value;
}
QByteArray pduOf(char type, const QByteArray& value) {
  return QByteArray(1, type) + '\0' + bigEndian(quint32(value.size())) + value;
}
QByteArray associationRequest() {
  const QByteArray context =
      QByteArray("\1\0\0\0", 4) + pduItem(0x30, UID_CTImageStorage) + pduItem(0x40, "1.2.840.10008.1.2");
  return pduOf(1, bigEndian(quint16(1)) + bigEndian(quint16(0)) + QByteArray("VOLUMEN").leftJustified(16) +
                      QByteArray("BYHAND").leftJustified(16) + QByteArray(32, '\0') +
                      pduItem(0x10, "1.2.840.10008.3.1.1.1") + pduItem(0x20, context) +
                      pduItem(0x50, pduItem(0x51, bigEndian(quint32(16384))) + pduItem(0x52, "1.2.3")));
}
QByteArray commandElement(quint16 element, QByteArray value) {
  if (value.size() % 2) value += '\0';
  return littleEndian(quint16(0)) + littleEndian(element) + littleEndian(quint32(value.size())) + value;
}
QByteArray dataPdu(char control, const QByteArray& fragment) {
  return pduOf(4, bigEndian(quint32(fragment.size() + 2)) + '\1' + control + fragment);
}
// A C-STORE request (PS3.7 9.3.1.1) and the begin of its data set.
QByteArray begunStorage() {
  const QByteArray command =
      commandElement(0x0002, UID_CTImageStorage) + commandElement(0x0100, littleEndian(quint16(1))) +
      commandElement(0x0110, littleEndian(quint16(1))) + commandElement(0x0700, littleEndian(quint16(0))) +
      commandElement(0x0800, littleEndian(quint16(1))) + commandElement(0x1000, "1.2.3.4");
  const QByteArray length = commandElement(0x0000, littleEndian(quint32(command.size())));
  return dataPdu(3, length + command) + dataPdu(0, QByteArray(8000, '\0'));
}

// Sequences within sequences (0040,0275), never closed: a command of 400 kB, in fragments.
QByteArray deepCommand() {
  const QByteArray level("\x40\0\x75\x02\xff\xff\xff\xff\xfe\xff\0\xe0\xff\xff\xff\xff", 16);
  QByteArray pdus;
  for (int n = 0; n < 50; ++n) pdus += dataPdu(1, level.repeated(500));
  return pdus + dataPdu(3, level);
}

std::unique_ptr<QTcpSocket> connectedTo(const Receiver& receiver, const QByteArray& bytes) {
  auto socket = std::make_unique<QTcpSocket>();
  socket->connectToHost(QStringLiteral("127.0.0.1"), quint16(receiver.port()));
  if (socket->waitForConnected(5000) && !bytes.isEmpty())
    socket->write(bytes), socket->waitForBytesWritten(5000);
  return socket;
}
bool isClosedWithin(QTcpSocket& socket, int ms) {
  return socket.state() == QAbstractSocket::UnconnectedState || socket.waitForDisconnected(ms);
}

}  // namespace

QString TestArchiveReceive::write(const char* name, const char* study, const char* instance,
                                  const char* patient, int side) const {
  DicomPicture picture{.seriesUid = std::string(study) + ".1", .columns = side, .rows = side};
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_StudyInstanceUID, study);
    data.putAndInsertString(DCM_SOPInstanceUID, instance);
    data.putAndInsertString(DCM_PatientName, patient);
    for (const DcmTagKey& tag : {DCM_StudyInstanceUID, DCM_SOPInstanceUID})
      if (OFString value; data.findAndGetOFString(tag, value).bad() || value.empty())
        data.findAndDeleteElement(tag);
  };
  writeDicom(in(name).toStdString(), picture);
  return in(name);
}

void TestArchiveReceive::initTestCase() {
  for (const char* program : {"storescu", "echoscu"})
    if (QStandardPaths::findExecutable(QLatin1String(program)).isEmpty())
      QSKIP("storescu and echoscu are not installed (package dcmtk)");
}

void TestArchiveReceive::instancesAreKeptAsSent_data() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::addColumn<QString>("option");  // of storescu, which proposes the syntax
  const auto row = [](const char* name, const char* syntax, const char* option) {
    QTest::newRow(name) << QByteArray(syntax) << QString::fromLatin1(option);
  };
  row("implicit", UID_LittleEndianImplicitTransferSyntax, "-xi");
  row("explicit", UID_LittleEndianExplicitTransferSyntax, "-xe");
  row("big endian", UID_BigEndianExplicitTransferSyntax, "-xb");
  row("RLE", UID_RLELosslessTransferSyntax, "-xr");
  row("JPEG lossless", UID_JPEGProcess14SV1TransferSyntax, "-xs");
  row("JPEG-LS", UID_JPEGLSLosslessTransferSyntax, "-xt");
}

void TestArchiveReceive::instancesAreKeptAsSent() {
  QFETCH(QByteArray, syntax);
  QFETCH(QString, option);
  const QString sent = in("sent.dcm");
  DicomPicture picture{.columns = 64, .rows = 64};
  for (int n = 0; n < 64 * 64; ++n) picture.pixels.push_back(std::uint16_t(n * 7));
  writeDicom(sent.toStdString(), picture, syntax);
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({sent}, {option}), 0);
  QCOMPARE(receiver.files().size(), 1);
  const QString kept = receiver.files().first();
  QVERIFY(!dataSetIn(sent).isEmpty() && dataSetIn(kept) == dataSetIn(sent));
  QVERIFY(contentsOf(kept).left(400).contains(syntax));
  QCOMPARE(receiver.interrupted(), QByteArray("STORESCU (127.0.0.1): 1 image received.\n"));
}

void TestArchiveReceive::allClassesButOtherServicesAreStored_data() {
  QTest::addColumn<QByteArray>("sopClass");
  QTest::addColumn<bool>("isStored");
  QTest::newRow("CT") << QByteArray(UID_CTImageStorage) << true;
  QTest::newRow("a class of the future") << QByteArray("1.2.840.10008.5.1.4.1.1.999") << true;
  QTest::newRow("colour palettes") << QByteArray(UID_ColorPaletteStorage) << true;
  QTest::newRow("a private class") << QByteArray("1.3.12.2.1107.5.9.1") << true;
  QTest::newRow("a search") << QByteArray(UID_FINDStudyRootQueryRetrieveInformationModel) << false;
  QTest::newRow("storage commitment") << QByteArray(UID_StorageCommitmentPushModelSOPClass) << false;
  QTest::newRow("a performed step") << QByteArray(UID_ModalityPerformedProcedureStepSOPClass) << false;
  QTest::newRow("printing") << QByteArray(UID_BasicGrayscalePrintManagementMetaSOPClass) << false;
}

void TestArchiveReceive::allClassesButOtherServicesAreStored() {
  QFETCH(QByteArray, sopClass);
  QFETCH(bool, isStored);
  QCOMPARE(volumen::isStorageClass(sopClass.toStdString()), isStored);
}

void TestArchiveReceive::onlyThoseWhoMayAreAnswered_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<QString>("calling");
  QTest::addColumn<QString>("called");
  QTest::addColumn<QByteArray>("told");
  const auto row = [](const char* name, const char* fields, const char* calling, const char* called,
                      const char* told) {
    QTest::newRow(name) << QByteArray(fields) << QString::fromLatin1(calling) << QString::fromLatin1(called)
                        << QByteArray(told);
  };
  const char* const verified = "verified that volumen answers.";
  row("anyone", "", "ANYONE", "VOLUMEN", verified);
  row("a peer", R"(, "peers": ["PACS", "CT 1"])", "CT 1", "VOLUMEN", verified);
  row("our own title", R"(, "ae": "READING ROOM 2")", "PACS", "READING ROOM 2", verified);
  row("another title", "", "PACS", "NOBODY", "was rejected: it calls \"NOBODY\", not \"VOLUMEN\".");
  row("another case", "", "PACS", "Volumen", "was rejected: it calls \"Volumen\", not \"VOLUMEN\".");
  row("no peer", R"(, "peers": ["PACS"])", "CT 1", "VOLUMEN", "was rejected: it is none of the \"peers\".");
}

void TestArchiveReceive::onlyThoseWhoMayAreAnswered() {
  QFETCH(QByteArray, fields);
  QFETCH(QString, calling);
  QFETCH(QString, called);
  QFETCH(QByteArray, told);
  Receiver receiver(fields);
  QVERIFY(receiver.start());
  const int status = statusOfPeer(QStringLiteral("echoscu"),
                                  {QStringLiteral("-aet"), calling, QStringLiteral("-aec"), called,
                                   QStringLiteral("127.0.0.1"), QString::number(receiver.port())});
  QCOMPARE(status == 0, told.startsWith("verified"));
  QCOMPARE(receiver.interrupted(), calling.toUtf8() + " (127.0.0.1): " + told + '\n');
}

void TestArchiveReceive::aMutePeerKeepsNobodyWaiting() {
  Receiver receiver;
  QVERIFY(receiver.start());
  QElapsedTimer since;
  since.start();
  const auto mute = connectedTo(receiver, {});
  QCOMPARE(receiver.send({write("a.dcm", "1.2.3", "1.2.3.1.1")}), 0);
  QVERIFY2(since.elapsed() < 2500, qPrintable(QString::number(since.elapsed())));
  QVERIFY(isClosedWithin(*mute, 10000));
  QVERIFY2(since.elapsed() >= 2000, qPrintable(QString::number(since.elapsed())));
  QCOMPARE(receiver.files().size(), 1);
}

void TestArchiveReceive::peersThatLieAreCutOff_data() {
  QTest::addColumn<QByteArray>("bytes");
  const QByteArray endless = bigEndian(quint32(0xfffffff0)) + QByteArray(1000, 'x');
  QTest::newRow("a request of 4 GiB") << QByteArray("\1\0", 2) + endless;
  QTest::newRow("data of 4 GiB") << associationRequest() + QByteArray("\4\0", 2) + endless;
  QTest::newRow("a fragment of 4 GiB") << associationRequest() + pduOf(4, endless);
  QTest::newRow("a command of 25,000 sequences within each other") << associationRequest() + deepCommand();
  QTest::newRow("data without a request") << begunStorage();
  QTest::newRow("TLS") << QByteArray::fromHex("16030100c8010000c40303") + QByteArray(190, 'a');
  QTest::newRow("HTTP") << QByteArray("GET / HTTP/1.1\r\n\r\n");
}

void TestArchiveReceive::peersThatLieAreCutOff() {
  QFETCH(QByteArray, bytes);
  Receiver receiver;
  QVERIFY(receiver.start());
  const auto liar = connectedTo(receiver, bytes);
  QVERIFY(isClosedWithin(*liar, 10000));
  QCOMPARE(receiver.echo(), 0);
  QVERIFY(receiver.files().isEmpty());
}

void TestArchiveReceive::aBrokenTransferLeavesNothing() {
  Receiver receiver;
  QVERIFY(receiver.start());
  const auto sender = connectedTo(receiver, associationRequest() + begunStorage());
  QTRY_COMPARE(receiver.files().size(), 1);
  QVERIFY(!receiver.files().first().endsWith(QLatin1String(".dcm")));
  sender->abort();
  QTRY_VERIFY(receiver.files().isEmpty());
  QCOMPARE(receiver.interrupted(), QByteArray("BYHAND (127.0.0.1): broke off within an image.\n"));
}

void TestArchiveReceive::peersAtOnceLoseNothing() {
  constexpr int peers = 4, images = 25;
  Receiver receiver;
  QVERIFY(receiver.start());
  std::vector<std::unique_ptr<QProcess>> sending;
  for (int peer = 0; peer < peers; ++peer) {
    QStringList files;
    for (int n = 0; n < images; ++n) {
      const QByteArray uid = QByteArray::number(peer) + '.' + QByteArray::number(n);
      files << write("p" + uid, "1.2.3", "1.2.3.1." + uid);
    }
    files << write("shared.dcm", "1.2.3", "1.2.3.1.9");
    QProcess& process = *sending.emplace_back(std::make_unique<QProcess>());
    process.setStandardOutputFile(QProcess::nullDevice());
    process.setStandardErrorFile(QProcess::nullDevice());
    process.start(QStringLiteral("storescu"), receiver.address() + files);
  }
  for (const auto& process : sending) {
    QVERIFY(process->waitForFinished(60000));
    QCOMPARE(process->exitCode(), 0);
  }
  QCOMPARE(receiver.files().size(), peers * images + 1);
  QCOMPARE(receiver.interrupted().count("; 1 image here already."), peers - 1);
}

void TestArchiveReceive::anInstanceIsKeptOnce() {
  const QString one = write("one.dcm", "1.2.3", "1.2.3.1.1");
  const QString other = write("other.dcm", "1.2.3", "1.2.3.1.1", "DOE^JOHN");
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({one}), 0);
  QCOMPARE(receiver.send({one}, {QStringLiteral("-aet"), QStringLiteral("AGAIN")}), 0);
  QVERIFY(receiver.send({other}) != 0);
  QCOMPARE(receiver.files().size(), 1);
  QCOMPARE(dataSetIn(receiver.files().first()), dataSetIn(one));
  QCOMPARE(receiver.interrupted(),
           QByteArray("STORESCU (127.0.0.1): 1 image received.\n"
                      "AGAIN (127.0.0.1): 1 image here already.\n"
                      "STORESCU (127.0.0.1): 1 image refused; another image with the UID 1.2.3.1.1 is here "
                      "already.\n"));
}

void TestArchiveReceive::instancesThatCannotBeFiledAreRefused_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<QByteArray>("study");
  QTest::addColumn<int>("side");
  QTest::addColumn<QByteArray>("told");
  QTest::newRow("no study") << QByteArray() << QByteArray() << 4
                            << QByteArray("1 image refused; an image has no StudyInstanceUID.");
  QTest::newRow("too large") << QByteArray(R"(, "mostMegabytes": 1)") << QByteArray("1.2.3") << 1024
                             << QByteArray(
                                    "was cut off: its image has more than 1 megabytes "
                                    "(\"mostMegabytes\").");
}

void TestArchiveReceive::instancesThatCannotBeFiledAreRefused() {
  QFETCH(QByteArray, fields);
  QFETCH(QByteArray, study);
  QFETCH(int, side);
  QFETCH(QByteArray, told);
  Receiver receiver(fields);
  QVERIFY(receiver.start());
  QVERIFY(receiver.send({write("odd.dcm", study, "1.2.3.1.1", "DOE^JANE", side)}) != 0);
  QVERIFY(receiver.files().isEmpty());
  QCOMPARE(receiver.interrupted(), "STORESCU (127.0.0.1): " + told + '\n');
}

void TestArchiveReceive::namesFromPeersAreNoPaths() {
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({write("path.dcm", "../../../../x", "../../x")}), 0);
  QCOMPARE(receiver.files().size(), 1);
  const QString name = receiver.files().first().mid(receiver.output().size());
  static const QRegularExpression hashes(QStringLiteral("^/[0-9a-f]{32}/[0-9a-f]{32}/[0-9a-f]{32}\\.dcm$"));
  QVERIFY2(hashes.match(name).hasMatch(), qPrintable(name));
}

void TestArchiveReceive::aFullDiskIsTold() {
  Receiver receiver({}, 64 << 10);
  QVERIFY(receiver.start());
  QVERIFY(receiver.send({write("large.dcm", "1.2.3", "1.2.3.1.1", "DOE^JANE", 256)}) != 0);
  QCOMPARE(receiver.echo(), 0);
  QVERIFY(receiver.files().isEmpty());
  QVERIFY(receiver.interrupted().startsWith(
      "STORESCU (127.0.0.1): 1 image refused; an image cannot be written: the disk may be full.\n"));
}

void TestArchiveReceive::tooManyAssociationsAreRejected() {
  Receiver receiver(R"(, "mostAssociations": 1)");
  QVERIFY(receiver.start());
  const auto first = connectedTo(receiver, associationRequest());
  QVERIFY(first->waitForReadyRead(5000));
  QVERIFY(receiver.echo() != 0);
  first->abort();
  QTRY_COMPARE(receiver.echo(), 0);
  QVERIFY(
      receiver.interrupted().contains("ECHOSCU (127.0.0.1): was rejected: 1 associations are open already"));
}

void TestArchiveReceive::whatCameIsInTheIndex() {
  const QString index = in("index");
  const auto studies = [&] {
    return uidsOf(QJsonDocument::fromJson(runProgram({QStringLiteral("list"), QStringLiteral("--index"),
                                                      index, QStringLiteral("--json")})
                                              .out)[QStringLiteral("studies")]
                      .toArray());
  };
  Receiver receiver;
  QVERIFY(receiver.start({QStringLiteral("--index"), index}));
  QCOMPARE(receiver.send({write("first.dcm", "1.2.3", "1.2.3.1.1")}), 0);
  QTRY_COMPARE_WITH_TIMEOUT(studies(), QStringList{QStringLiteral("1.2.3")}, 20000);
  QCOMPARE(receiver.send({write("second.dcm", "1.2.4", "1.2.4.1.1")}), 0);
  QVERIFY(!receiver.interrupted().isEmpty());
  QCOMPARE(studies(), (QStringList{QStringLiteral("1.2.3"), QStringLiteral("1.2.4")}));
}

void TestArchiveReceive::eachInstanceIsALineOfJson() {
  Receiver receiver;
  QVERIFY(receiver.start({QStringLiteral("--json")}));
  QCOMPARE(receiver.send({write("a.dcm", "1.2.3", "1.2.3.1.1"), write("b.dcm", "1.2.3", "1.2.3.1.2")}), 0);
  const QList<QByteArray> lines = receiver.interrupted().trimmed().split('\n');
  QCOMPARE(lines.size(), 2);
  const QJsonObject second = QJsonDocument::fromJson(lines[1]).object();
  QCOMPARE(second[QStringLiteral("sopInstanceUid")].toString(), QStringLiteral("1.2.3.1.2"));
  QCOMPARE(second[QStringLiteral("callingAe")].toString(), QStringLiteral("STORESCU"));
  QVERIFY(receiver.files().contains(second[QStringLiteral("path")].toString()));
}

void TestArchiveReceive::whatHindersListeningIsExplained() {
  QTcpServer other;
  QVERIFY(other.listen(QHostAddress::LocalHost));
  const auto receive = [&](const QByteArray& list) {
    QFile file(in("archives.json"));
    if (!file.open(QIODevice::WriteOnly) || file.write(list) < 0) return Outcome{};
    file.close();
    return runProgram({QStringLiteral("archive"), QStringLiteral("receive"), QStringLiteral("--archives"),
                       file.fileName(), QStringLiteral("-o"), in("nothing")});
  };
  const QByteArray port = QByteArray::number(other.serverPort());
  const Outcome used = receive("{\"listen\": {\"port\": " + port + "}}");
  QCOMPARE(used.status, 1);
  QVERIFY2(used.err.contains("Port " + port + " of 127.0.0.1 is in use: "), used.err);
  const Outcome elsewhere = receive(R"({"listen": {"address": "192.0.2.1"}})");
  QCOMPARE(elsewhere.status, 1);
  QVERIFY2(elsewhere.err.contains("192.0.2.1 is no address of this machine"), elsewhere.err);
  const Outcome none = receive("{}");
  QCOMPARE(none.status, 1);
  QVERIFY2(none.err.contains("archives.json does not say where to listen: add \"listen\": "), none.err);
}

VOLUMEN_TEST(TestArchiveReceive);
#include "tst_archive_receive.moc"
