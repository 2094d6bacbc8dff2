#include "ui/controller/label_changes.h"

#include <QtEndian>
#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>

namespace volumen {

namespace {

// Format: the header, the checksum of the base, then zlib data. Each brick has its number (four bytes, little
// endian), then 0 and its label, or 1 and its voxels.
const QByteArray headOfChanges = QByteArrayLiteral("volumen label changes 1\n");
constexpr int checksumDigits = 40, fastest = 1;
constexpr qsizetype numberBytes = 4, voxelBytes = qsizetype(LabelMap::edge) * LabelMap::edge * LabelMap::edge;

std::size_t brickCount(const LabelMap& map) {
  const glm::ivec3 n = map.bricks();
  return std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z);
}

// Returns the data that zlib packed; the size comes first and is at most that of all bricks. Nothing if it is
// damaged.
std::optional<QByteArray> unpacked(const QByteArray& packed, const LabelMap& map) {
  if (packed.size() < numberBytes) return {};
  const auto length = qFromBigEndian<quint32>(packed.constData());
  if (length > brickCount(map) * std::size_t(numberBytes + 1 + voxelBytes)) return {};
  QByteArray bytes = qUncompress(packed);
  return bytes.size() == qsizetype(length) ? std::optional(std::move(bytes)) : std::nullopt;
}

void setBrick(LabelEdit& edit, const LabelMap& map, int brick, const char* voxels, std::uint8_t label) {
  const glm::ivec3 bricks = map.bricks(),
                   corner = LabelMap::edge * glm::ivec3(brick % bricks.x, brick / bricks.x % bricks.y,
                                                        brick / bricks.x / bricks.y),
                   size = glm::min(glm::ivec3(LabelMap::edge), map.geometry().size - corner);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const int place = i + LabelMap::edge * (j + LabelMap::edge * k);
        edit.set(corner + glm::ivec3(i, j, k), voxels ? std::uint8_t(voxels[place]) : label);
      }
}

}  // namespace

QByteArray labelChanges(const LabelMap& base, const std::string& baseChecksum, const LabelMap& map) {
  QByteArray bytes;
  for (std::size_t n = 0; n < brickCount(map); ++n) {
    const LabelMap::Brick& brick = map.brick(n);
    if (brick == base.brick(n)) continue;
    char number[numberBytes];
    qToLittleEndian(quint32(n), number);
    bytes.append(number, numberBytes);
    bytes.append(brick.voxels ? '\1' : '\0');
    if (brick.voxels)
      bytes.append(reinterpret_cast<const char*>(brick.voxels->data()), voxelBytes);
    else
      bytes.append(char(brick.label));
  }
  return headOfChanges + QByteArray::fromStdString(baseChecksum) + qCompress(bytes, fastest);
}

std::optional<std::string> baseOfChanges(const QByteArray& changes) {
  if (!changes.startsWith(headOfChanges) || changes.size() < headOfChanges.size() + checksumDigits) return {};
  return changes.mid(headOfChanges.size(), checksumDigits).toStdString();
}

std::shared_ptr<const LabelMap> withLabelChanges(const LabelMap& base, const QByteArray& changes) {
  if (!baseOfChanges(changes)) return nullptr;
  const auto content = unpacked(changes.mid(headOfChanges.size() + checksumDigits), base);
  if (!content) return nullptr;
  const QByteArray& bytes = *content;
  LabelEdit edit(base);
  qsizetype at = 0;
  while (at < bytes.size()) {
    if (bytes.size() - at < numberBytes + 2) return nullptr;
    const auto brick = qFromLittleEndian<quint32>(bytes.constData() + at);
    const bool hasVoxels = bytes[at + numberBytes] != 0;
    at += numberBytes + 1;
    const qsizetype length = hasVoxels ? voxelBytes : 1;
    if (brick >= brickCount(base) || bytes.size() - at < length) return nullptr;
    const char* held = bytes.constData() + at;
    setBrick(edit, base, int(brick), hasVoxels ? held : nullptr, std::uint8_t(*held));
    at += length;
  }
  return std::make_shared<const LabelMap>(edit.done());
}

}  // namespace volumen
