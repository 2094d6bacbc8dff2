#include "ui/features/key_table.h"

#include "results/text/text.h"

namespace volumen {

std::vector<KeyRow> keyRows() {
  return {
      {tr("Left drag in 3D"),
       tr("the chosen tool: rotate (Ctrl: roll), or adjust the curve: up and down shift it, left and right "
          "change its width (Ctrl: overall opacity)")},
      {tr("Middle, right, Shift+left drag in 3D"), tr("pan, zoom, pan (Edit > Preferences changes them)")},
      {tr("Wheel in 3D, two fingers apart"), tr("zoom at the cursor")},
      {tr("Double-click"), tr("maximise the view and back")},
      {tr("Left drag by the arrow in a view"),
       tr("gives its picture to a folder or another program, as a PNG file")},
      {tr("D in 3D"),
       tr("measure a length between places of the visible surface, by a drag or two clicks (an angle: Tools "
          "> "
          "Measure); a click selects one, its points can be dragged, Delete removes it, Esc gives up")},
      {tr("Arrow keys in 3D"), tr("rotate by 5 degrees (Shift: 1)")},
      {tr("Keypad 1, 3, 7"), tr("anterior, left, superior view (Ctrl: the opposite one)")},
      {tr("Keypad 0"), tr("reset the view")},
      {tr("Left drag in projections"), tr("with Adjust curve: the window (Shift: fine, Ctrl: fast)")},
      {tr("Left drag with the scissors"),
       tr("draw around what is cut away (Ctrl: around what stays), Esc gives up")},
      {tr("Right click, Menu, Shift+F10"), tr("the menu of the view")},
      {tr("Tab, Shift+Tab"), tr("the next view, the one before")},
      {tr("In the curve"),
       tr("double-click adds a point, right-click or Delete removes it, arrow keys nudge it, Tab goes to the "
          "next, the wheel zooms the value axis, Home shows all of it")},
      {tr("Left drag in a slice"),
       tr("the chosen tool, at first the window (Shift: fine, Ctrl: fast); Esc gives it up")},
      {tr("Middle, right, Shift+left drag in a slice"),
       tr("pan, zoom, crosshair (Edit > Preferences changes them)")},
      {tr("Wheel in a slice"), tr("scrolls (Shift: ten times as fast, Ctrl: zooms, Alt: slab)")},
      {tr("Left drag at the right of a slice"), tr("goes through the stack, as a click on its number does")},
      {tr("Left drag with the magnifier"), tr("a lens; the wheel changes how much it enlarges")},
      {tr("Left drag with Paint or Outline"), tr("paints the current segment (Ctrl: erases); + and - change "
                                                 "the brush by 20 %; an outline is drawn by a "
                                                 "drag, or by clicks that Enter or a double-click closes, "
                                                 "Backspace takes the last one back; Esc gives up")},
      {tr("Left drag with Cut segment"), tr("draw around what goes from the current segment (Ctrl: around "
                                            "what stays), in 3D, or in a slice as an outline; Esc gives up")},
      {tr("Pointer at the bottom of a slice"),
       tr("a bar that plays slices, frames or time points, with speed (+ and -), range, back and forth")},
      {tr("Shift over a slice"), tr("moves the crosshair")},
      {tr("Up, Down, Page Up, Page Down, Home, End in a slice"), tr("scroll by 1, by 10, to the ends")},
      {tr("Left, Right in a slice"), tr("the time point before, the next one")},
      {tr("0 to 9 in a slice"), tr("choose a window")},
      {tr("Ctrl+1 to Ctrl+9 in a slice"), tr("choose a window of the file")},
      {tr("I in a slice"), tr("inverts")},
      {tr("On lines of other planes"),
       tr("a drag of an outer part moves that plane; the round handle turns the other planes; F puts them "
          "straight")},
      {tr("D, A, E, P, T in a slice"),
       tr("measure: length, angle, ellipse, probe, arrow with text; the tool before comes back after one "
          "measurement (Shift keeps it), Enter or a double-click ends a polyline or a curve, Esc gives up, "
          "Delete "
          "removes what is selected, W changes the window again")},
      {tr("In the list of studies"),
       tr("Enter opens, Ctrl+Enter opens beside, Delete removes from the list")},
  };
}

}  // namespace volumen
