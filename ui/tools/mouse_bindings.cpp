#include "ui/tools/mouse_bindings.h"

#include <algorithm>

#include "results/text/text.h"
#include "ui/tools/tool.h"

namespace volumen {

namespace {

constexpr Qt::KeyboardModifier heldKeys[] = {Qt::NoModifier, Qt::ShiftModifier, Qt::ControlModifier,
                                             Qt::AltModifier};

const char* wordOfKey(Qt::KeyboardModifier held) {
  switch (held) {
    case Qt::ShiftModifier:
      return "Shift+";
    case Qt::ControlModifier:
      return "Ctrl+";
    case Qt::AltModifier:
      return "Alt+";
    default:
      return "";
  }
}

const char* wordOfInput(MouseInput input) {
  switch (input) {
    case MouseInput::left:
      return "left";
    case MouseInput::middle:
      return "middle";
    case MouseInput::right:
      return "right";
    case MouseInput::wheel:
      return "wheel";
    default:
      return "move";
  }
}

std::vector<MouseAction> wheelActions(MousePlace place) {
  const MouseAction zoom{"zoom", tr("Zoom")}, pan{"pan", tr("Pan with two fingers")},
      none{"none", tr("Nothing")};
  if (place == MousePlace::scene) return {zoom, pan, none};
  return {{"scroll", tr("Scroll")},
          {"fast", tr("Scroll ten times as fast")},
          zoom,
          {"slab", tr("Thickness of the slab")},
          pan,
          none};
}

std::vector<MouseAction> dragActions(MousePlace place, bool isLeft) {
  std::vector<MouseAction> all;
  if (isLeft) all.push_back({"chosen", tr("The chosen tool")});
  const bool isFlat = place == MousePlace::flat;
  for (const Tool& tool : tools())
    if (!tool.measuring && (isLeft || !tool.draws()) &&
        (isFlat ? tool.inSlices != nullptr : tool.inScene != nullptr))
      all.push_back({tool.name, tool.text});
  all.push_back({"none", tr("Nothing")});
  return all;
}

const MousePreset& presetOf(const Preferences& preferences) {
  const auto& all = mousePresets();
  const auto found = std::ranges::find(all, preferences.mousePreset, &MousePreset::name);
  return found == all.end() ? all.front() : *found;
}

bool canBe(const MouseSlot& slot, const std::string& action) {
  return std::ranges::find(mouseActions(slot), action, &MouseAction::word) != mouseActions(slot).end();
}

}  // namespace

Qt::KeyboardModifier heldOf(Qt::KeyboardModifiers keys) {
  for (const Qt::KeyboardModifier held : heldKeys)
    if (keys & held) return held;
  return Qt::NoModifier;
}

MouseSlot slotOf(MousePlace place, Qt::MouseButton button, Qt::KeyboardModifiers keys) {
  const MouseInput input = button == Qt::LeftButton    ? MouseInput::left
                           : button == Qt::RightButton ? MouseInput::right
                                                       : MouseInput::middle;
  return {place, input, heldOf(keys)};
}

const std::vector<MouseSlot>& mouseSlots() {
  static const std::vector<MouseSlot> all = [] {
    std::vector<MouseSlot> made;
    for (const MousePlace place : {MousePlace::flat, MousePlace::scene})
      for (const MouseInput input :
           {MouseInput::left, MouseInput::middle, MouseInput::right, MouseInput::wheel, MouseInput::move})
        for (const Qt::KeyboardModifier held : heldKeys) {
          const bool needsKey = input == MouseInput::left || input == MouseInput::move;
          const bool exists = input != MouseInput::move || place == MousePlace::flat;
          if (exists && (held || !needsKey)) made.push_back({place, input, held});
        }
    return made;
  }();
  return all;
}

std::string wordOf(const MouseSlot& slot) {
  return std::string(slot.place == MousePlace::flat ? "flat." : "scene.") + wordOfKey(slot.held) +
         wordOfInput(slot.input);
}

const std::vector<MouseAction>& mouseActions(const MouseSlot& slot) {
  static const std::vector<MouseAction> flatWheel = wheelActions(MousePlace::flat),
                                        sceneWheel = wheelActions(MousePlace::scene),
                                        flatLeft = dragActions(MousePlace::flat, true),
                                        sceneLeft = dragActions(MousePlace::scene, true),
                                        flatDrag = dragActions(MousePlace::flat, false),
                                        sceneDrag = dragActions(MousePlace::scene, false),
                                        move{{"crosshair", tr("Crosshair")}, {"none", tr("Nothing")}};
  const bool isFlat = slot.place == MousePlace::flat;
  if (slot.input == MouseInput::move) return move;
  if (slot.input == MouseInput::wheel) return isFlat ? flatWheel : sceneWheel;
  if (slot.input == MouseInput::left) return isFlat ? flatLeft : sceneLeft;
  return isFlat ? flatDrag : sceneDrag;
}

const std::vector<MousePreset>& mousePresets() {
  static const std::vector<MousePreset> all{
      {"volumen",
       tr("volumen"),
       {{"flat.Shift+left", "crosshair"},
        {"flat.middle", "pan"},
        {"flat.right", "zoom"},
        {"flat.wheel", "scroll"},
        {"flat.Shift+wheel", "fast"},
        {"flat.Ctrl+wheel", "zoom"},
        {"flat.Alt+wheel", "slab"},
        {"flat.Shift+move", "crosshair"},
        {"scene.Shift+left", "pan"},
        {"scene.middle", "pan"},
        {"scene.right", "zoom"},
        {"scene.wheel", "zoom"}}},
      {"weasis",
       tr("Weasis"),
       {{"flat.middle", "pan"},
        {"flat.wheel", "scroll"},
        {"flat.Shift+wheel", "fast"},
        {"flat.Ctrl+wheel", "zoom"},
        {"flat.Alt+wheel", "slab"},
        {"scene.middle", "pan"},
        {"scene.wheel", "zoom"}}},
      {"radiant",
       tr("RadiAnt"),
       {{"flat.middle", "pan"},
        {"flat.right", "window"},
        {"flat.wheel", "scroll"},
        {"flat.Shift+wheel", "fast"},
        {"flat.Ctrl+wheel", "zoom"},
        {"flat.Alt+wheel", "slab"},
        {"flat.Shift+move", "crosshair"},
        {"scene.middle", "pan"},
        {"scene.right", "curve"},
        {"scene.wheel", "zoom"}}},
      {"slicer",
       tr("3D Slicer"),
       {{"flat.Shift+left", "pan"},
        {"flat.middle", "pan"},
        {"flat.right", "zoom"},
        {"flat.wheel", "scroll"},
        {"flat.Ctrl+wheel", "zoom"},
        {"flat.Shift+move", "crosshair"},
        {"scene.Shift+left", "pan"},
        {"scene.middle", "pan"},
        {"scene.right", "zoom"},
        {"scene.Ctrl+wheel", "zoom"}}},
      {"oneButton",
       tr("One button"),
       {{"flat.Shift+left", "pan"},
        {"flat.Ctrl+left", "zoom"},
        {"flat.Alt+left", "scroll"},
        {"flat.middle", "pan"},
        {"flat.right", "zoom"},
        {"flat.wheel", "scroll"},
        {"flat.Shift+wheel", "fast"},
        {"flat.Ctrl+wheel", "zoom"},
        {"flat.Alt+wheel", "slab"},
        {"scene.Shift+left", "pan"},
        {"scene.Ctrl+left", "zoom"},
        {"scene.middle", "pan"},
        {"scene.right", "zoom"},
        {"scene.wheel", "zoom"}}},
      {"trackpad",
       tr("Trackpad"),
       {{"flat.Shift+left", "pan"},
        {"flat.Ctrl+left", "zoom"},
        {"flat.Alt+left", "scroll"},
        {"flat.middle", "pan"},
        {"flat.right", "zoom"},
        {"flat.wheel", "pan"},
        {"flat.Shift+wheel", "scroll"},
        {"flat.Ctrl+wheel", "zoom"},
        {"flat.Alt+wheel", "slab"},
        {"scene.Shift+left", "pan"},
        {"scene.middle", "pan"},
        {"scene.right", "zoom"},
        {"scene.wheel", "pan"},
        {"scene.Ctrl+wheel", "zoom"}}},
  };
  return all;
}

std::string boundTo(const Preferences& preferences, const MouseSlot& slot) {
  const MousePreset& preset = presetOf(preferences);
  const MouseSlot plain{slot.place, slot.input};
  for (const MouseSlot& at : {slot, plain}) {
    const std::string word = wordOf(at);
    const auto own = preferences.mouseBindings.find(word);
    if (own != preferences.mouseBindings.end() && canBe(at, own->second)) return own->second;
    const auto row = preset.rows.find(word);
    if (row != preset.rows.end()) return row->second;
  }
  return slot.input == MouseInput::left ? "chosen" : "none";
}

Preferences withBound(Preferences preferences, const MouseSlot& slot, const std::string& action) {
  preferences.mouseBindings.erase(wordOf(slot));
  if (boundTo(preferences, slot) != action) preferences.mouseBindings[wordOf(slot)] = action;
  return preferences;
}

Preferences withMousePreset(Preferences preferences, const std::string& name) {
  preferences.mousePreset = name;
  preferences.mouseBindings.clear();
  return preferences;
}

}  // namespace volumen
