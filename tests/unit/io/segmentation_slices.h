#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "io/open.h"
#include "tests/fixtures/chance.h"
#include "tests/unit/io/dicom_folder.h"
#include "viewer/segment/segmentation.h"
#include "viewer/segment/tissue_codes.h"

namespace volumen::tests {

/// A series of slices with random position and orientation, at `z` mm along its normal, and its drawn grid.
struct Slices {
  DicomFolder folder;
  Series series;
  VoxelGeometry grid;

  Slices(glm::ivec2 size, const std::vector<double>& z, Chance& chance) {
    const glm::dvec3 row = glm::normalize(chance.vector()),
                     column = glm::normalize(glm::cross(row, chance.vector()));
    const auto number = [](double x) { return QString::number(x, 'f', 9).toStdString(); };
    DicomPicture picture;
    picture.columns = size.x;
    picture.rows = size.y;
    picture.pixels = {7};
    picture.spacing = number(chance.between(0.3, 2)) + "\\" + number(chance.between(0.3, 2));
    picture.orientation.clear();
    for (const glm::dvec3 v : {row, column})
      for (int a = 0; a < 3; ++a)
        picture.orientation += (picture.orientation.empty() ? "" : "\\") + number(v[a]);
    const glm::dvec3 corner = 100.0 * chance.vector();
    for (std::size_t n = 0; n < z.size(); ++n) {
      picture.position = corner + z[n] * glm::cross(row, column);
      picture.instance = int(n) + 1;
      picture.edit = [](DcmDataset& data) {
        data.putAndInsertString(DCM_PatientID, "P1");
        data.putAndInsertString(DCM_StudyDescription, "Head");
        data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.7");
        data.putAndInsertString(DCM_ReferringPhysicianName, "Doctor^A");
      };
      folder.add(numbered("s", int(n)), picture);
    }
    const Study study = folder.open();
    if (study.volumes.size() != 1) return;
    series = study.volumes[0];
    grid = series.regular ? series.regular->geometry : series.acquired;
  }
  bool isThere() const { return !series.files.empty(); }
  std::string seg() const { return folder.path("out.seg.dcm"); }
};

/// Returns `count` positions, `step` mm apart.
inline std::vector<double> even(int count, double step) {
  std::vector<double> z;
  for (int n = 0; n < count; ++n) z.push_back(n * step);
  return z;
}

/// Returns random voxels, sometimes all of them, with empty slices.
inline BitMask randomMask(const VoxelGeometry& grid, Chance& chance) {
  BitMask mask(grid);
  const double share = chance.oneIn(4) ? 1 : chance.share();
  for (int k = 0; k < grid.size.z; ++k) {
    if (chance.oneIn(4)) continue;  // empty slices
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        if (chance.share() < share) mask.set({i, j, k});
  }
  return mask;
}

/// Returns a segment with random name, codes and colour.
inline Segment randomSegment(int number, Chance& chance) {
  const TissueCode& tissue = tissueCodes()[std::size_t(chance.below(int(tissueCodes().size())))];
  static const char* const names[] = {"Liver", "Knochen, größer", "心臓", "a 'b' \"c\"", "3"};
  Segment segment{.number = number, .label = names[chance.below(5)]};
  segment.category = tissue.category;
  segment.type = tissue.type;
  if (chance.oneIn(2)) segment.modifier = chance.oneIn(2) ? rightSide() : leftSide();
  segment.colour = glm::u8vec3(chance.below(256), chance.below(256), chance.below(256));
  if (chance.oneIn(2)) segment.algorithm = "Threshold";
  if (chance.oneIn(2))
    segment.region = {"39607008", "SCT", "Lung"}, segment.regionModifier = segment.modifier;
  for (int more = chance.below(3); more > 0; --more)
    segment.structures.push_back({{"10200004", "SCT", "Liver"}, more > 1 ? rightSide() : Code()});
  if (chance.oneIn(2))
    segment.algorithms.push_back({{"123109", "DCM", "Artificial Intelligence"},
                                  chance.oneIn(2) ? Code{"1", "99A", "Net"} : Code(),
                                  "NetSegmentor",
                                  "2.1",
                                  "-fast",
                                  "A maker"});
  if (!segment.algorithm.empty()) segment.algorithmType = SegmentAlgorithm(2 + chance.below(2));
  if (chance.oneIn(2))
    segment.trackingId = "Lesion 1", segment.trackingUid = "1.2.3." + std::to_string(number);
  return segment;
}

/// Returns the text of an attribute; empty if it is missing.
inline std::string attributeText(DcmItem& item, const DcmTagKey& tag) {
  OFString text;
  return item.findAndGetOFStringArray(tag, text).good() ? text.c_str() : "";
}

/// Returns item `n` of a sequence; null if it is missing.
inline DcmItem* itemOf(DcmItem* in, const DcmTagKey& tag, long n = 0) {
  DcmItem* item = nullptr;
  if (in) in->findAndGetSequenceItem(tag, item, n);
  return item;
}

/// Returns whether one of the sentences contains these words.
inline bool isSaid(const std::vector<std::string>& notes, const char* words) {
  return std::ranges::any_of(notes, [&](const std::string& n) { return n.find(words) != std::string::npos; });
}

}  // namespace volumen::tests
