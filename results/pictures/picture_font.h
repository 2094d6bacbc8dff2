#pragma once

#include <QFont>

namespace volumen {

/// Returns the font of texts in pictures and over views: the bundled DejaVu Sans at 9 points, scaled by
/// `percent`. Pictures are the same on machines with other fonts. Letters that it lacks (Chinese, Japanese,
/// Korean) come from the system's fonts. Needs a QGuiApplication.
QFont pictureFont(int percent = 100);

/// Returns the bold font of the letters that name a side, slightly larger than `font`. Its I has serifs, so
/// that it does not look like a stroke.
QFont letterFont(const QFont& font);

}  // namespace volumen
