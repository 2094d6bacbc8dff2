// Guards import.md, "Safety": the program reports the content of any mutated file, or why it cannot, and does
// not crash. Cases are random from a seed: VOLUMEN_RANDOM_CASES=10000 VOLUMEN_RANDOM_SEED=7.
#include <QDir>
#include <QDirIterator>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <algorithm>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/mutated.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

constexpr int filesARun = 250;
constexpr double mostMebibytes = 512;

// Returns small real files of every kind in a fixed order.
QStringList seeds() {
  QStringList files;
  QDirIterator below(QString::fromStdString(dataPath()), QDir::Files, QDirIterator::Subdirectories);
  while (below.hasNext()) {
    const QFileInfo file(below.next());
    if (file.size() > 200 && file.size() < 300000) files << file.filePath();
  }
  files.sort();
  return files;
}

bool write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
}

}  // namespace

class TestMutatedFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void noneEndsTheProgram();
};

void TestMutatedFiles::noneEndsTheProgram() {
  NEED_DATA(dataPath());
  const QStringList files = seeds();
  QVERIFY(files.size() > 100);
  const auto [seed, cases] = seedsOf(filesARun, 10 * filesARun);
  Chance chance{std::uint64_t(seed)};
  for (int done = 0; done < cases; done += filesARun) {
    const QTemporaryDir folder;
    for (int n = 0; n < filesARun; ++n) {
      const QString file = files[chance.below(int(files.size()))];
      const QByteArray other = contentsOf(files[chance.below(int(files.size()))]);
      const QString name = QString::number(n) + QLatin1Char('-') + QFileInfo(file).fileName();
      QVERIFY(write(folder.filePath(name), mutated(contentsOf(file), other, chance)));
    }
    const MeasuredOutcome run = runMeasured({"info", folder.path().toStdString(), "--json", "--values"});
    const QString where = QStringLiteral("files %1 to %2").arg(done).arg(done + filesARun);
    QVERIFY2(run.status == 0, qPrintable(where));
    QVERIFY2(run.peakMebibytes < mostMebibytes, qPrintable(where));
    const QJsonObject found = QJsonDocument::fromJson(run.out).object();
    QVERIFY2(!found[QLatin1String("refused")].toArray().isEmpty(), qPrintable(where));
  }
}

VOLUMEN_TEST(TestMutatedFiles);
#include "tst_mutated_files.moc"
