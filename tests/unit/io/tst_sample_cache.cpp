// Guards design.md 10 (phantom ct-head): the cache gives the same bytes, and only intact files are used.
#include <zlib.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>

#include "io/files/sample_cache.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;

class TestSampleCache : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsKeptGivesTheSameBytes();
  void theFileIsRead();
  void badFilesAreMadeAgain_data();
  void badFilesAreMadeAgain();
  void aFolderThatCannotBeWrittenCostsOnlyTime();
};

namespace {

constexpr const char* head = "ct-head:48";

const Volume& made() {
  static const VolumePtr volume = *makePhantom(head);
  return *volume;
}

struct Cache {
  QTemporaryDir dir;
  QString folder = dir.filePath(QStringLiteral("a/b"));
  QString file = folder + QStringLiteral("/ct-head-48.values");

  VolumePtr open() const { return *cachedPhantom(head, folder.toStdString()); }
};

bool isMade(const Volume& volume) {
  return volume.stored() == made().stored() && volume.geometry() == made().geometry() &&
         volume.attributes().modality == made().attributes().modality &&
         volume.attributes().windows == made().attributes().windows &&
         volume.attributes().name == made().attributes().name;
}

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  QCOMPARE(file.write(bytes), bytes.size());
}

// Returns the file with `change` applied to its values and a correct checksum.
QByteArray withValues(QByteArray file, const std::function<void(std::vector<std::int16_t>&)>& change) {
  constexpr int checksumAt = 16, valuesAt = 24;
  std::vector<std::int16_t> values((std::size_t(file.size()) - valuesAt) / 2);
  std::memcpy(values.data(), file.constData() + valuesAt, values.size() * 2);
  change(values);
  std::memcpy(file.data() + valuesAt, values.data(), values.size() * 2);
  const std::uint64_t sum = crc32_z(0, reinterpret_cast<const Bytef*>(values.data()), values.size() * 2);
  std::memcpy(file.data() + checksumAt, &sum, sizeof sum);
  return file;
}

using Damage = QByteArray (*)(QByteArray);

}  // namespace

Q_DECLARE_METATYPE(Damage)

void TestSampleCache::whatIsKeptGivesTheSameBytes() {
  const Cache cache;
  QVERIFY(isMade(*cache.open()));
  QVERIFY2(QFile::exists(cache.file), "the folder is made, too");
  QVERIFY(isMade(*cache.open()));
  QCOMPARE(QDir(cache.folder).entryList(QDir::Files).size(), 1);
}

void TestSampleCache::theFileIsRead() {
  const Cache cache;
  cache.open();
  // The voxel is in no block that is checked.
  write(cache.file, withValues(tests::contentsOf(cache.file), [](auto& values) { values[20] = 1234; }));
  QCOMPARE(cache.open()->valueAt(20), 1234.f);
}

void TestSampleCache::badFilesAreMadeAgain_data() {
  QTest::addColumn<Damage>("damage");
  QTest::newRow("a bit") << Damage([](QByteArray b) { return b[b.size() / 2] = b[b.size() / 2] ^ 4, b; });
  QTest::newRow("cut off") << Damage([](QByteArray b) { return b.left(b.size() - 2); });
  QTest::newRow("an odd byte") << Damage([](QByteArray b) { return b + 'x'; });
  QTest::newRow("longer") << Damage([](QByteArray b) { return b + "xy"; });
  QTest::newRow("empty") << Damage([](QByteArray) { return QByteArray(); });
  QTest::newRow("another format") << Damage([](QByteArray b) { return b[15] = '0', b; });
  QTest::newRow("no values") << Damage([](QByteArray b) { return b.left(24); });
  QTest::newRow("of a version with other values") << Damage([](QByteArray b) {
    return withValues(b, [](auto& values) {
      for (auto& v : values) v = std::int16_t(v > 0 ? v + 1 : v);
    });
  });
  QTest::newRow("of another size") << Damage(
      [](QByteArray b) { return withValues(b.left(b.size() / 2 & ~1), [](auto&) {}); });
}

void TestSampleCache::badFilesAreMadeAgain() {
  QFETCH(Damage, damage);
  const Cache cache;
  cache.open();
  const QByteArray good = tests::contentsOf(cache.file);
  write(cache.file, damage(good));
  QVERIFY(tests::contentsOf(cache.file) != good);
  QVERIFY(isMade(*cache.open()));
  QVERIFY2(tests::contentsOf(cache.file) == good, "and kept again");
}

void TestSampleCache::aFolderThatCannotBeWrittenCostsOnlyTime() {
  const Cache cache;
  QDir().mkpath(QFileInfo(cache.folder).path());
  write(cache.folder, "a file in its place");
  QVERIFY(isMade(*cache.open()));
}

VOLUMEN_TEST(TestSampleCache);
#include "tst_sample_cache.moc"
