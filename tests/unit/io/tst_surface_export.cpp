// Guards the export of surfaces, one file a segment: each holds the surface of its segment. If one cannot be
// written, none is.
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <glm/geometric.hpp>

#include "io/export/export_segments.h"
#include "io/export/surface_file.h"
#include "io/study/series.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/later_cancel.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSurfaceExport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachFileIsItsSegments_data();
  void eachFileIsItsSegments();
  void filesOfSegmentsDiffer_data();
  void filesOfSegmentsDiffer();
  void filesSayWhoseTheyAre_data();
  void filesSayWhoseTheyAre();
  void cancelledAtAnyMomentAllAreThereOrNone();
};

namespace {

// Returns two balls, with a segment without voxels between them in the list.
Segmented ballsAndNothing(int edge) {
  LabelEdit edit{LabelMap(VoxelGeometry{.size = {2 * edge, edge, edge}})};
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < 2 * edge; ++i) {
        const double half = edge / 2.0;
        const glm::dvec3 p(i % edge, j, k);
        if (glm::distance(p, glm::dvec3(half)) < half - 2)
          edit.set({i, j, k}, std::uint8_t(i < edge ? 1 : 3));
      }
  return {{{.number = 1, .label = "Left"}, {.number = 2, .label = "None"}, {.number = 3, .label = "Right"}},
          edit.done()};
}

QByteArray bytesOfFile(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

QStringList filesIn(const QTemporaryDir& folder) {
  return QDir(folder.path()).entryList(QDir::Files | QDir::Hidden, QDir::Name);
}

}  // namespace

void TestSurfaceExport::eachFileIsItsSegments_data() {
  QTest::addColumn<double>("reducedByMm");
  QTest::newRow("all triangles") << 0.0;
  QTest::newRow("fewer triangles") << 0.3;
}

void TestSurfaceExport::eachFileIsItsSegments() {
  QFETCH(double, reducedByMm);
  const QTemporaryDir folder;
  const Segmented balls = ballsAndNothing(16);
  const auto done = exportSegments(folder.filePath(QStringLiteral("b.stl")).toStdString(), {&balls, 1},
                                   Series(), {}, {}, {reducedByMm, false});
  QVERIFY2(done, done ? "" : done.message().c_str());
  QCOMPARE(filesIn(folder), QStringList({QStringLiteral("b-Left.stl"), QStringLiteral("b-Right.stl")}));
  std::vector<std::string> notes;
  for (const Segment& segment : balls.segments) {
    const SurfaceToWrite made = *surfaceToWrite(balls, segment, reducedByMm);
    const std::string path = folder.filePath(QStringLiteral("b-")).toStdString() + segment.label + ".stl";
    if (made.surface.triangles.empty()) {
      notes.push_back(segment.label + " has no voxels, and no surface.");
      continue;
    }
    for (const std::string& told : toldOf(made)) notes.push_back(path + ": " + told);
    const QByteArray written = bytesOfFile(QString::fromStdString(path));
    QVERIFY(writeSurface(made.surface, path));
    QVERIFY(bytesOfFile(QString::fromStdString(path)) == written);
  }
  QVERIFY(done->notes == notes);
}

void TestSurfaceExport::filesSayWhoseTheyAre_data() {
  QTest::addColumn<QByteArray>("patient");
  QTest::addColumn<QByteArray>("said");  // parts, separated by bars
  for (const char* ending : {".stl", ".ply", ".obj", ".seg.nrrd"})
    QTest::newRow(ending) << QByteArray("Doe^Jane") << QByteArray("PAT4711|Doe^Jane|20260314|73165|Thorax");
  QTest::newRow("uid.ply") << QByteArray("Doe^Jane") << QByteArray("1.2.3.4.5");
  QTest::newRow("uid.seg.nrrd") << QByteArray("Doe^Jane") << QByteArray("SeriesInstanceUID:=1.2.3.4.5");
  QTest::newRow("long.stl") << QByteArray(64, 'x') << QByteArray("PAT4711|20260314|73165");
  QTest::newRow("hostile.obj") << QByteArray("A\nf 1 2 3 SPACE=RAS") << QByteArray("A f 1 2 3 SPACE:RAS");
  QTest::newRow("hostile.seg.nrrd") << QByteArray("A\n\nB") << QByteArray("PatientName:=A  B");
}

void TestSurfaceExport::filesSayWhoseTheyAre() {
  QFETCH(QByteArray, patient);
  QFETCH(QByteArray, said);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("a") + QLatin1String(QTest::currentDataTag()));
  Series series;
  series.patientName = patient.toStdString(), series.patientId = "PAT4711", series.studyDate = "20260314";
  series.seriesNumber = "73165", series.description = "Thorax", series.seriesUid = "1.2.3.4.5";
  const Segmented balls = ballsAndNothing(12);
  SurfaceWriting inOneFile;
  inOneFile.inOneFile = true;
  const auto done = exportSegments(path.toStdString(), {&balls, 1}, series, {}, {}, inOneFile);
  QVERIFY2(done, done ? "" : done.message().c_str());
  const QByteArray bytes = bytesOfFile(path),
                   header = path.endsWith(QStringLiteral(".stl")) ? bytes.left(80) : bytes;
  for (const QByteArray& part : said.split('|')) QVERIFY2(header.contains(part), part);
}

void TestSurfaceExport::filesOfSegmentsDiffer_data() {
  QTest::addColumn<QString>("left");
  QTest::addColumn<QString>("right");
  QTest::addColumn<QStringList>("files");
  const QString a99(99, QLatin1Char('a')), umlauts(3000, QChar(0xe4));
  const auto row = [](const char* name, const QString& left, const QString& right, const QString& first,
                      const QString& second) {
    QTest::newRow(name) << left << right << QStringList{first, second};
  };
  row("what a folder reads otherwise", QStringLiteral("x/A"), QStringLiteral("x:A"), QStringLiteral("x_A"),
      QStringLiteral("x_A (2)"));
  row("two long names", a99 + QStringLiteral("bc"), a99 + QStringLiteral("bd"), a99 + QLatin1Char('b'),
      a99 + QStringLiteral("b (2)"));
  row("no half letters", a99 + QChar(0xe4), umlauts, a99, umlauts.left(50));
}

void TestSurfaceExport::filesOfSegmentsDiffer() {
  QFETCH(QString, left);
  QFETCH(QString, right);
  QFETCH(QStringList, files);
  const QTemporaryDir folder;
  Segmented balls = ballsAndNothing(16);
  balls.segments[0].label = left.toStdString(), balls.segments[2].label = right.toStdString();
  const std::string path = folder.filePath(QStringLiteral("b.stl")).toStdString();
  const auto done = exportSegments(path, {&balls, 1}, Series());
  QVERIFY2(done, done ? "" : done.message().c_str());
  std::vector<std::string> wanted;
  for (const QString& name : files)
    wanted.push_back(folder.filePath(QStringLiteral("b-") + name + QStringLiteral(".stl")).toStdString());
  QCOMPARE(done->files, wanted);
  QCOMPARE(filesIn(folder).size(), 2);
}

void TestSurfaceExport::cancelledAtAnyMomentAllAreThereOrNone() {
  const Segmented balls = ballsAndNothing(40);
  QElapsedTimer timer;
  const auto exported = [&](const QTemporaryDir& folder, const CancelToken& cancel) {
    return exportSegments(folder.filePath(QStringLiteral("b.obj")).toStdString(), {&balls, 1}, Series(), {},
                          cancel, {0.1, false});
  };
  timer.start();
  const QTemporaryDir whole;
  QVERIFY(exported(whole, {}));
  const std::int64_t took = timer.nsecsElapsed();
  const Seeds seeds = seedsOf(10, 100);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const QTemporaryDir folder;
    const CancelToken cancel;
    const LaterCancel later(cancel, std::chrono::nanoseconds(std::int64_t(chance.share() * double(took))));
    const auto done = exported(folder, cancel);
    QCOMPARE(filesIn(folder).size(), done ? 2 : 0);
    if (!done) QCOMPARE(done.message(), std::string("Interrupted; nothing was written."));
  }
}

VOLUMEN_TEST(TestSurfaceExport);
#include "tst_surface_export.moc"
