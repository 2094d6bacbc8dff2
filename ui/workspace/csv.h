#pragma once

#include <QString>

namespace volumen {

/// A field of CSV, between quotation marks where it needs them (RFC 4180).
QString csvField(QString text);
/// The same of a name that somebody chose: one that a spreadsheet would take for a formula (=, +, -, @, a tab
/// or a line end in front) begins with an apostrophe.
QString csvName(const QString& text);
/// A number as it is read back to the last bit.
QString csvNumber(double number);

}  // namespace volumen
