#include "ui/workspace/window_keys.h"

#include <algorithm>

namespace volumen {

namespace {

constexpr int lastDigit = 9;

int digitOrNone(int n) { return n <= lastDigit ? n : -1; }

}  // namespace

QString WindowKey::text() const {
  if (alone >= 0) return QString::number(alone);
  return withCtrl >= 0 ? QStringLiteral("Ctrl+%1").arg(withCtrl) : QString();
}

std::vector<WindowKey> windowKeys(const WindowCounts& counts) {
  std::vector<WindowKey> keys{{0, -1}};
  const bool areOthers = counts.ofProgram + counts.own > 0;
  for (int n = 1; n <= counts.ofFile; ++n) keys.push_back({areOthers ? -1 : digitOrNone(n), digitOrNone(n)});
  const int fixed = counts.own > 0 ? std::min(counts.ofProgram, lastDigit - 1) : counts.ofProgram;
  for (int n = 1; n <= counts.ofProgram; ++n) keys.push_back({n <= fixed ? digitOrNone(n) : -1, -1});
  for (int n = 1; n <= counts.own; ++n) keys.push_back({digitOrNone(fixed + n), -1});
  return keys;
}

}  // namespace volumen
