// Guards that images which a peer was told to be stored enter the index, even if the program is killed.
#include <QDir>
#include <QStandardPaths>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/receiver.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestListenerKilled : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void whatCameBeforeAKillIsInTheIndexAfterTheNextStart();
  void aForgottenStudyStaysForgotten();

 private:
  QString image(const char* study, const char* instance) const {
    return writeImage(folder_.filePath(QLatin1String(instance)), study, instance);
  }

  QTemporaryDir folder_;
};

void TestListenerKilled::initTestCase() {
  if (QStandardPaths::findExecutable(QStringLiteral("storescu")).isEmpty())
    QSKIP("storescu is not installed (package dcmtk)");
}

void TestListenerKilled::whatCameBeforeAKillIsInTheIndexAfterTheNextStart() {
  Receiver receiver;
  QVERIFY(receiver.startIntoIndex());
  QCOMPARE(receiver.send({image("1.2.3", "1.2.3.1.1")}), 0);
  QVERIFY(receiver.endsBy(SIGKILL));
  QVERIFY(receiver.startIntoIndex());
  QTRY_COMPARE_WITH_TIMEOUT(uidsOf(receiver.studies()), QStringList{QStringLiteral("1.2.3")}, 20000);
  QTRY_VERIFY(QDir(receiver.index() + QStringLiteral("/arrived")).isEmpty());
}

void TestListenerKilled::aForgottenStudyStaysForgotten() {
  Receiver receiver;
  QVERIFY(receiver.startIntoIndex());
  QCOMPARE(receiver.send({image("1.2.3", "1.2.3.1.1"), image("1.2.4", "1.2.4.1.1")}), 0);
  QVERIFY(receiver.endsBy(SIGINT));
  const Outcome forgotten = runProgram(
      {QStringLiteral("forget"), QStringLiteral("1.2.3"), QStringLiteral("--index"), receiver.index()});
  QVERIFY2(forgotten.status == 0, forgotten.err);
  QVERIFY(receiver.startIntoIndex());
  QVERIFY(receiver.endsBy(SIGINT));
  QCOMPARE(uidsOf(receiver.studies()), QStringList{QStringLiteral("1.2.4")});
}

VOLUMEN_TEST(TestListenerKilled);
#include "tst_listener_killed.moc"
