// Guards the connectivity of clicked components: voxels that share a face, an edge or a corner, as chosen in
// the panel. The recorded steps state it.
#include <QComboBox>
#include <algorithm>

#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/segment_record.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// The first voxel is clicked. One of the others shares a face with it, one an edge, one only a corner. They
// do not touch each other, and the last touches none.
constexpr glm::ivec3 clickedVoxel(20), touchingVoxels[] = {{21, 20, 20}, {19, 21, 20}, {19, 19, 21}},
                                       voxelApart(25);
constexpr glm::dvec3 inClickedVoxel(0.5);

// Returns a volume in which they have 1000 and the rest 0.
LoadedSeriesPtr touchingInWays() {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->volume = volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
    const glm::ivec3 v(glm::round(pVoxel));
    const bool isOne = v == clickedVoxel || v == voxelApart || std::ranges::count(touchingVoxels, v) > 0;
    return isOne ? 1000.0 : 0.0;
  });
  series->firstScene.transferFunction.points = {{500, {1, 1, 1}, 0.0}, {500, {1, 1, 1}, 1.0}};
  return series;
}

// Returns the connectivity that the recipe states; the default if it states none.
std::string neighboursIn(const Recipe& recipe) {
  for (const Step& step : recipe.steps)
    if (const auto field = step.fields.find("neighbours"); field != step.fields.end())
      return std::get<std::string>(field->second);
  return "faces";
}

}  // namespace

class TestPartNeighbours : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theChoiceSaysWhatTouches_data();
  void theChoiceSaysWhatTouches();
};

void TestPartNeighbours::theChoiceSaysWhatTouches_data() {
  QTest::addColumn<QString>("word");
  QTest::addColumn<int>("keysDown");
  QTest::addColumn<int>("keys");
  int keysDown = 0;
  for (const char* word : {"faces", "edges", "corners"}) {
    for (const auto& [use, keys] :
         {std::pair("added", Qt::NoModifier), std::pair("kept", Qt::ControlModifier),
          std::pair("removed", Qt::AltModifier)})
      QTest::addRow("by %s, %s", word, use) << QString::fromLatin1(word) << keysDown << int(keys);
    ++keysDown;
  }
}

void TestPartNeighbours::theChoiceSaysWhatTouches() {
  QFETCH(QString, word);
  QFETCH(int, keysDown);
  QFETCH(int, keys);
  SegmentWindow w(touchingInWays());
  BitMask part(w.session().series()->volume->geometry());
  part.set(clickedVoxel);
  for (int n = 0; n <= keysDown; ++n) part.set(touchingVoxels[n]);
  BitMask all = part;
  for (const glm::ivec3 v : touchingVoxels) all.set(v);
  all.set(voxelApart);
  w.child<QDoubleSpinBox>("segmentLow")->setValue(500);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(1500);
  if (keys) QVERIFY(w.press("segment") && w.mask(1) == all);
  auto* choice = w.child<QComboBox>("segmentPartNeighbours");
  QCOMPARE(choice->currentText(), QStringLiteral("faces"));
  for (int n = 0; n < keysDown; ++n) QTest::keyClick(choice, Qt::Key_Down);
  QCOMPARE(choice->currentText(), word);
  w.child<QAction>("partTool")->trigger();
  const QPoint at = w.showPlace(inClickedVoxel);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QTest::mouseClick(w.view(), Qt::LeftButton, Qt::KeyboardModifiers(keys), at);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  const BitMask made = w.mask(1);
  QVERIFY(made == (keys == int(Qt::AltModifier) ? subtracted(all, part) : part));
  const RecordedRecipe recorded = recordedRecipe(*w.map(), "CT");
  QVERIFY(recorded.missing.empty());
  const auto again = readRecipe(recipeJson(recorded.recipe));
  QVERIFY(again);
  QCOMPARE(neighboursIn(*again), word.toStdString());
  const auto followed = follow(*again, *w.session().series()->volume);
  QVERIFY(followed && maskOf(followed->labels, 1) == made);
  w.undo();
  QVERIFY(w.isAs(before));
  QCOMPARE(choice->currentText(), word);
}

VOLUMEN_TEST(TestPartNeighbours);
#include "tst_part_neighbours.moc"
