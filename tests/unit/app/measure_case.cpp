#include "tests/unit/app/measure_case.h"

#include <QFile>
#include <QJsonDocument>
#include <QTemporaryDir>

namespace volumen::tests {

Outcome measuredShapes(const QString& path, const QByteArray& shapes, const QStringList& options) {
  const QTemporaryDir folder;
  QFile file(folder.filePath(QStringLiteral("shapes.json")));
  if (!file.open(QIODevice::WriteOnly) || file.write(shapes) != shapes.size()) return {-1, {}, "no file"};
  file.close();
  return runProgram(QStringList{QStringLiteral("measure"), path, QStringLiteral("--roi"), file.fileName()} +
                    options);
}

QJsonObject measuredShape(const QString& path, const QByteArray& shapes) {
  return QJsonDocument::fromJson(measuredShapes(path, shapes).out)[QStringLiteral("measurements")][0]
      .toObject();
}

}  // namespace volumen::tests
