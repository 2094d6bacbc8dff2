// Guards design.md 8 (the UI thread never decodes or waits; progress, cancel) and design.md 7 (a bad path
// costs a message).
#include <QSignalSpy>

#include "io/open.h"
#include "results/text/text.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/controller/loader.h"
#include "ui/main_window.h"
#include "ui/widgets/status_line.h"

using namespace volumen;

namespace {

using tests::longest;

Series phantom(const char* name) {
  const Result<Study> study = openStudy(std::string("phantom:") + name);
  return study->volumes.at(0);
}

struct Watched {
  Session session;
  Jobs jobs;
  Loader loader{session, jobs, realServices().makeScene};
  QSignalSpy loaded{&loader, &Loader::requestLoaded}, failed{&loader, &Loader::failed};

  void load(const Series& series) {
    session.request([&](Requests& r) { r.show = {std::make_shared<const Series>(series)}; });
  }
  bool finish() {
    return QTest::qWaitFor([this] { return !loader.isBusy(); }, longest);
  }
};

}  // namespace

class TestLoader : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesComesWithWhatThePanelsNeed();
  void theLaterLoadWins();
  void whatIsCancelledIsNotTold();
  void intentsComeBackWithTheirAnswers();
  void oneOfThreeOpensIsCancelled();
  void twoAreOpenedAtOnce_data();
  void twoAreOpenedAtOnce();
  void aBadPathIsASentence();
  void closingWhileLoadingIsClean();
  void aLoadThatTheUserCancelsIsTold();
  void whatIsOpenedStandsInTheListByItsName_data();
  void whatIsOpenedStandsInTheListByItsName();
  void theStatusLineShowsWhatLastsAndCancels();
  void theStatusLineShowsAllThatRun();
};

void TestLoader::aSeriesComesWithWhatThePanelsNeed() {
  Watched w;
  w.load(phantom("sphere:32"));
  QVERIFY(w.loader.isBusy());
  QVERIFY(w.finish());
  QCOMPARE(w.loaded.count(), 1);
  const auto series = w.loaded[0][0].value<LoadedSeriesPtr>();
  QCOMPARE(series->volume->size().x, 32);
  std::int64_t counted = 0;
  for (const std::int64_t count : series->histogram.counts) counted += count;
  QCOMPARE(counted, std::int64_t(32 * 32 * 32));
  QVERIFY(!series->firstScene.transferFunction.points.empty());
}

void TestLoader::theLaterLoadWins() {
  Watched w;
  w.load(phantom("ct-head:96"));
  w.load(phantom("sphere:32"));
  QVERIFY(w.finish());
  QCOMPARE(w.loaded.count(), 1);
  QCOMPARE(w.loaded[0][0].value<LoadedSeriesPtr>()->volume->size().x, 32);
}

void TestLoader::whatIsCancelledIsNotTold() {
  Watched w;
  w.load(phantom("ct-head:64"));
  w.loader.cancel();
  QVERIFY(w.finish());
  QCOMPARE(w.loaded.count(), 0);
  QCOMPARE(w.failed.count(), 0);
}

void TestLoader::intentsComeBackWithTheirAnswers() {
  Watched w;
  QSignalSpy opened(&w.loader, &Loader::studyOpened);
  std::vector<OpenIntent> asked(3);
  asked[0].seriesUid = "1.2", asked[0].how = OpenHow::beside;
  asked[1].scene.emplace();
  asked[2].isShown = std::make_shared<bool>(false);
  for (int n = 0; n < 3; ++n)
    w.loader.open(QStringLiteral("phantom:sphere:%1").arg(16 + n), asked[std::size_t(n)]);
  QVERIFY(w.finish());
  QCOMPARE(opened.count(), 3);
  for (int n = 0; n < 3; ++n) {
    const auto came = opened[n][2].value<OpenIntent>();
    const OpenIntent& sent = asked[std::size_t(n)];
    QVERIFY(opened[n][0].toString().endsWith(QString::number(16 + n)));
    QVERIFY(came.how == sent.how && came.seriesUid == sent.seriesUid && came.scene == sent.scene &&
            came.isShown == sent.isShown);
  }
}

// The other two open as requested, and the cancelled one leaves no trace among the open studies.
void TestLoader::oneOfThreeOpensIsCancelled() {
  Watched w;
  OpenStudies open;
  std::vector<OpenHow> came;
  connect(&w.loader, &Loader::studyOpened, &open,
          [&](const QString& path, const std::shared_ptr<const Study>& study, const OpenIntent& intent) {
            open.add(path, study);
            came.push_back(intent.how);
          });
  const OpenHow asked[] = {OpenHow::here, OpenHow::instead, OpenHow::beside};
  for (int n = 0; n < 3; ++n)
    w.loader.open(QStringLiteral("phantom:sphere:%1").arg(16 + n), {.how = asked[n]});
  const std::vector<JobRow> rows = w.jobs.rows();
  QCOMPARE(rows.size(), std::size_t(3));
  w.jobs.cancel(rows[1].id);
  QVERIFY(w.finish());
  QStringList paths;
  for (const OpenStudy& opened : open.all()) paths << opened.path;
  QCOMPARE(paths, QStringList({QStringLiteral("phantom:sphere:16"), QStringLiteral("phantom:sphere:18")}));
  QVERIFY(came == std::vector({OpenHow::here, OpenHow::beside}));
  QCOMPARE(w.failed.count(), 0);
}

void TestLoader::twoAreOpenedAtOnce_data() {
  QTest::addColumn<bool>("firstHasScene");
  QTest::newRow("by a scene, then as usual") << true;
  QTest::newRow("as usual, then by a scene") << false;
}

// Both are shown in the order of opening, each with its own scene.
void TestLoader::twoAreOpenedAtOnce() {
  QFETCH(bool, firstHasScene);
  tests::openAlone();
  Scene scene;
  scene.camera = Camera{.target = glm::dvec3(1, 2, 3), .height = 77};
  tests::Journey w;
  const auto open = [&](const char* path, bool byScene) {
    w.window.open({QLatin1String(path)}, byScene ? std::optional(scene) : std::nullopt);
  };
  open("phantom:sphere:16", firstHasScene);
  open("phantom:cube:20", !firstHasScene);
  const auto shows = [&](const char* name) {
    const LoadedSeriesPtr shown = w.window.session().series();
    return shown && shown->series.path.find(name) != std::string::npos;
  };
  QTRY_VERIFY_WITH_TIMEOUT(shows("cube"), longest);
  QVERIFY(w.settle());
  QCOMPARE(w.window.session().scene() == scene, !firstHasScene);
}

void TestLoader::aBadPathIsASentence() {
  Watched w;
  w.loader.open(QStringLiteral("/nowhere/at/all"));
  QVERIFY(w.finish());
  QCOMPARE(w.failed.count(), 1);
  QVERIFY(w.failed[0][0].toString().contains(QStringLiteral("/nowhere/at/all")));
}

void TestLoader::closingWhileLoadingIsClean() {
  Watched w;
  w.load(phantom("ct-head:64"));
  w.loader.open(QStringLiteral("phantom:sphere"));
}

void TestLoader::aLoadThatTheUserCancelsIsTold() {
  Watched w;
  QSignalSpy notLoaded(&w.loader, &Loader::notLoaded);
  w.load(phantom("ct-head:64"));
  w.loader.open(QStringLiteral("phantom:sphere:16"));
  QSignalSpy opened(&w.loader, &Loader::studyOpened);
  QCOMPARE(w.jobs.rows().size(), std::size_t(2));
  w.jobs.cancel(w.jobs.rows().front().id);
  QCOMPARE(notLoaded.count(), 1);
  QVERIFY(w.finish());
  QCOMPARE(opened.count(), 1);
  QCOMPARE(w.loaded.count(), 0);
  QCOMPARE(w.failed.count(), 0);
  QCOMPARE(notLoaded.count(), 1);
}

void TestLoader::whatIsOpenedStandsInTheListByItsName_data() {
  QTest::addColumn<bool>("namesHidden");
  QTest::addColumn<QStringList>("texts");
  QTest::newRow("each by its own") << false
                                   << QStringList{QStringLiteral("Opening CT-chest"),
                                                  QStringLiteral("Opening head.nii"),
                                                  QStringLiteral("Opening day.volumen"),
                                                  QStringLiteral("Opening series 3")};
  QTest::newRow("none while names are hidden") << true << QStringList(4, QStringLiteral("Opening"));
}

// The names are listed before any load begins. The first one is long.
void TestLoader::whatIsOpenedStandsInTheListByItsName() {
  QFETCH(bool, namesHidden);
  QFETCH(QStringList, texts);
  Watched w;
  w.loader.open(QStringLiteral("phantom:ct-head"));
  w.loader.open(QStringLiteral("/data/Doe/CT-chest"));
  w.loader.open(QStringLiteral("/data/Doe/head.nii"));
  w.loader.openSession(QStringLiteral("/data/Doe/day.volumen"));
  w.loader.openFiles(QStringLiteral("index:1"),
                     {.files = {"/data/Doe/series 3/1.dcm", "/data/Doe/series 3/2.dcm"}});
  hideNames(namesHidden);
  QStringList shown;
  for (const JobRow& row : w.jobs.rows()) shown << row.text;
  hideNames(false);
  w.loader.cancel();
  QCOMPARE(shown.mid(1), texts);
}

void TestLoader::theStatusLineShowsWhatLastsAndCancels() {
  Jobs jobs;
  StatusLine line(jobs);
  line.show();
  auto* cancel = line.findChild<QToolButton*>(QStringLiteral("cancelTask"));
  const int height = line.height();
  int cancelled = 0;
  const Job job(QStringLiteral("opening"));
  jobs.add(job, [&] { ++cancelled; });
  QVERIFY2(!cancel->isVisible(), "what takes less than 0.3 s shows no progress");
  QTRY_VERIFY(cancel->isVisible());
  QCOMPARE(line.height(), height);
  job.progress()("reading", 3, 10);
  QTRY_COMPARE(line.findChild<QLabel*>(QStringLiteral("taskText"))->text(),
               QStringLiteral("reading: 3 of 10"));
  QTest::mouseClick(cancel, Qt::LeftButton);
  QCOMPARE(cancelled, 1);
  QVERIFY(job.cancelled());
  QVERIFY(!cancel->isVisible());
}

// The status line shows the earliest request, and all of them on demand.
void TestLoader::theStatusLineShowsAllThatRun() {
  Jobs jobs;
  StatusLine line(jobs);
  line.show();
  std::vector<Job> three;
  for (const char* name : {"first", "second", "third"}) {
    three.emplace_back(QString::fromLatin1(name));
    jobs.add(three.back(), {});
  }
  auto* more = line.findChild<QToolButton*>(QStringLiteral("moreTasks"));
  QTRY_VERIFY(more->isVisible());
  QCOMPARE(more->text(), QStringLiteral("2 more"));
  QTest::mouseClick(more, Qt::LeftButton);
  auto* all = line.findChild<QWidget*>(QStringLiteral("allTasks"));
  const auto texts = [&] {
    QStringList found;
    for (const QLabel* text : all->findChildren<QLabel*>(QStringLiteral("taskText")))
      if (text->isVisible()) found << text->text();
    return found;
  };
  QTRY_COMPARE(texts(),
               QStringList({QStringLiteral("first"), QStringLiteral("second"), QStringLiteral("third")}));
  QTest::mouseClick(all->findChildren<QToolButton*>(QStringLiteral("cancelTask"))[1], Qt::LeftButton);
  QCOMPARE(texts(), QStringList({QStringLiteral("first"), QStringLiteral("third")}));
  QVERIFY(three[1].cancelled() && !three[0].cancelled() && !three[2].cancelled());
  jobs.remove(three[0]);
  QVERIFY(!more->isVisible());
  QCOMPARE(line.findChild<QLabel*>(QStringLiteral("taskText"))->text(), QStringLiteral("third"));
  jobs.remove(three[2]);
  QVERIFY(!all->isVisible());
}

VOLUMEN_TEST(TestLoader);
#include "tst_loader.moc"
