#include "ui/workspace/preferences.h"

#include <QSettings>
#include <algorithm>
#include <utility>

namespace volumen {

namespace {

constexpr std::pair<DragAction, const char*> dragNames[] = {{DragAction::rotate, "rotate"},
                                                            {DragAction::pan, "pan"},
                                                            {DragAction::zoom, "zoom"},
                                                            {DragAction::curve, "curve"}};

constexpr PetUnit petUnits[] = {PetUnit::suvBodyWeight, PetUnit::suvLeanBodyMass, PetUnit::suvBodySurface,
                                PetUnit::file};

// Goes through all preferences: one list for reading and writing.
template <class Visit>
void visit(Preferences& p, const Visit& each) {
  each("theme", p.theme);
  each("textPercent", p.textPercent);
  each("middleDrag", p.middleDrag);
  each("rightDrag", p.rightDrag);
  each("shiftDrag", p.shiftDrag);
  each("zoomDragInverted", p.zoomDragInverted);
  each("wheelInverted", p.wheelInverted);
  each("curveDragInverted", p.curveDragInverted);
  each("logarithmicOpacity", p.logarithmicOpacity);
  each("hideNames", p.hideNames);
  each("petUnit", p.petUnit);
  each("memoryPercent", p.memoryPercent);
  each("windows", p.windows);
}

QVariant toVariant(bool value) { return value; }
QVariant toVariant(int value) { return value; }
QVariant toVariant(Theme theme) {
  return theme == Theme::light ? QStringLiteral("light") : QStringLiteral("dark");
}
QVariant toVariant(DragAction action) { return QLatin1String(nameOf(action)); }
QVariant toVariant(PetUnit unit) { return QLatin1String(petUnitName(unit)); }
QVariant toVariant(const OwnWindows& windows) { return ownWindowsText(windows); }

void fromVariant(const QVariant& kept, bool& value) { value = kept.toBool(); }
void fromVariant(const QVariant& kept, int& percent) {
  const int number = kept.toInt();
  if (number >= 5 && number <= 200) percent = number;
}
void fromVariant(const QVariant& kept, Theme& theme) {
  theme = kept.toString() == QStringLiteral("light") ? Theme::light : Theme::dark;
}
void fromVariant(const QVariant& kept, DragAction& action) {
  for (const auto& [known, name] : dragNames)
    if (kept.toString() == QLatin1String(name)) action = known;
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

const char* nameOf(DragAction action) {
  return std::ranges::find(dragNames, action, &std::pair<DragAction, const char*>::first)->second;
}

Preferences storedPreferences() {
  Preferences preferences;
  const QSettings settings;
  visit(preferences, [&](const char* name, auto& value) {
    if (settings.contains(QLatin1String(name))) fromVariant(settings.value(QLatin1String(name)), value);
  });
  preferences.textPercent = std::clamp(preferences.textPercent, 80, 200);
  preferences.memoryPercent = std::clamp(preferences.memoryPercent, 5, 90);
  return preferences;
}

void storePreferences(const Preferences& preferences) {
  Preferences kept = preferences;
  QSettings settings;
  visit(kept,
        [&](const char* name, auto& value) { settings.setValue(QLatin1String(name), toVariant(value)); });
}

}  // namespace volumen
