#pragma once

class QCoreApplication;

namespace volumen {

/// British spelling and numbers, in Qt's own dialogs too.
void speakBritish(QCoreApplication& app);

}  // namespace volumen
