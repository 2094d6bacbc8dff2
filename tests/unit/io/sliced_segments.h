#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTest>
#include <string>
#include <vector>

#include "io/export/export_segments.h"
#include "io/study/series.h"
#include "tests/unit/io/dicom_folder.h"
#include "viewer/segment/label_map.h"
#include "viewer/segment/tissue_codes.h"

namespace volumen::tests {

/// Six slices of 9 x 7 pixels of 1 mm, 2 mm apart, and segments on them.
struct Sliced {
  DicomFolder folder;
  Series series;
  VoxelGeometry grid;
  Segmented segments{{}, LabelMap(VoxelGeometry{})};

  Sliced() {
    for (int n = 0; n < 6; ++n) {
      DicomPicture picture = sliceAt(2.0 * n, 5);
      picture.columns = 9;
      picture.rows = 7;
      picture.spacing = "1\\1";
      picture.edit = [](DcmDataset& data) { data.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.3.7"); };
      folder.add(numbered("s", n), picture);
    }
    const Study study = folder.open();
    if (study.volumes.size() != 1) return;
    series = study.volumes[0];
    grid = series.acquired;
    LabelEdit edit{LabelMap(grid)};
    for (int k = 1; k < 5; ++k)
      for (int j = 1; j < 4; ++j)
        for (int i = 0; i < 9; ++i) edit.set({i, j, k}, std::uint8_t(i < 4 ? 1 : 2));
    segments = {{{.number = 1, .label = "Liver"}, {.number = 2, .label = "Größe"}}, edit.done()};
    for (Segment& segment : segments.segments) {
      segment.category = tissueCodes()[std::size_t(segment.number)].category;
      segment.type = tissueCodes()[std::size_t(segment.number)].type;
      segment.colour = glm::u8vec3(20, 30 * segment.number, 255);
    }
  }
  /// Writes the segments in the format of `ending`. Returns the path, or an empty text on failure.
  std::string write(const char* ending) {
    const std::string path = folder.path(std::string("out") + ending);
    return exportSegments(path, {&segments, 1}, series) ? path : std::string();
  }
};

/// Adds a column of file endings with a row for each.
inline void addEndings(const std::vector<const char*>& endings) {
  QTest::addColumn<QByteArray>("ending");
  for (const char* ending : endings) QTest::newRow(ending) << QByteArray(ending);
}

}  // namespace volumen::tests
