#pragma once

#include <QAbstractButton>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QTreeWidget>

#include "results/segments/segments.h"
#include "tests/ui/hollow_balls.h"
#include "tests/ui/measure_window.h"

namespace volumen::tests {

/// A window that shows hollowBalls() in planes, with the Segments panel in front.
struct SegmentWindow : MeasureWindow {
  explicit SegmentWindow(const LoadedSeriesPtr& series = hollowBalls()) : MeasureWindow(series) {
    window.resize(1440, 900);
    child<QDockWidget>("segmentDock")->raise();
    QCoreApplication::processEvents();
  }
  /// Opens files in their hanging.
  explicit SegmentWindow(const QStringList& paths) : MeasureWindow(paths) {}

  const DrawnScenes& scenes() { return window.document().drawn; }
  const Workspace& workspace() { return session().workspace(); }
  SeriesKey series() { return keyOf(session().series()->series); }
  /// Returns null if there are no segments.
  const SegmentMap* map() { return segmentMapOf(workspace(), series()); }
  std::size_t count() { return map() ? map()->segments.size() : 0; }
  const Segment& segment(std::size_t n) { return map()->segments[n]; }
  const Segment& current() { return *currentSegment(*map()); }
  BitMask mask(int number) { return maskOf(*map()->labels, std::uint8_t(number)); }
  std::int64_t voxels(int number) { return mask(number).count(); }
  int steps() { return session().undoStack().index(); }
  /// Compares with a workspace except for the view in focus, which a press chooses without an undo step.
  bool isAs(const Workspace& before) { return withFocusOf(workspace(), before) == before; }
  QTreeWidget* list() { return child<QTreeWidget>("segmentList"); }
  QAbstractButton* button(const char* name) { return child<QAbstractButton>(name); }
  /// Returns true once no job changes or measures anything.
  bool idle() {
    return QTest::qWaitFor([this] { return window.jobs().rows().empty(); }, longest);
  }
  void click(const char* name) { QTest::mouseClick(button(name), Qt::LeftButton); }
  bool press(const char* name) {
    click(name);
    return idle();
  }
  /// Chooses a kind of recipe step in the list of the page Change.
  void chooseStep(const std::string& kind) {
    click("segmentChange");
    auto* kinds = child<QComboBox>("segmentStepKind");
    kinds->setCurrentIndex(kinds->findData(QString::fromStdString(kind)));
  }
  void setField(const char* name, double value) {
    child<QDoubleSpinBox>((std::string("stepField-") + name).c_str())->setValue(value);
  }
  /// Applies a recipe step with the present values of its fields.
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
  /// Makes segment 1 (the hollow ball and the small ball) and segment 2 (the core), and selects the first.
  bool makeBoth() { return make(800, 1200) && make(400, 600) && choose(0); }
  /// Clicks on the name of a row.
  bool choose(int row) {
    const QRect place = list()->visualItemRect(list()->topLevelItem(row));
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, {}, {60, place.center().y()});
    return idle();
  }
  /// Scrolls a view's plane to a position and returns its pixel.
  QPoint showPlace(glm::dvec3 p, ViewId id = axialViewId) {
    session().change(QStringLiteral("test"), [&](Workspace& after) {
      after.crosshairs.editOrAdd(frameOfReference(*after.series.at(series()).series)).at = p;
    });
    session().endGesture();
    const glm::dvec2 pixel = view(id)->plane()->pixelFromPatient(p);
    return {int(pixel.x), int(pixel.y)};
  }
  /// Turns the planes about the crosshair so that none is parallel to the patient's axes.
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
  /// Counts the tinted pixels of the axial slice.
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
  /// Clicks a check box of a row: column 0 is shown, 1 is locked.
  void tick(int row, int column) {
    const QModelIndex index = list()->model()->index(row, column);
    const QRect place = list()->visualRect(index);
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, {}, {place.left() + 10, place.center().y()});
  }
};

}  // namespace volumen::tests
