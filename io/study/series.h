#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/cine.h"
#include "io/study/curved_from.h"
#include "io/study/identity.h"
#include "io/study/suv.h"
#include "io/study/unread.h"
#include "io/study/warning.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// An attribute that separates the volumes of one series, with its value in one volume.
struct SplitBy {
  std::string attribute;  ///< DICOM keyword, "ConvolutionKernel"; "rank" if no attribute separates them
  std::string value;      ///< value as in the file
  std::string words;      ///< value for people, with its unit: "kernel B70f", "phase 40 %"
  bool operator==(const SplitBy&) const = default;
};

/// Side and view of a projection, in the form of SeriesIdentity.
struct ProjectionView {
  std::string laterality, viewPosition;
  bool operator==(const ProjectionView&) const = default;
};

/// A volume, or pictures that form no volume, as found from headers alone. Holds plain values for the rest of
/// the program and everything that loading needs.
struct Series : SeriesIdentity {
  std::string id;  ///< SeriesInstanceUID or file name, followed by "#n" if that holds several (design.md 10)
  std::string path;    ///< the file, or the folder that holds the files
  std::string format;  ///< "DICOM", "phantom" or the format of the file: "NRRD", "NIfTI", "MetaImage", ...
  std::string unit;    ///< unit of the values: "HU", "Bq/ml", "SUV"; empty if they have none
  SuvFactors suv;      ///< factors to SUV (PET)
  std::string contrastAgent;  ///< agent named by the file, or its code's meaning; may be empty
  std::string time;           ///< time of day as DICOM writes it: of the acquisition, else of the series
  std::string echoTime;       ///< ms, as in the file; empty if not given
  std::string bValue;         ///< diffusion weighting, s/mm^2, as in the file; empty if not given
  std::string timePoint;      ///< time point of a series in time, as in the file; empty if not given
  /// Words for other differences from the volumes of its series or file: "direction 12",
  /// "component x", "2 of 5"; may be empty.
  std::string label;

  /// Attributes that separate it from the other volumes of its series, most important first.
  std::vector<SplitBy> splitBy;
  double sliceThickness = 0;  ///< SliceThickness, mm; 0 if not given or not equal in all slices

  /// The slices as acquired. Spacing along k is their mean distance along the step between slices.
  VoxelGeometry acquired;
  std::string valueType;  ///< "uint8", "int16", "uint16", "float32"
  std::vector<Warning> warnings;

  /// The drawn grid if it differs from the slices as acquired (uneven or missing slices).
  struct Regular {
    VoxelGeometry geometry;
    int interpolatedSlices = 0;
    std::vector<int> copies;  ///< for each slice the index of its acquired slice; -1 if interpolated
    bool operator==(const Regular&) const = default;
  };
  std::optional<Regular> regular;

  std::vector<std::string> files;            ///< files of the slices in their order; one file for NRRD etc.
  std::vector<int> frames;                   ///< frame (from 0) of each entry of `files` (DICOM)
  std::vector<std::string> sopInstanceUids;  ///< one for each entry of `files` (DICOM)
  std::vector<PictureOrder> orders;          ///< one for each entry of `files` (DICOM volumes)
  std::vector<ProjectionView> projections;   ///< one for each of `files`; empty if all are alike (DICOM)
  std::vector<Unread> unread;                ///< files lost to the series (DICOM); `warnings` names them too

  std::string notVolume;  ///< why these are frames only: a sentence; empty for a volume
  Cine cine;              ///< timing of frames

  /// Set if this series is another one resampled along a curve, without files of its own.
  std::optional<CurvedFrom> curved;
  bool operator==(const Series&) const = default;
};

/// Stores side and view of each file if they differ. The series' own side and view become empty unless all
/// files agree.
void setProjections(Series& series, std::vector<ProjectionView> ofEach);

/// Returns side and view of an acquired frame (from 0), or those that all frames share if there is no such
/// frame.
ProjectionView projectionOf(const Series& series, int frame);

}  // namespace volumen
