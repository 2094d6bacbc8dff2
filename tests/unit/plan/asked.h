#pragma once

#include <QMetaType>
#include <QString>
#include <QStringList>
#include <QTest>

#include "viewer/plan/plan.h"

namespace volumen::tests {

/// Returns facts of a volume of two blocks, air and bone, without any voxels.
inline VolumeFacts inventedFacts() {
  VolumeFacts f;
  f.geometry.size = {16, 8, 8};
  f.range = {-1000, 1000};
  f.p01 = -1000;
  f.p999 = 900;
  f.blockRanges = std::make_shared<const BlockRanges>(blockRangesOf(4, {2, 1, 1}, {-1000, 0}, {-900, 1000}));
  return f;
}

/// The input of a planner test, which a table row changes before it is planned.
struct Asked {
  Scene scene;
  VolumeFacts facts = inventedFacts();
  RenderOptions options;
};

using Change = void (*)(Asked&);

}  // namespace volumen::tests

Q_DECLARE_METATYPE(volumen::tests::Change)

namespace volumen::tests {

/// addRuleColumns adds the columns of such rows and addRule a row. `states` is as in doesNotState.
inline void addRuleColumns() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("effect");
  QTest::addColumn<QString>("states");
}
inline void addRuleRow(const char* name, const char* effect, const char* states, Change change) {
  QTest::newRow(name) << change << QString::fromLatin1(effect) << QString::fromLatin1(states);
}

/// Returns what is wrong with a plan's statement of an effect; empty if nothing is. `states` is "on" or
/// "off", then all figures of the reason in order ("16 bits", "1/255", "0.25 voxel"). Words follow that the
/// reason contains in that order or, after a "!", does not contain. The rest of the wording is free.
QString doesNotState(const Plan& plan, const QString& effect, const QString& states);

/// Applies the change of a row of "change", "effect" and "states" and compares the plan's statement.
void compareEffect();

}  // namespace volumen::tests
