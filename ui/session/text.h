#pragma once

#include <QString>

#include "io/study.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// Text from a file as a person may read it: control characters become blanks, those that
/// reorder text are left out, blanks trimmed.
QString shownText(const std::string& utf8);

/// "Doe, Jane (12345)": DICOM's carets read as a name; "unknown patient" where a DICOM file names none; empty
/// for what has no patients.
QString patientText(const Series& series);

/// "2026-03-14 CT head": date and description of the study; "(no date)" where a DICOM file has neither.
QString studyText(const Series& series);

/// "CT Head 1.0 mm (3)": modality, description, number.
QString seriesText(const Series& series);

/// The unit of a volume's values: "HU" for CT, else empty.
QString valueUnit(const Volume& volume);

/// How many decimals tell values of this range apart: 1 for CT, more for what lies between 0 and 1.
int valueDecimals(const Histogram& histogram);

/// "2026-03-14" of DICOM's 20260314.
QString dateText(const std::string& dicomDate);

/// "10:22:31" of DICOM's 102231.25.
QString timeText(const std::string& dicomTime);

}  // namespace volumen
