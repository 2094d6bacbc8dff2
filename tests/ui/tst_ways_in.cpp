// Guards that a study shows the same series, in the same views and fused alike, on every way in. Real files,
// by real events.
#include <QMimeData>
#include <filesystem>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/browser_window.h"
#include "tests/ui/fusion_window.h"
#include "tests/ui/gestures.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/workspace/layout_text.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A study in a folder, and an index that knows it.
struct GivenStudy {
  QTemporaryDir dir;
  QString folder = dir.filePath(QStringLiteral("study")), home = dir.filePath(QStringLiteral("home"));

  // Copies files and folders of the test data.
  void copy(const QStringList& paths) const {
    namespace fs = std::filesystem;
    fs::create_directories(folder.toStdString());
    for (const QString& path : paths) {
      const fs::path from(dataPath(path.toStdString()));
      fs::copy(from, fs::path(folder.toStdString()) / from.filename(), fs::copy_options::recursive);
    }
  }
  Services services() const {
    Services real = realServices();
    real.indexFolder = home.toStdString();
    return real;
  }
  QStringList parts() const {
    QStringList parts;
    for (const QFileInfo& each : QDir(folder).entryInfoList(QDir::Dirs | QDir::NoDotAndDotDot))
      parts << each.absoluteFilePath();
    return parts.size() > 1 ? parts : QStringList(folder);
  }
};

// Returns what the views on screen show: layout, kinds, series and overlays; empty until all of it is there.
QString shownIn(MainWindow& window) {
  const Session& session = window.session();
  const Workspace& workspace = session.workspace();
  if (window.document().loader.isBusy()) return {};
  QStringList shown{QLatin1String(layoutName(workspace.layout))};
  for (const ViewId id : viewsOnScreen(workspace)) {
    const Series* series = seriesIn(workspace, id);
    const View* view = window.views()->viewOf(id);
    if (!series || !view ||
        !(showsFrames(workspace, id) ? frameIn(view) != nullptr : session.seriesOf(id) != nullptr))
      return {};
    const auto over = workspace.series.find(flatLookOf(workspace.view(id)).overlay);
    shown << QStringLiteral("%1: %2 of %3 under %4")
                 .arg(id)
                 .arg(int(workspace.view(id).kind))
                 .arg(QString::fromStdString(series->seriesUid),
                      over == workspace.series.end()
                          ? QStringLiteral("nothing")
                          : QString::fromStdString(over->second.series->seriesUid));
  }
  return shown.join(QLatin1Char('\n'));
}

void dropOn(Journey& w, const QStringList& paths) {
  QMimeData data;
  QList<QUrl> urls;
  for (const QString& path : paths) urls << QUrl::fromLocalFile(path);
  data.setUrls(urls);
  QVERIFY(tests::drop(data, &w.window));
}

void openListed(const GivenStudy& given, Qt::KeyboardModifiers modifiers, Journey& w) {
  const Result<Index> index = Index::open(given.home.toStdString());
  QVERIFY(index);
  auto* tree = w.child<QTreeView>("browserTree");
  QTRY_VERIFY_WITH_TIMEOUT(tree->isVisible() && tree->model()->rowCount() > 0, longest);
  tree->setCurrentIndex(tree->model()->index(0, 0));
  QTest::keyClick(tree, Qt::Key_Return, modifiers);
}

}  // namespace

class TestWaysIn : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStudyIsShownAlike_data();
  void aStudyIsShownAlike();
};

void TestWaysIn::aStudyIsShownAlike_data() {
  QTest::addColumn<QStringList>("files");
  QTest::addColumn<QString>("layout");
  QTest::newRow("a PET/CT") << QStringList{QStringLiteral("pet-ct/sts019-ct"),
                                           QStringLiteral("pet-ct/sts019-pet")}
                            << QStringLiteral("planes");
  QTest::newRow("a CT") << QStringList{QStringLiteral("dicom-geometry/ct-ge-tilt-varspacing-28")}
                        << QStringLiteral("planes");
  QTest::newRow("an MR of three series")
      << QStringList{QStringLiteral("dicom-geometry/mr-mosaic-siemens")} << QStringLiteral("planes");
  QTest::newRow("an MR of diffusion")
      << QStringList{QStringLiteral("dicom-geometry/mr-dwi-philips-enh")} << QString();
  QTest::newRow("localizers, which are frames alone")
      << QStringList{QStringLiteral("dicom-geometry/mr-localizer-ge-3plane-21")} << QString();
  QTest::newRow("four mammograms, which are hung") << QStringList() << QStringLiteral("four");
}

void TestWaysIn::aStudyIsShownAlike() {
  QFETCH(QStringList, files);
  QFETCH(QString, layout);
  const UsualLayouts usual;
  GivenStudy given;
  if (files.isEmpty()) {
    QDir().mkpath(given.folder);
    for (int n = 0; n < 4; ++n)
      QVERIFY(writeBreast(breasts[n], n + 1, QStringLiteral("%1/%2.dcm").arg(given.folder).arg(n),
                          BreastSeries::ofEach));
  } else {
    NEED_DATA(dataPath());
    given.copy(files);
  }
  QString expected;
  const QString session = given.dir.filePath(QStringLiteral("s.volumen"));
  {
    Journey w({given.folder}, given.services());
    QTRY_VERIFY_WITH_TIMEOUT(shownIn(w.window).startsWith(layout) && !shownIn(w.window).isEmpty(), longest);
    expected = shownIn(w.window);
    w.child<QAction>("saveSessionAs")->trigger();
    answer(w, "saveSessionDialog", session);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(session), longest);
  }
  {
    Result<Index> index = Index::open(given.home.toStdString());
    QVERIFY(index && index->import({given.folder.toStdString()}));
  }
  const std::pair<const char*, std::function<void(Journey&)>> ways[] = {
      {"each part of its own", [&](Journey& w) { w.window.open(given.parts()); }},
      {"dropped", [&](Journey& w) { dropOn(w, {given.folder}); }},
      {"its parts dropped", [&](Journey& w) { dropOn(w, given.parts()); }},
      {"by the list of studies", [&](Journey& w) { openListed(given, {}, w); }},
      {"by its session", [&](Journey& w) { w.window.open({session}); }},
  };
  for (const auto& [way, open] : ways) {
    Journey w({}, given.services());
    open(w);
    QTRY_VERIFY2_WITH_TIMEOUT(
        shownIn(w.window) == expected,
        qPrintable(
            QStringLiteral("%1:\n%2\nin place of\n%3").arg(QLatin1String(way), shownIn(w.window), expected)),
        20000);
  }
}

VOLUMEN_TEST(TestWaysIn);
#include "tst_ways_in.moc"
