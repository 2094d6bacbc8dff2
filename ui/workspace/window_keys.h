#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// The digit that chooses a window, by itself and with Ctrl; -1: none.
struct WindowKey {
  int alone = -1, withCtrl = -1;

  /// "5", "Ctrl+1"; empty: there is none.
  QString text() const;
};

/// How many windows there are to choose from beside the automatic one.
struct WindowCounts {
  int ofFile = 0, ofProgram = 0, own = 0;
};

/// Returns the keys of the automatic window, those of the file, of the program and of the user, in this
/// order. No digit depends on the file where there are others to choose: 0 is automatic, 1 to 9 are the
/// program's and then the user's, Ctrl with a digit the file's. A window of the user's takes the last digit
/// from one of the program's.
std::vector<WindowKey> windowKeys(const WindowCounts& counts);

}  // namespace volumen
