// Guards the window where memory is short: a series that is too large is told by both figures, and all else
// stays and goes on; 3D views are drawn of a reduced copy, say so, and are whole again when there is memory.
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>

#include "io/load.h"
#include "io/open.h"
#include "io/worker/sandbox.h"
#include "tests/fixtures/little_memory.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/controller/draw.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/warning_badge.h"
#include "viewer/scene/presets.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr std::uint64_t mebi = 1 << 20;

}  // namespace

class TestShortMemoryWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void aSeriesThatIsTooLargeIsTold();
  void picturesAreOfACopyWhileMemoryIsShort();
  void aViewSaysThatItsPictureIsOfACopy();
};

void TestShortMemoryWindow::initTestCase() {
  if (volumen::worker::sanitized) QSKIP("sanitizers reserve more than any limit");
}

void TestShortMemoryWindow::aSeriesThatIsTooLargeIsTold() {
  const QTemporaryDir folder;
  const QString large = folder.filePath(QStringLiteral("large.nhdr"));
  QFile header(large), values(folder.filePath(QStringLiteral("large.raw")));
  QVERIFY(header.open(QIODevice::WriteOnly) && values.open(QIODevice::WriteOnly));
  header.write(
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 512 512 1024\nencoding: raw\nendian: little\n"
      "data file: large.raw\n");
  header.close();
  QVERIFY(values.resize(qint64(512) * 512 * 1024 * 2));
  Journey w({QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  const LoadedSeriesPtr before = w.window.session().series();
  auto* banner = w.child<Banner>("banner");
  {
    const LittleMemory little(300 * mebi);
    w.window.open({large});
    QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  }
  const QRegularExpression figures(
      QStringLiteral(R"(large\.nhdr: reading it needs [\d.]+ MiB of memory, and \d+ MiB are available)"));
  QVERIFY2(figures.match(banner->sentence()).hasMatch(), qPrintable(banner->sentence()));
  QCOMPARE(w.window.session().series(), before);
  QVERIFY(!w.after([&] { w.window.open({QStringLiteral("phantom:cube:32")}); }).isNull());
  QVERIFY(w.window.session().series() != before);
}

void TestShortMemoryWindow::picturesAreOfACopyWhileMemoryIsShort() {
  const Result<Study> study = openStudy("phantom:ct-head:256");
  const Result<Loaded> loaded = loadSeries(study->volumes.at(0));
  QVERIFY(loaded);
  const auto scene = presetScene("CT-Bone", *loaded->drawn);
  QVERIFY(scene);
  RenderOptions options;
  options.size = {64, 64};
  const Draw usual = drawWithCaches(std::make_shared<StoredVoxels>(loaded->drawn));
  const Result<Drawn> whole = usual(*scene, options, {});
  QVERIFY(whole && whole->warnings.empty());
  const Draw draw = drawWithCaches(std::make_shared<StoredVoxels>(loaded->drawn));
  {
    const LittleMemory little(66 * mebi);
    const Result<Drawn> copy = draw(*scene, options, {});
    QVERIFY2(copy, copy ? "" : copy.message().c_str());
    QCOMPARE(copy->warnings.size(), std::size_t(1));
    QCOMPARE(copy->warnings[0].kind, WarningKind::reduced);
    QVERIFY(copy->plan.scene.camera == whole->plan.scene.camera);
    QVERIFY(copy->picture.rgba != whole->picture.rgba);
  }
  const Result<Drawn> again = draw(*scene, options, {});
  QVERIFY(again && again->warnings.empty());
  QCOMPARE(again->picture.rgba, whole->picture.rgba);
  // What is there already is used, however little more there is.
  const LittleMemory little(20 * mebi);
  const Result<Drawn> kept = draw(*scene, options, {});
  QVERIFY(kept && kept->warnings.empty());
}

void TestShortMemoryWindow::aViewSaysThatItsPictureIsOfACopy() {
  Journey w({QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  auto* badge = w.window.view()->findChild<WarningBadge*>();
  QVERIFY(badge->isHidden());
  {
    const LittleMemory little(80 * mebi);
    w.settled.clear();
    w.window.open({QStringLiteral("phantom:ct-head:256")});
    QVERIFY(w.settle());
    QTRY_VERIFY(badge->isVisible());
    QVERIFY2(badge->text().contains(QStringLiteral("Reduced copy")), qPrintable(badge->text()));
    QVERIFY2(badge->toolTip().contains(QStringLiteral("are available")), qPrintable(badge->toolTip()));
  }
  w.after([&] { w.window.open({QStringLiteral("phantom:sphere:32")}); });
  QTRY_VERIFY(badge->isHidden());
}

VOLUMEN_TEST(TestShortMemoryWindow);
#include "tst_short_memory_window.moc"
