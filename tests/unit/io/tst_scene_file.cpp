// Guards design.md 10: the scene in a picture's text can be read. Pictures without one are refused by name.
#include <QFile>
#include <QImage>
#include <QTemporaryDir>

#include "io/files/picture_file.h"
#include "io/files/scene_file.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestSceneFile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theSceneComesBack_data();
  void theSceneComesBack();
  void whatHoldsNoSceneIsRefusedByName_data();
  void whatHoldsNoSceneIsRefusedByName();

 private:
  QTemporaryDir folder_;
};

namespace {

const std::string sceneOf = R"({"volumenScene": 1, "name": "Grün"})" + std::string(70'000, ' ');

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(bytes);
}

}  // namespace

void TestSceneFile::theSceneComesBack_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("scene file") << QStringLiteral("scene.json");
  QTest::newRow("PNG") << QStringLiteral("a.png");
  QTest::newRow("PNG of another name") << QStringLiteral("a.json");
  QTest::newRow("JPEG") << QStringLiteral("a.jpg");
  QTest::newRow("PNG, text that Latin-1 lacks") << QStringLiteral("Ω.png");
  QTest::newRow("PNG, a few letters") << QStringLiteral("short.png");
}

void TestSceneFile::theSceneComesBack() {
  QFETCH(QString, name);
  const QString path = folder_.filePath(name);
  std::string scene = name.endsWith(QLatin1String("jpg")) ? sceneOf.substr(0, 60'000) : sceneOf;
  if (name.startsWith(QStringLiteral("Ω"))) scene = R"({"volumenScene": 1, "name": "Ω and more letters"})";
  if (name.startsWith(QStringLiteral("short"))) scene = "{}";
  if (name.startsWith(QStringLiteral("scene"))) {
    write(path, QByteArray::fromStdString(scene));
  } else {
    const Picture picture{.size = {2, 1}, .rgba = std::vector<float>(8, 1.0f)};
    const PictureText texts{{"Comment", "no"}, {"volumen-scene", scene}};
    QVERIFY(name.endsWith(QLatin1String("jpg"))
                ? writeImage(imageForFile(picture), path.toStdString(), texts).ok()
                : writePng(picture, path.toStdString(), texts).ok());
  }
  const auto text = sceneText(path.toStdString());
  QVERIFY2(text.ok(), text.ok() ? "" : text.message().c_str());
  QCOMPARE(QByteArray::fromStdString(*text).trimmed(), QByteArray::fromStdString(scene).trimmed());
}

void TestSceneFile::whatHoldsNoSceneIsRefusedByName_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("why");
  const auto row = [](const char* what, const QString& path, const char* why) {
    QTest::newRow(what) << path << QString::fromLatin1(why);
  };
  row("missing", folder_.filePath(QStringLiteral("none.json")), "no such file");
  row("folder", folder_.path(), "it is a folder");
  row("device", QStringLiteral("/dev/zero"), "not a regular file");
  const QString plain = folder_.filePath(QStringLiteral("plain.png"));
  QVERIFY(QImage(3, 3, QImage::Format_Grayscale8).save(plain));
  row("picture of another program", plain, "holds no scene");
  const QString cut = folder_.filePath(QStringLiteral("cut.png"));
  write(cut, QByteArray("\x89PNG\r\n\x1a\n\0\0", 10));
  row("PNG cut off", cut, "holds no scene");
  const QString damaged = folder_.filePath(QStringLiteral("damaged.png"));
  const Picture picture{.size = {2, 1}, .rgba = std::vector<float>(8, 1.0f)};
  QVERIFY(writePng(picture, damaged.toStdString(), {{"volumen-scene", sceneOf}}).ok());
  QFile written(damaged);
  QVERIFY(written.open(QIODevice::ReadWrite));
  written.seek(written.readAll().indexOf("volumen-scene") + 20);
  written.write("damage");
  written.close();
  row("PNG, its text damaged", damaged, "holds no scene");
  const QString large = folder_.filePath(QStringLiteral("large.json"));
  QVERIFY(QFile(large).open(QIODevice::WriteOnly) && QFile::resize(large, 17 << 20));
  row("too large", large, "larger than 16 MB");
}

void TestSceneFile::whatHoldsNoSceneIsRefusedByName() {
  QFETCH(QString, path);
  QFETCH(QString, why);
  const auto text = sceneText(path.toStdString());
  QVERIFY(!text.ok());
  const QString said = QString::fromStdString(text.message());
  QVERIFY2(said.contains(path) && said.contains(why) && said.endsWith(QLatin1Char('.')), qPrintable(said));
}

VOLUMEN_TEST(TestSceneFile);
#include "tst_scene_file.moc"
