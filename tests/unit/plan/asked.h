#pragma once

#include <QMetaType>
#include <QString>
#include <QStringList>
#include <QTest>

#include "viewer/plan/plan.h"

namespace volumen::tests {

/// A volume of two blocks, air and bone, that needs no voxels.
inline VolumeFacts inventedFacts() {
  VolumeFacts f;
  f.geometry.size = {16, 8, 8};
  f.range = {-1000, 1000};
  f.p01 = -1000;
  f.p999 = 900;
  f.blockRanges = std::make_shared<const BlockRanges>(blockRangesOf(4, {2, 1, 1}, {-1000, 0}, {-900, 1000}));
  return f;
}

/// What a row of a table changes before it is planned.
struct Asked {
  Scene scene;
  VolumeFacts facts = inventedFacts();
  RenderOptions options;
};

using Change = void (*)(Asked&);

}  // namespace volumen::tests

Q_DECLARE_METATYPE(volumen::tests::Change)

namespace volumen::tests {

/// The columns of such rows, and one of them. `states`: as in doesNotState.
inline void addRuleColumns() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("effect");
  QTest::addColumn<QString>("states");
}
inline void addRuleRow(const char* name, const char* effect, const char* states, Change change) {
  QTest::newRow(name) << change << QString::fromLatin1(effect) << QString::fromLatin1(states);
}

/// What is wrong with what a plan says of an effect; empty where nothing is. `states` is "on" or "off", then
/// all figures of the reason in their order ("16 bits", "1/255", "0.25 voxel"), then words that it holds in
/// that order, or, behind a "!", does not hold. How it is worded else is free.
QString doesNotState(const Plan& plan, const QString& effect, const QString& states);

/// A row of "change", "effect" and "states": what the plan says once the change is made.
void compareEffect();

}  // namespace volumen::tests
