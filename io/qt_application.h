#pragma once

namespace volumen {

/// Makes a QCoreApplication if there is none, as Qt's databases and network need one. It stays until the
/// program ends; a program with windows makes its own first.
void needQtApplication();

}  // namespace volumen
