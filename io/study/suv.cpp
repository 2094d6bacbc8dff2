#include "io/study/suv.h"

#include "io/study/series.h"

namespace volumen {

namespace {

const std::optional<double>& factorTo(PetUnit unit, const SuvFactors& suv) {
  return unit == PetUnit::suvLeanBodyMass  ? suv.leanBodyMass
         : unit == PetUnit::suvBodySurface ? suv.bodySurface
                                           : suv.bodyWeight;
}

}  // namespace

const char* petUnitName(PetUnit unit) {
  constexpr const char* names[] = {"SUVbw", "SUVlbm", "SUVbsa", "file"};
  return names[std::size_t(unit)];
}

ValueScale valueScale(const Series& series, PetUnit wanted) {
  const SuvFactors& suv = series.suv;
  if (wanted == PetUnit::file) return {1, series.unit, {}};
  if (const auto& factor = factorTo(wanted, suv)) return {*factor, petUnitName(wanted), {}};
  if (suv.why.empty()) return {1, series.unit, {}};
  const bool others = suv.bodyWeight || suv.leanBodyMass || suv.bodySurface;
  return {1, series.unit, std::string("no ") + (others ? petUnitName(wanted) : "SUV") + ": " + suv.why};
}

}  // namespace volumen
