// Guards design.md 8: `volumen render` draws a session as the window does.
#include <QComboBox>
#include <QSpinBox>

#include <memory>
#include <tuple>

#include "results/segments/segments.h"
#include "tests/fixtures/program.h"
#include "tests/ui/gestures.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_files.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

bool segmentsAreMade(Journey& w) {
  return QTest::qWaitFor([&] { return w.window.jobs().rows().empty(); }, longest);
}

// Shows the translucent trunk and the spine in a thin volume, in one map or in two. Returns true once they
// are in the picture.
bool showSegments(Journey& w, int maps = 1) {
  Session& session = w.window.session();
  const bool isThin = settles(w, [&] {
    session.edit(QStringLiteral("thin"), [](Scene& s) {
      for (CurvePoint& p : s.transferFunction.points) p.opacity *= 0.1;
    });
  });
  if (!isThin) return false;
  const VolumePtr volume = session.series()->volume;
  const SeriesKey series = keyOf(session.series()->series);
  Workspace with = session.workspace();
  for (const auto& [name, opacity, range] :
       {std::tuple("Trunk", 0.4, ValueRange{30, 50}), std::tuple("Spine", 1.0, ValueRange{690, 710})}) {
    Segment segment;
    segment.label = name;
    segment.opacity = opacity;
    const int number = with.segmentMaps.empty() ? 0 : maps - 1;
    with = withNewSegment(std::move(with), series, volume->geometry(), segment, number);
    const SegmentMap map = *segmentMapOf(with, series, number);
    with = withSegmentMap(std::move(with), withMask(map, map.current, voxelsInRange(*volume, range)));
  }
  const QImage without = w.window.view()->picture();
  w.settled.clear();
  session.change(QStringLiteral("test"), with);
  return segmentsAreMade(w) && w.window.document().drawn.segments(sceneViewId).size() == 2 && w.settle() &&
         w.window.view()->picture() != without;
}

// Returns true once the picture has changed.
bool showInsideSegments(Journey& w) {
  Session& session = w.window.session();
  const TissueShown tissue{TissueShown::Where::inside, 3};
  const QImage whole = w.window.view()->picture();
  w.settled.clear();
  session.change(QStringLiteral("test"),
                 withTissueShown(session.workspace(), keyOf(session.series()->series), tissue));
  return segmentsAreMade(w) && w.window.document().drawn.tissue(sceneViewId) && w.settle() &&
         w.window.view()->picture() != whole;
}

}  // namespace

class TestSessionPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theProgramDrawsTheSnapshot_data();
  void theProgramDrawsTheSnapshot();
  void segmentsComeBackWithTheSession();
  void theProgramRefusesWhatContradicts_data();
  void theProgramRefusesWhatContradicts();

 private:
  std::unique_ptr<SessionFolder> refused_;  // of theProgramRefusesWhatContradicts
};

void TestSessionPictures::theProgramDrawsTheSnapshot_data() {
  QTest::addColumn<int>("what");
  QTest::addColumn<QSize>("size");
  QTest::addColumn<QString>("cut");
  const QString no;
  const QSize view(0, 0);  // size of the window's view
  QTest::newRow("as it is opened") << 0 << view << no;
  QTest::newRow("turned") << 1 << QSize(230, 170) << no;
  QTest::newRow("without its table, by level") << 2 << QSize(200, 200) << QStringLiteral("table removed");
  QTest::newRow("from the planes beside it") << 3 << QSize(160, 120) << no;
  QTest::newRow("cut with the scissors, without its table")
      << 4 << QSize(200, 160) << QStringLiteral("1 outline, table removed");
  QTest::newRow("cut, in perspective") << 5 << QSize(200, 160) << QStringLiteral("1 outline");
  QTest::newRow("with segments") << 6 << QSize(220, 180) << no;
  QTest::newRow("with segments in two maps, cut, without its table")
      << 7 << QSize(200, 160) << QStringLiteral("1 outline, table removed");
  QTest::newRow("only inside segments") << 8 << QSize(220, 180) << no;
  QTest::newRow("only inside segments in two maps, cut, without its table")
      << 9 << QSize(200, 160) << QStringLiteral("1 outline, table removed");
}

void TestSessionPictures::theProgramDrawsTheSnapshot() {
  const SessionFolder folder;
  QFETCH(int, what);
  QFETCH(QSize, size);
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  Quality quality = Quality::standard;
  if (what >= 1) QVERIFY(settles(w, [&] { drag(w.window.view(), {100, 100}, {130, 90}); }));
  if (what == 2) {
    QVERIFY(!w.after("removeTable").isNull());
    quality = Quality::high;
    w.window.session().setGoal(QStringLiteral("Level"), {.level = {quality, 1}});
  }
  if (what == 3) {
    w.child<QAction>("layoutPlanes")->trigger();
    QTRY_VERIFY(w.window.views()->viewAs<FlatView>(coronalViewId));
    QTest::mouseClick(w.window.views()->viewAs<FlatView>(coronalViewId), Qt::LeftButton, {}, {50, 50});
  }
  if (what >= 6) QVERIFY(showSegments(w, what % 2 == 1 ? 2 : 1));
  if (what >= 8) QVERIFY(showInsideSegments(w));
  if (what == 4 || what == 5 || what == 7 || what == 9) {
    if (what != 5) QVERIFY(!w.after("removeTable").isNull());
    if (what == 5)
      QVERIFY(settles(w, [&] {
        w.window.session().edit(QStringLiteral("Perspective"), [&](Scene& s) {
          s.camera = withProjection(w.window.view()->camera(), Projection::perspective);
        });
      }));
    const QImage whole = w.window.view()->picture();
    w.window.session().setFocus(sceneViewId);
    w.child<QAction>("scissorsTool")->trigger();
    const QPoint centre = w.window.view()->rect().center();
    const QImage cut = w.after([&] {
      QTest::mousePress(w.window.view(), Qt::LeftButton, {}, centre);
      for (const QPoint by : {QPoint(50, 0), QPoint(50, 60), QPoint(-10, 40)})
        QTest::mouseEvent(QTest::MouseMove, w.window.view(), Qt::LeftButton, {}, centre + by);
      QTest::mouseRelease(w.window.view(), Qt::LeftButton, {}, centre);
    });
    QVERIFY(!cut.isNull() && cut != whole);
  }
  if (size.isNull()) size = w.window.view()->pixels();
  QVERIFY(segmentsAreMade(w));
  QVERIFY(folder.save(w));
  auto* panel = w.child<QWidget>("snapshotPanel");
  QVERIFY(panel);
  w.child<QSpinBox>("snapshotWidth")->setValue(size.width());
  w.child<QSpinBox>("snapshotHeight")->setValue(size.height());
  w.child<QComboBox>("snapshotQuality")->setCurrentIndex(quality == Quality::standard ? 0 : 1);
  w.child<QAction>("snapshot")->trigger();
  answer(w, "snapshotDialog", folder.at("window.png"));
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.at("window.png")), longest);
  const Outcome a = runProgram(QStringList{
      QStringLiteral("render"), folder.at("s.volumen"), QStringLiteral("-o"), folder.at("program.png"),
      QStringLiteral("--size"), QStringLiteral("%1x%2").arg(size.width()).arg(size.height())});
  QVERIFY2(a.status == 0, a.err);
  const QImage window(folder.at("window.png")), program(folder.at("program.png"));
  QCOMPARE(window.size(), size);
  QVERIFY(window == program);
  QCOMPARE(contentsOf(folder.at("window.png")), contentsOf(folder.at("program.png")));
  const QString cut = window.text(QStringLiteral("volumen-cut"));
  QTEST(cut, "cut");
  QCOMPARE(window.text(QStringLiteral("volumen-segments")),  // QImage reads line ends as blanks
           what >= 6 ? QStringLiteral("Trunk, opacity 0.4 Spine") : QString());
  QCOMPARE(window.text(QStringLiteral("volumen-tissue")),
           what >= 8 ? QStringLiteral("only inside the segments that are shown and within 3 mm of them")
                     : QString());
  const Outcome b = runProgram(QStringLiteral("render %1 --explain").arg(folder.at("s.volumen")));
  QVERIFY2(b.status == 0, b.err);
  QCOMPARE(b.out.contains("on   cut: " + cut.toUtf8() + "; "), !cut.isEmpty());
}

// The window shows the segments again. If their file is gone, the program draws the rest and says so.
void TestSessionPictures::segmentsComeBackWithTheSession() {
  const SessionFolder folder;
  QImage with;
  {
    Journey w({folder.ct()});
    QVERIFY(w.settle());
    QVERIFY(showSegments(w));
    QVERIFY(settles(w, [&] { drag(w.window.view(), {100, 100}, {130, 90}); }));
    with = w.window.view()->picture();
    QVERIFY(folder.save(w));
  }
  Journey w;
  QVERIFY(folder.open(w));
  QTRY_COMPARE_WITH_TIMEOUT(w.window.view()->picture(), with, longest);
  const QString line = QStringLiteral("render %1 -o %2 --size 40x40 --quality draft")
                           .arg(folder.at("s.volumen"), folder.at("p.png"));
  const Outcome drawn = runProgram(line);
  QVERIFY2(drawn.status == 0 && !drawn.err.contains("segments"), drawn.err);
  const QImage whole(folder.at("p.png"));
  const QStringList labels = segmentFilesOf(folder.at("s.volumen"));
  QCOMPARE(labels.size(), 1);
  QVERIFY(QFile::remove(labels.front()));
  const Outcome without = runProgram(line);
  QVERIFY2(without.status == 0 && without.err.contains("segments of the session were not found"),
           without.err);
  QVERIFY(QImage(folder.at("p.png")) != whole);
}

void TestSessionPictures::theProgramRefusesWhatContradicts_data() {
  QTest::addColumn<QString>("line");
  QTest::addColumn<int>("status");
  QTest::addColumn<QString>("words");
  const auto row = [](const char* name, const char* line, int status, const char* words) {
    QTest::newRow(name) << QString::fromLatin1(line) << status << QString::fromLatin1(words);
  };
  row("another series", "render S --series 1 -o P", 2, "leave --series out");
  row("another scene", "render S --scene x.json -o P", 2, "leave --scene out");
  row("a preset", "render S --preset CT-Bone -o P", 2, "leave --preset out");
  row("the table", "render S --remove-table -o P", 2, "leave --remove-table out");
  row("another view", "render S --view left --mode mip --size 16x16 --quality draft -o P", 0, "");
  row("a series that is gone", "render GONE -o P", 1, "not found");
  row("no session", "render /nowhere/x.volumen -o P", 1, "/nowhere/x.volumen");
  row("info", "info S", 1, "is a session, not a volume");
  row("convert", "convert S -o V", 1, "is a session, not a volume");
  row("slice", "slice S -o P", 1, "is a session, not a volume");
  row("bench", "bench S --views 1", 1, "is a session, not a volume");
  refused_ = std::make_unique<SessionFolder>();
  const SessionFolder& folder = *refused_;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(folder.save(w));
  QVERIFY(QFile::copy(folder.ct(), folder.at("gone.nrrd")));
  w.window.session().show(nullptr);
  QVERIFY(settles(w, [&] { w.window.open({folder.at("gone.nrrd")}); }));
  QVERIFY(folder.save(w, "gone.volumen"));
  QVERIFY(QFile::remove(folder.at("gone.nrrd")));
}

void TestSessionPictures::theProgramRefusesWhatContradicts() {
  QFETCH(QString, line);
  QFETCH(int, status);
  QFETCH(QString, words);
  const SessionFolder& folder = *refused_;
  line.replace(QStringLiteral("GONE"), folder.at("gone.volumen"));
  line.replace(QStringLiteral(" S"), QLatin1Char(' ') + folder.at("s.volumen"));
  line.replace(QStringLiteral("-o P"), QStringLiteral("-o ") + folder.at("p.png"));
  line.replace(QStringLiteral("-o V"), QStringLiteral("-o ") + folder.at("v.nrrd"));
  const Outcome a = runProgram(line);
  QVERIFY2(a.status == status, a.err);
  QVERIFY2(QString::fromUtf8(a.err).contains(words), a.err);
}

VOLUMEN_TEST(TestSessionPictures);
#include "tst_session_pictures.moc"
