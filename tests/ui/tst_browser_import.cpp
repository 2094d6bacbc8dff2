// Guards the index behind the study browser. Covers import, its cancellation, and closing the window
// meanwhile; refused and missing files; a damaged index or one that cannot be opened. Also covers other
// programs and many series.
#include <QHeaderView>
#include <QMimeData>
#include <QScrollBar>
#include <QToolButton>

#include "tests/fixtures/filled_index.h"
#include "tests/ui/browser_window.h"
#include "tests/ui/gestures.h"
#include "tests/ui/watchdog.h"
#include "tests/unit/suite.h"
#include "ui/controller/index_service.h"
#include "ui/panels/series_strip.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(bytes);
}

// Copies the files of a written series `times` times, each into a separate folder.
bool copyOften(const QString& from, const QString& to, int times) {
  const QStringList names = QDir(from).entryList(QDir::Files);
  for (int n = 0; n < times; ++n) {
    const QString folder = to + QStringLiteral("/%1/").arg(n);
    if (!QDir().mkpath(folder)) return false;
    for (const QString& name : names)
      if (!QFile::copy(from + QLatin1Char('/') + name, folder + name)) return false;
  }
  return true;
}

}  // namespace

class TestBrowserImport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { openAlone(); }
  void aFolderIsImported_data();
  void aFolderIsImported();
  void afterItTheListIsShown();
  void refusedFilesAreNamed();
  void anImportIsCancelledAndGoneOnWith();
  void theWindowClosesWhileItImports();
  void whatIsNotThereIsGrey();
  void aDamagedIndexIsToldOnce();
  void withoutAnIndexTheRestWorks();
  void otherProgramsAreSeen();
  void warningsAreSaid();
  void thumbnailsAreMadeForWhatIsSeen();
  void theNewestSearchIsAnswered();
  void tenThousandSeriesAreSearched();
};

void TestBrowserImport::aFolderIsImported_data() {
  QTest::addColumn<bool>("dropped");
  QTest::newRow("by the menu") << false;
  QTest::newRow("dropped on the list") << true;
}

void TestBrowserImport::aFolderIsImported() {
  QFETCH(bool, dropped);
  const Studies studies;
  QVERIFY(studies.write());
  BrowserWindow w(studies);
  auto* browser = w.child<QWidget>("studyBrowser");
  QVERIFY2(w.child<QWidget>("startPage")->isVisible(), "nothing to choose from yet");
  QVERIFY(!browser->isVisible());
  if (dropped) {
    w.child<QAction>("showBrowser")->trigger();
    QTRY_VERIFY(w.notice().startsWith(QStringLiteral("No studies yet.")));
    w.shot("browser-empty");
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(studies.data)});
    QVERIFY(tests::drop(data, browser));
  } else {
    w.child<QAction>("importFolder")->trigger();
    answer(w, "importFolderDialog", studies.data);
  }
  QVERIFY(w.shows({QStringLiteral("Doe, Jane"), QStringLiteral("Müller, Jörg"),
                   QStringLiteral("Yamada, Tarou  山田 太郎")}));
  QVERIFY(browser->isVisible());
  QTRY_VERIFY_WITH_TIMEOUT(w.window.jobs().rows().empty(), longest);
  QVERIFY2(w.child<QLabel>("toldText")->text().contains(QStringLiteral("images imported")),
           qPrintable(w.child<QLabel>("toldText")->text()));
  QVERIFY(!w.banner()->isVisible());
}

// The list opens beside an open series, which keeps the keyboard focus.
void TestBrowserImport::afterItTheListIsShown() {
  const Studies studies;
  QVERIFY(studies.write());
  BrowserWindow w(studies, {QStringLiteral("phantom:sphere:16")});
  QVERIFY(w.settle());
  auto* browser = w.child<QWidget>("studyBrowser");
  QVERIFY(!browser->isVisible());
  w.child<QAction>("importFolder")->trigger();
  answer(w, "importFolderDialog", studies.data);
  QTRY_VERIFY_WITH_TIMEOUT(browser->isVisible(), longest);
  QVERIFY(w.window.view()->isVisible());
  QVERIFY(!browser->isAncestorOf(w.window.focusWidget()));
  QVERIFY(w.has("Abdomen", 4));
}

void TestBrowserImport::refusedFilesAreNamed() {
  const Studies studies;
  QVERIFY(studies.write());
  const QString wrong = studies.data + QStringLiteral("/wrong.nrrd");
  write(wrong, "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\nshort");
  BrowserWindow w(studies);
  w.child<QAction>("importFolder")->trigger();
  answer(w, "importFolderDialog", studies.data);
  QTRY_VERIFY_WITH_TIMEOUT(w.banner()->isVisible(), longest);
  QCOMPARE(w.banner()->sentence(), QStringLiteral("1 file could not be imported."));
  const QString details = w.child<QPlainTextEdit>("bannerDetails")->toPlainText();
  QVERIFY2(details.startsWith(wrong + QStringLiteral(": ")), qPrintable(details));
  QVERIFY(w.shows({QStringLiteral("Doe, Jane"), QStringLiteral("Müller, Jörg"),
                   QStringLiteral("Yamada, Tarou  山田 太郎")}));
}

void TestBrowserImport::anImportIsCancelledAndGoneOnWith() {
  const Studies studies;
  QVERIFY(studies.write());
  QVERIFY(copyOften(studies.data + QStringLiteral("/doe/bone"), studies.data + QStringLiteral("/many"), 60));
  BrowserWindow w(studies);
  w.child<QAction>("importFolder")->trigger();
  answer(w, "importFolderDialog", studies.data);
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("cancelTask")->isVisible(), longest);
  QTest::mouseClick(w.child<QToolButton>("cancelTask"), Qt::LeftButton);
  auto* text = w.child<QLabel>("toldText");
  QTRY_VERIFY_WITH_TIMEOUT(text->text().startsWith(QStringLiteral("Import cancelled.")), longest);
  QVERIFY(!w.child<QWidget>("cancelTask")->isVisible());
  // The next import continues from there.
  w.child<QAction>("importFolder")->trigger();
  answer(w, "importFolderDialog", studies.data);
  QTRY_VERIFY_WITH_TIMEOUT(text->text().contains(QStringLiteral("imported")) &&
                               !text->text().startsWith(QStringLiteral("Import cancelled.")),
                           longest);
  Result<Index> index = Index::open(studies.home.toStdString());
  QVERIFY(index);
  const Result<ImportReport> again = index->import({studies.data.toStdString()});
  QVERIFY(again);
  QCOMPARE(again->added + again->changed, 0);
  QCOMPARE(again->unchanged, again->files);
}

void TestBrowserImport::theWindowClosesWhileItImports() {
  const Studies studies;
  QVERIFY(studies.write());
  QVERIFY(copyOften(studies.data + QStringLiteral("/doe/bone"), studies.data + QStringLiteral("/many"), 60));
  {
    BrowserWindow w(studies);
    w.child<QAction>("importFolder")->trigger();
    answer(w, "importFolderDialog", studies.data);
    QTRY_VERIFY_WITH_TIMEOUT(!w.window.jobs().rows().empty(), longest);
    w.window.close();
  }
  Result<Index> index = Index::open(studies.home.toStdString());
  QVERIFY(index);
  QVERIFY2(index->notice().empty(), index->notice().c_str());
  QVERIFY(index->import({studies.data.toStdString()}));
  QCOMPARE(index->studies()->size(), std::size_t(4));
}

void TestBrowserImport::whatIsNotThereIsGrey() {
  const Studies studies;
  QVERIFY(studies.import());
  QVERIFY(
      QDir().rename(studies.data + QStringLiteral("/mueller"), studies.dir.filePath(QStringLiteral("away"))));
  BrowserWindow w(studies);
  QVERIFY(w.has("Müller"));
  const QModelIndex row = w.row("Müller");
  QCOMPARE(row.data(Qt::ForegroundRole).value<QBrush>().color(),
           QApplication::palette().color(QPalette::Disabled, QPalette::Text));
  QVERIFY(row.data(Qt::ToolTipRole).toString().contains(QStringLiteral("Not there now")));
  QVERIFY(!w.row("Yamada").data(Qt::ForegroundRole).isValid());
  w.doubleClick(row);
  QTRY_VERIFY(w.banner()->isVisible());
  QVERIFY(w.banner()->sentence().startsWith(QStringLiteral("The files of this study are not there now")));
  QVERIFY(!seriesIn(w.window.session().workspace(), sceneViewId));
  w.shot("browser-offline");
}

void TestBrowserImport::aDamagedIndexIsToldOnce() {
  const Studies studies;
  QVERIFY(studies.import());
  const QDir home(studies.home);
  for (const QString& name : home.entryList(QDir::Files)) write(home.filePath(name), QByteArray(5000, 'x'));
  BrowserWindow w(studies);
  QTRY_VERIFY_WITH_TIMEOUT(w.banner()->isVisible(), longest);
  QVERIFY2(w.banner()->sentence().endsWith(QLatin1Char('.')), qPrintable(w.banner()->sentence()));
  w.shot("browser-damaged");
  // A new index is in use.
  w.child<QAction>("importFolder")->trigger();
  answer(w, "importFolderDialog", studies.data);
  QVERIFY(w.has("Müller"));
  BrowserWindow next(studies);
  QVERIFY(next.has("Müller"));
  QVERIFY(!next.banner()->isVisible());
}

void TestBrowserImport::withoutAnIndexTheRestWorks() {
  const Studies studies;
  write(studies.home, "a file, no folder");
  BrowserWindow w(studies);
  w.child<QAction>("showBrowser")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QLabel>("browserNotice")->isVisible() &&
                               w.notice().startsWith(QStringLiteral("The list of studies cannot be used: ")),
                           longest);
  QVERIFY(!w.search()->isEnabled());
  w.shot("browser-unavailable");
  w.window.open({QStringLiteral("phantom:sphere:16")});
  QVERIFY(w.settle());
}

void TestBrowserImport::otherProgramsAreSeen() {
  const Studies studies;
  QVERIFY(studies.write());
  BrowserWindow one(studies), two(studies);
  one.child<QAction>("importFolder")->trigger();
  answer(one, "importFolderDialog", studies.data);
  QVERIFY(one.has("Müller"));
  two.child<QAction>("showBrowser")->trigger();
  QVERIFY(two.has("Müller"));
  // One window removes a study. The other notices when its browser is shown again.
  one.click(one.row("Müller"));
  QTest::keyClick(one.tree(), Qt::Key_Delete);
  QVERIFY(one.shows({QStringLiteral("Doe, Jane"), QStringLiteral("Yamada, Tarou  山田 太郎")}));
  two.child<QAction>("showBrowser")->trigger();
  two.child<QAction>("showBrowser")->trigger();
  QVERIFY(two.shows({QStringLiteral("Doe, Jane"), QStringLiteral("Yamada, Tarou  山田 太郎")}));
}

void TestBrowserImport::warningsAreSaid() {
  const Studies studies;
  QVERIFY(fillIndex(studies.home.toStdString(), {.patients = 1, .studies = 1, .series = 5, .files = 1}));
  BrowserWindow w(studies);
  QVERIFY(w.has("Chest0", 4));
  const QModelIndex patient = w.row("Chest0", 4);
  QVERIFY(patient.data().toString().startsWith(QStringLiteral("! ")));
  QVERIFY(patient.data(Qt::ToolTipRole).toString().contains(QStringLiteral("! 1 warning")));
  w.tree()->setExpanded(w.tree()->model()->index(0, 0, patient), true);
  QVERIFY(w.has("Series 4", 4));
  const QString sentence = QStringLiteral("2 slices are missing and are interpolated.");
  QVERIFY(w.row("Series 4", 4).data().toString().startsWith(QStringLiteral("! ")));
  QVERIFY(w.row("Series 4", 4).data(Qt::ToolTipRole).toString().contains(sentence));
  QVERIFY(!w.row("Series 3", 4).data().toString().startsWith(QLatin1Char('!')));
  QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 5, longest);
  const QListWidgetItem* item = w.strip()->findItems(QStringLiteral("Series 4"), Qt::MatchContains).value(0);
  QVERIFY(item && item->text().startsWith(QStringLiteral("! ")) && item->toolTip().contains(sentence));
}

void TestBrowserImport::thumbnailsAreMadeForWhatIsSeen() {
  SeriesStrip strip;
  strip.resize(400, strip.height());
  strip.show();
  std::vector<IndexedSeries> series(40);
  for (std::size_t n = 0; n < series.size(); ++n) series[n].id = std::int64_t(n) + 1;
  std::vector<std::int64_t> wanted;
  connect(&strip, &SeriesStrip::thumbnailsWanted, this, [&](const auto& ids) { wanted = ids; });
  strip.showStudy(7, std::make_shared<const std::vector<IndexedSeries>>(series));
  QTRY_VERIFY_WITH_TIMEOUT(!wanted.empty(), longest);
  QCOMPARE(wanted.front(), std::int64_t(1));
  QVERIFY2(wanted.size() <= 5, "those on the right are not seen yet");
  for (const std::int64_t id : std::vector(wanted)) strip.setThumbnail(id, {});
  strip.horizontalScrollBar()->setValue(strip.horizontalScrollBar()->maximum());
  QTRY_VERIFY_WITH_TIMEOUT(!wanted.empty() && wanted.back() == 40, longest);
  QVERIFY(wanted.front() > 34 && wanted.size() <= 5);
}

void TestBrowserImport::theNewestSearchIsAnswered() {
  const Studies studies;
  QVERIFY(studies.import());
  Jobs jobs;
  IndexService service(studies.home.toStdString(), jobs);
  std::vector<StudyListPtr> lists;
  connect(&service, &IndexService::listed, this,
          [&](const StudyListRequest&, const StudyListPtr& list) { lists.push_back(list); });
  for (const char* words : {"d", "do", "doe", "doex", "mull"}) service.list({words, {}});
  QTRY_COMPARE_WITH_TIMEOUT(lists.size(), std::size_t(1), longest);
  QCOMPARE(lists[0]->patients.size(), std::size_t(1));
  QCOMPARE(QString::fromStdString(lists[0]->patients[0].studies[0].patientId), QStringLiteral("B222"));
}

// With 500 patients and 1,000 studies, the list and each key of a search are answered off the UI thread.
void TestBrowserImport::tenThousandSeriesAreSearched() {
  const Studies studies;
  const FilledIndex size{.patients = 500, .studies = 2, .series = 10, .files = 2};
  QVERIFY(fillIndex(studies.home.toStdString(), size));
  auto* watched = dynamic_cast<WatchedApplication*>(qApp);
  QVERIFY(watched);
  BrowserWindow w(studies);
  const auto count = [&] { return w.patients().size(); };
  QTRY_COMPARE_WITH_TIMEOUT(count(), qsizetype(500), longest);
  w.shot("browser-many");
  watched->takeMostMs();
  w.search()->setFocus();
  QTest::keyClicks(w.search(), QStringLiteral("muller8"));
  const auto found = [&] {
    QStringList names = w.patients();
    names.sort();
    return names;
  };
  // All of them have series with warnings.
  const QStringList expected =
      texts({"! Müller8, Anna", "! Müller80, Anna", "! Müller84, Anna", "! Müller88, Anna"});
  QTRY_COMPARE_WITH_TIMEOUT(found(), expected, longest);
  QTest::keyClick(w.search(), Qt::Key_Escape);
  QTRY_COMPARE_WITH_TIMEOUT(count(), qsizetype(500), longest);
  w.tree()->header()->setSortIndicator(int(StudyColumn::id), Qt::AscendingOrder);
  QTRY_COMPARE_WITH_TIMEOUT(w.patients(1).front(), QStringLiteral("P10000"), longest);
  const double most = watched->takeMostMs();
  std::printf("10,000 series: the longest event took %.1f ms of the UI thread\n", most);
  QVERIFY2(most < 100, "the UI thread lists, but does not search or sort");
}

VOLUMEN_TEST(TestBrowserImport);
#include "tst_browser_import.moc"
