#pragma once

#include <QString>
#include <map>
#include <string>
#include <vector>

#include "ui/workspace/preferences.h"

namespace volumen {

/// Kinds of views in which the mouse means different things: slices and frames, and 3D.
enum class MousePlace { flat, scene };
/// What a hand does with the mouse; `move`: the pointer goes over the view, no button held.
enum class MouseInput { left, middle, right, wheel, move };

/// What something can be bound to: an input with Shift, Ctrl, Alt or none of them held.
struct MouseSlot {
  MousePlace place;
  MouseInput input;
  Qt::KeyboardModifier held = Qt::NoModifier;
  bool operator==(const MouseSlot&) const = default;
};

/// The key of these that counts: the first of Shift, Ctrl, Alt.
Qt::KeyboardModifier heldOf(Qt::KeyboardModifiers keys);
/// Of a button that is pressed.
MouseSlot slotOf(MousePlace place, Qt::MouseButton button, Qt::KeyboardModifiers keys);

/// All that can be bound. The left button alone is not among them: it is the chosen tool's; nor is the
/// pointer without a key held, which only points.
const std::vector<MouseSlot>& mouseSlots();
/// As preferences keep it: "flat.right", "scene.Ctrl+wheel".
std::string wordOf(const MouseSlot& slot);

/// What can be bound to a slot: a tool by its name, "chosen", "none", or of the wheel "scroll", "fast",
/// "zoom", "slab", "pan".
struct MouseAction {
  std::string word;
  QString text;  ///< for people
};
const std::vector<MouseAction>& mouseActions(const MouseSlot& slot);

/// What all slots are bound to under one name. A modifier without a row of its own changes nothing; a left
/// button without one is the chosen tool's, anything else does nothing.
///
/// - "volumen": what most viewers do: middle pans, right zooms, the wheel scrolls, Ctrl+wheel zooms.
/// - "weasis": MouseActions.java of Weasis 4: middle pans, right opens the menu, the wheel scrolls; Alt+wheel
/// is
///   its thickness of the slab.
/// - "slicer": Docs/user_guide/user_interface.md of 3D Slicer, "Slice views" and "3D views".
/// - "radiant": from memory, no manual of RadiAnt could be read: right changes the window, middle pans,
///   Shift+move is its 3D cursor.
/// - "oneButton", "trackpad": our own: the left button with a key pans, zooms and scrolls; two fingers pan.
struct MousePreset {
  std::string name;
  QString text;
  std::map<std::string, std::string> rows;  ///< word of a slot -> word of an action
};
/// The first is the one at first.
const std::vector<MousePreset>& mousePresets();

/// The word of the action that a slot is bound to; what a person's preferences name that does not exist is
/// passed over.
std::string boundTo(const Preferences& preferences, const MouseSlot& slot);
/// With another action there.
Preferences withBound(Preferences preferences, const MouseSlot& slot, const std::string& action);
/// With all of a preset, and nothing else.
Preferences withMousePreset(Preferences preferences, const std::string& name);

}  // namespace volumen
