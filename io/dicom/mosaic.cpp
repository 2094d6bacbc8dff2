#include "io/dicom/mosaic.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/dicom/attributes.h"
#include "io/dicom/csa.h"

namespace volumen::dicom {
namespace {

constexpr double mostTiles = 4096;

std::vector<double> numbersOf(const CsaFields& fields, const char* name, std::size_t count) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() < count) return {};
  std::vector<double> numbers;
  for (std::size_t n = 0; n < count; ++n) {
    const auto number = parseNumber(found->second[n]);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

/// The number of slices and the step between them.
struct Tiles {
  int count = 0;
  glm::dvec3 step{0};  ///< step from each tile to the next, mm
};

/// Reads number and step of the tiles. An Error says what is missing.
Result<Tiles> readTiles(const DataSet& data, const Slice& whole) {
  const CsaFields fields = readCsaImageHeader(data);
  if (fields.empty()) return Error{"it has no CSA header that can be read"};
  const auto count = numbersOf(fields, "NumberOfImagesInMosaic", 1);
  if (count.empty() || !(count[0] >= 1 && count[0] <= mostTiles) || count[0] != std::floor(count[0]))
    return Error{"its CSA header does not say of how many slices"};
  const auto normal = numbersOf(fields, "SliceNormalVector", 3);
  if (normal.empty()) return Error{"its CSA header gives no normal of the slices"};
  if (!isPlaced(whole)) return Error{"its position, orientation or pixel spacing is not known"};
  const double distance = data.number(0x00180088, data.root()).value_or(0);
  if (!(distance > 0)) return Error{"SpacingBetweenSlices (0018,0088) is missing"};
  const glm::dvec3 across = glm::cross(whole.orientation->row, whole.orientation->column);
  const double along = glm::dot(glm::dvec3(normal[0], normal[1], normal[2]), across);
  if (!(std::abs(std::abs(along) - 1) < 0.01))
    return Error{"the normal of its CSA header is not that of the picture"};
  return Tiles{int(count[0]), across * std::copysign(distance, along)};
}

/// Returns the position of the first tile. A mosaic has the position of a slice as large as the whole
/// picture.
glm::dvec3 cornerOf(const Slice& whole, const PixelFormat& tile, const Mosaic& mosaic) {
  return *whole.position +
         whole.orientation->row * (whole.spacing->x * (mosaic.columns - tile.columns) / 2.0) +
         whole.orientation->column * (whole.spacing->y * (mosaic.rows - tile.rows) / 2.0);
}

}  // namespace

void splitMosaic(const DataSet& data, FileHeader& header) {
  const auto imageType = data.values(0x00080008, data.root());
  const bool isMosaic = std::find(imageType.begin(), imageType.end(), "MOSAIC") != imageType.end();
  if (!isMosaic || !header.notVolume.empty() || header.format.frames != 1) return;
  const auto refuse = [&](const std::string& why) {
    header.notVolume = "Siemens mosaic (the slices are tiles of one image): " + why;
  };
  const Slice whole = header.slices.front();
  const Result<Tiles> tiles = readTiles(data, whole);
  if (!tiles) return refuse(tiles.message());
  PixelFormat tile = header.format;
  const int across = int(std::ceil(std::sqrt(double(tiles->count))));
  const Mosaic mosaic{tile.columns, tile.rows, across};
  if (tile.columns % across != 0 || tile.rows % across != 0)
    return refuse(std::to_string(tile.columns) + " x " + std::to_string(tile.rows) +
                  " pixels do not hold its " + std::to_string(tiles->count) + " slices as tiles");
  tile.columns /= across, tile.rows /= across, tile.frames = tiles->count;
  header.slices.clear();
  for (int n = 0; n < tiles->count; ++n) {
    Slice slice = whole;
    slice.frame = n;
    slice.instance += n;
    slice.position = cornerOf(whole, tile, mosaic) + double(n) * tiles->step;
    header.slices.push_back(slice);
  }
  header.format = tile;
  header.mosaic = mosaic;
}

PixelFormat wholeMosaic(PixelFormat tile, const Mosaic& mosaic) {
  tile.columns = mosaic.columns;
  tile.rows = mosaic.rows;
  tile.frames = 1;
  return tile;
}

DecodedFrame tileOf(const DecodedFrame& whole, int n, const PixelFormat& format, const Mosaic& mosaic) {
  const std::size_t columns = std::size_t(format.columns), rows = std::size_t(format.rows);
  const std::size_t left = std::size_t(n % mosaic.tilesAcross) * columns,
                    top = std::size_t(n / mosaic.tilesAcross) * rows;
  DecodedFrame tile{{}, whole.note, whole.ybr};
  tile.samples = std::visit(
      [&](const auto& from) -> Samples {
        std::decay_t<decltype(from)> to(columns * rows);
        for (std::size_t row = 0; row < rows; ++row)
          std::copy_n(from.begin() + std::ptrdiff_t((top + row) * std::size_t(mosaic.columns) + left),
                      columns, to.begin() + std::ptrdiff_t(row * columns));
        return to;
      },
      whole.samples);
  return tile;
}

}  // namespace volumen::dicom
