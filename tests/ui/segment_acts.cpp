#include <QColorDialog>
#include <QLineEdit>
#include <QSlider>
#include <QToolButton>

#include "tests/ui/hand.h"
#include "tests/ui/segment_sequence.h"
#include "ui/controller/offered_steps.h"
#include "ui/workspace/camera_moves.h"

namespace volumen::tests {

namespace {

constexpr int mostSegments = 5;

}  // namespace

const std::vector<SegmentSequence::Act>& SegmentSequence::acts() {
  using S = SegmentSequence;
  static const std::vector<Act> all{{"look elsewhere", 4, &S::looksElsewhere},
                                    {"look from aside", 1, &S::looksFromAside},
                                    {"paint", 5, &S::paints},
                                    {"outline", 4, &S::outlines},
                                    {"smart brush", 3, &S::paintsSmartly},
                                    {"level trace", 3, &S::tracesLevel},
                                    {"connected part", 4, &S::takesPart},
                                    {"connected part in 3D", 3, &S::takesPartIn3d},
                                    {"lesion", 2, &S::finds},
                                    {"grow from seeds", 1, &S::grows},
                                    {"change", 6, &S::changes},
                                    {"range", 2, &S::makes},
                                    {"fill between slices", 1, &S::fillsBetween},
                                    {"cut segment", 3, &S::cuts},
                                    {"cut segment in 3D", 2, &S::cutsIn3d},
                                    {"volume in 3D", 2, &S::showsTissue},
                                    {"add or copy", 2, &S::addsOrCopies},
                                    {"remove", 2, &S::removes},
                                    {"choose", 5, &S::chooses},
                                    {"show or lock", 3, &S::ticks},
                                    {"colour", 1, &S::colours},
                                    {"opacity", 1, &S::fades},
                                    {"rename", 1, &S::renames},
                                    {"in 3D", 1, &S::showsIn3d},
                                    {"recipe", 1, &S::follows},
                                    {"undo", 2, &S::undoes},
                                    {"redo", 1, &S::redoes}};
  return all;
}

void SegmentSequence::looksElsewhere() {
  Crosshair crosshair = chance_.oneIn(2) ? throughMiddle() : obliquely();
  crosshair.at = 14.0 * chance_.vector();
  show(crosshair);
}

void SegmentSequence::looksFromAside() { take(chance_.oneIn(2) ? "viewLeft" : "viewRight"); }

void SegmentSequence::paints() {
  setBrush(chance_.oneIn(2), chance_.between(2, 12));
  take("paintTool");
  const ViewId id = anyView();
  stroke(anyWay(id, 1 + chance_.below(4)), id, ctrlOneIn(3));
}

void SegmentSequence::outlines() {
  take("outlineTool");
  const ViewId id = anyView();
  stroke(anyWay(id, 3 + chance_.below(4)), id, ctrlOneIn(3));
}

void SegmentSequence::paintsSmartly() {
  setBrush(chance_.oneIn(2), chance_.between(3, 9));
  take("smartBrushTool");
  const ViewId id = anyView();
  stroke(anyWay(id, 1 + chance_.below(3)), id, ctrlOneIn(4));
}

void SegmentSequence::tracesLevel() {
  take("levelTraceTool");
  const ViewId id = anyView();
  QTest::mouseClick(view(id), Qt::LeftButton, ctrlOneIn(3), anywhere(id));
}

void SegmentSequence::takesPart() {
  child<QDoubleSpinBox>("segmentLow")->setValue(chance_.below(900));
  child<QDoubleSpinBox>("segmentHigh")->setValue(1200);
  take("partTool");
  const ViewId id = anyView();
  QTest::mouseClick(view(id), Qt::LeftButton, anyKeys(), anywhere(id));
}

void SegmentSequence::takesPartIn3d() {
  child<QDoubleSpinBox>("segmentLow")->setValue(700);
  child<QDoubleSpinBox>("segmentHigh")->setValue(1200);
  take("partTool");
  VolumeView* scene = window.view();
  const glm::dvec3 p = chance_.oneIn(2) ? inSmallBall : glm::dvec3(-5) + 8.0 * chance_.vector();
  const glm::dvec2 at = seenAt(scene->camera(), {double(scene->width()), double(scene->height())}, p);
  QTest::mouseClick(scene, Qt::LeftButton, anyKeys(), {int(at.x), int(at.y)});
}

void SegmentSequence::finds() {
  if (count() >= mostSegments) return;
  take("lesionTool");
  const ViewId id = anyView();
  const QPoint at = pixelOf(chance_.oneIn(2) ? inSmallBall : 12.0 * chance_.vector(), id);
  drag(view(id), at, at + QPoint(20 + chance_.below(120), chance_.below(20)));
}

void SegmentSequence::grows() {
  click("segmentGrowing");
  pressButton("segmentGrow");
}

void SegmentSequence::changes() {
  const auto all = offeredSteps();
  const std::string name = all[std::size_t(chance_.below(int(all.size())))].name;
  if (name == "split" && count() >= mostSegments) return;
  (void)step(name);
}

void SegmentSequence::makes() {
  const double low = chance_.below(1000), high = chance_.below(1200);
  (void)make(low, high, count() < mostSegments ? "segment" : "segmentReplace");
}

void SegmentSequence::fillsBetween() {
  click("segmentPaint");
  pressButton("segmentFillBetween");
}

void SegmentSequence::cuts() {
  child<QDoubleSpinBox>("cutMm")->setValue(chance_.oneIn(2) ? 0 : chance_.between(0.5, 8));
  take("segmentScissorsTool");
  const ViewId id = anyView();
  stroke(anyWay(id, 3 + chance_.below(4)), id, ctrlOneIn(3));
}

// Cuts around one of the balls.
void SegmentSequence::cutsIn3d() {
  take("segmentScissorsTool");
  VolumeView* scene = window.view();
  const glm::dvec3 p = chance_.oneIn(2) ? inSmallBall : glm::dvec3(-5) + 4.0 * chance_.vector();
  const glm::dvec2 at = seenAt(scene->camera(), {double(scene->width()), double(scene->height())}, p);
  const QPoint middle{int(at.x), int(at.y)};
  const int far = 20 + chance_.below(60);
  const Qt::KeyboardModifiers keys = ctrlOneIn(3);
  QTest::mousePress(scene, Qt::LeftButton, keys, middle + QPoint(-far, -far));
  for (const QPoint by : {QPoint(far, -far), QPoint(far, far), QPoint(-far, far)})
    QTest::mouseEvent(QTest::MouseMove, scene, Qt::LeftButton, keys, middle + by);
  QTest::mouseRelease(scene, Qt::LeftButton, keys, middle + QPoint(-far, far));
}

void SegmentSequence::showsTissue() {
  constexpr Qt::Key keys[] = {Qt::Key_Home, Qt::Key_Down, Qt::Key_End};
  auto* where = child<QComboBox>("segmentTissue");
  if (where->isEnabled()) QTest::keyClick(where, keys[chance_.below(3)]);
}

void SegmentSequence::addsOrCopies() {
  const bool copies = chance_.oneIn(2) && rows() < 2 * mostSegments;
  if (copies || count() < mostSegments) pressButton(copies ? "segmentDuplicate" : "segmentAdd");
}

void SegmentSequence::removes() {
  if (rows() > 2) pressButton("segmentRemove");
}

void SegmentSequence::chooses() {
  if (rows() == 0) return;
  const int row = chance_.below(rows());
  list()->scrollToItem(list()->topLevelItem(row));
  (void)choose(row);
}

// Toggles the current segment only, because a click on another row would select that row first. Hidden or
// locked segments are more likely to be toggled.
void SegmentSequence::ticks() {
  if (count() == 0) return;
  const int column = chance_.below(2);
  const bool isOff = column == 0 ? !current().visible : current().locked;
  if (!isOff && !chance_.oneIn(3)) return;
  const int row = list()->indexOfTopLevelItem(list()->currentItem());
  list()->scrollToItem(list()->currentItem());
  tick(row, column);
}

void SegmentSequence::colours() {
  if (count() == 0) return;
  click("segmentColour");
  auto* dialog = child<QColorDialog>("colourDialog");
  if (!dialog) return;
  for (int n = 0; n < 2; ++n)
    dialog->setCurrentColor(QColor(chance_.below(256), chance_.below(256), chance_.below(256)));
  dialog->accept();
  QTest::qWait(1);  // lets it be deleted
}

void SegmentSequence::fades() {
  auto* slider = child<QSlider>("segmentFill");
  slider->setFocus();
  constexpr Qt::Key keys[] = {Qt::Key_Home, Qt::Key_End, Qt::Key_PageDown, Qt::Key_Left};
  QTest::keyClick(slider, keys[chance_.below(4)]);
  session().endGesture();
}

void SegmentSequence::renames() {
  const int before = steps();
  list()->setFocus();
  QTest::keyClick(list(), Qt::Key_F2);
  auto* field = list()->findChild<QLineEdit*>();
  if (!field) return;
  field->setText(QStringLiteral("Segment %1").arg(chance_.below(1000)));
  QTest::keyClick(field, Qt::Key_Return);
  (void)QTest::qWaitFor([&] { return steps() != before; }, 200);
}

void SegmentSequence::showsIn3d() { click("segmentsIn3d"); }

void SegmentSequence::follows() {
  if (count() < mostSegments)
    Hand(window).menuOf(child<QToolButton>("segmentRecipes"), chance_.oneIn(2) ? "recipeBone" : "recipeBody");
}

void SegmentSequence::undoes() {
  if (steps() > first_) undo();
}

void SegmentSequence::redoes() { redo(); }

}  // namespace volumen::tests
