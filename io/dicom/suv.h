#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen {
struct Series;
}

namespace volumen::dicom {

struct FileHeader;

/// What a PET file says of the uptake of its patient, as it is written, each at most 64 bytes; empty: not
/// given.
struct PetFacts {
  std::string units, suvType, decayCorrection;
  std::string weight, size;                       ///< of the patient: kg, m
  std::string dose, halfLife;                     ///< of the tracer: Bq, s
  std::string injectionDateTime, injectionTime;   ///< DT, TM
  std::string zone;                               ///< TimezoneOffsetFromUTC
  std::string seriesDate, seriesTime;             ///< DA, TM
  std::string acquisitionDate, acquisitionTime;   ///< DA, TM
  std::string geScanStart;                        ///< GE's own, DT
  std::string philipsSuvFactor, philipsBqFactor;  ///< from counts to SUVbw and to Bq/ml
  int injections = 0;                             ///< items of RadiopharmaceuticalInformationSequence
  bool attenuationCorrected = false, decayCorrected = false;
  bool operator==(const PetFacts&) const = default;
};

/// Of a PET file, classic or enhanced.
PetFacts readPetFacts(const DataSet& data);

/// Fills in Series::suv of the PET volumes that were made of these files. The scan begins with the earliest
/// picture of all that is here of a series, whatever volumes it was split into.
void addSuvFactors(std::span<const FileHeader> files, std::vector<Series>& volumes);

}  // namespace volumen::dicom
