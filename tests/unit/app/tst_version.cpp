// Guards what --version says: which program a report of a fault is about, and on which instructions it ran.
#include <QProcess>
#include <QRegularExpression>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"
#include "viewer/kernels/trace.h"

using namespace volumen::tests;

class TestVersion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void versionNamesRevisionAndTarget();
};

void TestVersion::versionNamesRevisionAndTarget() {
  const Outcome a = runProgram(QStringLiteral("--version"));
  QCOMPARE(a.status, 0);
  const QRegularExpression line(QStringLiteral(
      "^volumen (\\S+) \\(revision ([0-9a-f]{12,40}(-dirty)?|unknown), CPU target (\\w+)\\)\n$"));
  const auto found = line.match(QString::fromUtf8(a.out));
  QVERIFY2(found.hasMatch(), a.out);
  QCOMPARE(found.captured(1), QLatin1String(VOLUMEN_VERSION));
  QCOMPARE(found.captured(4), QLatin1String(volumen::kernelTarget()));
  const QStringList head{QStringLiteral("-C"), QStringLiteral(VOLUMEN_SOURCE_DIR),
                         QStringLiteral("rev-parse"), QStringLiteral("HEAD")};
  if (QProcess::execute(QStringLiteral("git"), head) == 0)
    QVERIFY(found.captured(2) != QLatin1String("unknown"));
}

VOLUMEN_TEST(TestVersion);
#include "tst_version.moc"
