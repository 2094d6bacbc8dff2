// Guards export/film_file.h: an animated PNG holds its pictures bit for bit by the specification, MP4 as the
// program ffmpeg encodes them; what fails or is cancelled is said, leaves no file and no running program.
#include <signal.h>

#include <QDir>
#include <QFile>
#include <QPainter>
#include <QTemporaryDir>

#include "io/export/film_file.h"
#include "tests/fixtures/later_cancel.h"
#include "tests/fixtures/mount_disk.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/read_film.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Colours that change from picture to picture, with a square that moves.
QImage filmPicture(QSize size, int n, QImage::Format format = QImage::Format_RGB888) {
  QImage picture(size, QImage::Format_RGB888);
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width(); ++x)
      picture.setPixel(x, y, qRgb(255 * x / size.width(), 255 * y / size.height(), 20 * n));
  QPainter(&picture).fillRect(5 * n, 3, 6, 6, Qt::white);
  return picture.convertToFormat(format);
}

std::vector<QImage> filmPictures(QSize size, int count, QImage::Format format = QImage::Format_RGB888) {
  std::vector<QImage> pictures;
  for (int n = 0; n < count; ++n) pictures.push_back(filmPicture(size, n, format));
  return pictures;
}

const PictureText filmText{{"Comment", "Not for clinical use"}, {"volumen-error-estimated", "of one"}};

Status writeFilm(const QString& path, const std::vector<QImage>& pictures, int count, int perSecond = 10,
                 const CancelToken& cancel = {}) {
  auto film = FilmFile::create(path.toStdString(), count, perSecond);
  if (!film) return film.error();
  for (const QImage& picture : pictures)
    if (Status s = (*film)->add(picture, filmText, cancel); !s) return s;
  return (*film)->finish(cancel);
}

QStringList everythingIn(const QString& folder) {
  return QDir(folder).entryList(QDir::AllEntries | QDir::Hidden | QDir::System | QDir::NoDotAndDotDot);
}

// Lets only the program ffmpeg of a folder be found.
class OtherFfmpeg {
 public:
  explicit OtherFfmpeg(const QByteArray& script) : before_(qgetenv("PATH")) {
    if (!script.isEmpty()) {
      QFile file(folder_.filePath(QStringLiteral("ffmpeg")));
      if (file.open(QIODevice::WriteOnly)) file.write("#!/bin/sh\n" + script);
      file.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    }
    qputenv("PATH", folder_.path().toUtf8());
  }
  ~OtherFfmpeg() { qputenv("PATH", before_); }
  OtherFfmpeg(const OtherFfmpeg&) = delete;
  OtherFfmpeg& operator=(const OtherFfmpeg&) = delete;
  QString path(const char* name) const { return folder_.filePath(QLatin1String(name)); }

 private:
  const QByteArray before_;
  QTemporaryDir folder_;
};

}  // namespace

class TestFilmFile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesComeBack_data();
  void picturesComeBack();
  void whatIsTransparentBecomesBlack();
  void plainReadersShowTheFirst();
  void mp4HoldsThem_data();
  void mp4HoldsThem();
  void whatIsWrongIsSaid_data();
  void whatIsWrongIsSaid();
  void programsThatFailAreSaid_data();
  void programsThatFailAreSaid();
  void cancelledLeavesNothing_data();
  void cancelledLeavesNothing();
  void aProgramThatHangsIsEnded();
  void aFullDiskKeepsNothing_data();
  void aFullDiskKeepsNothing();
};

void TestFilmFile::picturesComeBack_data() {
  QTest::addColumn<QSize>("size");
  QTest::addColumn<int>("count");
  QTest::addColumn<int>("perSecond");
  QTest::addColumn<QString>("name");
  QTest::addColumn<int>("format");
  const auto row = [](const char* name, QSize size, int count, int perSecond, const char* file,
                      QImage::Format format) {
    QTest::newRow(name) << size << count << perSecond << QString::fromLatin1(file) << int(format);
  };
  row("several", {64, 48}, 7, 10, "film.png", QImage::Format_RGB888);
  row("a single one", {64, 48}, 1, 1, "film.apng", QImage::Format_RGB888);
  row("a single pixel", {1, 1}, 3, 100, "film.PNG", QImage::Format_RGB888);
  row("more bytes than a chunk of the encoder holds", {700, 301}, 3, 25, "film.png", QImage::Format_RGB32);
  row("grey", {33, 21}, 4, 10, "film.png", QImage::Format_Grayscale8);
}

void TestFilmFile::picturesComeBack() {
  QFETCH(QSize, size);
  QFETCH(int, count);
  QFETCH(int, perSecond);
  QFETCH(QString, name);
  QFETCH(int, format);
  const QTemporaryDir folder;
  const QString path = folder.filePath(name);
  const std::vector<QImage> pictures = filmPictures(size, count, QImage::Format(format));
  const Status written = writeFilm(path, pictures, count, perSecond);
  QVERIFY2(written, written ? "" : written.message().c_str());
  QCOMPARE(everythingIn(folder.path()), QStringList{name});
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.plays, 0);
  QCOMPARE(film.pictures.size(), pictures.size());
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    QCOMPARE(film.pictures[n], pictures[n].convertToFormat(QImage::Format_RGB888));
    QCOMPARE(film.delays[n], std::pair(1, perSecond));
  }
}

void TestFilmFile::whatIsTransparentBecomesBlack() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("film.png"));
  QImage clear(8, 8, QImage::Format_ARGB32), half = clear;
  clear.fill(Qt::transparent);
  half.fill(qRgba(255, 255, 255, 128));
  QVERIFY(writeFilm(path, {clear, half}, 2));
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures[0].pixel(3, 3), qRgb(0, 0, 0));
  QVERIFY(std::abs(qGreen(film.pictures[1].pixel(3, 3)) - 128) <= 1);
}

// And its texts, but not what holds for the first picture alone, unless it is the only one.
void TestFilmFile::plainReadersShowTheFirst() {
  const QTemporaryDir folder;
  for (const int count : {1, 3}) {
    const QString path = folder.filePath(QStringLiteral("%1.png").arg(count));
    QVERIFY(writeFilm(path, filmPictures({40, 30}, count), count));
    const QImage shown(path);
    QCOMPARE(shown.convertToFormat(QImage::Format_RGB888), filmPicture({40, 30}, 0));
    QCOMPARE(shown.text(QStringLiteral("Comment")), QStringLiteral("Not for clinical use"));
    QCOMPARE(shown.text(QStringLiteral("volumen-error-estimated")).isEmpty(), count > 1);
  }
}

void TestFilmFile::mp4HoldsThem_data() {
  QTest::addColumn<QSize>("size");
  QTest::addColumn<int>("count");
  QTest::addColumn<QString>("name");
  QTest::newRow("even sizes") << QSize(128, 96) << 12 << QStringLiteral("film.mp4");
  QTest::newRow("odd sizes get a black edge") << QSize(127, 95) << 5 << QStringLiteral("film.mp4");
  QTest::newRow("a single one") << QSize(64, 64) << 1 << QStringLiteral("film.MP4");
  QTest::newRow("a name that a shell or a protocol would read")
      << QSize(64, 64) << 2 << QStringLiteral("-a 'b\" $(c): %03d;.mp4");
}

// Lossy, so only nearly.
void TestFilmFile::mp4HoldsThem() {
  NEED_FFMPEG();
  QFETCH(QSize, size);
  QFETCH(int, count);
  QFETCH(QString, name);
  const QTemporaryDir folder;
  const QString path = folder.filePath(name);
  const std::vector<QImage> pictures = filmPictures(size, count);
  const Status written = writeFilm(path, pictures, count);
  QVERIFY2(written, written ? "" : written.message().c_str());
  QCOMPARE(everythingIn(folder.path()), QStringList{name});
  QVERIFY(contentsOf(path).contains("Not for clinical use"));
  const QSize even(size.width() + size.width() % 2, size.height() + size.height() % 2);
  const std::vector<QImage> decoded = decodedFilm(QStringLiteral("file:") + path, even);
  QCOMPARE(decoded.size(), pictures.size());
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    const double off = meanDifference(decoded[n].copy(QRect({0, 0}, size)), pictures[n]);
    QVERIFY2(off < 6, qPrintable(QString::number(off)));
    if (n > 0) QVERIFY(meanDifference(decoded[n].copy(QRect({0, 0}, size)), pictures[n - 1]) > off);
  }
}

void TestFilmFile::whatIsWrongIsSaid_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<int>("count");
  QTest::addColumn<int>("given");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* file, int count, int given, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(file) << count << given << QString::fromLatin1(says);
  };
  row("no picture", "film.png", 0, 0, "a film needs a picture");
  row("one is missing", "film.png", 3, 2, "it has 2 of 3 pictures");
  row("none is given", "film.png", 3, 0, "it has 0 of 3 pictures");
  row("one too many", "film.png", 2, 3, "there are more than 2 pictures");
  row("another format", "film.gif", 2, 2, "films are written as .png or .apng (animated PNG) or as .mp4.");
  row("no such folder", "none/film.png", 2, 2, "no such folder");
}

void TestFilmFile::whatIsWrongIsSaid() {
  QFETCH(QString, name);
  QFETCH(int, count);
  QFETCH(int, given);
  QFETCH(QString, says);
  const QTemporaryDir folder;
  const QString path = folder.filePath(name);
  const Status written = writeFilm(path, filmPictures({16, 16}, given), count);
  QVERIFY(!written);
  const QString sentence = QString::fromStdString(written.message());
  QVERIFY2(sentence.contains(says) && sentence.contains(path), qPrintable(sentence));
  QCOMPARE(everythingIn(folder.path()), QStringList());
  const Status sizes = writeFilm(folder.filePath(QStringLiteral("film.png")),
                                 {filmPicture({16, 16}, 0), filmPicture({16, 15}, 1)}, 2);
  QVERIFY(!sizes && sizes.message().find("picture 2 has 16 x 15 pixels") != std::string::npos);
  QCOMPARE(everythingIn(folder.path()), QStringList());
}

void TestFilmFile::programsThatFailAreSaid_data() {
  QTest::addColumn<QByteArray>("script");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* script, const char* says) {
    QTest::newRow(name) << QByteArray(script) << QString::fromLatin1(says);
  };
  row("it is not installed", "", "MP4 needs ffmpeg: install the package ffmpeg.");
  row("it ends at once with a reason", "echo first >&2; echo 'Unknown encoder x' >&2; exit 1\n",
      "ffmpeg says: Unknown encoder x.");
  row("it fails after all pictures", "/bin/cat >/dev/null; echo 'No space left' >&2; exit 1\n",
      "ffmpeg says: No space left.");
  row("it crashes", "kill -9 $$\n", "ffmpeg ended early.");
}

// Pictures that no buffer between the programs holds.
void TestFilmFile::programsThatFailAreSaid() {
  QFETCH(QByteArray, script);
  QFETCH(QString, says);
  const OtherFfmpeg other(script);
  const QTemporaryDir folder;
  const Status written =
      writeFilm(folder.filePath(QStringLiteral("film.mp4")), filmPictures({800, 600}, 2), 2);
  QVERIFY(!written);
  const QString sentence = QString::fromStdString(written.message());
  QVERIFY2(sentence.endsWith(says), qPrintable(sentence));
  QCOMPARE(everythingIn(folder.path()), QStringList());
}

void TestFilmFile::cancelledLeavesNothing_data() {
  QTest::addColumn<QString>("name");
  QTest::newRow("animated PNG") << QStringLiteral("film.png");
  QTest::newRow("MP4") << QStringLiteral("film.mp4");
}

// A film that was there stays.
void TestFilmFile::cancelledLeavesNothing() {
  QFETCH(QString, name);
  if (name.endsWith(QLatin1String("mp4"))) NEED_FFMPEG();
  const QTemporaryDir folder;
  const QString path = folder.filePath(name);
  QVERIFY(writeFilm(path, filmPictures({32, 32}, 2), 2));
  const QByteArray before = contentsOf(path);
  {
    const CancelToken cancel;
    auto film = FilmFile::create(path.toStdString(), 3, 10);
    QVERIFY(film);
    QVERIFY((*film)->add(filmPicture({32, 32}, 0), {}, cancel));
    QVERIFY((*film)->add(filmPicture({32, 32}, 1), {}, cancel));
    cancel.cancel();
    QVERIFY(!(*film)->add(filmPicture({32, 32}, 2), {}, cancel));
  }
  {
    auto given = FilmFile::create(path.toStdString(), 3, 10);
    QVERIFY(given && (*given)->add(filmPicture({32, 32}, 0), {}, {}));
  }
  QCOMPARE(everythingIn(folder.path()), QStringList{name});
  QVERIFY(contentsOf(path) == before);
}

// This ffmpeg reads nothing. The export waits for it until it is cancelled.
void TestFilmFile::aProgramThatHangsIsEnded() {
  const OtherFfmpeg other("echo $$ >\"${0%/*}/pid\"; exec /bin/sleep 600\n");
  const QTemporaryDir folder;
  const CancelToken cancel;
  {
    const LaterCancel later(cancel, std::chrono::milliseconds(500));
    const Status written =
        writeFilm(folder.filePath(QStringLiteral("film.mp4")), filmPictures({800, 600}, 2), 2, 10, cancel);
    QVERIFY(!written);
    QCOMPARE(written.message(), std::string("Cancelled."));
  }
  QCOMPARE(everythingIn(folder.path()), QStringList());
  const int pid = contentsOf(other.path("pid")).trimmed().toInt();
  QVERIFY(pid > 0);
  QCOMPARE(::kill(pid, 0), -1);
  QCOMPARE(errno, ESRCH);
}

void TestFilmFile::aFullDiskKeepsNothing_data() { cancelledLeavesNothing_data(); }

void TestFilmFile::aFullDiskKeepsNothing() {
  QFETCH(QString, name);
  if (name.endsWith(QLatin1String("mp4"))) NEED_FFMPEG();
  std::vector<QImage> noise;  // which cannot be compressed
  quint32 state = 1;
  for (int n = 0; n < 4; ++n) {
    noise.emplace_back(320, 240, QImage::Format_RGB888);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) noise.back().setPixel(x, y, state = state * 1664525u + 1013904223u);
  }
  const QTemporaryDir disk;
  const QByteArray folder = disk.path().toUtf8();
  MOUNT_DISK(folder.constData(), 0, "size=64k");
  const Status written = writeFilm(disk.filePath(name), noise, 4);
  const QStringList left = everythingIn(disk.path());
  QCOMPARE(umount(folder.constData()), 0);
  QVERIFY(!written);
  QVERIFY2(written.message().find("No space left") != std::string::npos, written.message().c_str());
  QCOMPARE(left, QStringList());
}

VOLUMEN_TEST(TestFilmFile);
#include "tst_film_file.moc"
