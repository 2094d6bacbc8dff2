// Guards `volumen export SESSION --as series`: what the 3D view of a session leaves out becomes air, and
// nothing else.
#include <QDir>
#include <QTemporaryDir>

#include "io/files/write_volume.h"
#include "io/open.h"
#include "results/segments/segments.h"
#include "tests/fixtures/ct_with_table.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_files.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/session_json.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

class TestExportSessions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void sessionsGiveWhatTheyShow_data();
  void sessionsGiveWhatTheyShow();
  void sessionsWithoutTheirSegmentsAreRefused();

 private:
  // Writes a session that shows the CT with a table in 3D: without the table, or only inside the spine.
  QString sessionOf(const QTemporaryDir& folder, bool withoutTable, bool onlySpine) const;
  Outcome exported(const QString& source, const QString& options, const QString& folder) const {
    return runProgram(QStringList{QStringLiteral("export"), source, QStringLiteral("--as"),
                                  QStringLiteral("series"), QStringLiteral("-o"), folder} +
                      options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
  }
};

QString TestExportSessions::sessionOf(const QTemporaryDir& folder, bool withoutTable, bool onlySpine) const {
  const QString ct = folder.filePath(QStringLiteral("ct.nrrd")),
                session = folder.filePath(QStringLiteral("s.volumen"));
  const VolumePtr volume = CtWithTable::volume(true);
  if (!writeVolume(*volume, ct.toStdString())) return {};
  const auto study = openStudy(ct.toStdString());
  if (!study) return {};
  const SeriesKey series = keyOf(study->volumes[0]);
  Workspace workspace = withSeries({}, sceneViewId, study->volumes[0], {});
  workspace.series.edit(series).mask.tableRemoved = withoutTable;
  if (onlySpine) {
    Segment spine;
    spine.label = "Spine";
    workspace = withNewSegment(std::move(workspace), series, volume->geometry(), spine);
    const SegmentMap map = *segmentMapOf(workspace, series, 0);
    workspace =
        withSegmentMap(std::move(workspace), withMask(map, map.current, voxelsInRange(*volume, {690, 710})));
    workspace = withTissueShown(std::move(workspace), series, {TissueShown::Where::inside, 0});
  }
  if (!writeSegmentMaps(session.toStdString(), workspace)) return {};
  const auto text = sessionToJson(workspace, folder.path().toStdString());
  QFile file(session);
  if (!text || !file.open(QIODevice::WriteOnly) || file.write(QByteArray::fromStdString(*text)) < 0)
    return {};
  return session;
}

void TestExportSessions::sessionsGiveWhatTheyShow_data() {
  QTest::addColumn<bool>("withoutTable");
  QTest::addColumn<bool>("onlySpine");
  QTest::addColumn<QByteArray>("says");  // in brackets; empty: nothing is taken away
  QTest::newRow("all") << false << false << QByteArray();
  QTest::newRow("without its table") << true << false << QByteArray("(table removed)");
  QTest::newRow("only inside segments") << false << true << QByteArray("(only inside segments)");
  QTest::newRow("both") << true << true << QByteArray("(table removed, only inside segments)");
}

// Voxels are cubes: axial slices of the whole are those of the file.
void TestExportSessions::sessionsGiveWhatTheyShow() {
  QFETCH(bool, withoutTable);
  QFETCH(bool, onlySpine);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder;
  const QString session = sessionOf(folder, withoutTable, onlySpine);
  QVERIFY(!session.isEmpty());
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a = exported(session, {}, out);
  QVERIFY2(a.status == 0, a.err);
  QCOMPARE(a.err.contains("leaves out in 3D " + says), !says.isEmpty());
  const VolumePtr made = volumeAt(out.toStdString()), whole = CtWithTable::volume(!withoutTable);
  QVERIFY(made->size() == whole->size());
  for (std::size_t n = 0; n < std::size_t(whole->geometry().voxelCount()); ++n) {
    const float wanted = onlySpine && whole->valueAt(n) != 700 ? -1000 : whole->valueAt(n);
    if (made->valueAt(n) != wanted) QCOMPARE(made->valueAt(n), wanted);
  }
  if (says.isEmpty()) return;
  const Outcome twice =
      exported(session, QStringLiteral("--deface"), folder.filePath(QStringLiteral("faceless")));
  QCOMPARE(twice.status, 1);
  QVERIFY2(twice.err.contains("does not go with parts that are taken away"), twice.err);
}

void TestExportSessions::sessionsWithoutTheirSegmentsAreRefused() {
  const QTemporaryDir folder;
  const QString session = sessionOf(folder, false, true);
  const QStringList labels = segmentFilesOf(session);
  QCOMPARE(labels.size(), 1);
  QVERIFY(QFile::remove(labels.front()));
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome lost = exported(session, {}, out);
  QCOMPARE(lost.status, 1);
  QVERIFY2(lost.err.contains("segments of the session were not found"), lost.err);
  const Outcome said = exported(session, QStringLiteral("--remove-table"), out);
  QCOMPARE(said.status, 2);
  QVERIFY2(said.err.contains("is a session, which says what is shown"), said.err);
  QVERIFY(!QDir(out).exists());
}

VOLUMEN_TEST(TestExportSessions);
#include "tst_export_sessions.moc"
