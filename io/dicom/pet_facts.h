#pragma once

#include <string>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// The attributes of a PET file about uptake, as written, each at most 64 bytes; empty if not given.
struct PetFacts {
  std::string units, suvType, decayCorrection;
  std::string weight, size;                       ///< the patient's weight (kg) and size (m)
  std::string dose, halfLife;                     ///< the tracer's dose (Bq) and half-life (s)
  std::string injectionDateTime, injectionTime;   ///< DT, TM
  std::string zone;                               ///< TimezoneOffsetFromUTC
  std::string decayedTo;                          ///< DecayCorrectionDateTime, DT
  std::string seriesDate, seriesTime;             ///< DA, TM
  std::string acquisitionDate, acquisitionTime;   ///< DA, TM
  std::string geScanStart;                        ///< private attribute of GE, DT
  std::string philipsSuvFactor, philipsBqFactor;  ///< factors from counts to SUVbw and to Bq/ml
  int injections = 0;       ///< number of items of RadiopharmaceuticalInformationSequence
  bool isEnhanced = false;  ///< units and corrections are given as in enhanced PET
  bool attenuationCorrected = false, decayCorrected = false;
  /// SUVType of the values of a real world value mapping: "BW", "LBMJAMES128", "BSA".
  std::string mappedType;
  double mappedFactor = 0;  ///< factor from the file's values to that SUV; 0 if there is no such mapping
  bool operator==(const PetFacts&) const = default;
};

/// Returns text as printable ASCII without markup, at most 64 bytes. Other characters become '?'.
std::string plain(std::string text);

/// Returns whether two factors from values to an SUV differ only by rounding; false if one is 0.
bool isOneFactor(double a, double b);

/// Returns the SUVType of a UCUM code ("{SUVbw}g/ml": "BW"); empty if it is no SUV.
std::string suvTypeOfCode(const std::string& code);

/// Reads the facts of a classic, enhanced or legacy converted PET file. Legacy converted files keep some of
/// them in sequences of unassigned attributes.
PetFacts readPetFacts(const DataSet& data);

}  // namespace volumen::dicom
