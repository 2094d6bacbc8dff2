// Guards cluster.md: Slurm arrays and GNU parallel do a list of work, each piece as by hand, and what was
// killed is done when the task is queued again.
#include <QStandardPaths>

#include "tests/unit/app/batch_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

constexpr int pieceCount = 200, poisoned = 77;  // a line

// Pictures of 20 volumes, one of which cannot be opened in one piece.
QByteArray listOfPictures() {
  QList<QJsonObject> pieces;
  for (int n = 0; n < pieceCount; ++n) {
    QJsonObject one =
        smallPicture(QStringLiteral("%1.png").arg(n), QStringLiteral("phantom:ct-head:%1").arg(16 + n % 20));
    one[QStringLiteral("size")] = QStringLiteral("%1x16").arg(16 + n / 20);
    if (n + 1 == poisoned) one[QStringLiteral("path")] = QStringLiteral("poison.dcm");
    pieces << one;
  }
  return listOf(pieces);
}

struct Ended {
  int status = -1;
  QByteArray said;
};

Ended runScript(const BatchFolder& folder, const QByteArray& script, const QStringList& before = {}) {
  folder.write(QStringLiteral("script"),
               "#!/bin/bash\ncd '" + folder.at({}).toUtf8() + "'\nvolumen='" VOLUMEN_PROGRAM "'\n" + script);
  QFile::setPermissions(folder.at(QStringLiteral("script")),
                        QFileDevice::ReadOwner | QFileDevice::WriteOwner | QFileDevice::ExeOwner);
  QProcess process;
  process.setProcessChannelMode(QProcess::MergedChannels);
  const QStringList command = before + QStringList{folder.at(QStringLiteral("script"))};
  process.start(command[0], command.mid(1));
  if (!process.waitForFinished(300000)) return {-1, "timeout"};
  return {process.exitCode(), process.readAll()};
}

}  // namespace

class TestBatchSchedulers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void slurmDoesAList();
  void parallelDoesAList();

 private:
  void compare(const BatchFolder& folder) const;

  BatchFolder byHand_;
};

void TestBatchSchedulers::initTestCase() {
  byHand_.write(QStringLiteral("jobs"), listOfPictures());
  const Outcome a = byHand_.batch();
  QVERIFY2(a.status == 1 && a.err.contains("199 done, 0 done before, 1 failed"), a.err);
}

void TestBatchSchedulers::compare(const BatchFolder& folder) const {
  for (int n = 0; n < pieceCount; ++n) {
    const QString name = QStringLiteral("%1.png").arg(n);
    QCOMPARE(QFile::exists(folder.at(name)), n + 1 != poisoned);
    QVERIFY(folder.contents(name) == byHand_.contents(name));
  }
}

// Task 5 is killed in the middle of its work and queued again.
void TestBatchSchedulers::slurmDoesAList() {
  const BatchFolder folder, slurm;
  folder.write(QStringLiteral("jobs"), listOfPictures());
  folder.write(QStringLiteral("task"), R"(#!/bin/bash
if [ "$SLURM_ARRAY_TASK_ID" = 5 ] && mkdir killed; then
  ")" VOLUMEN_PROGRAM R"(" batch jobs >log.killed & sleep 0.15; kill -9 $!
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_5"; sleep 60
fi
")" VOLUMEN_PROGRAM R"(" batch jobs >"log.$SLURM_ARRAY_TASK_ID"
)");
  // A task that is queued again would wait for two minutes.
  const Ended a =
      runScript(folder, R"sh(id=$(sbatch --parsable --array=1-20 --chdir=. -o /dev/null task)
until [ -e killed ] && scontrol update JobId="${id}_5" StartTime=now 2>/dev/null; do sleep 0.2; done
while [ -n "$(squeue -h -j "$id")" ]; do sleep 0.2; done
)sh",
                {QStringLiteral(VOLUMEN_SOURCE_DIR "/tests/fixtures/with_slurm.sh"), slurm.at({})});
  if (a.status == 77) QSKIP(qPrintable(QStringLiteral("no Slurm: ") + QString::fromUtf8(a.said.right(200))));
  QVERIFY2(a.status == 0, a.said);
  QVERIFY(QFile::exists(folder.at(QStringLiteral("killed"))));
  int told = 0;
  for (int task = 1; task <= 20; ++task)
    told += int(endsIn(folder.contents(QStringLiteral("log.%1").arg(task))).size());
  QCOMPARE(told, pieceCount);
  compare(folder);
}

void TestBatchSchedulers::parallelDoesAList() {
  if (QStandardPaths::findExecutable(QStringLiteral("parallel")).isEmpty())
    QSKIP("GNU parallel is not installed");
  const BatchFolder folder;
  folder.write(QStringLiteral("jobs"), listOfPictures());
  const Ended a = runScript(folder,
                            "parallel --will-cite -j2 --joblog log \"$volumen\" batch jobs --shard {}/6 ::: "
                            "1 2 3 4 5 6 >out 2>said; echo $?\n"
                            "parallel --will-cite -j2 --joblog log --resume-failed \"$volumen\" batch jobs "
                            "--shard {}/6 ::: 1 2 3 4 5 6 >again 2>said\n");
  QVERIFY2(a.said.startsWith("1\n"), a.said);
  QCOMPARE(int(endsIn(folder.contents(QStringLiteral("out"))).size()), pieceCount);
  const QMap<int, QString> again =
      endsIn(folder.contents(QStringLiteral("again")));  // the shard with the poisoned piece
  QVERIFY(again.size() < pieceCount / 2 && again[poisoned] == QLatin1String("failed"));
  compare(folder);
}

VOLUMEN_TEST(TestBatchSchedulers);
#include "tst_batch_schedulers.moc"
