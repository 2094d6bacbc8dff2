#pragma once

#include <QByteArray>
#include <memory>
#include <optional>
#include <string>

#include "viewer/segment/label_map.h"

namespace volumen {

/// Returns the bricks in which `map` differs from `base`, compressed. Both have the same grid. `baseChecksum`
/// identifies `base`, 40 hexadecimal digits.
QByteArray labelChanges(const LabelMap& base, const std::string& baseChecksum, const LabelMap& map);

/// Returns the checksum of the base of these changes, or nothing if the bytes are no changes.
std::optional<std::string> baseOfChanges(const QByteArray& changes);

/// Returns the changed map, or null if the bytes are damaged or of another grid.
std::shared_ptr<const LabelMap> withLabelChanges(const LabelMap& base, const QByteArray& changes);

}  // namespace volumen
