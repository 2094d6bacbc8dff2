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
  /// Returns true if any value in low .. high has an opacity above 0.
  bool visible(double low, double high) const;
  /// Returns true if any value in this segment of the curve has an opacity above 0.
  bool visible(int segment) const;
  /// Returns the extinction per mm.
  double extinction(double opacity) const;

  Curve<glm::dvec4> colourOpacity;  ///< Red, green, blue and opacity over the value.
  Curve<double> gradientFactor;     ///< Factor over |g_p|; if empty, 1.
  double unitDistanceMm, densestPerMm;
};

/// The integral of picture.md 6 along one ray. Its cells are added front to back.
///
/// Inside a cell the density is a cubic along the ray. The piece is cut wherever a formula changes. These are
/// the points of the curve, so that its steps and kinks lie between pieces, and the kinks of gradient opacity
/// and shading. Between two cuts everything is smooth. It is integrated with three Gauss points, and split
/// until a piece and its halves agree.
class RayIntegral {
 public:
  RayIntegral(const Volume& volume, const Classifier& classifier, const Lighting& lighting)
      : volume_(volume), classifier_(classifier), lighting_(lighting) {}

  /// Adds one cell. Returns false if the rest of the ray can no longer be seen.
  bool add(const CellPiece& piece);
  /// Adds a surface; the rest of the ray is seen through 1 - opacity. Returns false as add() does.
  bool cover(glm::dvec3 colour, double opacity);
  glm::dvec3 colour() const { return colour_; }            ///< C of picture.md 6.
  double transmittance() const { return transmittance_; }  ///< T of picture.md 6.

 private:
  /// Contribution of a stretch of the ray (with nothing in front), and its optical depth.
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

  // The current cell:
  double lengthMm_ = 0;
  Cubic value_;
  CubicVector gradient_;  // The gradient g_p, value per mm.
  std::vector<double> cuts_;
  // The current piece between two cuts:
  int segment_ = 0, factorSegment_ = 0;
};

}  // namespace volumen::reference
