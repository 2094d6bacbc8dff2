#pragma once

#include <QString>

namespace volumen {

/// Returns a CSV field, quoted if necessary (RFC 4180).
QString csvField(QString text);
/// Returns a user's name so that no spreadsheet takes it for a formula. An apostrophe precedes a leading =,
/// +, -, @, tab or line end.
QString harmlessName(const QString& text);
/// Returns a number with 7 significant digits; integers below 1e15 in full.
QString csvNumber(double number);

}  // namespace volumen
