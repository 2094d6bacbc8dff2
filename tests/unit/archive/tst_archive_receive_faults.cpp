// Guards `volumen archive receive` against peers that are silent, lie or break off, full disks and its own
// end: nobody else is harmed, and nothing half-written stays.
#include <QElapsedTimer>
#include <QStandardPaths>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/pdus.h"
#include "tests/unit/archive/receiver.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveReceiveFaults : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void aMutePeerKeepsNobodyWaiting();
  void peersThatLieAreCutOff_data();
  void peersThatLieAreCutOff();
  void aBrokenTransferLeavesNothing();
  void anImageOnItsWayIsDroppedAtTheEnd();
  void whatAKilledOneLeftIsRemoved();
  void aFullDiskIsTold();
  void tooManyAssociationsAreRejected();

 private:
  QString image(const char* name, const char* study, const char* instance, const char* patient = "DOE^JANE",
                int side = 4) const {
    return writeImage(folder_.filePath(QLatin1String(name)), study, instance, patient, side);
  }

  QTemporaryDir folder_;
};

void TestArchiveReceiveFaults::initTestCase() {
  for (const char* program : {"storescu", "echoscu"})
    if (QStandardPaths::findExecutable(QLatin1String(program)).isEmpty())
      QSKIP("storescu and echoscu are not installed (package dcmtk)");
}

void TestArchiveReceiveFaults::aMutePeerKeepsNobodyWaiting() {
  Receiver receiver;
  QVERIFY(receiver.start());
  QElapsedTimer since;
  since.start();
  const auto mute = receiver.connection();
  QCOMPARE(receiver.send({image("a.dcm", "1.2.3", "1.2.3.1.1")}), 0);
  QVERIFY2(since.elapsed() < 2500, qPrintable(QString::number(since.elapsed())));
  QVERIFY(isClosed(*mute));
  QVERIFY2(since.elapsed() >= 2000, qPrintable(QString::number(since.elapsed())));
  QCOMPARE(receiver.files().size(), 1);
}

void TestArchiveReceiveFaults::peersThatLieAreCutOff_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::newRow("a request of 4 GiB") << QByteArray(1, pduRequest) + endlessPdu().mid(1);
  QTest::newRow("data of 4 GiB") << associationRequest() + endlessPdu();
  QTest::newRow("a fragment of 4 GiB") << associationRequest() + pduOf(pduData, endlessPdu().mid(2));
  QTest::newRow("a command of 25,000 sequences within each other") << associationRequest() + deepCommand();
  QTest::newRow("data without a request") << begunStorage();
  QTest::newRow("TLS") << QByteArray::fromHex("16030100c8010000c40303") + QByteArray(190, 'a');
  QTest::newRow("HTTP") << QByteArray("GET / HTTP/1.1\r\n\r\n");
}

void TestArchiveReceiveFaults::peersThatLieAreCutOff() {
  QFETCH(QByteArray, bytes);
  Receiver receiver;
  QVERIFY(receiver.start());
  const auto liar = receiver.connection(bytes);
  QVERIFY(isClosed(*liar));
  QCOMPARE(receiver.echo(), 0);
  QVERIFY(receiver.files().isEmpty());
}

void TestArchiveReceiveFaults::aBrokenTransferLeavesNothing() {
  Receiver receiver;
  QVERIFY(receiver.start());
  const auto sender = receiver.connection(associationRequest() + begunStorage());
  QTRY_COMPARE(receiver.files().size(), 1);
  QVERIFY(!receiver.files().first().endsWith(QLatin1String(".dcm")));
  sender->abort();
  QTRY_VERIFY(receiver.files().isEmpty());
  QCOMPARE(receiver.interrupted(), QByteArray("BYHAND (127.0.0.1): broke off within an image.\n"));
}

void TestArchiveReceiveFaults::aFullDiskIsTold() {
  Receiver receiver({}, 64 << 10);
  QVERIFY(receiver.start());
  QVERIFY(receiver.send({image("large.dcm", "1.2.3", "1.2.3.1.1", "DOE^JANE", 256)}) != 0);
  QCOMPARE(receiver.echo(), 0);
  QVERIFY(receiver.files().isEmpty());
  QVERIFY(receiver.interrupted().startsWith(
      "STORESCU (127.0.0.1): 1 image refused; an image cannot be written: the disk may be full.\n"));
}

void TestArchiveReceiveFaults::tooManyAssociationsAreRejected() {
  Receiver receiver(R"(, "mostAssociations": 1)");
  QVERIFY(receiver.start());
  const auto first = receiver.connection(associationRequest());
  QVERIFY(first->waitForReadyRead(5000));
  QVERIFY(receiver.echo() != 0);
  first->abort();
  QTRY_COMPARE(receiver.echo(), 0);
  QVERIFY(
      receiver.interrupted().contains("ECHOSCU (127.0.0.1): was rejected: 1 associations are open already"));
}

void TestArchiveReceiveFaults::anImageOnItsWayIsDroppedAtTheEnd() {
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({image("whole.dcm", "1.2.3", "1.2.3.1.1")}), 0);
  const auto sender = receiver.connection(associationRequest() + begunStorage());
  QTRY_COMPARE(receiver.files().size(), 2);
  QCOMPARE(receiver.interrupted(),
           QByteArray("STORESCU (127.0.0.1): 1 image received.\n"
                      "BYHAND (127.0.0.1): was cut off within an image, as volumen ends.\n"));
  QCOMPARE(dataSetsBelow(receiver.output()),
           QList<QByteArray>{dataSetIn(contentsOf(folder_.filePath(QStringLiteral("whole.dcm"))))});
}

void TestArchiveReceiveFaults::whatAKilledOneLeftIsRemoved() {
  Receiver receiver;
  QVERIFY(receiver.start());
  const auto sender = receiver.connection(associationRequest() + begunStorage());
  QTRY_COMPARE(receiver.files().size(), 1);
  QVERIFY(receiver.endsBy(SIGKILL));
  QVERIFY(receiver.start());
  const QString whole = image("whole.dcm", "1.2.3", "1.2.3.1.1");
  QCOMPARE(receiver.send({whole}), 0);
  QCOMPARE(dataSetsBelow(receiver.output()), QList<QByteArray>{dataSetIn(contentsOf(whole))});
}

VOLUMEN_TEST(TestArchiveReceiveFaults);
#include "tst_archive_receive_faults.moc"
