// Guards export.md, films: `volumen export --as apng` writes the pictures of `volumen render` and `volumen
// slice` bit for bit, and `--as mp4` nearly so. A film has one picture for each slice or time point, all in
// one window. Wrong options are refused as wrong usage.
#include <QDir>
#include <QFile>
#include <QImage>
#include <nlohmann/json.hpp>

#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/read_film.h"
#include "tests/unit/app/film_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestExportFilm : public QObject, FilmFolder {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void turnsAreThoseOfRender();
  void stacksAreThoseOfSlice_data();
  void stacksAreThoseOfSlice();
  void timePointsAreInOneWindow();
  void timePointsIn3dAreDrawnAlike();
  void mp4IsNearlyTheSame();
  void namesAreInNoFilm();
  void wrongWordsAreUsage_data();
  void wrongWordsAreUsage();
  void whatCannotBeIsSaid_data();
  void whatCannotBeIsSaid();

 private:
  const QString phantom_ = QStringLiteral("phantom:ct-head:24");
};

namespace {

constexpr int filmPoints = 3;

// Writes a file of three volumes of 8 x 8 x 8 voxels. `value` takes the indices of a voxel and of its
// volume.
template <class Value>
void writeTimePoints(const QString& path, const Value& value) {
  constexpr int voxels = 8 * 8 * 8;
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(
      "NRRD0005\ntype: uint16\ndimension: 4\nspace: left-posterior-superior\nsizes: 8 8 8 3\n"
      "space directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\n"
      "space origin: (0,0,0)\nendian: little\nencoding: raw\n\n");
  for (int n = 0; n < voxels * filmPoints; ++n) {
    const int at = value(n % voxels, n / voxels);
    file.write(QByteArray(1, char(at & 255)) + QByteArray(1, char(at >> 8)));
  }
}

QImage pictureIn(const QString& path) { return QImage(path).convertToFormat(QImage::Format_RGB888); }

}  // namespace

// The three volumes have the constant values 100, 200 and 300.
void TestExportFilm::initTestCase() {
  writeTimePoints(at(QStringLiteral("time.nrrd")), [](int, int step) { return 100 * (step + 1); });
}

void TestExportFilm::turnsAreThoseOfRender() {
  const QString options = QStringLiteral("--preset CT-Bone --view left --size 41x32 --turntable 4");
  const Outcome drawn = run(QStringLiteral("render"), phantom_, options, at(QStringLiteral("turn.png")));
  QVERIFY2(drawn.status == 0, drawn.err);
  const QString path = at(QStringLiteral("film.png"));
  const Outcome done =
      run(QStringLiteral("export"), phantom_, options + QStringLiteral(" --as apng --fps 25"), path);
  QVERIFY2(done.status == 0, done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures.size(), std::size_t(4));
  for (int n = 0; n < 4; ++n) {
    QCOMPARE(film.pictures[std::size_t(n)], pictureIn(at(QStringLiteral("turn-00%1.png").arg(n))));
    QCOMPARE(film.delays[std::size_t(n)], std::pair(1, 25));
  }
  const QImage first(path), rendered(at(QStringLiteral("turn-000.png")));
  for (const char* key : {"Comment", "volumen-scene", "volumen-level"}) {
    QVERIFY(!first.text(QLatin1String(key)).isEmpty());
    QCOMPARE(first.text(QLatin1String(key)), rendered.text(QLatin1String(key)));
  }
}

void TestExportFilm::stacksAreThoseOfSlice_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<double>("spacingMm");  // 0: the acquired slices, chosen by index
  QTest::newRow("axial, the acquired slices") << QStringLiteral("--plane axial --window 40,400") << 0.0;
  QTest::newRow("coronal slabs") << QStringLiteral("--plane coronal --size 40x30 --mm-per-pixel 5 --slab 20")
                                 << 20.0;
  QTest::newRow("sagittal, at a spacing") << QStringLiteral("--plane sagittal --window 40,400") << 30.0;
}

// Each slice lies one spacing further along the normal than the one before.
void TestExportFilm::stacksAreThoseOfSlice() {
  QFETCH(QString, options);
  QFETCH(double, spacingMm);
  const QString path = at(QLatin1String(QTest::currentDataTag()) + QStringLiteral(".apng"));
  const QString spacing = QStringLiteral(" --spacing %1").arg(spacingMm);
  const Outcome done =
      run(QStringLiteral("export"), phantom_,
          options + QStringLiteral(" --as apng") + (spacingMm > 0 ? spacing : QString()), path);
  QVERIFY2(done.status == 0, done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.delays[0], std::pair(1, 10));
  QVERIFY(film.pictures.size() > 4);
  const auto plane =
      nlohmann::json::parse(QImage(path, "PNG").text(QStringLiteral("volumen-plane")).toStdString());
  const bool isCoronal = options.contains(QStringLiteral("coronal"));
  const double first = plane["centre"][isCoronal ? 1 : 0], sign = isCoronal ? 1 : -1;
  for (int n = 0; n < int(film.pictures.size()); ++n) {
    const QString png = at(QStringLiteral("slice.png"));
    const QString place = spacingMm == 0
                              ? QStringLiteral(" --index %1").arg(n)
                              : QStringLiteral(" --at %1").arg(first + sign * n * spacingMm, 0, 'g', 12);
    const Outcome drawn = run(QStringLiteral("slice"), phantom_, options + place, png);
    QVERIFY2(drawn.status == 0, drawn.err);
    QCOMPARE(film.pictures[std::size_t(n)], pictureIn(png));
  }
  if (spacingMm > 0) return;
  const QString after = QStringLiteral(" --index %1").arg(film.pictures.size());
  QVERIFY(run(QStringLiteral("slice"), phantom_, options + after, at(QStringLiteral("slice.png"))).status !=
          0);
}

// Without --window, all time points are drawn in the window of the series that is opened first. Their
// pictures then differ as their values do.
void TestExportFilm::timePointsAreInOneWindow() {
  const QString path = at(QStringLiteral("time.png")), series = at(QStringLiteral("time.nrrd"));
  const Outcome done = run(QStringLiteral("export"), series,
                           QStringLiteral("--as apng --plane coronal --time-points --window 200,400"), path);
  QVERIFY2(done.status == 0, done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures.size(), std::size_t(filmPoints));
  for (int n = 0; n < filmPoints; ++n) {
    const QImage& picture = film.pictures[std::size_t(n)];
    const int grey = qGreen(picture.pixel(picture.width() / 2, picture.height() / 2));
    QVERIFY2(std::abs(grey - 255 * (n + 1) / 4) <= 1, qPrintable(QString::number(grey)));
  }
  const QString without = at(QStringLiteral("time-own.png"));
  const Outcome own = run(QStringLiteral("export"), series,
                          QStringLiteral("--as apng --plane axial --at 7 --time-points"), without);
  QVERIFY2(own.status == 0, own.err);
  const FilmRead ownFilm = readAnimatedPng(contentsOf(without));
  QCOMPARE(ownFilm.flaw, QString());
  QCOMPARE(ownFilm.pictures.size(), std::size_t(filmPoints));
  QVERIFY(ownFilm.pictures[0] != ownFilm.pictures[1]);
}

// The picture of each time point is that of `render` with the scene that the film contains.
void TestExportFilm::timePointsIn3dAreDrawnAlike() {
  const QString series = at(QStringLiteral("ramps.nrrd")), path = at(QStringLiteral("time-3d.png"));
  writeTimePoints(series, [](int n, int step) { return 100 * step + 30 * (n % 8); });
  const QString options = QStringLiteral("--mode mip --view anterior --size 31x24");
  const Outcome done = run(QStringLiteral("export"), series,
                           options + QStringLiteral(" --as apng --fps 4 --time-points"), path);
  QVERIFY2(done.status == 0, done.err);
  const FilmRead film = readAnimatedPng(contentsOf(path));
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures.size(), std::size_t(filmPoints));
  const Outcome info = runProgram({QStringLiteral("info"), QStringLiteral("--json"), series});
  const auto volumes = nlohmann::json::parse(info.out.toStdString())["volumes"];
  QCOMPARE(volumes.size(), std::size_t(filmPoints));
  for (int n = 0; n < filmPoints; ++n) {
    const QString png = at(QStringLiteral("step.png"));
    const QString id = QString::fromStdString(volumes[std::size_t(n)]["id"].get<std::string>());
    const Outcome drawn = run(QStringLiteral("render"), series,
                              QStringLiteral("--size 31x24 --series %1 --scene %2").arg(id, path), png);
    QVERIFY2(drawn.status == 0, drawn.err);
    QCOMPARE(film.pictures[std::size_t(n)], pictureIn(png));
  }
  QVERIFY(film.pictures[0] != film.pictures[1] && film.pictures[1] != film.pictures[2]);
}

void TestExportFilm::mp4IsNearlyTheSame() {
  NEED_FFMPEG();
  const QString options = QStringLiteral("--preset CT-Bone --size 96x64 --turntable 3");
  const QString png = at(QStringLiteral("both.png")), mp4 = at(QStringLiteral("both.mp4"));
  for (const auto& [format, path] : {std::pair(" --as apng", png), {" --as mp4", mp4}}) {
    const Outcome done = run(QStringLiteral("export"), phantom_, options + QLatin1String(format), path);
    QVERIFY2(done.status == 0, done.err);
  }
  const FilmRead film = readAnimatedPng(contentsOf(png));
  const std::vector<QImage> decoded = decodedFilm(mp4, {96, 64});
  QCOMPARE(decoded.size(), std::size_t(3));
  QCOMPARE(film.pictures.size(), decoded.size());
  for (std::size_t n = 0; n < decoded.size(); ++n) QVERIFY(meanDifference(decoded[n], film.pictures[n]) < 6);
  QVERIFY(contentsOf(mp4).contains("Not for clinical use"));
}

// Checks only the texts of the film. Its pictures are those of render and slice, which name nobody.
void TestExportFilm::namesAreInNoFilm() {
  NEED_DATA(dataPath());
  const QString source = QString::fromStdString(dataPath("ct-chest-lidc0314-138"));
  const QString path = at(QStringLiteral("names.png"));
  const Outcome done = run(QStringLiteral("export"), source,
                           QStringLiteral("--as apng --plane coronal --spacing 60 --mm-per-pixel 8"), path);
  QVERIFY2(done.status == 0, done.err);
  const QByteArray bytes = contentsOf(path);
  QVERIFY(readAnimatedPng(bytes).pictures.size() > 1);
  QVERIFY(!bytes.contains("LIDC-IDRI") && !bytes.contains(source.toUtf8()));
  const QImage first(path);
  for (const QString& key : first.textKeys()) QVERIFY(!first.text(key).contains(QStringLiteral("LIDC-IDRI")));
}

void TestExportFilm::wrongWordsAreUsage_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* options, const char* file, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(options) << QString::fromLatin1(file) << QByteArray(says);
  };
  row("MP4 in a PNG", "--as mp4", "x.png", "MP4 files end in .mp4.");
  row("a PNG in MP4", "--as apng", "x.mp4", "animated PNG files end in .png or .apng.");
  row("one slice", "--as apng --plane axial --at 3", "x.png", "A film goes through all slices");
  row("one slice by its number", "--as apng --index 3", "x.png", "A film goes through all slices");
  row("a turn through time", "--as apng --time-points --turntable 4", "x.png",
      "--turntable is for one time point");
  row("one frame", "--as apng --plane frame --index 3", "x.png", "only --window and --series go with it");
  row("frames in another size", "--as apng --plane frame --size 64x64", "x.png",
      "only --window and --series");
  row("frames through time", "--as apng --plane frame --time-points", "x.png", "only --window and --series");
  row("frames as a series", "--as series --plane frame", "x", "not for --as series");
  row("a frame as a capture", "--as sc --plane frame", "x.dcm", "not for --as sc");
  row("a spacing in 3D", "--as apng --spacing 3", "x.png", "--spacing is for slices");
  row("a spacing of time points", "--as apng --plane axial --time-points --spacing 3", "x.png",
      "--spacing is for films through slices");
  row("a turn of slices", "--as mp4 --plane axial --turntable 3", "x.mp4", "--turntable is for 3D pictures");
  row("another format's option", "--as apng --rle", "x.png", "--rle does not go with --as apng");
  row("the pictures a second of a capture", "--as sc --fps 10", "x.dcm", "--fps does not go with --as sc");
  row("an archive", "--as apng", "archive:none", "animated PNG files end in .png or .apng.");
  row("no pictures a second", "--as apng --fps 0", "x.png", "--fps");
  row("without identity", "--as apng --deidentify", "x.png", "leave --deidentify out");
}

void TestExportFilm::wrongWordsAreUsage() {
  QFETCH(QString, options);
  QFETCH(QString, name);
  QFETCH(QByteArray, says);
  const Outcome a = run(QStringLiteral("export"), phantom_, options,
                        name.startsWith(QStringLiteral("archive:")) ? name : at(name));
  QCOMPARE(a.status, 2);
  QVERIFY2(a.err.contains(says), a.err);
  QVERIFY(!QFile::exists(at(name)));
}

void TestExportFilm::whatCannotBeIsSaid_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<QString>("output");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("a single time point") << QStringLiteral("--as apng --plane axial --time-points")
                                       << at(QStringLiteral("y.png")) << QByteArray("only one time point");
  QTest::newRow("no such folder") << QStringLiteral("--as apng --turntable 2")
                                  << at(QStringLiteral("none/y.png")) << QByteArray("no such folder");
  QTest::newRow("a file that is there") << QStringLiteral("--as apng --turntable 2")
                                        << at(QStringLiteral("time.nrrd.png")) << QByteArray("there already");
}

void TestExportFilm::whatCannotBeIsSaid() {
  QFETCH(QString, options);
  QFETCH(QString, output);
  QFETCH(QByteArray, says);
  QFile there(at(QStringLiteral("time.nrrd.png")));
  QVERIFY(there.open(QIODevice::WriteOnly) && there.write("here") == 4);
  there.close();
  const QStringList before = QDir(folder.path()).entryList(QDir::Files | QDir::Hidden);
  const Outcome a = run(QStringLiteral("export"), phantom_, options, output);
  QVERIFY(a.status != 0);
  QVERIFY2(a.err.contains(says), a.err);
  QCOMPARE(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden), before);
  QCOMPARE(contentsOf(there.fileName()), QByteArray("here"));
}

VOLUMEN_TEST(TestExportFilm);
#include "tst_export_film.moc"
