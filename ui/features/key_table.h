#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// What the mouse does, or a key that belongs to no action.
struct KeyRow {
  QString keys;
  QString text;
};

/// Returns all rows in reading order. Actions name their own keys (action_text).
std::vector<KeyRow> keyRows();

}  // namespace volumen
