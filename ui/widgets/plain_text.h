#pragma once

#include <QLabel>
#include <QStringList>

// Qt interprets text that looks like rich text, and opens the files it names. Names in medical files are
// untrusted: all text except this program's literals goes through one of these.

namespace volumen {

/// Returns a label that shows every character as it is.
QLabel* plainLabel(const QString& text = {});

/// Returns a tooltip that shows every character as it is and wraps long sentences; empty lines are left out.
QString toolTipOf(QStringList lines);
QString toolTipOf(const QString& line);

}  // namespace volumen
