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

/// An attribute by which the volumes of one series were told apart, and what it is in one of them.
struct SplitBy {
  std::string attribute;  ///< its DICOM keyword: "ConvolutionKernel"; "rank" where none told them apart
  std::string value;      ///< as in the file
  std::string words;      ///< for people, with the unit: "kernel B70f", "phase 40 %"
  bool operator==(const SplitBy&) const = default;
};

/// From which side a picture was made, and by which view: as SeriesIdentity has them.
struct ProjectionView {
  std::string laterality, viewPosition;
  bool operator==(const ProjectionView&) const = default;
};

/// One volume that was found, or pictures that are none: plain values that the rest of the program sees, and
/// how to load it.
struct Series : SeriesIdentity {
  std::string id;  ///< SeriesInstanceUID or file name, "#n" behind it where that holds several (design.md 10)
  std::string path;           ///< the file, or the folder that holds the files
  std::string format;         ///< "DICOM", "phantom" or that of the file: "NRRD", "NIfTI", "MetaImage", ...
  std::string unit;           ///< of the values: "HU", "Bq/ml", "SUV"; empty where they have none
  SuvFactors suv;             ///< of PET
  std::string contrastAgent;  ///< DICOM: as in the file, of codes their words; empty: it names none
  std::string time;           ///< of day, as DICOM writes it: of the acquisition, else of the series
  std::string echoTime;       ///< ms, as in the file; empty where it is not given
  std::string bValue;         ///< diffusion weight, s/mm^2, as in the file; empty where it is not given
  std::string timePoint;      ///< of a series in time, as in the file; empty where it is not given
  std::string label;          ///< what else tells it from the other volumes of its series or file, in a few
                              ///< words: "direction 12", "component x", "2 of 5"; empty where nothing does

  std::vector<SplitBy> splitBy;  ///< what tells it from the other volumes of its series, first things first
  double sliceThickness = 0;     ///< SliceThickness, mm; 0: not given, or not the same of all slices

  VoxelGeometry
      acquired;  ///< the slices as acquired; spacing along k: mean distance along the step between slices
  std::string valueType;  ///< "uint8", "int16", "uint16", "float32"
  std::vector<Warning> warnings;

  /// The drawn grid, where it differs from the slices as acquired (uneven or missing slices).
  struct Regular {
    VoxelGeometry geometry;
    int interpolatedSlices = 0;
    std::vector<int> copies;  ///< of each slice: the one as acquired that it is; -1: interpolated
    bool operator==(const Regular&) const = default;
  };
  std::optional<Regular> regular;

  std::vector<std::string> files;  ///< every file it is made of, in slice order (one file for NRRD etc.)
  std::vector<int> frames;         ///< DICOM: the frame (from 0) of each of `files` that is the slice
  std::vector<std::string> sopInstanceUids;  ///< DICOM: of each of `files`
  std::vector<PictureOrder> orders;          ///< DICOM volumes: of each of `files`
  std::vector<ProjectionView> projections;   ///< DICOM: of each of `files`, where they differ; else empty
  std::vector<Unread> unread;                ///< DICOM: what is lost of it; also told in `warnings`

  std::string notVolume;  ///< why these are only frames: a sentence; empty: it is a volume
  Cine cine;              ///< of frames

  std::optional<CurvedFrom> curved;  ///< it is no file's: another series, resampled along a curve
  bool operator==(const Series&) const = default;
};

/// Keeps what each of its files says, where they differ; side or view of the series are then empty unless all
/// agree.
void setProjections(Series& series, std::vector<ProjectionView> ofEach);

/// Side and view of a frame as acquired, from 0; of one that there is not, what all frames share.
ProjectionView projectionOf(const Series& series, int frame);

}  // namespace volumen
