// Guards how the window looks with hospital data in its default hanging. At every screen size each view has
// space and its picture, nothing overlaps or is cut off, and the window fits the screen. If $VOLUMEN_SHOTS
// names a folder, takes screenshots of every size. QT_SCALE_FACTOR=2 does so for a screen of twice the
// density.
#include <algorithm>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/final_picture.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/journey.h"
#include "tests/ui/window_flaws.h"
#include "tests/unit/suite.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int leastWidth = 150, leastHeight = 120;  // of a view whose texts can be read
constexpr QSize smallScreen(1366, 700);             // of a laptop, without desktop bars

// Returns the views on screen once each has its picture.
std::vector<View*> drawnViews(MainWindow& window) {
  std::vector<View*> views;
  const auto areDrawn = [&] {
    views.clear();
    for (const ViewId id : viewsOnScreen(window.session().workspace()))
      if (seriesIn(window.session().workspace(), id)) views.push_back(window.views()->viewOf(id));
    return !views.empty() && std::ranges::all_of(views, [](View* view) {
      const auto* flat = qobject_cast<FlatView*>(view);
      const auto* scene = qobject_cast<VolumeView*>(view);
      return !(flat ? flat->picture() : scene->picture()).isNull();
    });
  };
  return QTest::qWaitFor(areDrawn, longest) ? views : std::vector<View*>{};
}

}  // namespace

class TestProtocolLooks : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void studiesAreShownAsTheyHang_data();
  void studiesAreShownAsTheyHang();
};

void TestProtocolLooks::studiesAreShownAsTheyHang_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<int>("views");
  QTest::addColumn<QSize>("size");
  const bool all = qEnvironmentVariableIsSet("VOLUMEN_SHOTS");
  const auto sizes = all ? QList<QSize>{{1366, 768}, {1440, 900}, {2560, 1440}} : QList<QSize>{{1366, 768}};
  const auto add = [&](const char* path, int views) {
    for (const QSize size : sizes)
      QTest::addRow("%s, %d x %d", path, size.width(), size.height())
          << QString::fromLatin1(path) << views << size;
  };
  add("ct-chest-lidc0314-138", 4);
  add("mr-head-ge-mprage-130", 4);
  add("dicom-geometry/mr-qt2-multiecho-7", 1);
  add("dicom-geometry/mr-localizer-ge-3plane-21", 1);
  add("pet-ct", 4);
  add("mammograms", 4);
  add("dicom-2d/mg-sigmoid-voilut3.dcm", 1);
  add("dicom-2d/cr-chest-mono1-jpeg8.dcm", 1);
  add("dicom-2d/cr-hip-mono2-jpeg12.dcm", 1);
  add("dicom-2d/us-cine-aspect-regions.dcm", 1);
  add("dicom-2d/xa-96frames.dcm", 1);
}

void TestProtocolLooks::studiesAreShownAsTheyHang() {
  QFETCH(QString, path);
  QFETCH(int, views);
  QFETCH(QSize, size);
  const Mammograms mammograms;
  QString data = QString::fromStdString(dataPath(path.toStdString()));
  if (path == QStringLiteral("mammograms")) {
    QVERIFY(mammograms.write(BreastSeries::ofEach));
    data = mammograms.folder.path();
  }
  NEED_DATA(data.toStdString());
  openAlone(false);
  MainWindow window(realServices());
  const FinalPicture scene(window);
  window.resize(size);
  window.show();
  window.open({data});
  QTRY_COMPARE_WITH_TIMEOUT(int(drawnViews(window).size()), views, longest);
  QTRY_VERIFY_WITH_TIMEOUT(window.jobs().rows().empty(), longest);
  QTest::qWait(300);  // pictures of views that were oriented towards each other
  const bool hasScene = std::ranges::any_of(
      drawnViews(window), [](View* view) { return qobject_cast<VolumeView*>(view) != nullptr; });
  QTRY_VERIFY_WITH_TIMEOUT(!hasScene || scene.isThere(), longest);
  if (const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS"); !folder.isEmpty())
    window.grab().save(QDir(folder).filePath(
        QString(path).replace(QLatin1Char('/'), QLatin1Char('_')) +
        QStringLiteral("-%1-x%2.png").arg(size.width()).arg(qRound(window.devicePixelRatioF()))));
  QCOMPARE(window.size(), size);
  const QSize least = window.minimumSizeHint();
  QVERIFY2(QRect({}, smallScreen).contains(QRect({}, least)),
           qPrintable(QStringLiteral("%1 x %2").arg(least.width()).arg(least.height())));
  for (const View* view : drawnViews(window)) {
    QVERIFY2(view->width() >= leastWidth && view->height() >= leastHeight,
             qPrintable(view->accessibleName()));
    QVERIFY(window.views()->rect().contains(view->geometry()));
  }
  const QStringList found = flaws(window);
  QVERIFY2(found.isEmpty(), qPrintable(found.join(QLatin1Char('\n'))));
}

VOLUMEN_TEST(TestProtocolLooks);
#include "tst_protocol_looks.moc"
