// Guards two whole ways from pictures to numbers, by real events: a chest CT whose bone is found, rid of an
// island, cut and read, saved, killed and opened again; a lesion in PET, its SUVpeak and TLG in a CSV file.
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/hand.h"
#include "tests/ui/killed_window.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* journeyFolder = "VOLUMEN_JOURNEY_FOLDER";  // set: this is the program that is killed
constexpr glm::ivec3 alongK(0, 0, 1);

// All texts of the table of numbers, by row and head.
QStringList tableTexts(Journey& w) {
  QStringList texts;
  const auto* table = w.child<QTableWidget>("segmentNumbers");
  for (int row = 0; row < table->rowCount(); ++row)
    for (int column = 0; column < table->columnCount(); ++column)
      texts << table->horizontalHeaderItem(column)->text() + QLatin1Char('\t') +
                   table->item(row, column)->text();
  return texts;
}

// True once the table of numbers is open and measured.
bool openTable(Journey& w) {
  QTest::mouseClick(w.child<QWidget>("segmentNumbersButton"), Qt::LeftButton);
  return QTest::qWaitFor(
      [&] {
        const auto* table = w.child<QTableWidget>("segmentNumbers");
        return table && table->rowCount() > 0 && w.window.jobs().rows().empty();
      },
      longest);
}

QString cellOf(Journey& w, const QString& head) {
  for (const QString& text : tableTexts(w))
    if (text.startsWith(head + QLatin1Char('\t'))) return text.section(QLatin1Char('\t'), 1);
  return {};
}

// A series that is in memory once the window that read it is gone.
LoadedSeriesPtr seriesReadFrom(const QString& folder) {
  Journey opened({folder});
  return opened.settle() ? opened.window.session().series() : nullptr;
}

// 40 slices of the chest, 8 cm of it; false where they cannot be copied.
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
  // A pixel of the axial view, which then shows it, that lies in a part; none: there is none.
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

// What of a rib lies in one slice: without it the bone above and below is in two parts.
struct RibCut {
  std::vector<glm::ivec3> voxels;
  glm::ivec3 above{0}, below{0};
};

// What of a mask is joined to a voxel by faces, within its slice.
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
  constexpr std::int64_t least = 200;  // voxels: no crumbs
  const std::size_t a = parts.of(cut.above), b = parts.of(cut.below);
  return a != b && a < parts.count() && b < parts.count() && parts.size(a) > least && parts.size(b) > least;
}

// The first rib that one slice cuts apart, from the middle slice on.
std::optional<RibCut> ribIn(const BitMask& bone) {
  constexpr std::size_t least = 20, most = 400;  // voxels of 0.6 mm^2
  const glm::ivec3 size = bone.size();
  for (int k = size.z / 2; k < size.z - 3; k += 3) {
    BitMask left = bone;  // not looked at yet
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
  void aLesionFromPetToCsv();
};

// No test, but what aChestFromItsPictureToASessionAndBack() starts.
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
  w.child<QDoubleSpinBox>("cutMm")->setValue(0.5);  // less than from slice to slice: one slice alone
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

namespace {

constexpr glm::dvec3 pHot(2.5, -3.5, 1.5);                       // the centre of a voxel
constexpr double hotTop = 16, hotMm = 11, suvOfBecquerel = 0.5;  // SUV 8

double hotValue(glm::dvec3 p) { return hotTop * std::max(0.0, 1 - glm::distance(p, pHot) / hotMm); }

// A cone of 16 Bq/ml in 0, of SUV 8.
LoadedSeriesPtr hotPet() {
  auto series = std::make_shared<LoadedSeries>(*seriesOf(volumeOf<float>(
      glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) { return hotValue(pVoxel - 19.5); })));
  series->series.acquired = series->volume->geometry();
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = suvOfBecquerel;
  series->firstScene.transferFunction.points = {{1, {1, 1, 1}, 0.0}, {8, {1, 1, 1}, 1.0}};
  return series;
}

// Of a CSV of one row without quotes: the field below each head.
std::map<QString, QString> fieldsOfCsv(const QByteArray& csv) {
  const QStringList lines = QString::fromUtf8(csv).split(QStringLiteral("\r\n"));
  std::map<QString, QString> fields;
  if (lines.size() != 3) return fields;
  const QStringList heads = lines[0].split(QLatin1Char(',')), values = lines[1].split(QLatin1Char(','));
  if (heads.size() != values.size()) return fields;
  for (qsizetype n = 0; n < heads.size(); ++n) fields[heads[n]] = values[n];
  return fields;
}

}  // namespace

// From 41 % of the top on a cone is one of 59 % of its radius r. The mean of a cone in a ball of radius b
// about its middle is top (1 - 3 b / (4 r)); the ball of 1 ml has 6.2 mm, and lies in the lesion.
void TestSegmentJourneys::aLesionFromPetToCsv() {
  const QTemporaryDir folder;
  SegmentWindow w(hotPet());
  w.click("segmentGrowing");
  w.child<QComboBox>("lesionThreshold")->setCurrentIndex(0);
  w.child<QAction>("lesionTool")->trigger();
  const QPoint at = w.showPlace(pHot);
  drag(w.view(), at, at + QPoint(int(12.5 / w.view()->plane()->mmPerPixel), 0));
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(1));
  QVERIFY(openTable(w));
  w.click("segmentNumbersCsv");
  const QString path = folder.filePath(QStringLiteral("lesion.csv"));
  answer(w, "segmentNumbersFileDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  const std::map<QString, QString> fields = fieldsOfCsv(contentsOf(path));
  const auto number = [&](const char* head) {
    const auto field = fields.find(QLatin1String(head));
    return field == fields.end() ? NAN : field->second.toDouble();
  };
  const auto isNear = [](double is, double wanted, double part) { return std::abs(is / wanted - 1) < part; };

  // Of its voxels, one by one.
  const double top = hotTop * suvOfBecquerel, radius = 0.59 * hotMm;
  std::int64_t voxels = 0;
  double sum = 0;
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) {
        const glm::dvec3 p = glm::dvec3(i, j, k) - 19.5;
        if (glm::distance(p, pHot) > radius + 1e-6) continue;
        ++voxels;
        sum += suvOfBecquerel * double(float(hotValue(p)));
      }
  QCOMPARE(number("Voxels"), double(voxels));
  QCOMPARE(number("Volume (ml)"), double(voxels) / 1000);
  QCOMPARE(number("SUVmax (SUVbw)"), top);
  QVERIFY(isNear(number("SUVmean (SUVbw)"), sum / double(voxels), 1e-6));
  QVERIFY(isNear(number("TLG (SUVbw ml)"), sum / 1000, 1e-6));
  // As far as voxels of 1 mm allow: of the cone.
  const double ballMm = std::cbrt(1000 * 3 / (4 * std::numbers::pi));
  QVERIFY(isNear(number("SUVpeak (SUVbw)"), top * (1 - 0.75 * ballMm / hotMm), 0.01));
  const double coneMl = 4 * std::numbers::pi / 3 * radius * radius * radius / 1000;
  QVERIFY(isNear(number("TLG (SUVbw ml)"), coneMl * top * (1 - 0.75 * 0.59), 0.05));
  // And what is read in the window is what the file says, to five digits.
  for (const char* head : {"SUVpeak (SUVbw)", "TLG (SUVbw ml)", "SUVmax (SUVbw)"})
    QVERIFY2(isNear(cellOf(w, QLatin1String(head)).toDouble(), number(head), 1e-4), head);
}

VOLUMEN_TEST(TestSegmentJourneys);
#include "tst_segment_journeys.moc"
