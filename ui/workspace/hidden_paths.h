#pragma once

#include <QString>

namespace volumen {

/// Sentences as a person may read them: while names are hidden (hideNames) absolute paths in them are, too. A
/// path goes as far as one is there on disk; else to the next colon, or to the end of its line.
QString withoutPaths(const QString& sentences);

}  // namespace volumen
