#pragma once

#include <QString>

namespace volumen {

/// A field of CSV, between quotation marks where it needs them (RFC 4180).
QString csvField(QString text);
/// A name that somebody chose as no spreadsheet takes it for a formula: with =, +, -, @, a tab or a line end
/// in front it begins with an apostrophe.
QString harmlessName(const QString& text);
/// A number as it is read back to the last bit.
QString csvNumber(double number);

}  // namespace volumen
