// Guards export.md, films of frames: `volumen export --plane frame --as apng` writes those of `volumen slice
// --plane frame` bit for bit, with square pixels, in one window, as fast as the file of a clip says.
#include <QDir>
#include <QImage>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/read_film.h"
#include "tests/unit/app/film_case.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestExportClip : public QObject, FilmFolder {
  Q_OBJECT
 private Q_SLOTS:
  void clipsAreTheirFrames_data();
  void clipsAreTheirFrames();
  void pixelsOfFilmsAreSquare_data();
  void pixelsOfFilmsAreSquare();
  void framesWithoutAWindowShareOne();
};

void TestExportClip::clipsAreTheirFrames_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<int>("frames");
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("perSecond");
  QTest::addColumn<QSize>("size");
  const auto row = [](const char* name, const char* file, int frames, const char* options, int perSecond,
                      QSize size) {
    QTest::newRow(name) << QString::fromLatin1(file) << frames << QString::fromLatin1(options) << perSecond
                        << size;
  };
  row("ultrasound in colour, as fast as its file says", "us-cine-aspect-regions.dcm", 34, "", 33, {600, 430});
  row("ultrasound, as fast as asked", "us-palette-cine-10.dcm", 10, "--fps 7", 7, {600, 430});
  row("an angiography in a window", "xa-96frames.dcm", 96, "--window 300,200", 30, {512, 512});
}

void TestExportClip::clipsAreTheirFrames() {
  QFETCH(QString, file);
  QFETCH(int, frames);
  QFETCH(QString, options);
  QFETCH(int, perSecond);
  QFETCH(QSize, size);
  const QString clip = QString::fromStdString(dataPath("dicom-2d/" + file.toStdString()));
  NEED_DATA(clip.toStdString());
  const QString path = at(QStringLiteral("clip %1.png").arg(QLatin1String(QTest::currentDataTag())));
  const QString plane = QStringLiteral(" --plane frame");
  const Outcome done =
      run(QStringLiteral("export"), clip, options + plane + QStringLiteral(" --as apng"), path);
  QVERIFY2(done.status == 0, done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures.size(), std::size_t(frames));
  QCOMPARE(film.delays[0], std::pair(1, perSecond));
  const QString window =
      options.contains(QStringLiteral("--window")) ? QLatin1Char(' ') + options : QString();
  for (const int n : {0, frames / 2, frames - 1}) {
    const QString png = at(QStringLiteral("frame.png"));
    const Outcome drawn =
        run(QStringLiteral("slice"), clip, plane + window + QStringLiteral(" --index %1").arg(n), png);
    QVERIFY2(drawn.status == 0, drawn.err);
    const QImage frame = QImage(png).convertToFormat(QImage::Format_RGB888);
    QCOMPARE(film.pictures[std::size_t(n)],
             frame.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                 .convertToFormat(QImage::Format_RGB888));
  }
}

void TestExportClip::pixelsOfFilmsAreSquare_data() {
  QTest::addColumn<QByteArray>("spacing");  // between rows, between columns
  QTest::addColumn<QSize>("size");
  QTest::newRow("square") << QByteArray("2\\2") << QSize(4, 4);
  QTest::newRow("wide") << QByteArray("1\\2.5") << QSize(10, 4);
  QTest::newRow("high") << QByteArray("3\\1") << QSize(4, 12);
  QTest::newRow("nearly square") << QByteArray("1\\1.01") << QSize(4, 4);
}

// Of a frame of 4 x 4 pixels whose last quarter is white, the last quarter of the film is.
void TestExportClip::pixelsOfFilmsAreSquare() {
  QFETCH(QByteArray, spacing);
  QFETCH(QSize, size);
  const QString dicom = at(QStringLiteral("one.dcm")), path = at(QStringLiteral("square.png"));
  DicomPicture picture{.columns = 4, .rows = 4, .spacing = spacing.toStdString(), .pixels = {}};
  for (int n = 0; n < 16; ++n) picture.pixels.push_back(std::uint16_t(n % 4 < 2 || n < 8 ? 0 : 100));
  writeDicom(dicom.toStdString(), picture);
  QFile::remove(path);
  const Outcome done =
      run(QStringLiteral("export"), dicom, QStringLiteral("--as apng --plane frame --window 50,100"), path);
  QVERIFY2(done.status == 0, done.err);
  QVERIFY2(!done.err.contains("square"), done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  const QImage& made = film.pictures.at(0);
  QCOMPARE(made.size(), size);
  for (const QPoint corner : {QPoint(0, 0), QPoint(1, 0), QPoint(0, 1), QPoint(1, 1)}) {
    const QPoint there(corner.x() * (size.width() - 1), corner.y() * (size.height() - 1));
    QCOMPARE(qGreen(made.pixel(there)), corner == QPoint(1, 1) ? 255 : 0);
  }
}

// Two slices of 100 and 200 all over are black and white: each by itself would be in a window of its own.
void TestExportClip::framesWithoutAWindowShareOne() {
  const QString slices = at(QStringLiteral("two"));
  QVERIFY(QDir().mkpath(slices));
  for (int n = 0; n < 2; ++n)
    writeDicom(slices.toStdString() + "/" + std::to_string(n),
               {.instance = n + 1, .position = {0, 0, n}, .pixels = {std::uint16_t(100 * (n + 1))}});
  const QString path = at(QStringLiteral("shared.png"));
  const Outcome done = run(QStringLiteral("export"), slices, QStringLiteral("--as apng --plane frame"), path);
  QVERIFY2(done.status == 0, done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.pictures.size(), std::size_t(2));
  QCOMPARE(qGreen(film.pictures[0].pixel(0, 0)), 0);
  QCOMPARE(qGreen(film.pictures[1].pixel(0, 0)), 255);
}

VOLUMEN_TEST(TestExportClip);
#include "tst_export_clip.moc"
