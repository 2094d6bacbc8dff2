#pragma once

#include <QString>

namespace volumen {

/// Returns sentences with absolute paths replaced while names are hidden (hideNames). A path extends as far
/// as it exists on disk, else to the next colon or the end of its line.
QString withoutPaths(const QString& sentences);

}  // namespace volumen
