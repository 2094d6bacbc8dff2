#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>

#include "tests/fixtures/program.h"

namespace volumen::tests {

/// Runs `volumen measure PATH --roi shapes.json OPTIONS` with `shapes` (JSON) in that file.
Outcome measuredShapes(const QString& path, const QByteArray& shapes, const QStringList& options = {});

/// Returns the numbers of the only shape.
QJsonObject measuredShape(const QString& path, const QByteArray& shapes);

}  // namespace volumen::tests
