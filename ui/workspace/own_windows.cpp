#include "ui/workspace/own_windows.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cmath>

#include "results/text/value_text.h"

namespace volumen {

bool isFor(const OwnWindow& own, const Series& series) {
  return own.modality == series.modality && own.unit == shownScale(series).unit;
}

QString ownWindowsText(const OwnWindows& windows) {
  QJsonArray all;
  for (const OwnWindow& own : windows)
    all.append(QJsonObject{{QStringLiteral("modality"), QString::fromStdString(own.modality)},
                           {QStringLiteral("unit"), QString::fromStdString(own.unit)},
                           {QStringLiteral("name"), own.name},
                           {QStringLiteral("centre"), own.window.centre},
                           {QStringLiteral("width"), own.window.width}});
  return QString::fromUtf8(QJsonDocument(all).toJson(QJsonDocument::Compact));
}

OwnWindows ownWindowsIn(const QString& text) {
  OwnWindows windows;
  for (const QJsonValue each : QJsonDocument::fromJson(text.toUtf8()).array()) {
    const QJsonObject object = each.toObject();
    const QString name = object[QStringLiteral("name")].toString().trimmed();
    const double centre = object[QStringLiteral("centre")].toDouble(std::nan("")),
                 width = object[QStringLiteral("width")].toDouble(0);
    if (name.isEmpty() || !std::isfinite(centre) || !(width > 0)) continue;
    windows.push_back({object[QStringLiteral("modality")].toString().toStdString(),
                       object[QStringLiteral("unit")].toString().toStdString(),
                       name,
                       {centre, width}});
  }
  return windows;
}

}  // namespace volumen
