#include "viewer/slice/slice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "viewer/slice/sample_line.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Extent {
  double low, high;  // mm
};

// Evenly spaced samples along one direction of a plane: sample n lies first + n distance mm from its centre.
struct Samples {
  double first = 0, distance = 1;  // mm
  std::int64_t count = 1;

  // Returns `count` samples centred on the plane's centre.
  static Samples centred(double width, std::int64_t count) {
    const double distance = width / double(count);
    return {distance * 0.5 - width * 0.5, distance, count};
  }

  // Returns the samples in an interval, and one more at each end.
  SampleRange between(Extent mm) const {
    if (distance == 0) return {0, count};
    const double last = double(count);
    const double from = std::clamp(std::floor((mm.low - first) / distance) - 1, 0.0, last);
    const double to = std::clamp(std::ceil((mm.high - first) / distance) + 2, from, last);
    return {std::int64_t(from), std::int64_t(to)};
  }
};

// Returns the extent of the volume's box along a direction from the plane's centre, mm.
Extent boxAlong(const VoxelGeometry& geometry, glm::dvec3 centre, glm::dvec3 direction) {
  Extent extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const glm::dvec3& corner : geometry.boxCorners()) {
    const double mm = glm::dot(corner - centre, direction);
    extent = {std::min(extent.low, mm), std::max(extent.high, mm)};
  }
  return extent;
}

SampleRange common(SampleRange a, SampleRange b) {
  const std::int64_t first = std::max(a.first, b.first);
  return {first, std::max(first, std::min(a.last, b.last))};
}

// A rectangle of (sub-)samples.
struct Tile {
  SampleRange columns, rows;

  std::int64_t width() const { return columns.last - columns.first; }
  std::int64_t count() const { return width() * (rows.last - rows.first); }
};

// Values of a tile's points on one layer of voxels, row by row.
struct Layer {
  int voxel = -1;  // index along the axis; -1: none yet
  std::vector<float> values;
};

// Slab results at the points of a tile, row by row, in stored values; NaN if there is none. Reused from tile
// to tile to save allocations.
struct Slabs {
  Layer layers[2];
  std::vector<SampleRange> inside;  // points of each row in the box
  std::vector<float> samples, extreme;
  std::vector<double> sum, value;
  std::vector<int> counted;
};

// Returns the mode for stored values: a negative slope swaps maximum and minimum.
SlabMode storedMode(SlabMode mode, double slope) {
  if (slope > 0 || mode == SlabMode::mean) return mode;
  return mode == SlabMode::max ? SlabMode::min : SlabMode::max;
}

class Resampler {
 public:
  Resampler(const Volume& volume, const SlicePlane& plane)
      : volume_(volume),
        size_(plane.size),
        perPixel_(subSamples(plane, volume.geometry())),
        tileColumns_(int(std::max<std::int64_t>(1, columnsATile / perPixel_))),
        tileRows_(int(std::max<std::int64_t>(1, rowsATile / perPixel_))),
        mode_(storedMode(plane.slabMode, volume.slope())),
        kernel_(chooseKernel(volume, plane.interpolation)) {
    const VoxelGeometry& g = volume.geometry();
    const glm::dvec3 normal = plane.normal();
    const double s = plane.mmPerPixel;
    across_ = Samples::centred(s * plane.size.x, perPixel_ * plane.size.x);
    down_ = Samples::centred(s * plane.size.y, perPixel_ * plane.size.y);
    deep_ = Samples::centred(plane.slabMm, slabSamples(plane, g));
    const glm::dmat3 perMm = g.voxelFromPatientStep();
    centre_ = perMm * (plane.centre - g.origin);
    right_ = perMm * plane.right, below_ = perMm * plane.down, normal_ = perMm * normal;
    columnsInBox_ = across_.between(boxAlong(g, plane.centre, plane.right));
    rowsInBox_ = down_.between(boxAlong(g, plane.centre, plane.down));
    depthsInBox_ = deep_.between(boxAlong(g, plane.centre, normal));
    layerAxis_ = plane.interpolation == Interpolation::linear && deep_.count > 1 ? axisAlongNormal() : -1;
    if (layerAxis_ >= 0) layerKernel_ = chooseLayerKernel(volume.stored(), layerAxis_);
    samples_ = std::visit([](const auto& v) { return static_cast<const void*>(v.data()); }, volume.stored());
  }

  // Tiles stand in rows of tilesAcross(), each tileRows() pixels high.
  int tileRows() const { return tileRows_; }
  int tilesAcross() const { return (size_.x + tileColumns_ - 1) / tileColumns_; }
  std::int64_t tiles() const { return std::int64_t(tilesAcross()) * ((size_.y + tileRows_ - 1) / tileRows_); }

  // Writes the pixels of tile n.
  void draw(std::int64_t n, Slabs& slabs, float* values) const {
    const int left = int(n % tilesAcross()) * tileColumns_, top = int(n / tilesAcross()) * tileRows_;
    const int right = std::min(left + tileColumns_, size_.x), bottom = std::min(top + tileRows_, size_.y);
    for (int y = top; y < bottom; ++y) {
      float* const row = values + std::int64_t(y) * size_.x;
      std::fill(row + left, row + right, float(nan));
    }
    const Tile tile{common({left * perPixel_, right * perPixel_}, columnsInBox_),
                    common({top * perPixel_, bottom * perPixel_}, rowsInBox_)};
    if (tile.count() == 0) return;
    if (deep_.count == 1)
      takePlane(tile, slabs);
    else
      takeSlabs(tile, slabs);
    if (perPixel_ == 1)
      copy(tile, slabs, values);
    else
      average(tile, slabs, {left, top}, {right, bottom}, values);
  }

 private:
  // Tile size in (sub-)samples. Voxels read at one depth must stay in the cache for the next, although voxels
  // above each other share few cache sets.
  static constexpr int columnsATile = 256, rowsATile = 16;

  void copy(const Tile& tile, const Slabs& slabs, float* values) const {
    const double* value = slabs.value.data();
    for (std::int64_t y = tile.rows.first; y < tile.rows.last; ++y)
      for (std::int64_t x = tile.columns.first; x < tile.columns.last; ++x)
        values[y * size_.x + x] = volume_.realValue(*value++);
  }

  void average(const Tile& tile, const Slabs& slabs, glm::ivec2 from, glm::ivec2 to, float* values) const {
    for (int y = from.y; y < to.y; ++y)
      for (int x = from.x; x < to.x; ++x) {
        const SampleRange columns = common({x * perPixel_, (x + 1) * perPixel_}, tile.columns),
                          rows = common({y * perPixel_, (y + 1) * perPixel_}, tile.rows);
        double sum = 0;
        std::int64_t counted = 0;
        for (std::int64_t v = rows.first; v < rows.last; ++v) {
          const double* row = slabs.value.data() + (v - tile.rows.first) * tile.width() - tile.columns.first;
          for (std::int64_t u = columns.first; u < columns.last; ++u)
            if (!std::isnan(row[u])) sum += row[u], ++counted;
        }
        if (counted) values[std::int64_t(y) * size_.x + x] = volume_.realValue(sum / double(counted));
      }
  }

  void takePlane(const Tile& tile, Slabs& slabs) const {
    slabs.value.assign(tile.count(), nan);
    overLines(tile, 0, slabs.samples, [&](std::int64_t at, std::int64_t count, const float* samples) {
      std::copy_n(samples, count, slabs.value.data() + at);
    });
  }

  void takeSlabs(const Tile& tile, Slabs& slabs) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    slabs.value.resize(tile.count());
    if (mode_ == SlabMode::mean) return takeMeans(tile, slabs);
    const bool largest = mode_ == SlabMode::max;
    slabs.extreme.assign(tile.count(), largest ? -infinity : infinity);
    overDepths(tile, slabs, [&](std::int64_t at, std::int64_t count, const float* samples) {
      float* const extreme = slabs.extreme.data() + at;
      if (largest)
        for (std::int64_t n = 0; n < count; ++n) extreme[n] = std::max(extreme[n], samples[n]);
      else
        for (std::int64_t n = 0; n < count; ++n) extreme[n] = std::min(extreme[n], samples[n]);
    });
    std::transform(slabs.extreme.begin(), slabs.extreme.end(), slabs.value.begin(),
                   [](float v) { return std::isinf(v) ? nan : double(v); });
  }

  void takeMeans(const Tile& tile, Slabs& slabs) const {
    slabs.sum.assign(tile.count(), 0);
    slabs.counted.assign(tile.count(), 0);
    overDepths(tile, slabs, [&](std::int64_t at, std::int64_t count, const float* samples) {
      for (std::int64_t n = 0; n < count; ++n) slabs.sum[at + n] += samples[n], ++slabs.counted[at + n];
    });
    for (std::size_t n = 0; n < slabs.value.size(); ++n)
      slabs.value[n] = slabs.counted[n] ? slabs.sum[n] / slabs.counted[n] : nan;
  }

  // Returns the volume axis along the normal if pixel rows lie in layers of voxels; else -1.
  int axisAlongNormal() const {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      if (normal_[b] == 0 && normal_[c] == 0 && right_[a] == 0 && below_[a] == 0) return a;
    }
    return -1;
  }

  // Works like overLines() for every depth. If depths run along a volume axis, each voxel layer is
  // interpolated once, and values between two layers are linear.
  template <class Use>
  void overDepths(const Tile& tile, Slabs& slabs, const Use& use) const {
    if (layerAxis_ < 0) {
      for (std::int64_t w = depthsInBox_.first; w < depthsInBox_.last; ++w)
        overLines(tile, w, slabs.samples, use);
      return;
    }
    slabs.layers[0].voxel = slabs.layers[1].voxel = -1;
    slabs.inside.clear();
    for (std::int64_t v = tile.rows.first; v < tile.rows.last; ++v)
      slabs.inside.push_back(insideBox(inLayer(v, 0), tile.columns, volume_.size()));
    for (std::int64_t w = depthsInBox_.first; w < depthsInBox_.last; ++w) betweenLayers(tile, w, slabs, use);
  }

  // Returns a row of pixels on a layer of voxels.
  SampleLine inLayer(std::int64_t v, int voxel) const {
    SampleLine line = lineAt(v, 0);
    line.start[layerAxis_] = voxel;
    return line;
  }

  template <class Use>
  void betweenLayers(const Tile& tile, std::int64_t w, Slabs& slabs, const Use& use) const {
    const int last = volume_.size()[layerAxis_] - 1;
    const double x = lineAt(tile.rows.first, w).at(0, layerAxis_);
    if (x < -0.5 || x > last + 0.5) return;
    const double within = std::clamp(x, 0.0, double(last));
    const int voxel = int(within);
    const float part = float(within - voxel);
    const float* low = layer(tile, voxel, slabs);
    const float* high = layer(tile, std::min(voxel + 1, last), slabs);
    slabs.samples.resize(tile.width() + lineSlack);
    for (std::size_t row = 0; row < slabs.inside.size(); ++row) {
      const SampleRange inside = slabs.inside[row];
      const std::int64_t at = std::int64_t(row) * tile.width() + inside.first - tile.columns.first,
                         count = inside.last - inside.first;
      for (std::int64_t n = 0; n < count; ++n)
        slabs.samples[n] = low[at + n] + part * (high[at + n] - low[at + n]);
      use(at, count, slabs.samples.data());
    }
  }

  // Returns the tile's values on one layer of voxels. The layer asked for before it stays cached.
  const float* layer(const Tile& tile, int voxel, Slabs& slabs) const {
    Layer& layer = slabs.layers[voxel % 2];
    if (layer.voxel == voxel) return layer.values.data();
    layer.voxel = voxel;
    layer.values.resize(tile.count() + lineSlack);
    float* row = layer.values.data() - tile.columns.first;
    for (std::int64_t v = tile.rows.first; v < tile.rows.last; ++v, row += tile.width()) {
      const SampleRange inside = slabs.inside[v - tile.rows.first];
      if (inside.first < inside.last)
        layerKernel_(samples_, volume_.size(), inLayer(v, voxel), inside, row + inside.first);
    }
    return layer.values.data();
  }

  // Calls use(index in the tile, count, samples) for the part of each row of the tile that lies in the box at
  // depth w.
  template <class Use>
  void overLines(const Tile& tile, std::int64_t w, std::vector<float>& samples, const Use& use) const {
    samples.resize(tile.width() + lineSlack);
    for (std::int64_t v = tile.rows.first; v < tile.rows.last; ++v) {
      const SampleLine line = lineAt(v, w);
      const SampleRange inside = insideBox(line, tile.columns, volume_.size());
      if (inside.first == inside.last) continue;
      kernel_(samples_, volume_.size(), line, inside, samples.data());
      use((v - tile.rows.first) * tile.width() + inside.first - tile.columns.first,
          inside.last - inside.first, samples.data());
    }
  }

  SampleLine lineAt(std::int64_t v, std::int64_t w) const {
    const double y = down_.first + double(v) * down_.distance, z = deep_.first + double(w) * deep_.distance;
    return {centre_ + across_.first * right_ + y * below_ + z * normal_, across_.distance * right_};
  }

  const Volume& volume_;
  glm::ivec2 size_;             // pixels
  std::int64_t perPixel_;       // sub-samples along a side of a pixel
  int tileColumns_, tileRows_;  // pixels
  SlabMode mode_;
  LineKernel kernel_, layerKernel_ = nullptr;
  int layerAxis_ = -1;  // axis of the slab's depths; -1: none
  Samples across_, down_, deep_;
  glm::dvec3 centre_, right_, below_, normal_;  // voxel space; directions in voxels per mm
  SampleRange columnsInBox_, rowsInBox_, depthsInBox_;
  const void* samples_;
};

}  // namespace

namespace {

// Draws tiles from `first` up to, not including, `last`. `values` is the first pixel of the picture.
Status drawTiles(const Resampler& resampler, std::int64_t first, std::int64_t last, float* values,
                 int threads, const CancelToken& cancel) {
  parallelFor(last - first, threads, [&](std::int64_t begin, std::int64_t end) {
    Slabs slabs;
    for (std::int64_t n = begin; n < end && !cancel.cancelled(); ++n)
      resampler.draw(first + n, slabs, values);
  });
  if (cancel.cancelled()) return Error{"cancelled"};
  return {};
}

}  // namespace

Result<SliceValues> resampleSlice(const Volume& volume, const SlicePlane& plane, int threads,
                                  const CancelToken& cancel) {
  if (Status s = checkPlane(plane); !s) return s.error();
  SliceValues out{plane.size, std::vector<float>(std::size_t(plane.size.x) * plane.size.y)};
  const Resampler resampler(volume, plane);
  if (Status s = drawTiles(resampler, 0, resampler.tiles(), out.values.data(), threads, cancel); !s)
    return s.error();
  return out;
}

Status resampleSliceByRows(const Volume& volume, const SlicePlane& plane,
                           const std::function<Status(std::span<const float>)>& use,
                           const CancelToken& cancel) {
  constexpr std::int64_t pixelsAtOnce = 1 << 22;
  if (Status s = checkPlane(plane); !s) return s.error();
  const Resampler resampler(volume, plane);
  const std::int64_t across = resampler.tilesAcross(),
                     aRow = std::int64_t(plane.size.x) * resampler.tileRows(),
                     rowsAtOnce = std::max<std::int64_t>(1, pixelsAtOnce / aRow);
  std::vector<float> values(
      std::size_t(std::min(rowsAtOnce * aRow, plane.size.x * std::int64_t(plane.size.y))));
  for (std::int64_t row = 0; row * across < resampler.tiles(); row += rowsAtOnce) {
    const std::int64_t last = std::min(resampler.tiles(), (row + rowsAtOnce) * across);
    if (Status s = drawTiles(resampler, row * across, last, values.data() - row * aRow, 0, cancel); !s)
      return s;
    const std::int64_t left = std::int64_t(plane.size.x) * plane.size.y - row * aRow;
    if (Status s = use(std::span(values).first(std::size_t(std::min(left, rowsAtOnce * aRow)))); !s) return s;
  }
  return {};
}

}  // namespace volumen
