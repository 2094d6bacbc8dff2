// Guards a complete workflow from pictures to numbers, by real events. The bone of a chest CT is found, freed
// of an island, cut and measured. The work is saved, the program killed, and the work reopened.
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/hand.h"
#include "tests/ui/killed_window.h"
#include "tests/ui/numbers_table.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* journeyFolder = "VOLUMEN_JOURNEY_FOLDER";  // set in the program that is killed
constexpr glm::ivec3 alongK(0, 0, 1);

// Returns a series that stays in memory after its window is closed.
LoadedSeriesPtr seriesReadFrom(const QString& folder) {
  Journey opened({folder});
  return opened.settle() ? opened.window.session().series() : nullptr;
}

// Copies 40 slices of the chest, 8 cm. Returns false if that fails.
bool copySlices(const std::string& chest, const QDir& folder) {
  const Result<Study> study = openStudy(chest);
  if (!study || study->volumes.empty() || study->volumes.front().files.size() < 100) return false;
  const std::vector<std::string>& files = study->volumes.front().files;
  for (std::size_t n = 50; n < 90; ++n) {
    const QFileInfo file(QString::fromStdString(files[n]));
    if (!QFile::copy(file.filePath(), folder.filePath(file.fileName()))) return false;
  }
  return true;
}

struct BoneWindow : SegmentWindow {
  using SegmentWindow::SegmentWindow;

  const VoxelGeometry& grid() { return session().series()->volume->geometry(); }
  glm::ivec3 voxelAt(QPoint pixel) { return glm::ivec3(glm::round(grid().voxelFromPatient(patient(pixel)))); }
  bool follow(const char* recipe) {
    Hand(window).menuOf(child<QToolButton>("segmentRecipes"), recipe);
    return QTest::qWaitFor([this] { return count() == 1; }, 10 * longest) && idle();
  }
  // Shows a part's slice in the axial view and returns a pixel in the part; empty if there is none.
  std::optional<QPoint> pixelIn(const Parts& parts, std::size_t part) {
    const VoxelBox box = *mask(current().number).box();
    for (int k = box.low.z; k <= box.high.z; ++k)
      for (int j = box.low.y; j <= box.high.y; j += 2)
        for (int i = box.low.x; i <= box.high.x; i += 2) {
          if (parts.of({i, j, k}) != part) continue;
          const QPoint at = showPlace(grid().patientFromVoxel({i, j, k}));
          if (parts.of(voxelAt(at)) == part) return at;
        }
    return {};
  }
};

// The section of a rib in one slice. Without it, the bone above and below is in two components.
struct RibCut {
  std::vector<glm::ivec3> voxels;
  glm::ivec3 above{0}, below{0};
};

// Returns the connected component of a voxel by faces within its slice.
std::vector<glm::ivec3> joinedInSlice(const BitMask& mask, glm::ivec3 voxel) {
  BitMask slice(mask.geometry());
  for (int j = 0; j < mask.size().y; ++j)
    std::ranges::copy(mask.row(j, voxel.z), slice.row(j, voxel.z).begin());
  const BitMask joined = connected(slice, std::span(&voxel, 1), Neighbours::faces);
  std::vector<glm::ivec3> voxels;
  const auto box = joined.box();
  for (int j = box->low.y; j <= box->high.y; ++j)
    for (int i = box->low.x; i <= box->high.x; ++i)
      if (joined.at({i, j, voxel.z})) voxels.emplace_back(i, j, voxel.z);
  return voxels;
}

BitMask withoutVoxels(BitMask mask, const std::vector<glm::ivec3>& voxels) {
  for (const glm::ivec3 v : voxels) mask.set(v, false);
  return mask;
}

bool areApart(const BitMask& bone, const RibCut& cut) {
  const Parts parts(bone, Neighbours::faces);
  constexpr std::int64_t least = 200;  // voxels, to ignore crumbs
  const std::size_t a = parts.of(cut.above), b = parts.of(cut.below);
  return a != b && a < parts.count() && b < parts.count() && parts.size(a) > least && parts.size(b) > least;
}

// Returns the first rib that one slice cuts apart, from the middle slice on; empty if there is none.
std::optional<RibCut> ribIn(const BitMask& bone) {
  constexpr std::size_t least = 20, most = 400;  // voxels of 0.6 mm^2
  const glm::ivec3 size = bone.size();
  for (int k = size.z / 2; k < size.z - 3; k += 3) {
    BitMask left = bone;  // not examined yet
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const glm::ivec3 voxel(i, j, k);
        if (!left.at(voxel)) continue;
        RibCut cut{joinedInSlice(bone, voxel)};
        left = withoutVoxels(std::move(left), cut.voxels);
        if (cut.voxels.size() < least || cut.voxels.size() > most) continue;
        bool isAbove = false, isBelow = false;
        for (const glm::ivec3 v : cut.voxels) {
          if (bone.at(v + alongK)) cut.above = v + alongK, isAbove = true;
          if (bone.at(v - alongK)) cut.below = v - alongK, isBelow = true;
        }
        if (isAbove && isBelow && areApart(withoutVoxels(bone, cut.voxels), cut)) return cut;
      }
  }
  return {};
}

}  // namespace

class TestSegmentJourneys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aChestThatIsKilled();
  void aChestFromItsPictureToASessionAndBack();
};

// Not a test. aChestFromItsPictureToASessionAndBack() starts it.
void TestSegmentJourneys::aChestThatIsKilled() {
  if (!qEnvironmentVariableIsSet(journeyFolder)) return;
  const QDir folder(qEnvironmentVariable(journeyFolder));
  const LoadedSeriesPtr chest = seriesReadFrom(folder.filePath(QStringLiteral("chest")));
  QVERIFY(chest);
  BoneWindow w(chest);
  QVERIFY(w.follow("recipeBone"));
  const auto voxelsOf = [&](const BitMask& mask) { return QString::number(mask.count()); };
  QVERIFY(openTable(w));
  QCOMPARE(cellOf(w, QStringLiteral("Voxels")), voxelsOf(w.mask(1)));

  const BitMask all = w.mask(1);
  const Parts parts(all, Neighbours::faces);
  QVERIFY(parts.count() > 1);
  const std::optional<QPoint> island = w.pixelIn(parts, 1);
  QVERIFY(island);
  w.child<QAction>("partTool")->trigger();
  QTest::mouseClick(w.view(), Qt::LeftButton, Qt::AltModifier, *island);
  QVERIFY(w.idle());
  std::vector<bool> chosen(parts.count());
  chosen[1] = true;
  const BitMask bone = subtracted(all, parts.mask(chosen));
  QVERIFY(w.mask(1) == bone);
  QTRY_COMPARE_WITH_TIMEOUT(cellOf(w, QStringLiteral("Voxels")), voxelsOf(bone), longest);

  const std::optional<RibCut> rib = ribIn(bone);
  QVERIFY(rib);
  w.click("segmentPaint");
  w.child<QDoubleSpinBox>("cutMm")->setValue(0.5);  // less than the slice spacing, so only one slice
  w.child<QAction>("segmentScissorsTool")->trigger();
  w.showPlace(w.grid().patientFromVoxel(rib->voxels.front()));
  QRectF box;
  for (const glm::ivec3 v : rib->voxels) {
    const glm::dvec2 p = w.view()->plane()->pixelFromPatient(w.grid().patientFromVoxel(v));
    box |= QRectF(p.x - 2, p.y - 2, 4, 4);
  }
  QTest::mousePress(w.view(), Qt::LeftButton, {}, box.topLeft().toPoint());
  for (const QPointF corner : {box.topRight(), box.bottomRight(), box.bottomLeft(), box.topLeft()})
    QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, corner.toPoint());
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, box.topLeft().toPoint());
  QVERIFY(w.idle());
  const BitMask cut = w.mask(1);
  QCOMPARE(w.session().undoStack().undoText(), QStringLiteral("Cut segment inside"));
  QVERIFY(subtracted(cut, bone).empty() && cut != bone);
  for (const glm::ivec3 v : rib->voxels) QVERIFY(!cut.at(v));
  QVERIFY(!areApart(bone, *rib) && areApart(cut, *rib));

  const double ml = double(cut.count()) * w.grid().voxelVolume() / 1000;
  QTRY_COMPARE_WITH_TIMEOUT(w.list()->topLevelItem(0)->text(2), QLocale().toString(ml, 'f', ml < 100 ? 2 : 0),
                            longest);
  QTRY_COMPARE_WITH_TIMEOUT(cellOf(w, QStringLiteral("Volume (ml)")), QString::number(ml, 'g', 5), longest);

  w.child<QAction>("saveSessionAs")->trigger();
  answer(w, "saveSessionDialog", folder.filePath(QStringLiteral("s.volumen")));
  QVERIFY(
      QTest::qWaitFor([&] { return w.window.windowTitle().contains(QStringLiteral("s.volumen")); }, longest));
  QFile told(folder.filePath(QStringLiteral("told")));
  QVERIFY(told.open(QIODevice::WriteOnly));
  told.write((QStringList(QString::fromStdString(checksumOf(*w.map()->labels))) + tableTexts(w))
                 .join(QLatin1Char('\n'))
                 .toUtf8());
  told.close();
  QVERIFY(told.rename(folder.filePath(QStringLiteral("done"))));
  QTest::qWait(longest);  // until it is killed
}

void TestSegmentJourneys::aChestFromItsPictureToASessionAndBack() {
  const std::string data = dataPath("ct-chest-lidc0314-138");
  NEED_DATA(data);
  const QTemporaryDir dir;
  const QDir folder(dir.path());
  QVERIFY(folder.mkdir(QStringLiteral("chest")));
  QVERIFY(copySlices(data, QDir(folder.filePath(QStringLiteral("chest")))));
  const QString output = folder.filePath(QStringLiteral("output")),
                done = folder.filePath(QStringLiteral("done"));
  const auto program = startedTest("TestSegmentJourneys", QStringLiteral("aChestThatIsKilled"),
                                   {{QLatin1String(journeyFolder), dir.path()}}, output);
  const bool isDone = QTest::qWaitFor(
      [&] { return QFile::exists(done) || program->state() == QProcess::NotRunning; }, 10 * longest);
  killProgram(*program);
  QVERIFY2(isDone && QFile::exists(done), contentsOf(output));
  const QStringList told = QString::fromUtf8(contentsOf(done)).split(QLatin1Char('\n'));

  Journey again({folder.filePath(QStringLiteral("s.volumen"))});
  again.window.resize(1440, 900);
  QTRY_VERIFY_WITH_TIMEOUT(again.window.session().series() != nullptr, longest);
  const SharedList<SegmentMap>& maps = again.window.session().workspace().segmentMaps;
  QCOMPARE(maps.size(), std::size_t(1));
  QVERIFY(maps.front().labels);
  QCOMPARE(QString::fromStdString(checksumOf(*maps.front().labels)), told.front());
  again.child<QDockWidget>("segmentDock")->raise();
  QCoreApplication::processEvents();
  QVERIFY(openTable(again));
  QCOMPARE(tableTexts(again), told.mid(1));
}

VOLUMEN_TEST(TestSegmentJourneys);
#include "tst_segment_journeys.moc"
