#pragma once

#include <QByteArray>
#include <memory>
#include <optional>
#include <string>

#include "viewer/segment/label_map.h"

namespace volumen {

/// What makes one label map of another one of the same grid: the bricks that are different, compressed.
/// `baseChecksum` names the other one, 40 hexadecimal digits.
QByteArray labelChanges(const LabelMap& base, const std::string& baseChecksum, const LabelMap& map);

/// The checksum of the map that these bytes change; none: they are no such changes.
std::optional<std::string> baseOfChanges(const QByteArray& changes);

/// The changed map; null: the bytes are damaged, or of another grid.
std::shared_ptr<const LabelMap> withLabelChanges(const LabelMap& base, const QByteArray& changes);

}  // namespace volumen
