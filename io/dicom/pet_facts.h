#pragma once

#include <string>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// What a PET file says of the uptake of its patient, as it is written, each at most 64 bytes; empty: not
/// given.
struct PetFacts {
  std::string units, suvType, decayCorrection;
  std::string weight, size;                       ///< of the patient: kg, m
  std::string dose, halfLife;                     ///< of the tracer: Bq, s
  std::string injectionDateTime, injectionTime;   ///< DT, TM
  std::string zone;                               ///< TimezoneOffsetFromUTC
  std::string decayedTo;                          ///< DecayCorrectionDateTime, DT
  std::string seriesDate, seriesTime;             ///< DA, TM
  std::string acquisitionDate, acquisitionTime;   ///< DA, TM
  std::string geScanStart;                        ///< GE's own, DT
  std::string philipsSuvFactor, philipsBqFactor;  ///< from counts to SUVbw and to Bq/ml
  int injections = 0;                             ///< items of RadiopharmaceuticalInformationSequence
  bool isEnhanced = false;                        ///< its units and corrections are those of enhanced PET
  bool attenuationCorrected = false, decayCorrected = false;
  std::string
      mappedType;  ///< SUVType of the values of a real world value mapping: "BW", "LBMJAMES128", "BSA"
  double mappedFactor = 0;  ///< from the values of the file to those; 0: there is no such mapping
  bool operator==(const PetFacts&) const = default;
};

/// Text of a VR that is ASCII and no markup, at most 64 bytes; whatever else stands there shows as '?'.
std::string plain(std::string text);

/// Whether two factors from values to an SUV differ by no more than rounding; never where one is 0.
bool isOneFactor(double a, double b);

/// The SUVType that a UCUM code stands for ("{SUVbw}g/ml": "BW"); empty: it is no SUV.
std::string suvTypeOfCode(const std::string& code);

/// Of a PET file: classic, enhanced, or legacy converted, where what has no place of its own stands in
/// sequences of unassigned attributes.
PetFacts readPetFacts(const DataSet& data);

}  // namespace volumen::dicom
