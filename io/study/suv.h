#pragma once

#include <optional>
#include <string>

namespace volumen {

struct Series;

/// What the values of a PET series are multiplied by to give standardised uptake values (slices.md 4). All
/// empty: it is no PET series.
struct SuvFactors {
  std::optional<double> bodyWeight;    ///< to SUVbw, g/ml
  std::optional<double> leanBodyMass;  ///< to SUVlbm, g/ml
  std::optional<double> bodySurface;   ///< to SUVbsa, cm^2/ml
  std::string why;  ///< where one of them is missing: "PatientWeight (0010,1030) is missing"
  bool operator==(const SuvFactors&) const = default;
};

/// What the values of PET are shown in: an SUV, or the unit of the file.
enum class PetUnit { suvBodyWeight, suvLeanBodyMass, suvBodySurface, file };

/// "SUVbw", "SUVlbm", "SUVbsa", "file".
const char* petUnitName(PetUnit unit);

/// From the values of a series to the numbers that people read.
struct ValueScale {
  double factor = 1;  ///< above 0
  std::string unit;   ///< empty: none
  std::string why;    ///< where it is not what was wanted: "no SUV: PatientWeight (0010,1030) is missing"
  bool operator==(const ValueScale&) const = default;
};

/// The scale in which a series is shown where this is wanted of PET.
ValueScale valueScale(const Series& series, PetUnit wanted);

}  // namespace volumen
