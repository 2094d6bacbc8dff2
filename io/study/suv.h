#pragma once

#include <optional>
#include <string>

namespace volumen {

struct Series;

/// Factors from the values of a PET series to standardised uptake values (slices.md 4). All members are empty
/// for other series.
struct SuvFactors {
  std::optional<double> bodyWeight;    ///< factor to SUVbw, g/ml
  std::optional<double> leanBodyMass;  ///< factor to SUVlbm, g/ml
  std::optional<double> bodySurface;   ///< factor to SUVbsa, cm^2/ml
  std::string why;  ///< reason for a missing factor: "PatientWeight (0010,1030) is missing"
  bool operator==(const SuvFactors&) const = default;
};

/// The unit PET values are shown in: an SUV, or the unit of the file.
enum class PetUnit { suvBodyWeight, suvLeanBodyMass, suvBodySurface, file };

/// Returns "SUVbw", "SUVlbm", "SUVbsa" or "file".
const char* petUnitName(PetUnit unit);

/// Scale from the values of a series to the numbers that people read.
struct ValueScale {
  double factor = 1;  ///< above 0
  std::string unit;   ///< empty if there is none
  std::string why;    ///< why it is not the wanted unit: "no SUV: PatientWeight (0010,1030) is missing"
  bool operator==(const ValueScale&) const = default;
};

/// Returns the scale in which `series` is shown. `wanted` applies to PET alone.
ValueScale valueScale(const Series& series, PetUnit wanted);

}  // namespace volumen
