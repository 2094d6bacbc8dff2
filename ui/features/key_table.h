#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// What the mouse, or a key that is none of an action, does.
struct KeyRow {
  QString keys;
  QString text;
};

/// All of them, in the order in which they are read: the keys of actions are told by these (action_text).
std::vector<KeyRow> keyRows();

}  // namespace volumen
