#pragma once

class QCoreApplication;

namespace volumen {

/// Sets British spelling and numbers, also in Qt's own dialogs.
void speakBritish(QCoreApplication& app);

}  // namespace volumen
