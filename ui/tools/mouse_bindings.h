#pragma once

#include <QString>
#include <map>
#include <string>
#include <vector>

#include "ui/workspace/preferences.h"

namespace volumen {

/// Kinds of views with their own bindings: `flat` for slices and frames, `scene` for 3D.
enum class MousePlace { flat, scene };
/// Inputs of the mouse. `move` is a movement over the view with no button held.
enum class MouseInput { left, middle, right, wheel, move };

/// An input together with Shift, Ctrl, Alt or none of them.
struct MouseSlot {
  MousePlace place;
  MouseInput input;
  Qt::KeyboardModifier held = Qt::NoModifier;
  bool operator==(const MouseSlot&) const = default;
};

/// Returns the modifier that counts: the first of Shift, Ctrl, Alt.
Qt::KeyboardModifier heldOf(Qt::KeyboardModifiers keys);
/// Returns the slot of a pressed button.
MouseSlot slotOf(MousePlace place, Qt::MouseButton button, Qt::KeyboardModifiers keys);

/// Returns all slots that can be bound. The left button without a modifier is missing because it belongs to
/// the chosen tool. A movement without a modifier is missing because it only points.
const std::vector<MouseSlot>& mouseSlots();
/// Returns the name of a slot in the preferences: "flat.right", "scene.Ctrl+wheel".
std::string wordOf(const MouseSlot& slot);

/// An action for a slot: the name of a tool, "chosen" or "none". For the wheel also "scroll", "fast", "zoom",
/// "slab", "pan".
struct MouseAction {
  std::string word;
  QString text;  ///< shown to the user
};
const std::vector<MouseAction>& mouseActions(const MouseSlot& slot);

/// A named set of bindings for all slots. A slot with a modifier but without a row acts as without the
/// modifier. A left button without a row is the chosen tool's; other slots without a row do nothing.
///
/// - "volumen" is what most viewers do: middle pans, right zooms, the wheel scrolls, Ctrl+wheel zooms.
/// - "weasis" follows MouseActions.java of Weasis 4: middle pans, right opens the menu, the wheel scrolls,
///   Alt+wheel sets the slab thickness.
/// - "slicer" follows Docs/user_guide/user_interface.md of 3D Slicer, "Slice views" and "3D views".
/// - "radiant" is from memory, as no manual of RadiAnt could be read: right changes the window, middle pans,
///   Shift+move is its 3D cursor.
/// - "oneButton" and "trackpad" are our own: the left button with a modifier pans, zooms and scrolls. On a
///   trackpad two fingers pan.
struct MousePreset {
  std::string name;
  QString text;
  std::map<std::string, std::string> rows;  ///< name of a slot -> name of an action
};
/// Returns all presets; the first is the default.
const std::vector<MousePreset>& mousePresets();

/// Returns the name of the action bound to a slot. Unknown actions in the preferences are ignored.
std::string boundTo(const Preferences& preferences, const MouseSlot& slot);
/// Returns the preferences with `action` bound to `slot`.
Preferences withBound(Preferences preferences, const MouseSlot& slot, const std::string& action);
/// Returns the preferences with a preset and without own bindings.
Preferences withMousePreset(Preferences preferences, const std::string& name);

}  // namespace volumen
