#pragma once

#include <QString>
#include <QStringList>
#include <cstdint>

namespace volumen::tests {

/// Does `length` random acts in a sequence of this seed and checks each. Then checks the sequence undone and
/// redone and, if it has wrongInSession(), in its session. Returns what is wrong and after which acts; empty
/// if nothing is. A sequence that isUndecided() ends there.
template <class Sequence>
QString wrongInSequence(int seed, int length) {
  Sequence sequence{std::uint64_t(seed)};
  QStringList done;
  const auto failure = [&](const QString& why) {
    return QStringLiteral("seed %1: %2\nafter %3").arg(seed).arg(why, done.join(QStringLiteral("\n      ")));
  };
  const auto isUndecided = [&] {
    if constexpr (requires { sequence.isUndecided(); })
      return sequence.isUndecided();
    else
      return false;
  };
  if (const QString why = sequence.wrong(); !why.isEmpty()) return failure(why);
  while (done.size() < length && !isUndecided()) {
    const QString what = sequence.act();
    if (what.isEmpty()) continue;
    done << what;
    if (isUndecided()) break;
    if (const QString why = sequence.wrong(); !why.isEmpty()) return failure(why);
  }
  if (isUndecided()) return {};
  if (const QString why = sequence.wrongUndone(); !why.isEmpty())
    return failure(QStringLiteral("undone and done again: ") + why);
  if constexpr (requires { sequence.wrongInSession(); })
    if (const QString why = sequence.wrongInSession(); !why.isEmpty())
      return failure(QStringLiteral("in its session: ") + why);
  return {};
}

}  // namespace volumen::tests
