// Guards the positions that a view scrolls through and their numbers: of slices along the file and across it,
// of slices that the file lacks, and of frames. Positions are compared with closed forms.
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/workspace/stack.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int stackSlices = 31;

// Returns 24 x 22 voxels of 1 mm in slices of 2 mm. The last is the uppermost, or the first with `isTurned`.
std::shared_ptr<LoadedSeries> stackOf(bool isTurned = false) {
  auto loaded = std::make_shared<LoadedSeries>();
  glm::dmat3 step(1);
  step[1].y = isTurned ? -1 : 1;
  step[2].z = isTurned ? -2 : 2;
  loaded->volume = volumeOf<std::int16_t>({24, 22, stackSlices}, step, [](glm::dvec3) { return 0; });
  Series& series = loaded->series;
  series.path = "stack", series.id = "1", series.format = "DICOM";
  series.acquired = loaded->volume->geometry();
  for (int n = 0; n < stackSlices; ++n) {
    series.files.push_back(std::to_string(n));
    series.frames.push_back(0);
    series.sopInstanceUids.push_back("1.2." + std::to_string(n));
  }
  return loaded;
}

Workspace workspaceOf(const LoadedSeriesPtr& loaded, ViewKind kind = ViewKind::axial) {
  Workspace workspace = withSeries({}, axialViewId, loaded->series, {});
  workspace.editView(axialViewId).kind = kind;
  return workspace;
}

Stack stackAt(const LoadedSeriesPtr& loaded, int place, ViewKind kind = ViewKind::axial) {
  return stackIn(withPlace(workspaceOf(loaded, kind), axialViewId, loaded, place), axialViewId, loaded);
}

}  // namespace

class TestStack : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyPositionIsReached_data();
  void everyPositionIsReached();
  void slicesThatTheFileLacksHaveNoNumber();
  void onlyThinPlanesOnASliceShowAPicture();
  void keyImagesLieAtTheirPictures();
  void theEndsAreTheFirstAndTheLastPicture();
  void nothingShownHasNoPositions();
};

void TestStack::everyPositionIsReached_data() {
  QTest::addColumn<ViewKind>("kind");
  QTest::addColumn<bool>("isTurned");
  QTest::addColumn<int>("count");
  QTest::addColumn<bool>("countsDown");
  QTest::newRow("from the last slice") << ViewKind::axial << false << stackSlices << true;
  QTest::newRow("from the first slice") << ViewKind::axial << true << stackSlices << false;
  QTest::newRow("across the slices") << ViewKind::sagittal << false << 24 << false;
  QTest::newRow("frames") << ViewKind::frames << false << stackSlices << false;
}

// Positions beyond the ends are the ends.
void TestStack::everyPositionIsReached() {
  QFETCH(ViewKind, kind);
  QFETCH(bool, isTurned);
  QFETCH(int, count);
  QFETCH(bool, countsDown);
  const LoadedSeriesPtr loaded = stackOf(isTurned);
  for (int place = -3; place < count + 3; ++place) {
    const Stack stack = stackAt(loaded, place, kind);
    const int index = std::clamp(place, 0, count - 1), number = countsDown ? count - index : index + 1;
    QCOMPARE(stack.place.index, index);
    QVERIFY(stack.place.count == count && stack.numberCount == count);
    QVERIFY(stack.number == number && stack.numberOf(index) == number && stack.placeOf(number) == index);
    QCOMPARE(stack.seen.index.value_or(-1), kind == ViewKind::sagittal ? -1 : number - 1);
  }
}

// The 16th of 31 drawn slices, from below, belongs to no file. Picture 7 lies on none.
void TestStack::slicesThatTheFileLacksHaveNoNumber() {
  const auto loaded = stackOf();
  Series::Regular regular{loaded->series.acquired, 1, {}};
  for (int n = 0; n < stackSlices; ++n) regular.copies.push_back(n == 15 ? -1 : n < 7 ? n : n + 1);
  loaded->series.regular = regular;
  loaded->series.acquired.size.z = stackSlices + 1;
  for (int place = 0; place < stackSlices; ++place) {
    const Stack stack = stackAt(loaded, place);
    const int number = regular.copies[std::size_t(stackSlices - 1 - place)] + 1;
    QVERIFY(stack.number == number && stack.numberOf(place) == number);
    QVERIFY(stack.numberCount == stackSlices + 1 && stack.seen.interpolated == (place == 15));
    if (number > 0) QVERIFY(stack.placeOf(number) == place);
    QVERIFY(!stack.placeOf(8));
  }
}

void TestStack::onlyThinPlanesOnASliceShowAPicture() {
  const LoadedSeriesPtr loaded = stackOf();
  const Workspace on = workspaceOf(loaded);
  Workspace thick = on;
  thick.editView(axialViewId).flats.editOrAdd(keyOf(loaded->series)).slabMm = 5;
  const Crosshair before = crosshairOf(on, axialViewId, *loaded);
  const Workspace off = withCrosshair(on, axialViewId, frameOfReference(loaded->series), before,
                                      {before.at + glm::dvec3(0, 0, 0.6)});
  for (const auto& [workspace, number] : {std::pair(thick, 16), {off, 0}}) {
    const Stack stack = stackIn(workspace, axialViewId, loaded);
    QVERIFY(stack.number == number && stack.place.index == 15 && !stack.seen.index);
  }
}

void TestStack::keyImagesLieAtTheirPictures() {
  const LoadedSeriesPtr loaded = stackOf();
  for (const ViewKind kind : {ViewKind::axial, ViewKind::coronal, ViewKind::frames}) {
    Workspace workspace = workspaceOf(loaded, kind);
    for (const int picture : {3, 4, 30})
      workspace = withKeyImageToggled(workspace, *keyImageOf(loaded->series, picture));
    std::vector<int> expected;
    if (kind == ViewKind::axial) expected = {27, 26, 0};
    if (kind == ViewKind::frames) expected = {3, 4, 30};
    QCOMPARE(keyImagePlaces(workspace, loaded->series, stackIn(workspace, axialViewId, loaded)), expected);
  }
}

// Other frames of a stack that is no volume have positions once they are read.
void TestStack::theEndsAreTheFirstAndTheLastPicture() {
  const auto loaded = stackOf();
  for (const auto& [kind, down] : {std::pair(ViewKind::axial, -2.0), {ViewKind::frames, 2.0}}) {
    const auto ends = stackAt(loaded, 7, kind).toEnds;
    QVERIFY(ends && glm::length(ends->first - glm::dvec3(0, 0, -7 * down)) < 1e-9);
    QVERIFY(glm::length(ends->second - glm::dvec3(0, 0, (stackSlices - 8) * down)) < 1e-9);
  }
  loaded->series.notVolume = "Localizers.";
  QVERIFY(!stackAt(loaded, 7, ViewKind::frames).toEnds);
}

// Files of a session may be missing.
void TestStack::nothingShownHasNoPositions() {
  const auto loaded = stackOf();
  QCOMPARE(stackIn(workspaceOf(loaded), axialViewId, nullptr).place.count, 0);
  QVERIFY(withPlace(workspaceOf(loaded), axialViewId, nullptr, 3) == workspaceOf(loaded));
  loaded->series.files.clear();
  const Workspace frames = workspaceOf(loaded, ViewKind::frames);
  QCOMPARE(stackIn(frames, axialViewId, nullptr).place.count, 0);
  QVERIFY(withPlace(frames, axialViewId, nullptr, 3) == frames);
}

VOLUMEN_TEST(TestStack);
#include "tst_stack.moc"
