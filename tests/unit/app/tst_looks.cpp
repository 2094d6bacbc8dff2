// Guards design.md 4 and 10 and picture.md 6: looks on the command line, from the user's own presets to
// inverted windows.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestLooks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPresetOfOnesOwnIsUsed();
  void anInvertedWindowIsTheNegative_data();
  void anInvertedWindowIsTheNegative();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  void write(const QString& path, const QByteArray& text) const {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
  }
  QTemporaryDir folder_;
};

void TestLooks::aPresetOfOnesOwnIsUsed() {
  const QByteArray before = qgetenv("XDG_CONFIG_HOME");
  qputenv("XDG_CONFIG_HOME", folder_.path().toLocal8Bit());
  QVERIFY(QDir(folder_.path()).mkpath(QStringLiteral("volumen/presets")));
  const QByteArray look = R"({"mode": "mip", "window": {"centre": 500, "width": 2000}})";
  write(at("volumen/presets/mine.json"), R"({"name": "My MIP", "modality": "CT", "scene": )" + look + "}");
  write(at("volumen/presets/broken.json"), "{");
  write(at("scene.json"), look);
  const QString common = QStringLiteral("render phantom:ct-head:32 --size 30x30 ");
  const Outcome own = runProgram(common + QStringLiteral("--preset \"My MIP\" -o %1").arg(at("own.nrrd")));
  const Outcome scene =
      runProgram(common + QStringLiteral("--scene %1 -o %2").arg(at("scene.json"), at("scene.nrrd")));
  const Outcome none = runProgram(common + QStringLiteral("--preset Nobodys -o %1").arg(at("none.png")));
  qputenv("XDG_CONFIG_HOME", before);
  QVERIFY2(own.status == 0 && scene.status == 0, own.err + scene.err);
  QVERIFY(!contentsOf(at("own.nrrd")).isEmpty());
  QCOMPARE(contentsOf(at("own.nrrd")), contentsOf(at("scene.nrrd")));
  QVERIFY(none.status != 0);
  QVERIFY2(none.err.contains("broken.json"), none.err);
}

void TestLooks::anInvertedWindowIsTheNegative_data() {
  QTest::addColumn<QString>("options");
  for (const char* options :
       {"--mode mip", "--mode minip --quality draft", "--mode average", "--mode mip --reference",
        "--mode average --method blend", "--mode mip --step 0.5"})
    QTest::newRow(options) << QString::fromLatin1(options);
}

void TestLooks::anInvertedWindowIsTheNegative() {
  QFETCH(QString, options);
  const auto drawn = [&](const char* width, const char* background) {
    write(at("window.json"), QByteArray(R"({"window": {"centre": 100, "width": )") + width +
                                 R"(}, "background": )" + background + "}");
    const Outcome outcome =
        runProgram(QStringLiteral("render phantom:ct-head:32 --size 40x40 --scene %1 %2 -o %3")
                       .arg(at("window.json"), options, at("window.png")));
    return outcome.status == 0 ? QImage(at("window.png")) : QImage();
  };
  const QImage plain = drawn("1500", "[0, 0, 0]"), inverted = drawn("-1500", "[1, 1, 1]");
  QVERIFY(!plain.isNull() && !inverted.isNull());
  for (int y = 0; y < plain.height(); ++y)
    for (int x = 0; x < plain.width(); ++x)
      QVERIFY(std::abs(qGray(plain.pixel(x, y)) + qGray(inverted.pixel(x, y)) - 255) <= 1);
}

VOLUMEN_TEST(TestLooks);
#include "tst_looks.moc"
