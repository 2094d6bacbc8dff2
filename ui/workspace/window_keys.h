#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// The digit that chooses a window, alone and with Ctrl; -1: none.
struct WindowKey {
  int alone = -1, withCtrl = -1;

  /// Returns "5" or "Ctrl+1"; empty if there is none.
  QString text() const;
};

/// The numbers of windows to choose from, without the automatic one.
struct WindowCounts {
  int ofFile = 0, ofProgram = 0, own = 0;
};

/// Returns the keys of the automatic window, then of the file's, the program's and the user's windows. 0 is
/// automatic, 1 to 9 are the program's and then the user's, Ctrl with a digit is the file's. Thus no digit
/// depends on the file if there are others to choose. A window of the user takes the last digit from one of
/// the program.
std::vector<WindowKey> windowKeys(const WindowCounts& counts);

}  // namespace volumen
