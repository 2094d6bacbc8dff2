// Guards the recipe steps at their limits: volumes of one voxel, one row or one slice, of NaN, of one value
// and of padding alone. Segments are empty or full. After a cancel at any moment the segments are unchanged.
#include <tbb/global_control.h>

#include <QElapsedTimer>
#include <chrono>
#include <limits>
#include <optional>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/later_cancel.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/recipe/recipe.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Size and contents of a volume.
struct LimitVolume {
  glm::ivec3 size{1};
  float (*value)(Chance& chance) = nullptr;
  bool isPadding = false, isCalibrated = true;
};

}  // namespace

Q_DECLARE_METATYPE(LimitVolume)

class TestStepLimits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyStepOfAVolume_data();
  void everyStepOfAVolume();
  void cancelledAtAnyMoment_data();
  void cancelledAtAnyMoment();
};

namespace {

float noise(Chance& chance) { return float(chance.below(2000) - 1000); }

VolumePtr limitVolume(const LimitVolume& kind, Chance& chance) {
  VolumeParts parts;
  parts.geometry.size = kind.size;
  parts.geometry.patientFromVoxelStep = grids[chance.below(int(std::size(grids)))].patientFromVoxelStep;
  parts.geometry.origin = 20.0 * chance.vector();
  parts.geometry.calibrated = kind.isCalibrated;
  std::vector<float> values(std::size_t(parts.geometry.voxelCount()));
  for (float& value : values) value = kind.value(chance);
  parts.values = std::move(values);
  if (kind.isPadding) parts.attributes.padding = ValueRange{-1e6, 1e6};
  parts.attributes.modality = "CT";
  return volumeFrom(std::move(parts));
}

// Returns positions inside the volume, beside it, and farther away than voxel indices can count.
std::vector<glm::dvec3> anyPlaces(const VoxelGeometry& grid, Chance& chance) {
  std::vector<glm::dvec3> places(std::size_t(2 + chance.below(4)));
  for (glm::dvec3& p : places)
    p = chance.oneIn(8) ? 1e12 * chance.vector()
                        : grid.patientFromVoxel((1.4 * chance.colour() - 0.2) * glm::dvec3(grid.size));
  return places;
}

// Returns a step of a kind on the segments "A" and "B" with random fields.
Step anyStepOf(const StepKind& kind, const VoxelGeometry& grid, Chance& chance) {
  constexpr double farthest = 12;  // mm; larger distances reach all of a small volume
  Step step{kind.name, "A"};
  for (const StepField& field : kind.fields) {
    if (field.need == StepField::Need::no && chance.oneIn(2)) continue;
    StepValue& value = step.fields[field.name];
    const bool isWord = !field.words.empty();
    if (std::holds_alternative<bool>(field.byDefault))
      value = chance.oneIn(2);
    else if (std::holds_alternative<double>(field.byDefault))
      value = chance.between(std::max(field.allowed.low, -1000.0), std::min(field.allowed.high, farthest));
    else if (std::holds_alternative<std::string>(field.byDefault))
      value = std::string(isWord ? field.words[std::size_t(chance.below(int(field.words.size())))] : "B");
    else if (std::holds_alternative<std::vector<std::string>>(field.byDefault))
      value = std::vector<std::string>{"B"};
    else
      value = anyPlaces(grid, chance);
  }
  if (step.kind == "scissors") {
    std::vector<glm::dvec3>& sight = std::get<std::vector<glm::dvec3>>(step.fields.at("sight"));
    sight.resize(2, glm::dvec3(7, 11, 13));
  }
  return step;
}

BitMask limitMask(const VoxelGeometry& grid, Chance& chance) {
  BitMask mask(grid);
  const int kind = chance.below(4);
  if (kind == 0) return mask;
  if (kind == 1) return inverted(mask);
  const std::vector<glm::ivec3> voxels = voxelsOf(grid);
  const int count = kind == 2 ? 1 : 1 + int(voxels.size()) / 2;
  for (int n = 0; n < count; ++n) mask.set(voxels[std::size_t(chance.below(int(voxels.size())))]);
  return mask;
}

bool areOfTheGrid(const NamedMasks& masks, const VoxelGeometry& grid) {
  const BitMask all = inverted(BitMask(grid));
  return std::ranges::all_of(masks, [&](const auto& named) {
    return named.second.geometry() == grid && subtracted(named.second, all).empty();
  });
}

// Returns what is wrong with a step's refusal; empty if nothing is.
QString wrongRefusal(const Step& step, const Status& status) {
  const QString said = QString::fromStdString(status.message());
  const bool isGood = said.startsWith(QString::fromStdString(step.kind) + QStringLiteral(": ")) &&
                      said.endsWith(QLatin1Char('.')) && !said.contains(QLatin1Char('\n'));
  return isGood ? QString() : said;
}

// Returns what is wrong with the result of a step on these segments; empty if nothing is.
QString wrongStep(const StepKind& kind, const Step& step, const Volume& volume, const NamedMasks& before) {
  NamedMasks made = before, again = before;
  const Status done = runStep(step, volume, made);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Status doneAgain = runStep(step, volume, again);
  if (done.ok() != doneAgain.ok() || made != again) return QStringLiteral("others by one thread");
  if (!done) return made == before ? wrongRefusal(step, done) : QStringLiteral("refused, but changed");
  if (!areOfTheGrid(made, volume.geometry())) return QStringLiteral("voxels beyond the grid");
  if (kind.use == StepKind::Use::narrows && !subtracted(made.at("A"), before.at("A")).empty())
    return QStringLiteral("not made smaller");
  if (leavesEmpty(step) && before.at("A").empty() && !made.at("A").empty())
    return QStringLiteral("made of nothing");
  return {};
}

}  // namespace

void TestStepLimits::everyStepOfAVolume_data() {
  QTest::addColumn<LimitVolume>("kind");
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto some = [](Chance& chance) { return chance.oneIn(3) ? nan : noise(chance); };
  QTest::newRow("one voxel") << LimitVolume{{1, 1, 1}, noise};
  QTest::newRow("a row") << LimitVolume{{70, 1, 1}, noise};
  QTest::newRow("a column") << LimitVolume{{1, 1, 40}, noise};
  QTest::newRow("a slice") << LimitVolume{{65, 9, 1}, noise};
  QTest::newRow("a slice across i") << LimitVolume{{1, 12, 11}, noise};
  QTest::newRow("a few voxels") << LimitVolume{{7, 6, 5}, noise};
  QTest::newRow("NaN alone") << LimitVolume{{9, 4, 3}, [](Chance&) { return nan; }};
  QTest::newRow("NaN among values") << LimitVolume{{9, 4, 3}, some};
  QTest::newRow("one value") << LimitVolume{{9, 4, 3}, [](Chance&) { return 7.0f; }};
  QTest::newRow("the largest numbers") << LimitVolume{
      {9, 4, 3}, [](Chance& chance) {
        return chance.oneIn(2) ? std::numeric_limits<float>::max() : std::numeric_limits<float>::lowest();
      }};
  QTest::newRow("padding alone") << LimitVolume{{9, 4, 3}, noise, true};
  QTest::newRow("not calibrated") << LimitVolume{{9, 4, 3}, noise, false, false};
}

void TestStepLimits::everyStepOfAVolume() {
  QFETCH(LimitVolume, kind);
  const Seeds seeds = seedsOf(20, 500);
  int done = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VolumePtr volume = limitVolume(kind, chance);
    const NamedMasks before{{"A", limitMask(volume->geometry(), chance)},
                            {"B", limitMask(volume->geometry(), chance)}};
    for (const StepKind& each : stepKinds()) {
      const Step step = anyStepOf(each, volume->geometry(), chance);
      const QString wrong = wrongStep(each, step, *volume, before);
      QVERIFY2(wrong.isEmpty(),
               qPrintable(QStringLiteral("seed %1, %2: %3").arg(seed).arg(QLatin1String(each.name), wrong)));
      NamedMasks made = before;
      done += runStep(step, *volume, made).ok();
    }
  }
  QVERIFY2(done > 10 * seeds.count, "most steps can be done");
}

void TestStepLimits::cancelledAtAnyMoment_data() {
  QTest::addColumn<QString>("name");
  for (const StepKind& kind : stepKinds()) QTest::newRow(kind.name) << QString::fromLatin1(kind.name);
}

// A cancelled step is done completely or not at all.
void TestStepLimits::cancelledAtAnyMoment() {
  QFETCH(QString, name);
  const StepKind& kind = *stepKind(name.toStdString());
  const Seeds seeds = seedsOf(3, 40);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VolumePtr volume = limitVolume({{90, 60, 40}, noise}, chance);
    const NamedMasks before{{"A", limitMask(volume->geometry(), chance)},
                            {"B", limitMask(volume->geometry(), chance)}};
    const Step step = anyStepOf(kind, volume->geometry(), chance);
    NamedMasks whole = before;
    QElapsedTimer timer;
    timer.start();
    const Status done = runStep(step, *volume, whole);
    const std::chrono::nanoseconds took(timer.nsecsElapsed());
    for (int n = 0; n < 4; ++n) {
      NamedMasks masks = before;
      const CancelToken cancel;
      const LaterCancel later(cancel, std::chrono::nanoseconds(std::int64_t(chance.share() * took.count())));
      const Status status = runStep(step, *volume, masks, cancel);
      const bool isCancelled = !status && status.message() == "Cancelled.";
      QVERIFY2(isCancelled || status.ok() == done.ok(), qPrintable(QString::number(seed)));
      QVERIFY2(masks == (isCancelled ? before : whole), qPrintable(QString::number(seed)));
    }
  }
}

VOLUMEN_TEST(TestStepLimits);
#include "tst_step_limits.moc"
