#pragma once

#include <QAbstractButton>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QTreeWidget>

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/segments.h"

namespace volumen::tests {

/// 40 x 40 x 40 voxels of 1 mm about the origin: a hollow ball of 1000 about -5 (radius 6 to 10), in it a
/// core of 500 (radius 4), and apart from it a small ball of 1000 about 12 (radius 3); else 0.
inline LoadedSeriesPtr hollowBalls() {
  auto series = std::make_shared<LoadedSeries>(
      *seriesOf(volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
        const glm::dvec3 p = pVoxel - 19.5;
        const double inBall = glm::length(p + 5.0), inSmall = glm::length(p - 12.0);
        if (inBall < 4) return 500.0;
        return (inBall > 6 && inBall < 10) || inSmall < 3 ? 1000.0 : 0.0;
      })));
  series->series.acquired = series->volume->geometry();
  series->firstScene.transferFunction.points = {{400, {1, 1, 1}, 0.0}, {400, {1, 1, 1}, 1.0}};
  return series;
}

/// The voxels of the grid of hollowBalls() whose centre is at a place for which `isIn`.
template <class IsIn>
std::int64_t voxelsWhere(const IsIn& isIn) {
  std::int64_t count = 0;
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) count += isIn(glm::dvec3(i, j, k) - 19.5) ? 1 : 0;
  return count;
}
inline bool isShell(glm::dvec3 p) { return glm::length(p + 5.0) > 6 && glm::length(p + 5.0) < 10; }
inline bool isCore(glm::dvec3 p) { return glm::length(p + 5.0) < 4; }
inline bool isSmall(glm::dvec3 p) { return glm::length(p - 12.0) < 3; }

/// A window with that, in planes, and the panel of segments in front.
struct SegmentWindow : MeasureWindow {
  explicit SegmentWindow(const LoadedSeriesPtr& series = hollowBalls()) : MeasureWindow(series) {
    window.resize(1440, 900);
    child<QDockWidget>("segmentDock")->raise();
    QCoreApplication::processEvents();
  }
  /// With what is opened, as it hangs.
  explicit SegmentWindow(const QStringList& paths) : MeasureWindow(paths) {}

  const Workspace& workspace() { return session().workspace(); }
  SeriesKey series() { return keyOf(session().series()->series); }
  /// Null: there are no segments.
  const SegmentMap* map() { return segmentMapOf(workspace(), series()); }
  std::size_t count() { return map() ? map()->segments.size() : 0; }
  const Segment& segment(std::size_t n) { return map()->segments[n]; }
  const Segment& current() { return *currentSegment(*map()); }
  BitMask mask(int number) { return maskOf(*map()->labels, std::uint8_t(number)); }
  std::int64_t voxels(int number) { return mask(number).count(); }
  int steps() { return session().undoStack().index(); }
  /// But for the view in focus, which a press of the mouse chooses without a step.
  bool isAs(const Workspace& before) { return withFocusOf(workspace(), before) == before; }
  QTreeWidget* list() { return child<QTreeWidget>("segmentList"); }
  QAbstractButton* button(const char* name) { return child<QAbstractButton>(name); }
  /// True once nothing is being changed or measured.
  bool idle() {
    return QTest::qWaitFor([this] { return window.jobs().rows().empty(); }, longest);
  }
  void click(const char* name) { QTest::mouseClick(button(name), Qt::LeftButton); }
  bool press(const char* name) {
    click(name);
    return idle();
  }
  /// A kind of step in the list of the page Change; a number of it.
  void chooseStep(const std::string& kind) {
    click("segmentChange");
    auto* kinds = child<QComboBox>("segmentStepKind");
    kinds->setCurrentIndex(kinds->findData(QString::fromStdString(kind)));
  }
  void setField(const char* name, double value) {
    child<QDoubleSpinBox>((std::string("stepField-") + name).c_str())->setValue(value);
  }
  /// Done with the fields as they are.
  bool step(const std::string& kind) {
    chooseStep(kind);
    return press("segmentApply");
  }
  bool make(double low, double high, const char* with = "segment") {
    click("segmentFromCurve");
    child<QDoubleSpinBox>("segmentLow")->setValue(low);
    child<QDoubleSpinBox>("segmentHigh")->setValue(high);
    return press(with);
  }
  /// 1: the hollow ball and the small one, 2: the core; the first is current.
  bool makeBoth() { return make(800, 1200) && make(400, 600) && choose(0); }
  /// A click on the name of a row.
  bool choose(int row) {
    const QRect place = list()->visualItemRect(list()->topLevelItem(row));
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, {}, {60, place.center().y()});
    return idle();
  }
  /// Shows the slice of a view's plane at a place, and its pixel.
  QPoint showPlace(glm::dvec3 p, ViewId id = axialViewId) {
    session().change(QStringLiteral("test"), [&](Workspace& after) {
      after.crosshairs.editOrAdd(frameOfReference(*after.series.at(series()).series)).at = p;
    });
    session().endGesture();
    const glm::dvec2 pixel = view(id)->plane()->pixelFromPatient(p);
    return {int(pixel.x), int(pixel.y)};
  }
  /// Turns the planes about the crosshair, so that none is one of the patient's.
  void turnPlanes() {
    const glm::dvec3 a = glm::normalize(glm::dvec3(2, 1, 0.5)),
                     b = glm::normalize(glm::cross({-0.3, 0.2, 1}, a)), c = glm::cross(a, b);
    session().change(QStringLiteral("turned"), [&](Workspace& after) {
      Crosshair& cross = after.crosshairs.editOrAdd(frameOfReference(*after.series.at(series()).series));
      cross.axial = {a, b}, cross.coronal = {a, -c}, cross.sagittal = {b, -c};
      cross.byHand = true;
    });
    session().endGesture();
  }
  /// Pixels of the axial slice that are tinted.
  int coloured() {
    const QImage picture = view()->picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const QRgb c = picture.pixel(x, y);
        count += qRed(c) != qGreen(c) || qGreen(c) != qBlue(c);
      }
    return count;
  }
  /// A click on the check box of a row: 0: shown, 1: locked.
  void tick(int row, int column) {
    const QModelIndex index = list()->model()->index(row, column);
    const QRect place = list()->visualRect(index);
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, {}, {place.left() + 10, place.center().y()});
  }
};

/// In the hollow ball, in the small one.
inline constexpr glm::dvec3 inShell(-5 + 8, -5, -5), inSmallBall(12);

}  // namespace volumen::tests
