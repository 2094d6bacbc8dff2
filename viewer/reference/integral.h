#pragma once

#include <vector>

#include "viewer/reference/cell.h"
#include "viewer/reference/curve.h"
#include "viewer/reference/lighting.h"
#include "viewer/reference/march.h"
#include "viewer/volume/volume.h"

namespace volumen::reference {

/// The transfer function of a scene (picture.md 4).
struct Classifier {
  explicit Classifier(const TransferFunction& function, const VoxelGeometry& geometry);
  /// Whether any value in low .. high has an opacity above 0.
  bool visible(double low, double high) const;
  /// Whether any value in this segment of the curve has.
  bool visible(int segment) const;
  /// Extinction per mm.
  double extinction(double opacity) const;

  Curve<glm::dvec4> colourOpacity;  ///< r, g, b, opacity over the value
  Curve<double> gradientFactor;     ///< over |g_p|; empty: 1
  double unitDistanceMm, densestPerMm;
};

/// The integral of picture.md 6 along one ray, fed with its cells front to back.
///
/// Inside a cell the density is a cubic along the ray. The piece is cut wherever a formula changes: at the
/// points of the curve, so that its steps and kinks lie between pieces, and at the kinks of gradient opacity
/// and shading. What is left between two cuts is smooth; it is integrated with three Gauss points and split
/// until the answer of a piece and that of its halves agree.
class RayIntegral {
 public:
  RayIntegral(const Volume& volume, const Classifier& classifier, const Lighting& lighting)
      : volume_(volume), classifier_(classifier), lighting_(lighting) {}

  /// Adds one cell. False where the rest of the ray cannot be seen any more.
  bool add(const CellPiece& piece);
  /// Adds a surface: what is behind it is seen through 1 - opacity. False likewise.
  bool cover(glm::dvec3 colour, double opacity);
  glm::dvec3 colour() const { return colour_; }            ///< C
  double transmittance() const { return transmittance_; }  ///< T

 private:
  /// What a stretch of the ray adds (seen through nothing), and its optical depth.
  struct Interval {
    glm::dvec3 colour;
    double depth;
  };
  struct Sample {
    glm::dvec3 colour;
    double extinctionPerMm;
  };

  template <class Values>
  bool visible(const Values& values) const;
  void cutAtFormulaChanges();
  bool opaque() const;
  void integrate(double a, double b, const Interval& whole, int splitsLeft);
  bool agree(double a, double b, const Interval& whole, const Interval& halves) const;
  bool normalsKeepTogether(double a, double b) const;
  Interval gauss(double a, double b) const;
  Sample sample(double s) const;
  static Interval over(const Interval& front, const Interval& back);

  const Volume& volume_;
  const Classifier& classifier_;
  const Lighting& lighting_;
  glm::dvec3 colour_{0};
  double transmittance_ = 1;

  // The cell in hand:
  double lengthMm_ = 0;
  Cubic value_;
  CubicVector gradient_;  // g_p, value per mm
  std::vector<double> cuts_;
  // The piece between two cuts in hand:
  int segment_ = 0, factorSegment_ = 0;
};

}  // namespace volumen::reference
