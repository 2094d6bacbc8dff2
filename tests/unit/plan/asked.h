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

/// The line of --explain that tells of the effect, or the sentence of a refusal.
inline QString lineOf(const Asked& asked, const QString& effect) {
  const auto plan = makePlan(asked.scene, asked.facts, asked.options);
  if (!plan) return QString::fromStdString("refused: " + plan.message());
  for (const QString& line : QString::fromStdString(explain(*plan)).split(QLatin1Char('\n')))
    if (line.mid(5).startsWith(effect + QLatin1Char(':'))) return line;
  return {};
}

}  // namespace volumen::tests

Q_DECLARE_METATYPE(volumen::tests::Change)

namespace volumen::tests {

/// The columns of such rows, and one of them.
inline void addRuleColumns() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QString>("effect");
  QTest::addColumn<QString>("expected");
}
inline void addRuleRow(const char* name, const char* effect, const char* expected, Change change) {
  QTest::newRow(name) << change << QString::fromLatin1(effect) << QString::fromLatin1(expected);
}

/// A row of "change", "effect" and "expected": the effect's line once the change is made.
inline void compareLine() {
  QFETCH(Change, change);
  QFETCH(QString, effect);
  QFETCH(QString, expected);
  Asked asked;
  change(asked);
  QCOMPARE(lineOf(asked, effect), expected);
}

}  // namespace volumen::tests
