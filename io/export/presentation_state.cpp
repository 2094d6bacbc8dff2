#include "io/export/presentation_state.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <map>
#include <new>

#include "io/export/dicom_file.h"
#include "io/export/dicom_modules.h"
#include "io/export/presentation_elements.h"
#include "io/study/series.h"

namespace volumen {

namespace {

// Returns a text as a ContentLabel, which is of VR CS.
std::string contentLabel(const std::string& label) {
  constexpr std::size_t longest = 16;
  std::string term;
  for (const char c : label.substr(0, longest))
    term += (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ? c
            : c >= 'a' && c <= 'z'                                       ? char(c - 'a' + 'A')
                                                                         : '_';
  return term.find_first_not_of(" _") == std::string::npos ? "VOLUMEN" : term;
}

// Returns the indices of the pictures in the series. Without pictures the result is empty, which stands for
// all. The Error names a picture that the series lacks.
Result<std::vector<std::size_t>> slicesOf(const std::vector<ReferencedPicture>& pictures,
                                          const Series& series) {
  std::vector<std::size_t> slices;
  for (const ReferencedPicture& picture : pictures) {
    const auto found = std::ranges::find(series.sopInstanceUids, picture.sopInstanceUid);
    if (found == series.sopInstanceUids.end())
      return Error{series.id + " has no picture " + picture.sopInstanceUid +
                   ", which the presentation is for."};
    slices.push_back(std::size_t(found - series.sopInstanceUids.begin()));
  }
  return slices;
}

// Checks that each part of the presentation is for pictures that the presentation names.
Status checkParts(const Presentation& p, const std::map<std::string, const DicomSourceFile*>& files) {
  const auto check = [&](const auto& parts) {
    for (const auto& part : parts)
      for (const ReferencedPicture& picture : part.of)
        if (!files.contains(picture.sopInstanceUid)) return false;
    return true;
  };
  if (check(p.greys) && check(p.areas) && check(p.annotations)) return {};
  return Error{"A part of the presentation is for a picture that the presentation does not list."};
}

DicomElements identification(const Presentation& p, const ObjectTags& dated) {
  return {{0x00200013, "1"},
          {0x00700080, contentLabel(p.label)},
          {0x00700081, inOneLine(p.description)},
          {0x00700082, dated.date},
          {0x00700083, dated.time},
          {0x00700084, inOneLine(p.creator)}};
}

}  // namespace

Result<std::vector<std::string>> writePresentationState(const Presentation& presentation,
                                                        const Series& series, const Frame& frame,
                                                        const ObjectTags& tags, const std::string& path,
                                                        const Progress& progress,
                                                        const CancelToken& cancel) try {
  if (frame.colour())
    return Error{series.id + " has pictures in colour: a grayscale presentation state is of grey ones."};
  const auto slices = slicesOf(presentation.pictures, series);
  if (!slices) return slices.error();
  const auto object = StudyObject::of(series, tags, progress, cancel, *slices);
  if (!object) return object.error();
  if (Status s = checkNames(series, *slices); !s) return s.error();
  std::map<std::string, const DicomSourceFile*> files;
  for (const DicomSourceFile& file : object->source().files) files[file.sopInstanceUid] = &file;
  if (Status s = checkParts(presentation, files); !s) return s.error();
  std::vector<ReferencedPicture> pictures = presentation.pictures;
  if (pictures.empty())
    for (const SourcePicture& picture : object->pictures())
      pictures.push_back({picture.sopInstanceUid, {}, {}, {}});
  PresentationElements elements(presentation, frame, files);
  DicomElements all = identification(presentation, object->tags());
  append(all, bodyPart(series));
  append(all, elements.all(pictures, series.seriesUid));
  DcmFileFormat file;
  object->put(UID_GrayscaleSoftcopyPresentationStateStorage, "PR", all, *file.getDataset());
  if (Status s = writeNewDicom(file, path, cancel); !s) return s.error();
  return elements.notes();
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path + ": there is not enough memory."};
}

}  // namespace volumen
