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

int below(Chance& chance, qsizetype n) { return chance.below(std::max(1, int(n))); }

// Changes, cuts off, repeats or removes bytes, or appends the end of another file.
QByteArray mutated(QByteArray bytes, const QByteArray& other, Chance& chance) {
  constexpr char telling[] = {0, 1, 0x7f, char(0x80), char(0xff), '\\'};
  const int at = below(chance, bytes.size());
  switch (chance.below(6)) {
    case 0:
      return bytes.left(at);
    case 1:
      return bytes.insert(at, bytes.mid(at, 1 + chance.below(200)).repeated(1 + chance.below(50)));
    case 2:
      return bytes.remove(at, 1 + chance.below(64));
    case 3:
      return bytes.left(at) + other.mid(at);
    default:
      for (int n = 1 + chance.below(8); n > 0; --n)
        bytes[below(chance, std::min<qsizetype>(bytes.size(), chance.oneIn(2) ? 1000 : bytes.size()))] =
            chance.oneIn(2) ? telling[chance.below(sizeof telling)] : char(chance.below(256));
      return bytes;
  }
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
      const QString file = files[below(chance, files.size())];
      const QByteArray other = contentsOf(files[below(chance, files.size())]);
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
