#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/suv.h"
#include "io/warning.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Whose pictures these are and which series they belong to. Text is UTF-8, exactly as in the file; whoever
/// shows it escapes control characters.
struct SeriesIdentity {
  std::string patientName, patientId;
  std::string patientIdIssuer;   ///< whose number patientId is; empty: not given
  std::string patientBirthDate;  ///< as DICOM writes it, YYYYMMDD
  std::string patientSex;        ///< "F", "M", "O"
  std::string patientAge;        ///< at the study, as DICOM writes it: "045Y"
  std::string studyUid, studyDate, studyTime, studyId, accessionNumber, studyDescription;
  std::string seriesUid, seriesNumber, modality, description;
  std::string bodyPart, laterality;  ///< as in the file: "BREAST", "L"
  std::string viewPosition;          ///< of projections, as in the file: "MLO", "PA"
  std::string frameOfReferenceUid;   ///< positions of one frame of reference are comparable; empty: not given
  std::optional<std::string> lossyRatio;  ///< of pictures with losses by compression, as in the file: "20",
                                          ///< empty where it is not given; none: they have none
  bool operator==(const SeriesIdentity&) const = default;
};

/// How the frames of a clip follow each other (PS3.3 C.7.6.5).
struct Cine {
  double framesPerSecond = 0;        ///< as the file recommends; 0: it does not
  std::vector<double> frameTimesMs;  ///< from the frame before to each frame; empty: always the same
  bool backAndForth = false;         ///< PreferredPlaybackSequencing 1
  bool operator==(const Cine&) const = default;
};

/// An attribute by which the volumes of one series were told apart, and what it is in one of them.
struct SplitBy {
  std::string attribute;  ///< its DICOM keyword: "ConvolutionKernel"; "rank" where none told them apart
  std::string value;      ///< as in the file
  std::string words;      ///< for people, with the unit: "kernel B70f", "phase 40 %"
  bool operator==(const SplitBy&) const = default;
};

/// A file that could not be read; the reason stands behind its name: "F: compressed with bzip2, ...".
struct Refused {
  std::string path, reason;
  bool again = false;  ///< what failed was the machine, not the file: it is worth another try
  bool operator==(const Refused&) const = default;
};

/// A file of a series that could not be read, or one beside its files that does not say whose it is.
struct Unread : Refused {
  bool beside = false;                 ///< its header could not be read: it may be of another series
  std::optional<glm::dvec3> position;  ///< of its slice, mm (LPS); empty: not known
  bool operator==(const Unread&) const = default;
};

/// One volume that was found, or pictures that are none: plain values that the rest of the program sees, and
/// how to load it.
struct Series : SeriesIdentity {
  std::string id;  ///< SeriesInstanceUID or file name, "#n" behind it where that holds several (design.md 10)
  std::string path;       ///< the file, or the folder that holds the files
  std::string format;     ///< "DICOM", "phantom" or that of the file: "NRRD", "NIfTI", "MetaImage", ...
  std::string unit;       ///< of the values: "HU", "Bq/ml", "SUV"; empty where they have none
  SuvFactors suv;         ///< of PET
  std::string time;       ///< of day, as DICOM writes it: of the acquisition, else of the series
  std::string echoTime;   ///< ms, as in the file; empty where it is not given
  std::string bValue;     ///< diffusion weight, s/mm^2, as in the file; empty where it is not given
  std::string timePoint;  ///< of a series in time, as in the file; empty where it is not given
  std::string label;      ///< what else tells it from the other volumes of its series or file, in a few
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
  std::vector<Unread> unread;                ///< DICOM: what is lost of it; also told in `warnings`

  std::string notVolume;  ///< why these are only frames: a sentence; empty: it is a volume
  Cine cine;              ///< of frames
  bool operator==(const Series&) const = default;
};

/// A DICOM file that is no volume and whose frames can be shown as acquired (io/frames.h): colour, clips,
/// frames without a place.
struct Image : SeriesIdentity {
  std::string id;         ///< SOPInstanceUID or file name, "#n" behind it where several are alike
  std::string path;       ///< of the file
  std::string notVolume;  ///< why it is no volume: a sentence without the file's name
  std::string sopInstanceUid, sopClassUid;
  int frames = 1, rows = 0, columns = 0;
  std::string photometric;  ///< PhotometricInterpretation
  Cine cine;
};

/// A picture, or some of its frames, that an object refers to.
struct ReferencedPicture {
  std::string sopInstanceUid;
  std::string seriesUid;      ///< empty where it is not said
  std::vector<int> frames;    ///< from 0, in order; none: all of them
  std::vector<int> segments;  ///< of a segmentation, their numbers; none: all of them
};

/// What kind of object refers to pictures.
enum class ReferenceKind {
  presentation,  ///< softcopy presentation states: how pictures are to be shown (io/presentation.h)
  keyObjects,    ///< Key Object Selection: pictures that are marked (io/report.h)
  report,        ///< structured reports, among them TID 1500 (io/report.h)
  contours,      ///< RTSTRUCT: regions of interest (io/contours.h)
  segmentation   ///< SEG (io/segmentation.h)
};

/// The kind's name for people and scripts: "presentation state".
const char* kindName(ReferenceKind kind);

/// A DICOM object that refers to pictures and can be read by itself.
struct Reference : SeriesIdentity {
  ReferenceKind kind = ReferenceKind::report;
  std::string id;  ///< SOPInstanceUID or file name, "#n" behind it where several are alike
  std::string path, sopInstanceUid, sopClassUid;
  std::string label;  ///< of presentation states, structure sets and segmentations; the title of documents
  std::string text;   ///< the description that goes with it; of key objects what is said of the pictures
  std::string date;   ///< as DICOM writes it: of the content; empty where it is not given
  std::vector<ReferencedPicture> pictures;  ///< pictures and other objects, each once
  std::size_t notHere = 0;                  ///< how many of `pictures` the study does not hold
};

/// Valid, but no volume: SR, RT, DICOMDIR, a text file. What refers to pictures is in Study::references, too.
struct Other {
  std::string path, kind;
};

/// All that one PATH holds. Volumes in `info`'s order: patient, study, series number, position; images and
/// references by patient, study, series number and path. Of the other lists what is in one is in none else.
struct Study {
  std::vector<Series> volumes;
  std::vector<Image> images;
  std::vector<Refused> refused;
  std::vector<Other> other;
  std::vector<Reference> references;  ///< their files are in `other`, too
};

/// Called now and then with what is being done ("reading headers"), how many of how many. From the calling
/// thread.
using Progress = std::function<void(const char* what, std::size_t done, std::size_t total)>;

/// What is under `path`: a file, a folder (nested; links followed, to folders only below it, each file once),
/// a DICOMDIR (all below its folder; no links out of it), a zip archive (unpacked until the program ends) or
/// what is in one ("a.zip/CT"), or "phantom:NAME[:SIZE]".
/// Reads headers only. An Error where there is no such path; what cannot be loaded is in `refused` with its
/// reason.
Result<Study> openStudy(const std::string& path, const Progress& progress = {},
                        const CancelToken& cancel = {});

/// The same of what lies directly in these folders, whose names are told from `path`. Folders that are not
/// there hold nothing.
Result<Study> openFolders(const std::string& path, const std::vector<std::string>& folders,
                          const Progress& progress = {}, const CancelToken& cancel = {});

/// What these files hold, as if they were all that is in a folder. An Error only where it was cancelled.
Result<Study> openFiles(const std::vector<std::string>& files, const Progress& progress = {},
                        const CancelToken& cancel = {});

/// What a drawn slice of a DICOM series was made of: entries of Series::files. Two that differ: it lies
/// between them and is interpolated.
struct SliceOrigin {
  int below = 0, above = 0;
  bool isInterpolated() const { return below != above; }
};

/// A loaded series. `acquired` holds the slices as acquired (what `info --values` describes); `drawn` the
/// regular grid (the same pointer where they do not differ). `warnings`: the series' and those of loading.
struct Loaded {
  VolumePtr acquired, drawn;
  std::vector<Warning> warnings;
  std::vector<Unread> unread = {};        ///< the series' and those of loading
  std::vector<SliceOrigin> origins = {};  ///< DICOM: of each drawn slice

  /// How many slices of `drawn` are not as acquired.
  int interpolatedSlices() const;
};

/// Reads and decodes a series. An Error names the file and why.
Result<Loaded> loadSeries(const Series& series, const Progress& progress = {},
                          const CancelToken& cancel = {});

/// The series that `--series` means: an id, a UID or its number (from 1) in the study's order; empty: the one
/// with most voxels. An Error where nothing is meant by it.
Result<std::size_t> chooseSeries(const Study& study, const std::string& text);

}  // namespace volumen
