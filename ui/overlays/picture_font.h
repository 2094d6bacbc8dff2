#pragma once

#include <QFont>

namespace volumen {

/// The font of texts that are written into pictures and over views: DejaVu Sans at 9 points, `percent` of it,
/// which the program brings. Equal pictures come out on machines with other fonts. Letters that it lacks
/// (Chinese, Japanese, Korean) are taken from the system's fonts. Needs a QGuiApplication.
QFont pictureFont(int percent = 100);

/// The bold font of the letters that name a side, a little larger than the text in `font`: its I has serifs,
/// so that it does not look like a stroke.
QFont letterFont(const QFont& font);

}  // namespace volumen
