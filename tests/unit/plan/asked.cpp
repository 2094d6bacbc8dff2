#include "tests/unit/plan/asked.h"

#include <QRegularExpression>
#include <algorithm>

#include "viewer/plan/rule_lines.h"

namespace volumen::tests {
namespace {

// Matches a number or fraction with its unit.
const QRegularExpression figure(QStringLiteral("\\d+(\\.\\d+)?(/\\d+)?( (%|dB|voxels?|bits)(?![a-z]))?"));

QStringList figuresIn(const QString& text) {
  QStringList figures;
  for (auto found = figure.globalMatch(text); found.hasNext();) figures << found.next().captured();
  return figures;
}

// Returns whether the text holds the words in that order, and nowhere those after a "!".
bool holdsWords(const QString& text, const QStringList& words) {
  qsizetype from = 0;
  for (const QString& word : words) {
    const bool unwanted = word.startsWith(QLatin1Char('!'));
    const QRegularExpression whole(QStringLiteral("\\b%1\\b").arg(word.mid(unwanted ? 1 : 0)));
    const QRegularExpressionMatch found = whole.match(text, unwanted ? 0 : from);
    if (found.hasMatch() == unwanted) return false;
    if (!unwanted) from = found.capturedEnd();
  }
  return true;
}

// Returns whether the plan does what the effect says. Handles effects that a single field of the plan
// decides.
bool isDone(const Plan& plan, const Effect& e) {
  const std::pair<const char*, bool> done[] = {{"lighting", plan.lit},
                                               {"specular", plan.specular},
                                               {"light colour", plan.colouredLight},
                                               {"gradient opacity", plan.gradientOpacity},
                                               {"gradients", plan.gradients},
                                               {"clip", plan.clip},
                                               {"segments", plan.segments},
                                               {"empty blocks", plan.skipBlocks},
                                               {"empty cells", plan.skipCells},
                                               {"early ray termination", plan.stopTransmittance > 0},
                                               {"faint samples", plan.options.opacityThreshold.has_value()},
                                               {"curve table", plan.options.curveTable.has_value()}};
  const auto* found =
      std::find_if(std::begin(done), std::end(done), [&](const auto& d) { return e.name == d.first; });
  return found == std::end(done) || found->second == e.on;
}

// Returns the figure with unit that the plan uses for an effect; empty if it has none.
QString figureOf(const Plan& plan, const std::string& effect) {
  if (effect == "precision") return QString::number(plan.bits) + QStringLiteral(" bits");
  if (effect != "integration") return {};
  if (!plan.cellByCell) return QString::fromStdString(inVoxels(plan.stepVoxels));
  return plan.scene.mode != Mode::composite
             ? QString()
             : QString::fromStdString(inDigits(255 * plan.errorBudget, 3)) + QStringLiteral("/255");
}

}  // namespace

QString doesNotState(const Plan& plan, const QString& effect, const QString& states) {
  const auto line = std::find_if(plan.effects.begin(), plan.effects.end(),
                                 [&](const Effect& e) { return e.name == effect.toStdString(); });
  if (line == plan.effects.end()) return QStringLiteral("the plan has no line of ") + effect;
  const QString state = line->on ? QStringLiteral("on") : QStringLiteral("off"),
                reason = QString::fromStdString(line->reason), said = state + QStringLiteral(": ") + reason;
  QString words = states;
  words.remove(figure);
  QStringList wanted = words.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  if (wanted.takeFirst() != state) return said + QStringLiteral(": on or off is wrong");
  if (figuresIn(reason) != figuresIn(states))
    return said + QStringLiteral(": figures expected: ") + figuresIn(states).join(QStringLiteral(", "));
  if (!holdsWords(reason, wanted))
    return said + QStringLiteral(": words expected: ") + wanted.join(QLatin1Char(' '));
  if (!isDone(plan, *line)) return said + QStringLiteral(": the plan does otherwise");
  const QString drawnBy = figureOf(plan, line->name);
  if (!drawnBy.isEmpty() && figuresIn(reason).value(0) != drawnBy)
    return said + QStringLiteral(": the plan draws by ") + drawnBy;
  return {};
}

void compareEffect() {
  QFETCH(Change, change);
  QFETCH(QString, effect);
  QFETCH(QString, states);
  Asked asked;
  change(asked);
  const auto plan = makePlan(asked.scene, asked.facts, asked.options);
  QVERIFY2(plan.ok(), plan.ok() ? "" : plan.message().c_str());
  const QString wrong = doesNotState(*plan, effect, states);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

}  // namespace volumen::tests
