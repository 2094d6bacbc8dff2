#pragma once

#include <QLabel>
#include <QStringList>

// Qt takes a text that looks like rich text for that, and opens the files that it names. Names in medical
// files are written by strangers: what is no literal of this program goes through one of these.

namespace volumen {

/// A label that shows every character as it is.
QLabel* plainLabel(const QString& text = {});

/// Lines for a tool tip that shows every character as it is and wraps long sentences; empty ones are left
/// out.
QString toolTipOf(QStringList lines);
QString toolTipOf(const QString& line);

}  // namespace volumen
