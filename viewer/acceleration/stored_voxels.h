#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "viewer/plan/facts.h"
#include "viewer/tables/curve_table.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/bytes.h"
#include "viewer/volume/gradient_bricks.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Densities in 16 bits as the kernels read them: the volume's own samples if they fit, else a copy.
struct Density16 {
  const std::int16_t* data = nullptr;
  std::uint32_t flip = 0;  ///< Same as RayInputs::flip16.
  DensityScale scale;
  Buffer<std::int16_t> copy;
};

/// Densities as floats: real values in their units (FloatUnits).
struct Density32 {
  const float* data = nullptr;
  DensityScale scale;
  Buffer<float> copy;
};

/// A volume as pictures read it: facts, densities and gradients in each precision. Each is computed on first
/// use and kept; of the gradients only those of the last operator. Several RenderCaches may share one. Not
/// thread-safe.
class StoredVoxels {
 public:
  /// Called before `bytes` are allocated. May throw std::bad_alloc.
  using MakeRoom = std::function<void(std::size_t bytes)>;

  explicit StoredVoxels(VolumePtr volume, MakeRoom makeRoom = {})
      : volume_(std::move(volume)), makeRoom_(std::move(makeRoom)) {}

  const VolumePtr& volume() const { return volume_; }
  /// Returns the bytes of the data made of the volume, finished or not. Thread-safe.
  std::size_t bytes() const { return bytes_; }
  const VolumeFacts& facts();
  const Density16& densities16();  ///< Available only for integers with a positive slope.
  const Density32& densities32();
  const Density8& densitiesIn8();
  const Gradients16& gradientsIn16(GradientOperator by);
  /// Returns Sobel gradients of at least the bricks with a nonzero entry in `kept`.
  const GradientBricks16& gradientsOfBricks(const std::vector<std::uint8_t>& kept);
  /// Sets whether to keep gradients of visible bricks only, for plans that read no others.
  void spareGradients(bool spare) { spare_ = spare; }
  bool sparesGradients() const { return spare_ && !gradients16_; }
  /// Returns whether `bytes` more are available, if need be after others have made room.
  bool hasRoomFor(std::uint64_t bytes) const;
  std::size_t brickBytes() const { return bricks16_ ? bricks16_->bricks.bytes() : 0; }
  const Gradients32& gradientsIn32(GradientOperator by);
  const Voxels8& voxelsIn8(GradientOperator by);

 private:
  template <class Gradients>
  struct ByOperator {
    GradientOperator by;
    Gradients gradients;
  };
  struct KeptBricks {
    std::vector<std::uint8_t> kept;
    GradientBricks16 bricks;
  };
  std::size_t held() const;
  void begin(std::size_t bytes);

  VolumePtr volume_;
  MakeRoom makeRoom_;
  std::atomic<std::size_t> bytes_{0};
  std::optional<VolumeFacts> facts_;
  std::optional<Density16> density16_;
  std::optional<Density32> density32_;
  std::optional<Density8> density8_;
  std::optional<ByOperator<Gradients16>> gradients16_;
  std::optional<KeptBricks> bricks16_;
  bool spare_ = false;
  std::optional<ByOperator<Gradients32>> gradients32_;
  std::optional<ByOperator<Voxels8>> voxels8_;
};

}  // namespace volumen
