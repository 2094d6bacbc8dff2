// Guards import.md through the command line. Each format other than DICOM, NRRD, NIfTI and MetaImage is
// listed, drawn, shown in slices and converted, alone and in a folder. Truncated files are refused with their
// name and the numbers. Either name opens a pair of files.
#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/io/gzipped.h"
#include "tests/unit/io/other_formats.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestFormatCommands : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }
  void isOpenedByEveryCommand_data() { rows(); }
  void isOpenedByEveryCommand();
  void cutShortItIsRefused_data() { rows(); }
  void cutShortItIsRefused();
  void pairsAreOpenedByEitherName_data();
  void pairsAreOpenedByEitherName();
  void samplesWithoutHeaderAreRefused();
  void whatIsNotReadIsNamed_data();
  void whatIsNotReadIsNamed();

 private:
  static void rows();
  QString at(const char* name) const { return folder_->filePath(QLatin1String(name)); }
  void write(const QString& name, const QByteArray& content, int cut = 0) const;
  void writeFile(const QString& name, const QByteArray& bytes) const;
  std::unique_ptr<QTemporaryDir> folder_;
};

namespace {

// Returns the only volume at a path, as `info` lists it.
QJsonObject volumeAt(const QString& path) {
  const Outcome info = runProgram(QStringLiteral("info %1 --json --values").arg(path));
  const QJsonArray all = QJsonDocument::fromJson(info.out).object()[QStringLiteral("volumes")].toArray();
  return info.status == 0 && all.size() == 1 ? all[0].toObject() : QJsonObject();
}

}  // namespace

void TestFormatCommands::rows() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QString>("format");
  const auto row = [](const char* name, const QByteArray& content, const char* format) {
    QTest::newRow(name) << QString::fromLatin1(name) << content << QString::fromLatin1(format);
  };
  row("a.hdr", analyzeHeader(), "Analyze");
  row("a.mgh", mgh(), "MGH");
  row("a.mgz", gzipped(mgh()), "MGH");
  row("a.gipl", gipl(), "GIPL");
  row("a.gipl.gz", gzipped(gipl()), "GIPL");
  row("a.vtk", vtk(), "VTK");
  row("a.mrc", mrc(), "MRC");
}

// Writes a file, for Analyze also the .img. `cut` is the number of bytes missing from its data.
void TestFormatCommands::write(const QString& name, const QByteArray& content, int cut) const {
  const bool isPair = name.endsWith(QLatin1String(".hdr"));
  writeFile(name, isPair ? content : content.chopped(cut));
  if (isPair) writeFile(QStringLiteral("a.img"), samples().chopped(cut));
}

void TestFormatCommands::writeFile(const QString& name, const QByteArray& bytes) const {
  QFile file(folder_->filePath(name));
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size()) qFatal("no temporary file");
}

void TestFormatCommands::isOpenedByEveryCommand() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QString, format);
  write(name, content);
  const QString file = folder_->filePath(name);
  const QJsonObject volume = volumeAt(file);
  QCOMPARE(volume[QStringLiteral("format")].toString(), format);
  QCOMPARE(volume[QStringLiteral("dims")].toArray(), (QJsonArray{4, 3, 2}));
  QCOMPARE(volume[QStringLiteral("min")].toDouble(), 1.0);
  QCOMPARE(volume[QStringLiteral("max")].toDouble(), 24.0);
  QCOMPARE(volumeAt(folder_->path()), volume);
  for (const QString& command : {QStringLiteral("render %1 --size 16x16 -o %2").arg(file, at("p.png")),
                                 QStringLiteral("slice %1 -o %2").arg(file, at("p.png")),
                                 QStringLiteral("convert %1 -o %2").arg(file, at("v.nrrd"))}) {
    const Outcome done = runProgram(command);
    QVERIFY2(done.status == 0, qPrintable(command + QString::fromUtf8(done.err)));
  }
  const QJsonObject converted = volumeAt(at("v.nrrd"));
  for (const char* same : {"dims", "spacing", "origin", "farCorner", "crc32Values"})
    QCOMPARE(converted[QLatin1String(same)], volume[QLatin1String(same)]);
}

void TestFormatCommands::cutShortItIsRefused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  write(name, content, 9);
  const Outcome info = runProgram(QStringLiteral("info %1 --json --values").arg(folder_->path()));
  const QJsonObject found = QJsonDocument::fromJson(info.out).object();
  QVERIFY(found[QStringLiteral("volumes")].toArray().isEmpty());
  const QJsonArray refused = found[QStringLiteral("refused")].toArray();
  QCOMPARE(refused.size(), 1);
  QVERIFY(refused[0].toObject()[QStringLiteral("path")].toString().endsWith(name));
  for (const char* line : {"render %1 --size 16x16 -o %2", "slice %1 -o %2", "convert %1 -o %2"}) {
    const QString out = at(line[0] == 'c' ? "v.nrrd" : "p.png");
    const Outcome done = runProgram(QString::fromLatin1(line).arg(folder_->filePath(name), out));
    QCOMPARE(done.status, 1);
    QVERIFY2(done.err.contains(name.toUtf8()), done.err);
    QVERIFY(!QFile::exists(out));
  }
}

void TestFormatCommands::pairsAreOpenedByEitherName_data() {
  QTest::addColumn<QString>("header");
  QTest::addColumn<QString>("image");
  const auto row = [](const char* name, const char* header, const char* image) {
    QTest::newRow(name) << QString::fromLatin1(header) << QString::fromLatin1(image);
  };
  row("plain", "a.hdr", "a.img");
  row("capitals", "A.HDR", "A.IMG");
  row("packed samples", "a.hdr", "a.img.gz");
  row("both packed", "a.hdr.gz", "a.img.gz");
  row("packed header", "a.hdr.gz", "a.img");
  row("dots in the name", "scan.2.hdr", "scan.2.img");
}

void TestFormatCommands::pairsAreOpenedByEitherName() {
  QFETCH(QString, header);
  QFETCH(QString, image);
  const auto inside = [](const QString& name, const QByteArray& bytes) {
    return name.endsWith(QLatin1String(".gz")) ? gzipped(bytes) : bytes;
  };
  writeFile(header, inside(header, analyzeHeader()));
  writeFile(image, inside(image, samples()));
  for (const QString& name : {header, image}) {
    const QJsonObject volume = volumeAt(folder_->filePath(name));
    QCOMPARE(volume[QStringLiteral("dims")].toArray(), (QJsonArray{4, 3, 2}));
    QCOMPARE(volume[QStringLiteral("max")].toDouble(), 24.0);
  }
}

void TestFormatCommands::samplesWithoutHeaderAreRefused() {
  writeFile(QStringLiteral("a.img"), samples());
  writeFile(QStringLiteral("b.hdr"), analyzeHeader());
  const Outcome info = runProgram(QStringLiteral("info %1").arg(at("a.img")));
  QCOMPARE(info.status, 1);
  QVERIFY2(info.out.contains("a.img"), info.out);
}

void TestFormatCommands::whatIsNotReadIsNamed_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  const auto row = [](const char* name, const QByteArray& begins) {
    QTest::newRow(name) << QString::fromLatin1(name) << begins + QByteArray(600, '\0');
  };
  row("a.mnc", "CDF\1");
  row("a.h5", "\x89HDF\r\n\x1a\n");
  row("a.tif", QByteArray("II*\0", 4));
  row("a.PAR", "# === DATA DESCRIPTION FILE ===\n# CLINICAL TRYOUT Research image export tool V4.2\n");
}

void TestFormatCommands::whatIsNotReadIsNamed() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  write(name, content);
  const Outcome done =
      runProgram(QStringLiteral("render %1 --size 16x16 -o %2").arg(folder_->filePath(name), at("p.png")));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains("onvert it to NIfTI or NRRD"), done.err);
}

VOLUMEN_TEST(TestFormatCommands);
#include "tst_format_commands.moc"
