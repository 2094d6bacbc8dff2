#include "ui/workspace/preferences.h"

#include <QSettings>
#include <QStringList>
#include <algorithm>
#include <cmath>

namespace volumen {

namespace {

constexpr PetUnit petUnits[] = {PetUnit::suvBodyWeight, PetUnit::suvLeanBodyMass, PetUnit::suvBodySurface,
                                PetUnit::file};

// Visits all preferences: one list serves reading and writing.
template <class Visit>
void visit(Preferences& p, const Visit& each) {
  each("theme", p.theme);
  each("textPercent", p.textPercent);
  each("mousePreset", p.mousePreset);
  each("mouseBindings", p.mouseBindings);
  each("zoomDragInverted", p.zoomDragInverted);
  each("wheelInverted", p.wheelInverted);
  each("curveDragInverted", p.curveDragInverted);
  each("logarithmicOpacity", p.logarithmicOpacity);
  each("crosshairLines", p.crosshairLines);
  each("referenceLines", p.referenceLines);
  each("referenceEnds", p.referenceEnds);
  each("hideNames", p.hideNames);
  each("exportsWithoutIdentity", p.exportsWithoutIdentity);
  each("receives", p.receives);
  each("tableIn3d", p.tableIn3d);
  each("petUnit", p.petUnit);
  each("memoryPercent", p.memoryPercent);
  each("brushBall", p.brush.ball);
  each("brushMm", p.brush.diameterMm);
  each("windows", p.windows);
}

QVariant toVariant(bool value) { return value; }
QVariant toVariant(int value) { return value; }
QVariant toVariant(double value) { return value; }
QVariant toVariant(Theme theme) {
  return theme == Theme::light ? QStringLiteral("light") : QStringLiteral("dark");
}
QVariant toVariant(const std::string& word) { return QString::fromStdString(word); }
// Writes one line for each binding: "flat.right=pan".
QVariant toVariant(const std::map<std::string, std::string>& bindings) {
  QStringList lines;
  for (const auto& [slot, action] : bindings) lines << QString::fromStdString(slot + '=' + action);
  return lines;
}
QVariant toVariant(PetUnit unit) { return QLatin1String(petUnitName(unit)); }
QVariant toVariant(const OwnWindows& windows) { return ownWindowsText(windows); }

void fromVariant(const QVariant& kept, bool& value) { value = kept.toBool(); }
void fromVariant(const QVariant& kept, int& percent) {
  const int number = kept.toInt();
  if (number >= 5 && number <= 200) percent = number;
}
void fromVariant(const QVariant& kept, double& value) {
  if (const double number = kept.toDouble(); std::isfinite(number)) value = number;
}
void fromVariant(const QVariant& kept, Theme& theme) {
  theme = kept.toString() == QStringLiteral("light") ? Theme::light : Theme::dark;
}
void fromVariant(const QVariant& kept, std::string& word) { word = kept.toString().toStdString(); }
void fromVariant(const QVariant& kept, std::map<std::string, std::string>& bindings) {
  for (const QString& line : kept.toStringList()) {
    const QStringList parts = line.split(QLatin1Char('='));
    if (parts.size() == 2) bindings[parts[0].toStdString()] = parts[1].toStdString();
  }
}
void fromVariant(const QVariant& kept, PetUnit& unit) {
  for (const PetUnit known : petUnits)
    if (kept.toString() == QLatin1String(petUnitName(known))) unit = known;
}

void fromVariant(const QVariant& kept, OwnWindows& windows) { windows = ownWindowsIn(kept.toString()); }

}  // namespace

Preferences defaultsFor(const Preferences& preferences) {
  Preferences defaults;
  defaults.windows = preferences.windows;
  return defaults;
}

Preferences storedPreferences() {
  Preferences preferences;
  const QSettings settings;
  visit(preferences, [&](const char* name, auto& value) {
    if (settings.contains(QLatin1String(name))) fromVariant(settings.value(QLatin1String(name)), value);
  });
  preferences.textPercent = std::clamp(preferences.textPercent, 80, 200);
  preferences.memoryPercent = std::clamp(preferences.memoryPercent, 5, 90);
  preferences.brush.diameterMm = std::clamp(preferences.brush.diameterMm, Brush::leastMm, Brush::mostMm);
  return preferences;
}

void storePreferences(const Preferences& preferences) {
  Preferences kept = preferences;
  QSettings settings;
  visit(kept,
        [&](const char* name, auto& value) { settings.setValue(QLatin1String(name), toVariant(value)); });
}

}  // namespace volumen
