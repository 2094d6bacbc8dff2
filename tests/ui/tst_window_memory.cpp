// Guards design.md 11: what the window keeps in memory stays within its budget, whatever is opened one after
// the other. With VOLUMEN_FIGURES it prints what it took; with VOLUMEN_FULL_SIZE series have the size of a
// CT.
#include <QProcess>

#include "results/segments/segments.h"
#include "tests/fixtures/scarce_memory.h"
#include "tests/ui/killed_window.h"
#include "tests/ui/many_series.h"
#include "tests/ui/perfusion_window.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

double inMebi(std::size_t bytes) { return double(bytes) / (1 << 20); }

}  // namespace

class TestWindowMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void fortySeriesInTurnStayWithinTheBudget();
  void fortySeriesInTurnSurviveALimit_data();
  void fortySeriesInTurnSurviveALimit();
  void aClipIn3dStaysWithinTheBudget();
  void aSessionOfTenSeriesStaysWithinTheBudget();
  void viewsThatAreHiddenHoldNothing();
  void labelsInStepsOfUndoCount();
};

// Run by fortySeriesInTurnSurviveALimit(), it has the budget that follows from the limit.
void TestWindowMemory::fortySeriesInTurnStayWithinTheBudget() {
  const ManySeries all;
  ManyWindow w;
  if (!qEnvironmentVariableIsSet("VOLUMEN_UNDER_LIMIT")) w.pool().setBudget(ManySeries::budget());
  w.window.open({all.folder()});
  QVERIFY(w.settle());
  const QImage first = w.window.view()->picture();
  // The window itself, with its fonts and panels.
  const std::size_t rest = statusOf("VmRSS:") - w.pool().counted();
  for (int n = 1; n < ManySeries::most; ++n) {
    const QImage picture = w.click(n);
    QVERIFY2(!picture.isNull() && picture != first, qPrintable(ManySeries::name(n)));
  }
  const std::size_t taken = ManyWindow::peakRss() - rest;
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES"))
    std::printf("counted %.0f MiB at most, taken %.0f MiB: %.2f\n", inMebi(w.mostCounted), inMebi(taken),
                double(w.mostCounted) / double(taken));
  if (!qEnvironmentVariableIsSet("VOLUMEN_UNDER_LIMIT")) {
    QVERIFY2(w.mostCounted <= ManySeries::budget(), qPrintable(QString::number(w.mostCounted)));
    QVERIFY2(w.mostCounted > ManySeries::budget() / 2, "what there is room for is kept");
#ifndef __SANITIZE_ADDRESS__  // which keeps what was freed
    QVERIFY2(taken <= ManySeries::budget() + 4 * ManySeries::valueBytes(),
             qPrintable(QString::number(taken)));
#endif
  }
  QVERIFY2(w.click(0) == first, "what was dropped is computed again, and is the same");
}

void TestWindowMemory::fortySeriesInTurnSurviveALimit_data() {
  QTest::addColumn<ScarceMemory::By>("by");
  QTest::addColumn<quint64>("mebibytes");
  QTest::newRow("a control group of 768 MiB") << ScarceMemory::By::controlGroup << quint64(768);
  QTest::newRow("ulimit -v of 2 GiB") << ScarceMemory::By::addressSpace << quint64(2048);
}

void TestWindowMemory::fortySeriesInTurnSurviveALimit() {
  QFETCH(ScarceMemory::By, by);
  QFETCH(quint64, mebibytes);
#ifdef __SANITIZE_ADDRESS__
  QSKIP("the sanitizer takes more than any limit, and keeps what was freed");
#endif
  const ScarceMemory memory(by);
  if (!memory.isPossible()) QSKIP("control groups of version 1 cannot be made here");
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("VOLUMEN_ONLY"), QStringLiteral("TestWindowMemory"));
  environment.insert(QStringLiteral("VOLUMEN_UNDER_LIMIT"), QStringLiteral("1"));
  process.setProcessEnvironment(environment);
  process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  process.setChildProcessModifier(memory.limit(mebibytes << 20));
  process.start(QCoreApplication::applicationFilePath(),
                {QStringLiteral("fortySeriesInTurnStayWithinTheBudget")});
  QVERIFY(process.waitForFinished(10 * longest));
  const QByteArray said = process.readAllStandardOutput();
  if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES")) std::printf("%s\n", said.constData());
  QVERIFY2(process.exitStatus() == QProcess::NormalExit, "killed");
  QVERIFY2(process.exitCode() == 0, said);
}

// Each step has gradients of its own.
void TestWindowMemory::aClipIn3dStaysWithinTheBudget() {
  const QTemporaryDir folder;
  constexpr int steps = 8;
  const QString path = folder.filePath(QStringLiteral("clip.nrrd"));
  constexpr int edge = 96;
  {
    std::ofstream file(path.toStdString(), std::ios::binary);
    file << "NRRD0005\ntype: int16\ndimension: 4\nspace: left-posterior-superior\nsizes: " << edge << ' '
         << edge << ' ' << edge << ' ' << steps
         << "\nspace directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\nspace "
            "origin: "
            "(0,0,0)\nendian: little\nencoding: raw\n\n";
    for (int n = 0; n < steps; ++n)
      for (int v = 0; v < edge * edge * edge; ++v) {
        const auto value = std::int16_t(v / edge % edge < 20 + 5 * n ? 0 : 100 + n + v % edge);
        file.write(reinterpret_cast<const char*>(&value), sizeof value);
      }
  }
  // Values of one step are 1.7 MiB, gradients 6.8.
  const std::size_t budget = std::size_t(20) << 20;
  ManyWindow w;
  w.pool().setBudget(budget);
  w.window.open({path});
  QVERIFY(w.settle());
  FlatView* axial = w.window.views()->viewAs<FlatView>(axialViewId);
  QVERIFY(axial && axial->isVisible());
  const auto isShown = [&](int step) {
    const LoadedSeriesPtr shown = w.window.session().seriesOf(sceneViewId);
    return shown && shown->volume->value(0, edge - 1, 0) == 100.f + float(step);
  };
  std::vector<QImage> seen{w.window.view()->picture()};
  const auto go = [&](Qt::Key key) { return w.after([&] { QTest::keyClick(axial, key); }); };
  for (int n = 1; n < steps; ++n) {
    seen.push_back(go(Qt::Key_Right));
    QVERIFY2(isShown(n), qPrintable(QString::number(n)));
    QVERIFY(!seen.back().isNull() && seen[std::size_t(n)] != seen[std::size_t(n) - 1]);
  }
  for (int n = steps - 2; n >= 0; --n)
    QVERIFY2(go(Qt::Key_Left) == seen[std::size_t(n)] && isShown(n), qPrintable(QString::number(n)));
  QVERIFY2(w.mostCounted <= budget, qPrintable(QString::number(w.mostCounted)));
}

void TestWindowMemory::aSessionOfTenSeriesStaysWithinTheBudget() {
  constexpr int count = 10;
  const ManySeries all(count);
  const SessionFolder sessions;
  std::vector<QImage> seen;
  {
    ManyWindow w;
    w.pool().setBudget(ManySeries::budget());
    w.window.open({all.folder()});
    QVERIFY(w.settle());
    seen.push_back(w.window.view()->picture());
    for (int n = 1; n < count; ++n) seen.push_back(w.click(n));
    QVERIFY(sessions.save(w));
  }
  ManyWindow w;
  w.pool().setBudget(ManySeries::budget());
  QVERIFY(sessions.open(w));
  QCOMPARE(w.window.session().workspace().series.size(), std::size_t(count));
  for (int n = 0; n < count; ++n)
    QVERIFY2(w.click(n) == seen[std::size_t(n)], qPrintable(ManySeries::name(n)));
  // Back and forth through all of them.
  while (w.window.session().undoStack().canUndo()) QVERIFY(!w.after("undo").isNull());
  while (w.window.session().undoStack().canRedo()) QVERIFY(!w.after("redo").isNull());
  QVERIFY2(w.mostCounted <= ManySeries::budget(), qPrintable(QString::number(w.mostCounted)));
}

// Twelve series side by side stay; once they are hidden they go as others do.
void TestWindowMemory::viewsThatAreHiddenHoldNothing() {
  constexpr int count = 14, side = 12;
  const ManySeries all(count);
  ManyWindow w;
  w.pool().setBudget(ManySeries::budget());
  w.window.open({all.folder()});
  QVERIFY(w.settle());
  Session& session = w.window.session();
  w.window.document().opener.chooseLayout({Layout::Kind::grid, 3, 4});
  for (int n = 0; n < side; ++n) {
    const ViewId view = firstComparedId + n;
    session.setFocus(view);
    w.press(n);
    const auto isShown = [&] {
      const LoadedSeriesPtr shown = session.seriesOf(view);
      return shown && shown->series.path.find(ManySeries::name(n).toStdString()) != std::string::npos &&
             !w.window.views()->viewAs<FlatView>(view)->picture().isNull();
    };
    QVERIFY2(QTest::qWaitFor(isShown, longest), qPrintable(ManySeries::name(n)));
  }
  QVERIFY(w.pool().counted() >= side * ManySeries::valueBytes());
  w.window.document().opener.chooseLayout(Layout::planes);
  session.setFocus(axialViewId);
  QVERIFY(!w.click(side).isNull());
  QVERIFY(!w.click(side + 1).isNull());
  QVERIFY2(w.pool().counted() <= ManySeries::budget(), qPrintable(QString::number(w.pool().counted())));
}

// Series give way to them: they cannot be had again.
void TestWindowMemory::labelsInStepsOfUndoCount() {
  Session session;
  const LoadedSeriesPtr series = ballSeries(64, 20);
  const SeriesKey key = keyOf(series->series);
  session.show(series);
  const std::size_t before = session.pool().counted();
  const auto add = [&](double low) {
    const Workspace with = withNewSegment(session.workspace(), key, series->volume->geometry(), {});
    const SegmentMap& made = *segmentMapOf(with, key);
    session.change(
        QStringLiteral("test"),
        withSegmentMap(with, withMask(made, made.current, voxelsInRange(*series->volume, {low, 2000}))));
  };
  add(500);
  const std::size_t labels = segmentMapOf(session.workspace(), key)->labels->bytes();
  QVERIFY(labels > 0);
  QCOMPARE(session.pool().counted(), before + labels);
  session.close({key});
  QVERIFY2(session.pool().counted() >= labels, "a series that is closed keeps what was made on it");
  session.undoStack().undo();
  session.undoStack().undo();
  session.change(QStringLiteral("test"), [](Workspace& w) { w.measurementsShown = false; });
  QVERIFY2(session.pool().counted() <= before, "steps that cannot be done again hold nothing");
}

VOLUMEN_TEST(TestWindowMemory);
#include "tst_window_memory.moc"
