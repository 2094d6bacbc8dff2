// Guards that images which a peer was told to be stored enter the index, even if the program is killed.
#include <QDir>
#include <QStandardPaths>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/listener_process.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestListenerKilled : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void whatCameBeforeAKillIsInTheIndexAfterTheNextStart();
  void aForgottenStudyStaysForgotten();
};

void TestListenerKilled::initTestCase() {
  if (QStandardPaths::findExecutable(QStringLiteral("storescu")).isEmpty())
    QSKIP("storescu is not installed (package dcmtk)");
}

void TestListenerKilled::whatCameBeforeAKillIsInTheIndexAfterTheNextStart() {
  ListenerProcess listener;
  QVERIFY(listener.start(true));
  QCOMPARE(listener.send({listener.writeImage("1.2.3", "1.2.3.1.1")}), 0);
  listener.kill();
  QVERIFY(listener.start(true));
  QTRY_COMPARE_WITH_TIMEOUT(uidsOf(listener.studies()), QStringList{QStringLiteral("1.2.3")}, 20000);
  QTRY_VERIFY(QDir(listener.index() + QStringLiteral("/arrived")).isEmpty());
}

void TestListenerKilled::aForgottenStudyStaysForgotten() {
  ListenerProcess listener;
  QVERIFY(listener.start(true));
  QCOMPARE(
      listener.send({listener.writeImage("1.2.3", "1.2.3.1.1"), listener.writeImage("1.2.4", "1.2.4.1.1")}),
      0);
  QVERIFY(listener.interrupted());
  const Outcome forgotten = runProgram(
      {QStringLiteral("forget"), QStringLiteral("1.2.3"), QStringLiteral("--index"), listener.index()});
  QVERIFY2(forgotten.status == 0, forgotten.err);
  QVERIFY(listener.start(true));
  QVERIFY(listener.interrupted());
  QCOMPARE(uidsOf(listener.studies()), QStringList{QStringLiteral("1.2.4")});
}

VOLUMEN_TEST(TestListenerKilled);
#include "tst_listener_killed.moc"
